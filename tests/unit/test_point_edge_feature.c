/* Closest feature of a point and an edge, against the exact minimum of rational candidates. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* The feature's exact distance may exceed the minimum by what a misjudged end costs: the foot is off by at most 4 u S along the edge. */
#define FEATURE_TOLERANCE (4.0 * UNIT_ROUNDOFF)
#define SAMPLES 4000
#define LEAST_PER_BRANCH 200

/* Random; on the line; next to the perpendicular at an end; zero length; on the edge; on an end. Any size, any place. */
static void draw(uint64_t *seed, double x[9])
{
    random_fill(seed, x, 9, 1.0);
    int family = random_below(seed, 6);
    double t = random_uniform(seed, -0.5, 1.5);
    for (int k = 0; k < 3; k++) {
        if (family == 1) x[k] = x[3 + k] + t * (x[6 + k] - x[3 + k]);
        if (family == 3) x[6 + k] = x[3 + k];
        if (family == 4) x[k] = 0.5 * (x[3 + k] + x[6 + k]);
        if (family == 5) x[k] = x[6 + k];
    }
    if (family == 2) { /* edge along y, point at the height of an end to within an ulp or so */
        x[6] = x[3], x[8] = x[5];
        x[1] = x[random_below(seed, 2) ? 4 : 7] + random_uniform(seed, -1e-16, 1e-16);
    }
    double scale = pow(10.0, random_uniform(seed, -12.0, 12.0)), shift = random_below(seed, 4) ? 0.0 : 1e3;
    for (int i = 0; i < 9; i++) x[i] = (x[i] + shift) * scale;
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 21;
    int hits[3] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[9];
        draw(&seed, x);
        cipc_feature f = cipc_point_edge_feature(x);
        double exact = exact_true_distance(CIPC_POINT_EDGE, x), tolerance = FEATURE_TOLERANCE * stencil_size(x, 9);
        assert_true(fabs(exact_feature_distance(f, x) - exact) <= tolerance + 4.0 * UNIT_ROUNDOFF * exact);
        assert_int_equal(f.local[0], 0);
        hits[f.kind == CIPC_POINT_EDGE ? 2 : f.local[1] - 1]++;
    }
    for (int i = 0; i < 3; i++) assert_true(hits[i] >= LEAST_PER_BRANCH);
}

/* Where the answer is clear it must be the very one. */
static void test_clear_cases(void **state)
{
    (void)state;
    const double before[9] = {-1, 0, 1, 0, 0, 0, 2, 0, 0}, inside[9] = {1, 5, 1, 0, 0, 0, 2, 0, 0}, after[9] = {3, 0, 0, 0, 0, 0, 2, 0, 0};
    cipc_feature f = cipc_point_edge_feature(before);
    assert_true(f.kind == CIPC_POINT_POINT && f.count == 2 && f.local[1] == 1);
    f = cipc_point_edge_feature(inside);
    assert_true(f.kind == CIPC_POINT_EDGE && f.count == 3 && f.local[1] == 1 && f.local[2] == 2);
    f = cipc_point_edge_feature(after);
    assert_true(f.kind == CIPC_POINT_POINT && f.count == 2 && f.local[1] == 2);
}

static void test_zero_length_edge_is_a_point(void **state)
{
    (void)state;
    const double x[9] = {5, 4, 3, 1, 1, 1, 1, 1, 1};
    assert_int_equal(cipc_point_edge_feature(x).kind, CIPC_POINT_POINT);
    assert_true(cipc_point_edge_distance2(x) == 16.0 + 9.0 + 4.0);
    const double tiny[9] = {0.5e-160, 1, 0, 0, 0, 0, 1e-160, 0, 0}; /* its squared length has next to no digits */
    assert_int_equal(cipc_point_edge_feature(tiny).kind, CIPC_POINT_POINT);
    assert_true(cipc_point_edge_distance2(tiny) == 1.0);
}

/* The check must be able to fail: the line of the edge in the place of its end is caught. */
static void test_checker_rejects(void **state)
{
    (void)state;
    const double x[9] = {-1e-7, 1, 0, 0, 0, 0, 2, 0, 0};
    const cipc_feature wrong = {CIPC_POINT_EDGE, 3, {0, 1, 2, 0}};
    double exact = exact_true_distance(CIPC_POINT_EDGE, x);
    assert_true(fabs(exact_feature_distance(wrong, x) - exact) > FEATURE_TOLERANCE * stencil_size(x, 9) + 4.0 * UNIT_ROUNDOFF * exact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),
        cmocka_unit_test(test_clear_cases),
        cmocka_unit_test(test_zero_length_edge_is_a_point),
        cmocka_unit_test(test_checker_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
