/* Conditions and tolerances of derivatives: in closed form where there is one, and infinite where nothing is determined. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "verify/condition.h"

static void test_largest(void **state)
{
    (void)state;
    const double a[3] = {1, -5, 2}, b[3] = {1, -4, 2.5}, broken[3] = {1, NAN, 2};
    assert_true(verify_largest(a, 3) == 5 && verify_largest(a, 1) == 1);
    assert_true(verify_largest_error(a, b, 3) == 1);
    assert_true(verify_largest_error(broken, a, 3) == INFINITY);
    assert_true(verify_over(0, 0) == 0 && verify_over(1, 0) == INFINITY && verify_over(1, 4) == 0.25);
}

/* Every term once: f = 2, |g| = 3, |H| = 5, S = 7, |dH| S = 11. */
static void test_tolerances(void **state)
{
    (void)state;
    const double g[2] = {3, -1}, H[4] = {0, -5, -5, 1}, ku = 16 * VERIFY_UNIT;
    verify_tolerances t = verify_tolerances_of(-2, g, H, 2, 7, 11);
    assert_true(fabs(t.value - ku * (2 + 3 * 7)) <= 1e-12 * ku); /* u S^2 5 adds 3e-14 */
    assert_true(t.gradient == ku * (3 + 35));
    assert_true(t.hessian == ku * (5 + 11));
    assert_true(verify_tolerances_of(0, (double[]){0, 0}, H, 2, 7, 0).value == ku * VERIFY_UNIT * 245);
    assert_true(verify_tolerances_of(0, g, H, 2, 7, INFINITY).hessian == INFINITY);
}

/* H = 5 and d = 3 add 16 u 15 to the gradient's and 16 u 45 to the value's; to nobody else's. */
static void test_a_matrix_is_rounded_too(void **state)
{
    (void)state;
    const double H[144] = {[7] = -5}, ku = 16 * VERIFY_UNIT;
    double x[12] = {0}, fields[91] = {0};
    verify_tolerances t = {1, 1, 1};
    x[4] = 1;
    fields[1 + 4] = 4;
    fields[1 + 12] = 1e9; /* beyond start: no displacement */
    verify_add_matrix_rounding(&t, cipc_oracle_function_find("hinge_bending"), x, fields, H);
    assert_true(t.value == 1 && t.gradient == 1 && t.hessian == 1);
    verify_add_matrix_rounding(&t, cipc_oracle_function_find("damping"), x, fields, H);
    assert_true(t.value == 1 + ku * 45 && t.gradient == 1 + ku * 15 && t.hessian == 1);
}

static double change_of(const char *name, const double *x, const double *fields, double size)
{
    const cipc_oracle_function *f = cipc_oracle_function_find(name);
    double value, g[12], H[144];
    assert_non_null(f);
    assert_int_equal(cipc_oracle_evaluate(f, x, fields, &value, g, H), CIPC_YES);
    return verify_hessian_change(f, x, fields, g, H, size, 0x123456);
}

/* A quadratic's Hessian is constant; 1/gap^3 of a barrier's changes by S/gap of itself, more or less. */
static void test_changes_of_hessians(void **state)
{
    (void)state;
    const double quadratic[6] = {1, 2, 3, 0, 0, 0};
    assert_true(change_of("distance2_point_point", quadratic, NULL, 3) == 0);
    for (int k = 1; k <= 9; k++) {
        double gap = pow(10, -k), x[6] = {1 + gap, 0, 0, 0, 0, 0}, fields[4] = {1, 1, 1, 1}, value, g[6], H[36];
        double change = change_of("barrier_point_point", x, fields, 1);
        assert_int_equal(cipc_oracle_evaluate(cipc_oracle_function_find("barrier_point_point"), x, fields, &value, g, H), CIPC_YES);
        double ratio = change / (verify_largest(H, 36) / gap);
        if (!(ratio > 0.1 && ratio < 10)) fail_msg("gap 1e-%d: %g times H S / gap", k, ratio);
    }
}

/* Lines at an angle of a few roundings: whatever shift is tried, the Hessian is another. */
static void test_not_determined(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0.1, 1, 0, 0.1, 0.25, 0.5, 0, 1.25, 0.5 + 0x1p-52, 0};
    assert_true(change_of("distance2_line_line", x, NULL, 1) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_largest),
        cmocka_unit_test(test_tolerances),
        cmocka_unit_test(test_a_matrix_is_rounded_too),
        cmocka_unit_test(test_changes_of_hessians),
        cmocka_unit_test(test_not_determined),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
