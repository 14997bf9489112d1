/* Additive CCD against exact distances (GMP) and against roots of the coplanarity polynomial (GSL): never past an impact, never below
 * the lower bound, exact head-on, and indifferent to common motion and to the place in the world. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_poly.h>

#include "cipc/contact.h"
#include "support/exact_geometry.h"

static const int node_count[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4}, first_count[CIPC_PAIR_KIND_COUNT] = {1, 1, 1, 2};

/* Slackness of all examples. */
#define SLACKNESS 0.1

/* Distances of stencils of size S are good to some u S (docs/theory/distance.md 6.3: 7 u S); positions add as much again. */
#define DISTANCE_ROUNDING (32 * UNIT_ROUNDOFF)

/* A relative error: the few operations from distances to times. */
static const double ROUNDINGS = 64 * UNIT_ROUNDOFF;

typedef struct ccd_query {
    cipc_pair_kind kind;
    double x[12], p[12], xi, t_max;
} ccd_query;

static cipc_ccd_result solve(const ccd_query *q, bool gap_first)
{
    cipc_ccd_options options = cipc_ccd_options_default();
    options.gap_first = gap_first;
    return cipc_additive_ccd(q->kind, q->x, q->p, q->xi, q->t_max, &options);
}

/* d - xi at x + t p, computed exactly and then rounded. */
static double exact_gap(const ccd_query *q, double t)
{
    mpq_t y[12], displacement[12], time, best;
    int n = 3 * node_count[q->kind];
    q_init(y, 12), q_init(displacement, 12), mpq_inits(time, best, NULL);
    q_set(y, q->x, n), q_set(displacement, q->p, n), mpq_set_d(time, t);
    for (int i = 0; i < n; i += 3) q_axpy(y + i, time, displacement + i);
    exact_minimum(best, q->kind, y);
    double gap = sqrt(mpq_get_d(best)) - q->xi;
    q_clear(y, 12), q_clear(displacement, 12), mpq_clears(time, best, NULL);
    return gap;
}

/* l_p of SPEC C.5. */
static double largest_approach(const ccd_query *q)
{
    double mean[3] = {0, 0, 0}, most[2] = {0, 0};
    int n = node_count[q->kind];
    for (int i = 0; i < 3 * n; i++) mean[i % 3] += q->p[i] / n;
    for (int i = 0; i < n; i++) {
        double r[3] = {q->p[3 * i] - mean[0], q->p[3 * i + 1] - mean[1], q->p[3 * i + 2] - mean[2]};
        double *side = &most[i >= first_count[q->kind]];
        *side = fmax(*side, norm3(r));
    }
    return most[0] + most[1];
}

enum { GENERAL, THICK, NEARLY_PARALLEL, TINY_GAP, SMALL_MOTION, FAMILIES };

/* Let the first primitive fly towards the middle of the second. */
static void aim(ccd_query *q)
{
    int n = node_count[q->kind], first = first_count[q->kind];
    double middle[2][3] = {{0}};
    for (int i = 0; i < 3 * n; i++) middle[i >= 3 * first][i % 3] += q->x[i] / (i >= 3 * first ? n - first : first);
    for (int i = 0; i < 3 * first; i++) q->p[i] += middle[1][i % 3] - middle[0][i % 3];
}

/* A query of a family, at a distance larger than xi. */
static ccd_query draw(uint64_t *seed, cipc_pair_kind kind, int family)
{
    ccd_query q = {.kind = kind, .t_max = 1};
    int n = 3 * node_count[kind];
    random_fill(seed, q.x, n, 1);
    random_fill(seed, q.p, n, family == SMALL_MOTION ? 0.2 : 1);
    if (family != SMALL_MOTION) aim(&q);
    if (family == NEARLY_PARALLEL && n == 12) /* the last edge along the one before it, but for a thousandth */
        for (int k = 0; k < 3; k++) q.x[9 + k] = q.x[6 + k] + (q.x[3 + k] - q.x[k]) + random_uniform(seed, -1e-3, 1e-3);
    double distance = exact_true_distance(kind, q.x);
    if (family == THICK) q.xi = random_uniform(seed, 0, 1) * distance;
    if (family == TINY_GAP) q.xi = distance * (1 - pow(10, random_uniform(seed, -9, -1)));
    return q;
}

/* Between two evaluations the gap shrinks at most by the factor s, and every evaluation but the last shows at least s of the first gap:
 * so it is at least s^2 of it all the way. Every hit comes after the lower bound (eq. 16), and right before a place where less than s
 * is left. */
static void check_query(const ccd_query *q)
{
    enum { PLACES = 9 };
    cipc_ccd_result r = solve(q, false);
    double first = exact_gap(q, 0), lp = largest_approach(q),
           rounding = DISTANCE_ROUNDING * (stencil_size(q->x, 3 * node_count[q->kind]) + lp + q->xi);
    assert_false(r.capped);
    for (int i = 0; i < PLACES; i++) {
        double t = r.toi * i / (PLACES - 1), gap = exact_gap(q, t);
        if (!(gap >= SLACKNESS * SLACKNESS * first - rounding)) fail_msg("gap %g of %g at t = %.17g of %.17g", gap, first, t, r.toi);
        if (first > 1e4 * rounding) assert_true(gap > 0);
    }
    assert_true(r.toi >= fmin(q->t_max, (1 - SLACKNESS) * (first - rounding) / lp * (1 - ROUNDINGS)));
    if (!r.hit) {
        assert_true(r.toi == q->t_max);
        return;
    }
    double next = r.toi + (1 - SLACKNESS) * exact_gap(q, r.toi) / lp;
    assert_true(next <= q->t_max * (1 + ROUNDINGS) + rounding / lp);
    assert_true(exact_gap(q, next) < SLACKNESS * first + 2 * rounding);
}

static void test_is_conservative(void **state)
{
    (void)state;
    enum { QUERIES = 60 };
    uint64_t seed = 201;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++)
        for (int family = 0; family < FAMILIES; family++) {
            int hits = 0;
            for (int i = 0; i < QUERIES; i++) {
                ccd_query q = draw(&seed, (cipc_pair_kind)kind, family);
                check_query(&q);
                hits += solve(&q, false).hit;
            }
            if (family == THICK || family == TINY_GAP) assert_true(hits >= QUERIES / 4); /* not vacuous */
        }
}

/* ---- Impact times without any distance: roots of det[u, a, b](t), with the foot inside. ---- */

static void line_of_motion(const ccd_query *q, int to, int from, double v[6])
{
    for (int k = 0; k < 3; k++) {
        v[k] = q->x[3 * to + k] - q->x[3 * from + k];
        v[3 + k] = q->p[3 * to + k] - q->p[3 * from + k];
    }
}

static double determinant(const double *u, const double *a, const double *b)
{
    return u[0] * (a[1] * b[2] - a[2] * b[1]) + u[1] * (a[2] * b[0] - a[0] * b[2]) + u[2] * (a[0] * b[1] - a[1] * b[0]);
}

/* u, a, b of the stencil as lines of motion: point-triangle p - t0, t1 - t0, t2 - t0; edges a0 - b0, a1 - a0, b1 - b0. */
static void frame_motion(const ccd_query *q, double v[3][6])
{
    bool plane = q->kind == CIPC_POINT_TRIANGLE;
    line_of_motion(q, 0, plane ? 1 : 2, v[0]);
    line_of_motion(q, plane ? 2 : 1, plane ? 1 : 0, v[1]);
    line_of_motion(q, 3, plane ? 1 : 2, v[2]);
}

/* Is the point of contact at t inside both primitives, by this margin of their parameters? */
static bool inside(const ccd_query *q, double v[3][6], double t, double margin)
{
    double w[3][3], aa = 0, ab = 0, bb = 0, au = 0, bu = 0;
    for (int i = 0; i < 9; i++) w[i / 3][i % 3] = v[i / 3][i % 3] + t * v[i / 3][3 + i % 3];
    for (int k = 0; k < 3; k++) {
        aa += w[1][k] * w[1][k], ab += w[1][k] * w[2][k], bb += w[2][k] * w[2][k];
        au += w[1][k] * w[0][k], bu += w[2][k] * w[0][k];
    }
    double beta = (au * bb - bu * ab) / (aa * bb - ab * ab), gamma = (bu * aa - au * ab) / (aa * bb - ab * ab);
    if (q->kind == CIPC_POINT_TRIANGLE) return beta > margin && gamma > margin && beta + gamma < 1 - margin;
    return -beta > margin && -beta < 1 - margin && gamma > margin && gamma < 1 - margin;
}

/* First certain impact in (0, 1), or INFINITY. */
static double first_impact(const ccd_query *q)
{
    static const double MARGIN = 1e-3; /* far more than the roots' error */
    double v[3][6], c[4] = {0, 0, 0, 0}, roots[3];
    frame_motion(q, v);
    for (int bits = 0; bits < 8; bits++) {
        int moving[3] = {bits & 1, bits >> 1 & 1, bits >> 2 & 1};
        c[moving[0] + moving[1] + moving[2]] += determinant(v[0] + 3 * moving[0], v[1] + 3 * moving[1], v[2] + 3 * moving[2]);
    }
    int count = gsl_poly_solve_cubic(c[2] / c[3], c[1] / c[3], c[0] / c[3], &roots[0], &roots[1], &roots[2]);
    double first = INFINITY;
    for (int i = 0; i < count; i++)
        if (roots[i] > 0 && roots[i] < 1 && inside(q, v, roots[i], MARGIN)) first = fmin(first, roots[i]);
    return first;
}

/* The root itself is good to 1e-10 here, the step stays at least a hundredth of the gap away. */
static void test_stops_before_every_impact(void **state)
{
    (void)state;
    uint64_t seed = 202;
    for (int kind = CIPC_POINT_TRIANGLE; kind <= CIPC_EDGE_EDGE; kind++) {
        int impacts = 0;
        for (int i = 0; i < 20000; i++) {
            ccd_query q = draw(&seed, (cipc_pair_kind)kind, i % 2 ? GENERAL : NEARLY_PARALLEL);
            double impact = first_impact(&q);
            if (impact == INFINITY) continue;
            impacts++;
            for (int gap_first = 0; gap_first < 2; gap_first++) {
                cipc_ccd_result r = solve(&q, gap_first);
                if (!r.hit || !(r.toi < impact)) fail_msg("impact at %.17g, step %.17g", impact, r.toi);
                assert_true(r.toi > 0);
            }
        }
        assert_true(impacts >= 500);
    }
}

/* ---- Known answers. ---- */

/* Two primitives face each other across the plane z = 0 at distance 1 and approach at speed P: the first moves alone. */
static ccd_query head_on(cipc_pair_kind kind, double speed, double xi)
{
    static const double stencils[CIPC_PAIR_KIND_COUNT][12] = {
        {0, 0, 1, 0, 0, 0}, {0, 0, 1, -1, 0, 0, 1, 0, 0}, {0, 0, 1, -1, -1, 0, 2, -1, 0, 0, 2, 0}, {-1, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 0}};
    ccd_query q = {.kind = kind, .xi = xi, .t_max = 1};
    memcpy(q.x, stencils[kind], sizeof q.x);
    for (int i = 0; i < first_count[kind]; i++) q.p[3 * i + 2] = -speed;
    return q;
}

/* (1 - s)(d - xi)/P: the first step leaves s of the gap, the second would leave less (SPEC C.5). */
static void test_head_on(void **state)
{
    (void)state;
    static const double speeds[] = {1, 2, 1000}, thicknesses[] = {0, 0.25, 0.9};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++)
        for (int i = 0; i < 9; i++) {
            double P = speeds[i / 3], xi = thicknesses[i % 3], want = (1 - SLACKNESS) * (1 - xi) / P;
            ccd_query q = head_on((cipc_pair_kind)kind, P, xi);
            for (int gap_first = 0; gap_first < 2; gap_first++) {
                cipc_ccd_result r = solve(&q, gap_first);
                assert_true(r.hit && !r.capped);
                assert_true(fabs(r.toi - want) <= ROUNDINGS * want);
            }
        }
}

/* Where the two orders of the tests differ: the path ends after (1 - s) of the way to contact, but before s (1 - s) more. */
static void test_early_hits(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        ccd_query q = head_on((cipc_pair_kind)kind, 1, 0);
        q.t_max = 0.95;
        cipc_ccd_result certified = solve(&q, false), early = solve(&q, true);
        assert_true(!certified.hit && certified.toi == q.t_max);
        assert_true(early.hit && fabs(early.toi - 0.9) <= ROUNDINGS);
        q.t_max = 0.89; /* the first step is never a hit */
        assert_true(!solve(&q, false).hit && !solve(&q, true).hit);
        q.t_max = 0.995; /* beyond the second step */
        assert_true(solve(&q, false).hit && solve(&q, true).hit);
    }
}

/* The released order finds what ours finds, at the same time, and more. */
static void test_gap_first_hits_are_a_superset(void **state)
{
    (void)state;
    uint64_t seed = 203;
    int both = 0, more = 0;
    for (int i = 0; i < 20000; i++) {
        ccd_query q = draw(&seed, (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT), i % FAMILIES);
        q.t_max = random_uniform(&seed, 0.01, 1);
        cipc_ccd_result ours = solve(&q, false), released = solve(&q, true);
        if (ours.hit) assert_true(released.hit && released.toi == ours.toi);
        assert_true(released.toi <= ours.toi);
        both += ours.hit;
        more += released.hit && !ours.hit;
    }
    assert_true(both >= 1000 && more >= 50);
}

static void test_no_relative_motion_is_no_hit(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        ccd_query q = head_on((cipc_pair_kind)kind, 0, 0.5);
        q.t_max = 0.75;
        for (int common = 0; common < 2; common++) {
            cipc_ccd_result r = solve(&q, false);
            assert_true(!r.hit && r.toi == 0.75 && r.iterations == 0);
            for (int i = 0; i < 3 * node_count[kind]; i++) q.p[i] = 0.375 * (1 + i % 3);
        }
    }
}

static void test_parting_is_no_hit(void **state)
{
    (void)state;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        ccd_query q = head_on((cipc_pair_kind)kind, -5, 0.5);
        assert_true(!solve(&q, false).hit && !solve(&q, true).hit);
    }
}

/* Started in contact, or closer than the thickness: no step at all, whatever the direction. */
static void test_started_in_contact(void **state)
{
    (void)state;
    static const double thicknesses[] = {1, 1.5};
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++)
        for (int i = 0; i < 4; i++) {
            ccd_query q = head_on((cipc_pair_kind)kind, i / 2 ? 1 : -1, thicknesses[i % 2]);
            cipc_ccd_result r = solve(&q, i % 2);
            assert_true(r.hit && r.toi == 0 && r.iterations == 0 && !r.capped);
        }
}

/* A shift of the world by a power of two that leaves the coordinates exact changes nothing, to the last bit. */
static void test_translation(void **state)
{
    (void)state;
    uint64_t seed = 204;
    for (int i = 0; i < 2000; i++) {
        ccd_query q = draw(&seed, (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT), GENERAL), shifted = q;
        for (int k = 0; k < 12; k++) q.x[k] = ldexp(rint(ldexp(q.x[k], 30)), -30);
        for (int k = 0; k < 12; k++) shifted.x[k] = q.x[k] + (k % 3 - 1) * 0x1p20;
        cipc_ccd_result a = solve(&q, false), b = solve(&shifted, false);
        assert_true(a.toi == b.toi && a.hit == b.hit && a.iterations == b.iterations);
    }
}

/* Nor does a common displacement, up to the rounding of the sums with it: relative to the times, u times the ratio of the displacements,
 * and as much again for each of a few iterations. */
static void test_common_motion(void **state)
{
    (void)state;
    static const double COMMON = 16, ITERATIONS = 64;
    uint64_t seed = 205;
    int hits = 0;
    for (int i = 0; i < 2000; i++) {
        ccd_query q = draw(&seed, (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT), THICK), carried = q;
        for (int k = 0; k < 12; k++) carried.p[k] = q.p[k] + COMMON * (k % 3 + 1);
        cipc_ccd_result a = solve(&q, false), b = solve(&carried, false);
        if (a.iterations > ITERATIONS) continue;
        assert_true(a.hit == b.hit);
        assert_true(fabs(a.toi - b.toi) <= 1e3 * COMMON * UNIT_ROUNDOFF);
        hits += a.hit;
    }
    assert_true(hits >= 500);
}

/* A point that slides past another one just out of reach: many small steps; the cap returns what is certified so far. */
static void test_iteration_cap(void **state)
{
    (void)state;
    ccd_query q = {.kind = CIPC_POINT_POINT, .x = {-1, 0, 0, 0, 0.11, 0}, .p = {2, 0, 0}, .t_max = 1};
    cipc_ccd_options options = cipc_ccd_options_default();
    cipc_ccd_result full = cipc_additive_ccd(q.kind, q.x, q.p, q.xi, q.t_max, &options);
    assert_true(!full.hit && full.iterations > 5);
    double before = 0;
    for (int cap = 1; cap < full.iterations; cap++) {
        options.max_iterations = cap;
        cipc_ccd_result r = cipc_additive_ccd(q.kind, q.x, q.p, q.xi, q.t_max, &options);
        assert_true(r.hit && r.capped && r.toi > before && r.toi <= q.t_max);
        before = r.toi;
    }
}

/* At a gap of a few ulp the first step lands, by rounding, on a gap of zero. It is shortened until it does not. */
static void test_gap_of_an_ulp(void **state)
{
    (void)state;
    for (int ulps = 1; ulps <= 16; ulps++) {
        ccd_query q = {.kind = CIPC_POINT_POINT, .x = {0, 0, 0, 1 + ulps * DBL_EPSILON}, .p = {0.5, 0, 0, -0.5}, .xi = 1, .t_max = 1};
        for (int gap_first = 0; gap_first < 2; gap_first++) {
            cipc_ccd_result r = solve(&q, gap_first);
            assert_true(r.hit && !r.capped && r.toi > 0);
            assert_true(r.toi < ulps * DBL_EPSILON); /* the impact */
            assert_true((q.x[3] - 0.5 * r.toi) - 0.5 * r.toi > q.xi);
        }
    }
}

static void test_defaults(void **state)
{
    (void)state;
    cipc_ccd_options options = cipc_ccd_options_default();
    assert_true(options.slackness == SLACKNESS && !options.gap_first && options.max_iterations >= 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_is_conservative),
        cmocka_unit_test(test_stops_before_every_impact),
        cmocka_unit_test(test_head_on),
        cmocka_unit_test(test_early_hits),
        cmocka_unit_test(test_gap_first_hits_are_a_superset),
        cmocka_unit_test(test_no_relative_motion_is_no_hit),
        cmocka_unit_test(test_parting_is_no_hit),
        cmocka_unit_test(test_started_in_contact),
        cmocka_unit_test(test_translation),
        cmocka_unit_test(test_common_motion),
        cmocka_unit_test(test_iteration_cap),
        cmocka_unit_test(test_gap_of_an_ulp),
        cmocka_unit_test(test_defaults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
