/* Squared point-point distance: value, gradient and Hessian against rational differences. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* Value: 3 differences, squares and sums, 4 roundings each at most. Derivatives: one rounding, and the Hessian is constant. */
#define VALUE_TOLERANCE (8.0 * UNIT_ROUNDOFF)
#define GRADIENT_TOLERANCE (2.0 * UNIT_ROUNDOFF)
#define SAMPLES 200

static const cipc_pair_kind kind = CIPC_POINT_POINT;

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[6], g[6], H[36];
        random_fill(&seed, x, 6, pow(10.0, random_uniform(&seed, -12.0, 12.0)));
        double value = cipc_point_point_distance2_value(x);
        cipc_point_point_distance2_gradient(x, g);
        cipc_point_point_distance2_hessian(x, H);
        assert_true(value_error(exact_distance2, &kind, x, 6, value) <= VALUE_TOLERANCE * value);
        assert_true(gradient_error(exact_distance2, &kind, x, 6, g) <= GRADIENT_TOLERANCE * 2.0 * sqrt(value));
        assert_true(hessian_error(exact_distance2, &kind, x, 6, H) < 1e-30); /* exact; the differences of a quadratic are exact too */
    }
}

/* The checker itself: one component off by a few roundings must show. */
static void test_checker_rejects(void **state)
{
    (void)state;
    double x[6] = {0.25, 1.0, -2.0, 1.5, 0.0, 3.0}, g[6], H[36];
    cipc_point_point_distance2_gradient(x, g);
    cipc_point_point_distance2_hessian(x, H);
    g[4] *= 1.0 + 8.0 * DBL_EPSILON;
    H[7] = 1e-20;
    assert_true(gradient_error(exact_distance2, &kind, x, 6, g) > 8.0 * UNIT_ROUNDOFF);
    assert_true(hessian_error(exact_distance2, &kind, x, 6, H) > 1e-21);
}

static void test_coincident_points(void **state)
{
    (void)state;
    double x[6] = {1.0, 2.0, 3.0, 1.0, 2.0, 3.0}, g[6];
    assert_true(cipc_point_point_distance2_value(x) == 0.0);
    cipc_point_point_distance2_gradient(x, g);
    for (int i = 0; i < 6; i++) assert_true(g[i] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),
        cmocka_unit_test(test_checker_rejects),
        cmocka_unit_test(test_coincident_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
