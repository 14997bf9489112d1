/* M6: energy decrease and residual, decided to the last bit. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/invariant.h"

static void test_decrease(void **state)
{
    (void)state;
    cipc_error error;
    assert_int_equal(cipc_monitor_energy(1, 0.5, 0, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_energy(1, 1, 0, &error), CIPC_OK); /* no rise */
    assert_int_equal(cipc_monitor_energy(1, nextafter(1, 0), 0, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_energy(1, nextafter(1, 2), 0, &error), CIPC_E_VIOLATED_ENERGY);
    assert_int_equal(cipc_monitor_energy(-2, -1, 0, &error), CIPC_E_VIOLATED_ENERGY);
    assert_int_equal(cipc_monitor_energy(-1, -2, 0, NULL), CIPC_OK);
}

static void test_noise_is_exact(void **state)
{
    (void)state;
    cipc_error error;
    assert_int_equal(cipc_monitor_energy(1, 1.25, 0.25, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_energy(1, 1.25, nextafter(0.25, 0), &error), CIPC_E_VIOLATED_ENERGY);
    /* after - before is not a double: 1 + 2^-80 rounds to 1, yet exceeds it. */
    assert_int_equal(cipc_monitor_energy(-0x1p-80, 1, 1, &error), CIPC_E_VIOLATED_ENERGY);
    assert_int_equal(cipc_monitor_energy(0x1p-80, 1, 1, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_energy(-1, 0x1p-80, 1, &error), CIPC_E_VIOLATED_ENERGY);
    assert_int_equal(cipc_monitor_energy(-1, -0x1p-80, 1, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_energy(-DBL_MAX, DBL_MAX, DBL_MAX, &error), CIPC_E_VIOLATED_ENERGY); /* the difference overflows */
}

static void test_non_finite(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    cipc_error error;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(cipc_monitor_energy(bad[i], 1, 1, &error), CIPC_E_VIOLATED_ENERGY);
        assert_int_equal(cipc_monitor_energy(1, bad[i], 1, &error), CIPC_E_VIOLATED_ENERGY);
        assert_int_equal(cipc_monitor_energy(1, 0, bad[i], &error), CIPC_E_OUT_OF_RANGE);
        assert_int_equal(cipc_monitor_residual(bad[i], 1, &error), CIPC_E_VIOLATED_ENERGY);
        assert_int_equal(cipc_monitor_residual(0, bad[i], &error), CIPC_E_VIOLATED_ENERGY);
    }
    assert_int_equal(cipc_monitor_energy(1, 0, -1, &error), CIPC_E_OUT_OF_RANGE);
}

static void test_residual(void **state)
{
    (void)state;
    cipc_error error;
    assert_int_equal(cipc_monitor_residual(0.01, 0.01, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_residual(0, 0, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_residual(-1, 1, &error), CIPC_E_VIOLATED_ENERGY); /* a norm cannot be negative */
    assert_int_equal(cipc_monitor_residual(nextafter(0.5, 1), 0.5, &error), CIPC_E_VIOLATED_ENERGY);
    assert_non_null(strstr(error.what, "0x1.0000000000001p-1"));
    assert_non_null(strstr(error.what, "0x1p-1"));
    assert_string_equal(error.place, "monitor residual");
}

static void test_message(void **state)
{
    (void)state;
    cipc_error error;
    cipc_monitor_energy(0.5, 0.75, 0.125, &error);
    const char *const parts[] = {"0.5 (0x1p-1)", "0.75 (0x1.8p-1)", "0.125 (0x1p-3)"};
    for (int i = 0; i < 3; i++) { assert_non_null(strstr(error.what, parts[i])); }
    assert_string_equal(error.place, "monitor energy");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_decrease), cmocka_unit_test(test_noise_is_exact), cmocka_unit_test(test_non_finite),
        cmocka_unit_test(test_residual), cmocka_unit_test(test_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
