/* Inertia against its closed form, in numbers whose products are exact. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "cipc/energy.h"

static const cipc_inertia params = {.mass = 0.5, .target = {1, -2, 3}};
static const double x[3] = {3, -2, 2};

static void test_value(void **state)
{
    (void)state;
    assert_true(cipc_inertia_value(x, &params) == 1.25); /* 1/2 * 1/2 * (2^2 + 0 + 1^2) */
    assert_true(cipc_inertia_value(params.target, &params) == 0);
}

static void test_gradient_and_hessian(void **state)
{
    (void)state;
    double g[3], H[9];
    cipc_inertia_gradient(x, &params, g);
    cipc_inertia_hessian(x, &params, H);
    assert_true(g[0] == 1 && g[1] == 0 && g[2] == -0.5);
    for (int i = 0; i < 9; i++) assert_true(H[i] == (i % 4 == 0 ? 0.5 : 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),
        cmocka_unit_test(test_gradient_and_hessian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
