/* Gravity: falling lowers the energy by m g h, the force is the weight. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "cipc/energy.h"

static const cipc_gravity params = {.mass = 0.25, .acceleration = {0, -8, 2}};

static void test_value_is_weight_times_height(void **state)
{
    (void)state;
    const double low[3] = {5, 1, 0}, high[3] = {5, 3, 0};
    assert_true(cipc_gravity_value(high, &params) - cipc_gravity_value(low, &params) == 0.25 * 8 * 2);
}

static void test_gradient_is_minus_the_weight(void **state)
{
    (void)state;
    const double x[3] = {1, 2, 3};
    double g[3], H[9];
    cipc_gravity_gradient(x, &params, g);
    cipc_gravity_hessian(x, &params, H);
    assert_true(g[0] == 0 && g[1] == 2 && g[2] == -0.5);
    for (int i = 0; i < 9; i++) assert_true(H[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value_is_weight_times_height),
        cmocka_unit_test(test_gradient_is_minus_the_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
