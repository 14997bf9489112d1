/* Closest feature of two edges, against the exact minimum of rational candidates: random, degenerate, near-parallel over 16 decades. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* By how much the feature's own distance (its line, its ends; exactly) may differ from the exact minimum, in stencil
 * sizes. docs/theory/distance.md 6.2: at a clear angle a misjudged clamp costs 4 u / sin at most, and only while the distance itself is no
 * larger; 6.3: otherwise what counts is the rounding of the candidates' distances, 4 u on either side. The computed distance adds 4 u of
 * the size in the formula and as much of |u| in the differences. */
#define CLEAR_SINE 0.1
static double feature_tolerance(double sine)
{
    return (8.0 + (sine > CLEAR_SINE ? 4.0 / sine : 0.0)) * UNIT_ROUNDOFF;
}
#define FORMULA_TOLERANCE (8.0 * UNIT_ROUNDOFF)
#define SAMPLES 20000
#define LEAST_PER_BRANCH 100

enum {
    GENERAL, COPLANAR, CROSSING, NEAR_PARALLEL, PARALLEL, COLLINEAR, POINT_A,
    POINT_B, POINTS, AT_VERTEX, TOUCHING, SHORT, AT_THRESHOLD, FAMILIES
};

static void lerp(double r[3], const double *p, const double *q, double t)
{
    for (int k = 0; k < 3; k++) r[k] = p[k] + t * (q[k] - p[k]);
}

/* Moves edge b so that the point at s on a and some point of b are a small or zero gap apart. */
static void bring_together(uint64_t *seed, double x[12], double s, double gap)
{
    double a[3], b[3];
    lerp(a, x, x + 3, s);
    lerp(b, x + 6, x + 9, random_uniform(seed, -0.1, 1.1));
    for (int k = 0; k < 3; k++) {
        double shift = a[k] - b[k] + gap * random_uniform(seed, -1.0, 1.0);
        x[6 + k] += shift;
        x[9 + k] += shift;
    }
}

static double tiny(uint64_t *seed)
{
    return pow(10.0, random_uniform(seed, -16.0, 0.0));
}

static int draw(uint64_t *seed, double x[12])
{
    int family = random_below(seed, FAMILIES);
    random_fill(seed, x, 12, 1.0);
    if (family == COPLANAR) x[2] = x[5] = x[8] = x[11] = 0.25;
    if (family == CROSSING) bring_together(seed, x, random_uniform(seed, -0.1, 1.1), tiny(seed));
    if (family == NEAR_PARALLEL || family == PARALLEL) {
        double stretch = random_uniform(seed, -2.0, 2.0), angle = family == PARALLEL ? 0.0 : tiny(seed);
        for (int k = 0; k < 3; k++) x[9 + k] = x[6 + k] + stretch * (x[3 + k] - x[k]) + angle * random_uniform(seed, -1.0, 1.0);
        if (random_below(seed, 2)) bring_together(seed, x, random_uniform(seed, -0.1, 1.1), tiny(seed));
    }
    if (family == AT_THRESHOLD) { /* an end against the interior at angles about the threshold: where a misjudged clamp costs most */
        double stretch = random_uniform(seed, 0.3, 2.0), angle = pow(10.0, random_uniform(seed, -2.0, -0.7));
        for (int k = 0; k < 3; k++) x[9 + k] = x[6 + k] + stretch * (x[3 + k] - x[k]) + angle * random_uniform(seed, -1.0, 1.0);
        bring_together(seed, x, random_below(seed, 2), random_below(seed, 2) ? 0.0 : pow(10.0, random_uniform(seed, -17.0, -12.0)));
    }
    if (family == COLLINEAR) {
        lerp(x + 6, x, x + 3, random_uniform(seed, -2.0, 2.0));
        lerp(x + 9, x, x + 3, random_uniform(seed, -2.0, 2.0));
    }
    for (int k = 0; k < 3; k++) {
        if (family == POINT_A || family == POINTS) x[3 + k] = x[k];
        if (family == POINT_B || family == POINTS) x[9 + k] = x[6 + k];
        if (family == AT_VERTEX) x[6 + k] = x[3 + k];
    }
    if (family == TOUCHING) lerp(x + 9, x, x + 3, 0.5);
    if (family == SHORT) lerp(x + 3, x, x + 3, tiny(seed));
    double scale = pow(10.0, random_uniform(seed, -12.0, 12.0)), shift = random_below(seed, 4) ? 0.0 : 1e3;
    for (int i = 0; i < 12; i++) x[i] = (x[i] + shift) * scale;
    return family;
}

/* 0-3: vertex pairs; 4-7: vertex-edge; 8: interior. */
static int branch_of(cipc_feature f)
{
    if (f.kind == CIPC_POINT_POINT) return 2 * f.local[0] + f.local[1] - 2;
    return f.kind == CIPC_POINT_EDGE ? 4 + f.local[0] : 8;
}

static void assert_well_formed(cipc_feature f)
{
    if (f.kind == CIPC_POINT_POINT) {
        assert_int_equal(f.count, 2);
        assert_true(f.local[0] < 2 && f.local[1] >= 2);
    } else if (f.kind == CIPC_POINT_EDGE) {
        int e0 = f.local[0] < 2 ? 2 : 0;
        assert_int_equal(f.count, 3);
        assert_true(f.local[1] == e0 && f.local[2] == e0 + 1);
    } else {
        assert_int_equal(f.kind, CIPC_EDGE_EDGE);
        for (int i = 0; i < 4; i++) assert_int_equal(f.local[i], i);
    }
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 31;
    int hits[9] = {0}, families[FAMILIES] = {0}, clear = 0, unclear_interior = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12];
        families[draw(&seed, x)]++;
        cipc_feature f = cipc_edge_edge_feature(x);
        double exact = exact_true_distance(CIPC_EDGE_EDGE, x), size = stencil_size(x, 12), sine = shape_of(CIPC_EDGE_EDGE, x).sine;
        assert_well_formed(f);
        assert_true(fabs(exact_feature_distance(f, x) - exact) <= feature_tolerance(sine) * size);
        double tolerance = (feature_tolerance(sine) + FORMULA_TOLERANCE) * size;
        assert_true(fabs(sqrt(cipc_edge_edge_distance2(x)) - exact) <= tolerance);
        hits[branch_of(f)]++;
        bool is_clear = sine > CLEAR_SINE;
        clear += is_clear;
        unclear_interior += !is_clear && f.kind == CIPC_EDGE_EDGE;
    }
    for (int i = 0; i < 9; i++) assert_true(hits[i] >= LEAST_PER_BRANCH);
    for (int i = 0; i < FAMILIES; i++) assert_true(families[i] >= LEAST_PER_BRANCH);
    assert_true(clear >= LEAST_PER_BRANCH && SAMPLES - clear >= LEAST_PER_BRANCH && unclear_interior >= LEAST_PER_BRANCH);
}

/* Crossing edges at an angle of 1e-9, where a threshold of 1.6e-8 on the sine would see parallels and report an end (SPEC V.4). */
static void test_crossing_below_the_usual_threshold(void **state)
{
    (void)state;
    const double h = 1e-10, x[12] = {-1, -1e-9, 0, 1, 1e-9, 0, -1, 1e-9, h, 1, -1e-9, h};
    assert_int_equal(cipc_edge_edge_feature(x).kind, CIPC_EDGE_EDGE);
    assert_true(fabs(sqrt(cipc_edge_edge_distance2(x)) - h) <= (feature_tolerance(1e-9) + FORMULA_TOLERANCE) * 2.0);
}

/* A zero-length edge on the other's line but outside it: the line's distance would be 0. */
static void test_zero_length_edge(void **state)
{
    (void)state;
    const double x[12] = {5, 0, 0, 5, 0, 0, 0, 0, 0, 1, 0, 0};
    assert_int_equal(cipc_edge_edge_feature(x).kind, CIPC_POINT_POINT);
    assert_true(cipc_edge_edge_distance2(x) == 16.0);
}

/* r += scale v. */
static void add(double r[3], double scale, const double v[3])
{
    for (int k = 0; k < 3; k++) r[k] += scale * v[k];
}

/* A random right-handed orthonormal frame. */
static void draw_frame(uint64_t *seed, double d[3], double l[3], double n[3])
{
    double v[3];
    random_fill(seed, d, 3, 1.0);
    random_fill(seed, v, 3, 1.0);
    double length = norm3(d);
    for (int k = 0; k < 3; k++) d[k] /= length;
    for (int k = 0; k < 3; k++) n[k] = d[(k + 1) % 3] * v[(k + 2) % 3] - d[(k + 2) % 3] * v[(k + 1) % 3];
    length = norm3(n);
    for (int k = 0; k < 3; k++) n[k] /= length;
    for (int k = 0; k < 3; k++) l[k] = n[(k + 1) % 3] * d[(k + 2) % 3] - n[(k + 2) % 3] * d[(k + 1) % 3];
}

/* At an angle so small and a gap so wide that rounding moves the crossing by up to 10^4 lengths, while it gains less than u over the
 * ends (angle^2 / 8 gap < u / 8, so these are the minimum and no rationals are needed): whatever feature is chosen, the distance must
 * be right. */
static void test_wide_gap_at_tiny_angle(void **state)
{
    (void)state;
    enum { WIDE_SAMPLES = 300000 };
    static const int rows[4][3] = {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
    uint64_t seed = 35;
    for (int sample = 0; sample < WIDE_SAMPLES; sample++) {
        double x[12] = {0.0}, d[3], l[3], n[3], angle = pow(10.0, random_uniform(&seed, -13.0, -8.0)), least = INFINITY;
        double gap = fmin(1.0, pow(10.0, random_uniform(&seed, 0.0, 4.0)) * angle * angle / UNIT_ROUNDOFF);
        draw_frame(&seed, d, l, n);
        for (int end = 0; end < 2; end++) { /* a along d, b along d + angle l, crossing inside both at a height of gap */
            add(x + 3 * end, (end ? 1.0 : -1.0) * random_uniform(&seed, 0.3, 1.0), d);
            double reach = (end ? 1.0 : -1.0) * random_uniform(&seed, 0.3, 1.0);
            add(x + 6 + 3 * end, reach, d), add(x + 6 + 3 * end, reach * angle, l), add(x + 6 + 3 * end, gap, n);
        }
        for (int row = 0; row < 4; row++) {
            double y[9];
            for (int k = 0; k < 9; k++) y[k] = x[3 * rows[row][k / 3] + k % 3];
            least = fmin(least, sqrt(cipc_point_edge_distance2(y)));
        }
        double tolerance = (feature_tolerance(0.0) + FORMULA_TOLERANCE) * stencil_size(x, 12);
        assert_true(fabs(sqrt(cipc_edge_edge_distance2(x)) - least) <= tolerance);
    }
}

static void test_common_translation_costs_nothing(void **state)
{
    (void)state;
    uint64_t seed = 32;
    for (int sample = 0; sample < 500; sample++) {
        double x[12], y[12];
        for (int i = 0; i < 12; i++) x[i] = (double)random_below(&seed, 1 << 20) * 0x1p-20;
        for (int i = 0; i < 12; i++) y[i] = x[i] + 1024.0; /* exact on this grid */
        assert_true(cipc_edge_edge_distance2(x) == cipc_edge_edge_distance2(y));
    }
}

static void test_checker_rejects(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0, 0, 1.0 + 1e-7, 1e-3, 0, 1.5, 1, 1}; /* just past the end of edge a */
    const cipc_feature wrong = {CIPC_POINT_EDGE, 3, {2, 0, 1, 0}};
    double exact = exact_true_distance(CIPC_EDGE_EDGE, x);
    assert_true(fabs(exact_feature_distance(wrong, x) - exact) > feature_tolerance(1.0) * stencil_size(x, 12));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),       cmocka_unit_test(test_crossing_below_the_usual_threshold),
        cmocka_unit_test(test_zero_length_edge),    cmocka_unit_test(test_common_translation_costs_nothing),
        cmocka_unit_test(test_wide_gap_at_tiny_angle),
        cmocka_unit_test(test_checker_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
