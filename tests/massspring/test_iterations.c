/* How many iterations plain and improved bisection take for the same accuracy (SPEC B.6, B.7; docs/theory/massspring_collision.md, section 2): over speeds, thresholds, angles and kinds of bodies;
 * against the ratio of way to threshold; and what the parts of the improved method are there for. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "support/claim.h"
#include "support/colliders.h"
#include "support/exact_geometry.h"
#include "support/validation.h"

static double distance_at(const cipc_collider *c, const double x[3], const double d[3], double t)
{
    double at[3];
    v3_copy(at, x);
    v3_axpy(at, t, d);
    return cipc_collider_distance(c, at, NULL);
}

/* A node on its way into a body. */
typedef struct flight {
    cipc_collider body;
    double x[3], d[3], threshold;
} flight;

/* Where a ray from the centre leaves the body, which is within 4 m: points of faces, since by chance a way hits no edge. */
static void random_surface_point(uint64_t *seed, const cipc_collider *body, double s[3], double normal[3])
{
    double u[3], inside = 0, outside = body->kind == CIPC_COLLIDER_PLANE ? 0 : 4;
    random_direction(seed, u);
    while (outside - inside > 1e-14) {
        const double t = 0.5 * (inside + outside);
        *(distance_at(body, body->center, u, t) < 0 ? &inside : &outside) = t;
    }
    v3_copy(s, body->center);
    v3_axpy(s, outside, u); /* of a plane: the point that it is given by */
    cipc_collider_distance(body, s, normal);
}

/* A way of the length given that meets the surface somewhere, at any part of it and at `angle` to the normal there, begins beyond the threshold and ends inside. False: none found. */
static bool random_flight(uint64_t *seed, double length, double angle, flight *w)
{
    for (int trial = 0; trial < 3000; trial++) {
        double s[3], n[3], u[3], aside[3];
        random_surface_point(seed, &w->body, s, n);
        random_direction(seed, u);
        v3_cross(aside, n, u);
        if (!(v3_norm(aside) > 0.1)) continue;
        v3_scale(w->d, length * sin(angle) / v3_norm(aside), aside);
        v3_axpy(w->d, -length * cos(angle), n);
        v3_copy(w->x, s);
        v3_axpy(w->x, -random_uniform(seed, 0, 1), w->d);
        if (cipc_collider_distance(&w->body, w->x, NULL) >= w->threshold && distance_at(&w->body, w->x, w->d, 1) < 0) return true;
    }
    return false;
}

static cipc_bisection_result stop(cipc_bisection_method method, const flight *w) { return cipc_bisection(method, &w->body, w->x, w->d, w->threshold); }

/* Improved bisection with parts of it left out, written anew: where interpolation aims at, whether an end that stays counts half, whether midpoints come after three bad interpolations. */
typedef struct variant {
    const char *name;
    double aim; /* part of the threshold */
    bool halves, safeguarded;
} variant;
enum { NEVER = 1000 };

static int iterations_of(const variant *v, const flight *w)
{
    const double aim = v->aim * w->threshold;
    double low = 0, high = 1, at_low = distance_at(&w->body, w->x, w->d, 0) - aim, at_high = distance_at(&w->body, w->x, w->d, 1) - aim, f = at_low, g = at_high, begin = 1;
    for (int k = 1, side = 0, bad = 0, halvings = 0, next = 1; k < NEVER; k++) {
        const bool middle = halvings > 0;
        double t = low + (high - low) * (f / (f - g));
        if (middle || !(t > low && t < high)) t = 0.5 * (low + high);
        const double distance = distance_at(&w->body, w->x, w->d, t);
        if (distance >= 0 && distance < w->threshold) return k;
        const int now = distance < 0 ? 1 : -1;
        if (now > 0) high = t, g = at_high = distance - aim;
        else low = t, f = at_low = distance - aim;
        if (middle) {
            halvings--, side = 0, bad = 0;
            f = at_low, g = at_high, begin = high - low;
            continue;
        }
        if (v->halves && side == now) *(now > 0 ? &f : &g) *= 0.5;
        side = now;
        if (high - low <= begin / pow(2, ++bad)) begin = high - low, bad = 0;
        else if (bad == 3 && v->safeguarded) halvings = next, next *= 3;
    }
    return NEVER;
}

/* ---- Over everything -------------------------------------------------------------------------------------------------------------------------- */

enum { SPEEDS = 5, THRESHOLDS = 7, ANGLES = 5, PER_CELL = 40 };
static const double degrees[ANGLES] = {0, 30, 60, 80, 89};

enum { BINS = 64 };

typedef struct tally {
    int ways, wrong_ends, beyond_bound, more, fewer;
    int most[2], total[2], with[2][BINS]; /* ways with k iterations */
} tally;

/* (8), of plain bisection's worst case. */
static int bound(int plain) { return plain + 5 + 3 * (int)floor(log(2 * plain - 1) / log(3) + 1e-9); }

static int most_of(int a, int b) { return a > b ? a : b; }

static void count_flight(tally *t, const flight *w)
{
    int iterations[2];
    for (int m = 0; m < 2; m++) {
        const cipc_bisection_result r = stop((cipc_bisection_method)m, w);
        t->wrong_ends += !(r.hit && r.distance >= 0 && r.distance < w->threshold && r.distance == distance_at(&w->body, w->x, w->d, r.t));
        iterations[m] = r.iterations;
        t->total[m] += r.iterations;
        t->most[m] = most_of(t->most[m], r.iterations);
        assert_true(r.iterations < BINS);
        t->with[m][r.iterations]++;
    }
    t->ways++;
    t->more += iterations[1] > iterations[0];
    t->fewer += iterations[1] < iterations[0];
    t->beyond_bound += iterations[1] > bound((int)ceil(log2(v3_norm(w->d) / w->threshold)));
}

/* Calls `count` with every way of the sweep. A way that is not longer along the normal than the threshold needs no iteration and is left out. */
static void sweep(cipc_collider_kind kind, void (*count)(void *, const flight *), void *context)
{
    uint64_t seed = 1 + (uint64_t)kind;
    for (int cell = 0; cell < SPEEDS * THRESHOLDS * ANGLES; cell++) {
        const double length = 0.01 * pow(10, cell % SPEEDS) / 60, angle = degrees[cell / SPEEDS % ANGLES] * acos(-1) / 180;
        flight w = {.threshold = pow(10, -2 - cell / (SPEEDS * ANGLES))};
        for (int sample = 0; sample < PER_CELL && length * cos(angle) > w.threshold; sample++) {
            w.body = random_collider(&seed, kind, 0.05);
            if (random_flight(&seed, length, angle, &w)) count(context, &w);
        }
    }
}

static void count_both(void *context, const flight *w) { count_flight(context, w); }

/* Iterations that 95 % of the ways do with. */
static int most_of_95(const tally *t, int method)
{
    int k = 0;
    for (int sum = t->with[method][0]; sum < 0.95 * t->ways; k++) sum += t->with[method][k + 1];
    return k;
}

static double mean(const tally *t, int method) { return (double)t->total[method] / t->ways; }

static void add(tally *sum, const tally *t)
{
    sum->ways += t->ways;
    sum->wrong_ends += t->wrong_ends;
    sum->beyond_bound += t->beyond_bound;
    sum->more += t->more;
    sum->fewer += t->fewer;
    for (int m = 0; m < 2; m++) {
        sum->total[m] += t->total[m];
        sum->most[m] = most_of(sum->most[m], t->most[m]);
        for (int k = 0; k < BINS; k++) sum->with[m][k] += t->with[m][k];
    }
}

static void report_kind(const char *name, const tally *t)
{
    print_message("%-8s %5d ways: plain %5.2f in the mean, 95 %% within %2d, most %2d; improved %5.2f, %2d, %2d; fewer on %d, more on %d\n", name, t->ways, mean(t, 0),
                  most_of_95(t, 0), t->most[0], mean(t, 1), most_of_95(t, 1), t->most[1], t->fewer, t->more);
}

static void test_over_everything(void **state)
{
    (void)state;
    tally all = {0}, of[COLLIDER_KINDS] = {{0}};
    double worst = 0;
    for (int kind = 0; kind < COLLIDER_KINDS; kind++) {
        char scene[64];
        sweep((cipc_collider_kind)kind, count_both, &of[kind]);
        report_kind(collider_names[kind], &of[kind]);
        assert_true(of[kind].ways > 2000);
        (void)snprintf(scene, sizeof scene, "bisection: sweep, %s (B2)", collider_names[kind]);
        validation_range(scene, "iterations of the improved method over those of plain bisection", 0, 0.5, mean(&of[kind], 1) / mean(&of[kind], 0));
        worst = fmax(worst, mean(&of[kind], 1));
        add(&all, &of[kind]);
    }
    report_kind("all", &all);
    claim_figure("B2", "0.01 to 100 m/s, thresholds 1e-2 to 1e-8 m, 0 to 89 degrees, five kinds of bodies: ways", all.ways, "1", CLAIM_AT_LEAST, 10000);
    claim_figure("B2", "the same: ends of either method not at 0 <= distance < threshold", all.wrong_ends, "1", CLAIM_EQUAL, 0);
    claim_figure("B2", "the same: iterations of plain bisection, mean", mean(&all, 0), "1", CLAIM_MORE, 10);
    claim_figure("B2", "the same: iterations of the improved method, mean", mean(&all, 1), "1", CLAIM_LESS, 3.5);
    claim_figure("B2", "the same, of the worst kind of body", worst, "1", CLAIM_LESS, 5);
    claim_figure("B2", "the same: iterations that 95 % of the ways do with, plain bisection", most_of_95(&all, 0), "1", CLAIM_AT_LEAST, 20);
    claim_figure("B2", "the same: iterations that 95 % of the ways do with, improved method", most_of_95(&all, 1), "1", CLAIM_LESS, 15);
    claim_figure("B2", "the same: part of the ways on which the improved method takes more", (double)all.more / all.ways, "1", CLAIM_LESS, 0.08);
    claim_figure("B2", "the same: most iterations of the improved method less most of plain bisection", all.most[1] - all.most[0], "1", CLAIM_LESS, 0);
    claim_figure("B2", "the same: ways on which it takes more than N + 5 + 3 log3(2 N - 1), N = ceil(log2(|d|/threshold))", all.beyond_bound, "1", CLAIM_EQUAL, 0);
    claim_figure("B2", "planes: iterations of the improved method, most", of[CIPC_COLLIDER_PLANE].most[1], "1", CLAIM_EQUAL, 1);
}

/* ---- Against the ratio of way to threshold ------------------------------------------------------------------------------------------------------ */

/* Of a surface anywhere on the way, beyond the threshold from its beginning, the chance that k midpoints do not do is 1 - 2^k/ratio. */
static double mean_on_planes(int log2_ratio) { return (log2_ratio - 1 + ldexp(1, -log2_ratio)) / (1 - ldexp(1, -log2_ratio)); }

enum { RATIOS = 26, PER_RATIO = 2000 };

static tally tally_at_ratio(cipc_collider_kind kind, int log2_ratio)
{
    const double length = 0.4, angle = acos(-1) / 4;
    uint64_t seed = 100 + (uint64_t)log2_ratio;
    tally t = {0};
    flight w = {.threshold = ldexp(length * cos(angle), -log2_ratio)};
    while (t.ways < PER_RATIO) {
        w.body = random_collider(&seed, kind, 0.25);
        if (random_flight(&seed, length, angle, &w)) count_flight(&t, &w);
    }
    return t;
}

static void test_against_the_ratio(void **state)
{
    (void)state;
    for (int k = 1; k <= RATIOS; k++) {
        const tally plane = tally_at_ratio(CIPC_COLLIDER_PLANE, k), sphere = tally_at_ratio(CIPC_COLLIDER_SPHERE, k);
        const double ratio = ldexp(1, k), deviation = sqrt(2.0 / PER_RATIO); /* the variance is below 2, that of a geometric distribution */
        print_message("|d.n|/m = 2^%d: plane %.2f (expected %.2f) and %.2f; sphere %.2f, most %d, and %.2f, most %d\n", k, mean(&plane, 0), mean_on_planes(k), mean(&plane, 1),
                      mean(&sphere, 0), sphere.most[0], mean(&sphere, 1), sphere.most[1]);
        validation_point("bisection", "most on planes: log2(|d.n|/m)", ratio, k);
        validation_point("bisection", "plane, plain", ratio, mean(&plane, 0));
        validation_point("bisection", "plane, improved", ratio, mean(&plane, 1));
        validation_point("bisection", "sphere, plain", ratio, mean(&sphere, 0));
        validation_point("bisection", "sphere, improved", ratio, mean(&sphere, 1));
        assert_int_equal(plane.most[0], k);
        assert_int_equal(plane.most[1], 1);
        assert_true(fabs(mean(&plane, 0) - mean_on_planes(k)) <= 5 * deviation);
        assert_true(k < 5 || mean(&sphere, 1) < mean(&sphere, 0));
        if (k % 10) continue;
        char scene[96];
        (void)snprintf(scene, sizeof scene, "bisection: planes, threshold 2^-%d of the way along the normal (B2)", k);
        validation_row(scene, "iterations of plain bisection, most", k, plane.most[0], DBL_EPSILON);
        validation_row(scene, "iterations of plain bisection, mean", mean_on_planes(k), mean(&plane, 0), 5 * deviation / mean_on_planes(k));
        validation_row(scene, "iterations of the improved method, most", 1, plane.most[1], DBL_EPSILON);
    }
}

/* ---- What the parts are for --------------------------------------------------------------------------------------------------------------------- */

enum { VARIANTS = 6 };
static const variant variants[VARIANTS] = {
    {"as it is", 0.5, true, true},
    {"no halving", 0.5, false, true},
    {"no halving, no midpoints", 0.5, false, false},
    {"aims at the surface", 0, true, true},
    {"aims at the surface, no halving, no midpoints", 0, false, false}, /* regula falsi */
    {"no midpoints", 0.5, true, false},
};
typedef struct comparison {
    int ways, total[VARIANTS], most[VARIANTS], never[VARIANTS];
} comparison;

static void count_variants(void *context, const flight *w)
{
    comparison *c = context;
    c->ways++;
    for (int v = 0; v < VARIANTS; v++) {
        const int iterations = iterations_of(&variants[v], w);
        if (v == 0) assert_int_equal(iterations, stop(CIPC_BISECTION_IMPROVED, w).iterations);
        c->never[v] += iterations == NEVER;
        c->total[v] += iterations;
        c->most[v] = most_of(c->most[v], iterations);
    }
}

static comparison compare_on(cipc_collider_kind kind)
{
    comparison c = {0};
    sweep(kind, count_variants, &c);
    for (int v = 0; v < VARIANTS; v++)
        print_message("%-7s %-46s %6.2f in the mean, most %4d, no end on %d of %d\n", collider_names[kind], variants[v].name, (double)c.total[v] / c.ways, c.most[v], c.never[v], c.ways);
    return c;
}

/* The distance along the way is convex and its chords lie above it: regula falsi that aims at the surface only finds points inside, until rounding helps, or never. On planes too it is then a
 * matter of rounding. */
static void test_what_the_parts_are_for(void **state)
{
    (void)state;
    const comparison spheres = compare_on(CIPC_COLLIDER_SPHERE), planes = compare_on(CIPC_COLLIDER_PLANE);
    for (int kind = CIPC_COLLIDER_BOX; kind < COLLIDER_KINDS; kind++) (void)compare_on((cipc_collider_kind)kind);
    assert_true(spheres.never[0] == 0 && planes.total[0] == planes.ways);
    assert_true(1.1 * spheres.total[0] < spheres.total[1] && 3 * spheres.total[0] < spheres.total[2]); /* without halving */
    assert_true(1.2 * spheres.total[0] < spheres.total[3] && 1.2 * planes.total[0] < planes.total[3]); /* aiming at the surface */
    assert_true(spheres.never[4] > 100 && 10 * spheres.total[0] < spheres.total[4]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_over_everything),
        cmocka_unit_test(test_against_the_ratio),
        cmocka_unit_test(test_what_the_parts_are_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
