/* Campaign "distance": squared distances, closest features and derivatives against the exact oracle (SPEC V.2, V.6; docs/theory/tolerances.md). */
#include "verify/distance.h"

#include <math.h>
#include <string.h>

#include "verify/condition.h"
#include "verify/query.h"
#include "verify/stencils.h"

enum { DERIVATIVE_EVERY = 16 }; /* of the samples have their derivatives checked too: MPFR differences cost a hundred times an exact distance */

static cipc_feature solver_feature(cipc_pair_kind kind, const double *x)
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_feature_at(CIPC_POINT_POINT, 0);
    case CIPC_POINT_EDGE: return cipc_point_edge_feature(x);
    case CIPC_POINT_TRIANGLE: return cipc_point_triangle_feature(x);
    default: return cipc_edge_edge_feature(x);
    }
}
const verify_distance_subject verify_distance_of_the_solver = {solver_feature, cipc_distance2_value, cipc_distance2_gradient, cipc_distance2_hessian};

/* --- samples --- */

static void nodes_at_random(gsl_rng *rng, double *x, int n)
{
    for (int i = 0; i < n; i++) x[i] = verify_uniform(rng, -1, 1);
}

static void draw_random(gsl_rng *rng, cipc_pair_kind kind, double *x) { nodes_at_random(rng, x, 3 * cipc_pair_nodes(kind)); }

static void place(gsl_rng *rng, cipc_pair_kind kind, const verify_shape *shape, double *x)
{
    cipc_stencil_path path;
    verify_place(rng, kind, shape, &path);
    memcpy(x, path.x, sizeof path.x);
}

/* Edges or a triangle's sides at angles over sixteen orders of magnitude. */
static void draw_flat(gsl_rng *rng, cipc_pair_kind kind, double *x)
{
    verify_shape s = verify_shape_default();
    s.angle = verify_log_uniform(rng, 1e-16, 1);
    s.gap = verify_chance(rng, 0.2) ? 0 : verify_log_uniform(rng, 1e-16, 1);
    s.aligned = verify_chance(rng, 0.3);
    place(rng, kind, &s, x);
}

/* Closest points next to an end or a side. */
static void draw_border(gsl_rng *rng, cipc_pair_kind kind, double *x)
{
    verify_shape s = verify_shape_default();
    s.foot = verify_log_uniform(rng, 1e-17, 1e-3);
    s.gap = verify_log_uniform(rng, 1e-12, 1);
    s.angle = verify_uniform(rng, 0.01, 1.5);
    s.aligned = verify_chance(rng, 0.3);
    place(rng, kind, &s, x);
}

static void draw_close(gsl_rng *rng, cipc_pair_kind kind, double *x)
{
    verify_shape s = verify_shape_default();
    s.gap = verify_log_uniform(rng, 1e-16, 1e-3);
    s.angle = verify_uniform(rng, 0.01, 1.5);
    s.offset = verify_chance(rng, 0.5) ? verify_log_uniform(rng, 1, 1e6) : 0;
    place(rng, kind, &s, x);
}

static void draw_scaled(gsl_rng *rng, cipc_pair_kind kind, double *x)
{
    verify_shape s = verify_shape_default();
    s.size = verify_log_uniform(rng, 1e-12, 1e12);
    s.gap = verify_log_uniform(rng, 1e-9, 10);
    s.angle = verify_uniform(rng, 0.01, 1.5);
    place(rng, kind, &s, x);
}

/* Small whole numbers: coincident, collinear, coplanar, parallel; zero lengths and areas. */
static void draw_degenerate(gsl_rng *rng, cipc_pair_kind kind, double *x)
{
    for (int i = 0; i < 3 * cipc_pair_nodes(kind); i++) x[i] = verify_index(rng, 4) - 1;
    if (verify_chance(rng, 0.3)) memcpy(x + 3, x + 3 * verify_index(rng, cipc_pair_nodes(kind)), 3 * sizeof *x);
    if (verify_chance(rng, 0.2)) x[verify_index(rng, 3 * cipc_pair_nodes(kind))] += verify_log_uniform(rng, 1e-16, 1e-8);
}

static void (*const draws[])(gsl_rng *, cipc_pair_kind, double *) = {draw_random, draw_flat, draw_border, draw_close, draw_scaled, draw_degenerate};
static const char *const draw_names[] = {"random", "angles 1e-16..1", "next to ends and sides", "gaps 1e-16..1e-3, far away", "sizes 1e-12..1e12",
                                         "degenerate"};
enum { DRAW_COUNT = sizeof draws / sizeof draws[0] };

/* Rows: every kind in every class. */
enum { OUTSIDE = CIPC_FEATURE_LIMIT, NOT_FINITE, DERIVATIVES, ILL_POSED, UNDECIDED };

static void describe(int index, verify_row *row)
{
    char name[VERIFY_NAME];
    cipc_pair_kind kind = (cipc_pair_kind)(index / DRAW_COUNT);
    bool everywhere = index % DRAW_COUNT == 0; /* random nodes reach every feature */
    snprintf(name, sizeof name, "%.14s, %.30s", cipc_pair_name(kind), draw_names[index % DRAW_COUNT]);
    verify_row_init(row, name);
    for (int f = 0; f < CIPC_FEATURE_LIMIT; f++) {
        bool known = f < cipc_feature_count(kind);
        verify_row_branch(row, known ? cipc_feature_name(kind, f) : "-", known && everywhere ? 0.01 : 0);
    }
    verify_row_counter(row, "feature of a tie or next to one");
    verify_row_forbid(row, "not finite");
    verify_row_counter(row, "derivatives checked");
    verify_row_counter(row, "Hessian not determined by doubles");
    verify_row_forbid(row, "derivatives undecided by the oracle");
    verify_row_maximum(row, "d, ULP of the stencil's size", VERIFY_DISTANCE_ULPS);
    verify_row_maximum(row, "gradient, error over tolerance", 1);
    verify_row_maximum(row, "Hessian, error over tolerance", 1);
}

static void gather(const cipc_feature *feature, const double *x, double *y)
{
    for (int i = 0; i < feature->count; i++) memcpy(y + 3 * i, x + 3 * feature->local[i], 3 * sizeof *y);
}

/* Derivatives of the feature's smooth distance. Tolerances (5), (6): how fast the oracle's own gradient and Hessian change with the nodes. */
static void check_derivatives(const cipc_feature *feature, const double *y, const verify_distance_subject *subject, unsigned long random, long sample,
                              verify_row *row, const cipc_query *query)
{
    static const char *const names[CIPC_PAIR_KIND_COUNT] = {"distance2_point_point", "distance2_point_line", "distance2_point_plane", "distance2_line_line"};
    const cipc_oracle_function *f = cipc_oracle_function_find(names[feature->kind]);
    double g[12], H[144], want_g[12], want_H[144], size = 0;
    int n = 3 * feature->count;
    for (int i = 0; i < n; i++) size = fmax(size, fabs(y[i] - y[i % 3]));
    if (cipc_oracle_evaluate(f, y, NULL, NULL, want_g, want_H) != CIPC_YES) {
        verify_count(row, UNDECIDED, sample, NULL);
        return;
    }
    double change = verify_hessian_change(f, y, NULL, want_g, want_H, size, random);
    if (change == INFINITY) { /* rounding the nodes changes everything: no answer in doubles could be right */
        verify_count(row, ILL_POSED, sample, NULL);
        return;
    }
    subject->gradient(feature->kind, y, g);
    subject->hessian(feature->kind, y, H);
    double g_tolerance = VERIFY_ROUNDINGS * VERIFY_UNIT * (verify_largest(want_g, n) + verify_largest(want_H, n * n) * size);
    double H_tolerance = VERIFY_ROUNDINGS * VERIFY_UNIT * (verify_largest(want_H, n * n) + change);
    verify_count(row, DERIVATIVES, sample, NULL);
    verify_measure(row, 1, verify_over(verify_largest_error(g, want_g, n), g_tolerance), sample, query);
    verify_measure(row, 2, verify_over(verify_largest_error(H, want_H, n * n), H_tolerance), sample, query);
}

static void sample(int index, gsl_rng *rng, long number, verify_row *row, const void *context)
{
    static const char *const names[CIPC_PAIR_KIND_COUNT] = {"distance2_point_point", "distance2_point_edge", "distance2_point_triangle", "distance2_edge_edge"};
    const verify_distance_subject *subject = context;
    cipc_pair_kind kind = (cipc_pair_kind)(index / DRAW_COUNT);
    cipc_query query = {.fn = names[kind]};
    double x[12] = {0}, y[12] = {0}, size = 0;
    unsigned features;
    draws[index % DRAW_COUNT](rng, kind, x);
    memcpy(query.x, x, sizeof x);
    for (int i = 0; i < 3 * cipc_pair_nodes(kind); i++) size = fmax(size, fabs(x[i] - x[i % 3]));
    double d = cipc_exact_distance_gap(kind, x, 0);
    cipc_exact_distance2(kind, x, &features);
    cipc_feature feature = subject->feature(kind, x);
    int named = cipc_feature_index(kind, &feature);
    gather(&feature, x, y);
    double d2 = subject->value(feature.kind, y);
    if (!isfinite(d2) || d2 < 0 || named < 0) {
        verify_count(row, NOT_FINITE, number, &query);
        return;
    }
    verify_count(row, named, number, NULL);
    if (!(features >> named & 1)) verify_count(row, OUTSIDE, number, NULL);
    double error = fabs(sqrt(d2) - d);
    verify_measure(row, 0, error == 0 ? 0 : error / (2 * VERIFY_UNIT * size), number, &query);
    if (number % DERIVATIVE_EVERY == 0) check_derivatives(&feature, y, subject, gsl_rng_uniform_int(rng, 1UL << 24), number, row, &query);
}

const verify_campaign verify_distance = {"distance", CIPC_PAIR_KIND_COUNT * DRAW_COUNT, describe, sample, &verify_distance_of_the_solver, 0.1};
