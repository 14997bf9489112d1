/* The exact stretch oracle: stretches known by hand, to one ulp. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"

static const double unit_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static void test_one_ulp_of_the_limit(void **state)
{
    (void)state;
    const double limits[] = {1.134, 1.0608, 1.01, 1.001, 0x1p300, 0x1p-300};
    for (int i = 0; i < 6; i++) {
        double s = limits[i], x[9] = {0, 0, 0, s, 0, 0, 0, 0, 0x1p-310};
        assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, s), 0);
        assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, nextafter(s, INFINITY)), 1);
        assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, nextafter(s, 0)), -1);
        x[3] = nextafter(s, 0);
        assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, s), 1);
        x[3] = nextafter(s, INFINITY);
        assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, s), -1);
    }
}

static void test_both_stretches_at_the_limit(void **state)
{
    (void)state;
    const double s = 1.0625; /* M = 0: semi-definite */
    const double x[9] = {1024, 7, -3, 1024 + s, 7, -3, 1024, 7 + s, -3}, longer[9] = {0, 0, 0, s, 0, 0, 0, s + 1, 0},
                 wider[9] = {0, 0, 0, s + 1, 0, 0, 0, s, 0};
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, s), 0);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, nextafter(s, 2)), 1);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, longer, s), -1); /* one at, one beyond */
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, wider, s), -1);
}

/* Simple shear by g stretches by (g + sqrt(g^2 + 4)) / 2: g = 3/2 gives 2. */
static void test_shear(void **state)
{
    (void)state;
    const double x[9] = {0, 0, 0, 1, 0, 0, 1.5, 1, 0};
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, 2), 0);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, nextafter(2, 3)), 1);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, nextafter(2, 1)), -1);
}

/* The least stretch: of a triangle compressed along one axis and stretched along the other, by one ulp; simple shear by 3/2 compresses to 1/2. */
static void test_least_stretch(void **state)
{
    (void)state;
    const double limits[] = {0.9, 0.7, 0.999, 0x1p-300};
    for (int i = 0; i < 4; i++) {
        double s = limits[i], x[9] = {0, 0, 0, 3, 0, 0, 0, s, 0};
        assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, x, s), 0);
        assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, x, nextafter(s, 0)), 1);
        assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, x, nextafter(s, 1)), -1);
        x[7] = nextafter(s, 1);
        assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, x, s), 1);
        x[3] = nextafter(s, 0);
        assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, x, s), -1);
    }
    const double shear[9] = {0, 0, 0, 1, 0, 0, 1.5, 1, 0}, point[9] = {0};
    assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, shear, 0.5), 0);
    assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, shear, nextafter(0.5, 0)), 1);
    assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, point, 0.5), -1); /* collapsed */
    assert_int_equal(cipc_exact_compare_least_stretch(unit_triangle, shear, NAN), -1);
}

/* Rigid motions of a triangle whose rotation is rational: the stretch is 1. */
static void test_rigid_motion(void **state)
{
    (void)state;
    const double rest[9] = {0, 0, 0, 5, 0, 0, 0, 5, 0}, x[9] = {9, 9, 9, 12, 13, 9, 5, 12, 9};
    assert_int_equal(cipc_exact_compare_stretch(rest, x, 1), 0);
    assert_int_equal(cipc_exact_compare_stretch(rest, x, nextafter(1, 2)), 1);
    assert_int_equal(cipc_exact_compare_stretch(rest, x, nextafter(1, 0)), -1);
}

/* Any order of the nodes describes the same triangle. */
static void test_order_of_nodes(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 500; i++) {
        double rest[9], x[9], turned_rest[9], turned[9];
        random_fill(&seed, rest, 9, 1);
        random_fill(&seed, x, 9, 1);
        for (int k = 0; k < 9; k++) {
            turned_rest[k] = rest[(k + 3) % 9];
            turned[k] = x[(k + 3) % 9];
        }
        double s = random_uniform(&seed, 0.5, 3);
        assert_int_equal(cipc_exact_compare_stretch(rest, x, s), cipc_exact_compare_stretch(turned_rest, turned, s));
    }
}

static void test_degenerate(void **state)
{
    (void)state;
    const double point[9] = {0}, line[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, point, 1), 1); /* collapsed: stretch 0 */
    assert_int_equal(cipc_exact_compare_stretch(point, point, 1), 0);
    assert_int_equal(cipc_exact_compare_stretch(point, unit_triangle, 1), -1); /* infinite stretch */
    assert_int_equal(cipc_exact_compare_stretch(line, unit_triangle, 100), -1);
}

static void test_non_finite_proves_nothing(void **state)
{
    (void)state;
    double x[9];
    memcpy(x, unit_triangle, sizeof x);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, NAN), -1);
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, INFINITY), -1);
    x[4] = NAN;
    assert_int_equal(cipc_exact_compare_stretch(unit_triangle, x, 2), -1);
    assert_int_equal(cipc_exact_compare_stretch(x, unit_triangle, 2), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_ulp_of_the_limit),
        cmocka_unit_test(test_both_stretches_at_the_limit),
        cmocka_unit_test(test_shear),
        cmocka_unit_test(test_least_stretch),
        cmocka_unit_test(test_rigid_motion),
        cmocka_unit_test(test_order_of_nodes),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_non_finite_proves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
