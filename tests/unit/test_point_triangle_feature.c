/* Closest feature of a point and a triangle, against the exact minimum of rational candidates: random, degenerate, slivers over 16
 * decades. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* By how much the feature's own distance (its plane, its lines, its ends; exactly) may differ from the exact minimum, in stencil
 * sizes. docs/theory/distance.md 6.2: at a clear angle a misjudged side costs 4 u / sin at most, and only while the distance itself is no
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
    GENERAL, ON_PLANE, NEAR_PLANE, SLIVER, CAP, NEEDLE, SEGMENT,
    ONE_POINT, TWO_COINCIDE, AT_VERTEX, ON_EDGE, ABOVE_EDGE, AT_THRESHOLD, FAMILIES
};

/* r = t0 + beta (t1 - t0) + gamma (t2 - t0). */
static void in_plane(double r[3], const double x[12], double beta, double gamma)
{
    for (int k = 0; k < 3; k++) r[k] = x[3 + k] + beta * (x[6 + k] - x[3 + k]) + gamma * (x[9 + k] - x[3 + k]);
}

static double tiny(uint64_t *seed)
{
    return pow(10.0, random_uniform(seed, -16.0, 0.0));
}

/* Flatten the triangle: corner t1 or t2 moves onto the line of the other two but for a relative height. */
static void flatten(uint64_t *seed, double x[12], double place, double height)
{
    int moved = 3 * (1 + random_below(seed, 3)), p = moved == 3 ? 6 : 3, q = moved == 9 ? 6 : 9;
    for (int k = 0; k < 3; k++) x[moved + k] = x[p + k] + place * (x[q + k] - x[p + k]) + height * random_uniform(seed, -1.0, 1.0);
}

/* Put the point over the triangle or a little outside, at a small or zero height. */
static void bring_near(uint64_t *seed, double x[12], double height)
{
    in_plane(x, x, random_uniform(seed, -0.1, 0.6), random_uniform(seed, -0.1, 0.6));
    for (int k = 0; k < 3; k++) x[k] += height * random_uniform(seed, -1.0, 1.0);
}

static void shape(uint64_t *seed, int family, double x[12])
{
    if (family == SLIVER) flatten(seed, x, random_uniform(seed, -1.0, 2.0), tiny(seed));
    if (family == CAP) flatten(seed, x, 0.5, tiny(seed));
    if (family == NEEDLE) flatten(seed, x, 0.0, tiny(seed));
    if (family == SEGMENT) flatten(seed, x, random_uniform(seed, -1.0, 2.0), 0.0);
    for (int k = 0; k < 3; k++) {
        if (family == ONE_POINT) x[6 + k] = x[9 + k] = x[3 + k];
        if (family == TWO_COINCIDE) x[6 + k] = x[9 + k];
        if (family == AT_VERTEX) x[k] = x[6 + k];
    }
    if ((family == SLIVER || family == CAP || family == NEEDLE) && random_below(seed, 2)) bring_near(seed, x, tiny(seed));
    if (family == NEAR_PLANE) bring_near(seed, x, tiny(seed));
    if (family == ON_PLANE) x[2] = x[5] = x[8] = x[11] = 0.25;
    if (family == ON_EDGE) in_plane(x, x, 0.25, 0.75);
    if (family == AT_THRESHOLD) { /* on a side to within 1e-14 at angles about the threshold: where a misjudged side costs most */
        double beta = random_uniform(seed, 0.0, 1.0), angle = pow(10.0, random_uniform(seed, -2.0, -0.7));
        for (int k = 0; k < 3; k++) x[9 + k] = x[3 + k] + 1.5 * (x[6 + k] - x[3 + k]) + angle * random_uniform(seed, -1.0, 1.0);
        in_plane(x, x, beta, random_below(seed, 2) ? 0.0 : 1.0 - beta);
        for (int k = 0; k < 3; k++) x[k] += random_uniform(seed, -1e-14, 1e-14);
    }
    if (family == ABOVE_EDGE) { /* right angle at t0, the point over an edge's line to within an ulp or so */
        x[5] = x[8] = x[11] = 0.0;
        x[7] = x[4], x[9] = x[3];
        x[1] = x[4] + random_uniform(seed, -1e-16, 1e-16);
    }
}

static int draw(uint64_t *seed, double x[12])
{
    int family = random_below(seed, FAMILIES);
    random_fill(seed, x, 12, 1.0);
    shape(seed, family, x);
    double scale = pow(10.0, random_uniform(seed, -12.0, 12.0)), shift = random_below(seed, 4) ? 0.0 : 1e3;
    for (int i = 0; i < 12; i++) x[i] = (x[i] + shift) * scale;
    return family;
}

/* 0-2: vertices; 3-5: edges t0t1, t1t2, t2t0; 6: face. */
static int branch_of(cipc_feature f)
{
    if (f.kind == CIPC_POINT_POINT) return f.local[1] - 1;
    return f.kind == CIPC_POINT_EDGE ? 2 + f.local[1] : 6;
}

static void assert_well_formed(cipc_feature f)
{
    assert_int_equal(f.local[0], 0);
    if (f.kind == CIPC_POINT_POINT) {
        assert_int_equal(f.count, 2);
        assert_true(f.local[1] >= 1 && f.local[1] <= 3);
    } else if (f.kind == CIPC_POINT_EDGE) {
        assert_int_equal(f.count, 3);
        assert_true(f.local[1] >= 1 && f.local[1] <= 3 && f.local[2] == f.local[1] % 3 + 1);
    } else {
        assert_int_equal(f.kind, CIPC_POINT_TRIANGLE);
        for (int i = 0; i < 4; i++) assert_int_equal(f.local[i], i);
    }
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 41;
    int hits[7] = {0}, families[FAMILIES] = {0}, clear = 0, unclear_face = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12];
        families[draw(&seed, x)]++;
        cipc_feature f = cipc_point_triangle_feature(x);
        double exact = exact_true_distance(CIPC_POINT_TRIANGLE, x), size = stencil_size(x, 12);
        double sine = shape_of(CIPC_POINT_TRIANGLE, x).sine;
        assert_well_formed(f);
        assert_true(fabs(exact_feature_distance(f, x) - exact) <= feature_tolerance(sine) * size);
        double tolerance = (feature_tolerance(sine) + FORMULA_TOLERANCE) * size;
        assert_true(fabs(sqrt(cipc_point_triangle_distance2(x)) - exact) <= tolerance);
        hits[branch_of(f)]++;
        bool is_clear = sine > CLEAR_SINE;
        clear += is_clear;
        unclear_face += !is_clear && f.kind == CIPC_POINT_TRIANGLE;
    }
    for (int i = 0; i < 7; i++) assert_true(hits[i] >= LEAST_PER_BRANCH);
    for (int i = 0; i < FAMILIES; i++) assert_true(families[i] >= LEAST_PER_BRANCH);
    assert_true(clear >= LEAST_PER_BRANCH && SAMPLES - clear >= LEAST_PER_BRANCH && unclear_face >= LEAST_PER_BRANCH);
}

/* Where the answer is clear it must be the very one: over the middle of the face, beyond the middle of each edge, beyond each corner. */
static void test_clear_cases(void **state)
{
    (void)state;
    static const struct {
        double p[3];
        int branch;
    } cases[] = {
        {{0.25, 0.25, 1.0}, 6}, {{0.5, -1.0, 0.5}, 3}, {{1.0, 1.0, 0.0}, 4},  {{-1.0, 0.5, 0.25}, 5},
        {{-1.0, -1.0, 0.0}, 0}, {{3.0, -0.5, 1.0}, 1}, {{-0.5, 3.0, -1.0}, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double *p = cases[i].p, x[12] = {p[0], p[1], p[2], 0, 0, 0, 1, 0, 0, 0, 1, 0};
        assert_int_equal(branch_of(cipc_point_triangle_feature(x)), cases[i].branch);
    }
}

static void test_zero_area_triangle_is_its_edges(void **state)
{
    (void)state;
    const double segment[12] = {1, 3, 0, 0, 0, 0, 4, 0, 0, 2, 0, 0}, point[12] = {3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    assert_int_equal(cipc_point_triangle_feature(segment).kind, CIPC_POINT_EDGE);
    assert_true(cipc_point_triangle_distance2(segment) == 9.0);
    assert_int_equal(cipc_point_triangle_feature(point).kind, CIPC_POINT_POINT);
    assert_true(cipc_point_triangle_distance2(point) == 25.0);
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

/* At an angle so small and a gap so wide that rounding moves the foot by up to 10^4 lengths, while it gains less than u over the
 * edges (angle^2 / 8 gap < u / 8, so these are the minimum and no rationals are needed): whatever feature is chosen, the distance must
 * be right. */
static void test_wide_gap_at_tiny_angle(void **state)
{
    (void)state;
    enum { WIDE_SAMPLES = 300000 };
    static const int rows[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    uint64_t seed = 35;
    for (int sample = 0; sample < WIDE_SAMPLES; sample++) {
        double x[12] = {0.0}, d[3], l[3], n[3], angle = pow(10.0, random_uniform(&seed, -13.0, -8.0)), least = INFINITY;
        double gap = fmin(1.0, pow(10.0, random_uniform(&seed, 0.0, 4.0)) * angle * angle / UNIT_ROUNDOFF);
        draw_frame(&seed, d, l, n);
        add(x + 3, -1.0, d), add(x + 6, 1.0, d), add(x + 9, random_uniform(&seed, -0.9, 0.9), d), add(x + 9, angle, l);
        add(x, random_uniform(&seed, -0.1, 0.1), d), add(x, 0.1 * angle, l), add(x, gap, n); /* over the inside, at a height of gap */
        for (int row = 0; row < 3; row++) {
            double y[9];
            for (int k = 0; k < 9; k++) y[k] = x[3 * rows[row][k / 3] + k % 3];
            least = fmin(least, sqrt(cipc_point_edge_distance2(y)));
        }
        double tolerance = (feature_tolerance(0.0) + FORMULA_TOLERANCE) * stencil_size(x, 12);
        assert_true(fabs(sqrt(cipc_point_triangle_distance2(x)) - least) <= tolerance);
    }
}

static void test_common_translation_costs_nothing(void **state)
{
    (void)state;
    uint64_t seed = 42;
    for (int sample = 0; sample < 500; sample++) {
        double x[12], y[12];
        for (int i = 0; i < 12; i++) x[i] = (double)random_below(&seed, 1 << 20) * 0x1p-20;
        for (int i = 0; i < 12; i++) y[i] = x[i] + 1024.0; /* exact on this grid */
        assert_true(cipc_point_triangle_distance2(x) == cipc_point_triangle_distance2(y));
    }
}

static void test_checker_rejects(void **state)
{
    (void)state;
    const double x[12] = {-1e-7, 0.5, 1e-3, 0, 0, 0, 1, 0, 0, 0, 1, 0}; /* just outside the edge t2 t0 */
    const cipc_feature wrong = {CIPC_POINT_TRIANGLE, 4, {0, 1, 2, 3}};
    double exact = exact_true_distance(CIPC_POINT_TRIANGLE, x);
    assert_true(fabs(exact_feature_distance(wrong, x) - exact) > feature_tolerance(1.0) * stencil_size(x, 12));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),
        cmocka_unit_test(test_clear_cases),
        cmocka_unit_test(test_zero_area_triangle_is_its_edges),
        cmocka_unit_test(test_common_translation_costs_nothing),
        cmocka_unit_test(test_wide_gap_at_tiny_angle),
        cmocka_unit_test(test_checker_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
