/* Campaign "intersection": the exact predicates of src/geometry against the exact oracle, which shares no code with them (SPEC V.5 M1). */
#include "verify/intersection.h"

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "verify/stencils.h"

const verify_intersection_subject verify_intersection_of_the_solver = {cipc_edge_triangle_intersect, cipc_orient3d};

/* Small whole numbers, where everything touches and is coplanar, with a last bit now and then. */
static void draw_lattice(gsl_rng *rng, double x[15])
{
    for (int k = 0; k < 15; k++) {
        x[k] = verify_index(rng, 4) - 1;
        if (verify_chance(rng, 0.1)) x[k] = nextafter(x[k], verify_chance(rng, 0.5) ? -2 : 2);
    }
}

static void draw_random(gsl_rng *rng, double x[15])
{
    for (int k = 0; k < 15; k++) x[k] = verify_uniform(rng, -1, 1);
}

/* An end of the edge next to the triangle, its sides or its corners, at a distance of rounding; anywhere in the world. */
static void draw_near(gsl_rng *rng, double x[15])
{
    double w[3] = {verify_uniform(rng, 0, 1), verify_uniform(rng, 0, 1), verify_uniform(rng, 0, 1)}, sum = 0, shift = verify_chance(rng, 0.5) ? 1e6 : 0;
    draw_random(rng, x);
    for (int k = 0; k < 15; k++) x[k] += shift;
    for (int i = 0; i < 3; i++) {
        if (verify_chance(rng, 0.3)) w[i] = 0;
        sum += w[i];
    }
    for (int k = 0; k < 3 && sum > 0; k++) {
        x[k] = (w[0] * x[6 + k] + w[1] * x[9 + k] + w[2] * x[12 + k]) / sum;
        if (verify_chance(rng, 0.3)) x[k] = nextafter(x[k], verify_chance(rng, 0.5) ? -1e9 : 1e9);
    }
}

static void draw_scaled(gsl_rng *rng, double x[15])
{
    int e = verify_index(rng, 601) - 300;
    draw_lattice(rng, x);
    for (int k = 0; k < 15; k++) x[k] = ldexp(x[k], e);
}

static void (*const draws[])(gsl_rng *, double *) = {draw_random, draw_lattice, draw_near, draw_scaled};
static const char *const names[] = {"edge-triangle, random", "edge-triangle, lattice", "edge-triangle, next to contact", "edge-triangle, sizes 2^-300..2^300",
                                    "orient3d, random",      "orient3d, lattice",      "orient3d, next to coplanar",     "orient3d, sizes 2^-300..2^300"};
enum { DRAW_COUNT = 4, WRONG = 0, YES, NO, ZERO };

static void describe(int index, verify_row *row)
{
    bool orient = index >= DRAW_COUNT, random = index % DRAW_COUNT == 0;
    verify_row_init(row, names[index]);
    verify_row_forbid(row, "wrong");
    verify_row_branch(row, orient ? "positive" : "meet", 0.02);
    verify_row_branch(row, orient ? "negative" : "apart", 0.02);
    verify_row_branch(row, "zero", orient && !random ? 0.01 : 0);
}

static void sample(int index, gsl_rng *rng, long number, verify_row *row, const void *context)
{
    const verify_intersection_subject *subject = context;
    bool orient = index >= DRAW_COUNT;
    cipc_query query = {.fn = orient ? "orient3d" : "intersect_edge_triangle"};
    double x[15];
    draws[index % DRAW_COUNT](rng, x);
    memcpy(query.x, x, sizeof x);
    if (orient) {
        int want = cipc_exact_orientation(x, x + 3, x + 6, x + 9), got = subject->orient3d(x, x + 3, x + 6, x + 9);
        verify_count(row, want > 0 ? YES : want < 0 ? NO : ZERO, number, NULL);
        if (got != want) verify_count(row, WRONG, number, &query);
    } else {
        bool want = cipc_exact_edge_triangle(x, x + 6) == CIPC_YES, got = subject->meet(x, x + 6);
        verify_count(row, want ? YES : NO, number, NULL);
        if (got != want) verify_count(row, WRONG, number, &query);
    }
}

const verify_campaign verify_intersection = {"intersection", 2 * DRAW_COUNT, describe, sample, &verify_intersection_of_the_solver, 0.5};
