/* Dirichlet penalty against its closed form, in numbers whose products are exact. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "cipc/energy.h"

static const cipc_dirichlet_penalty params = {.stiffness = 64, .mass = 0.5, .target = {1, 0, 0}};

static void test_value_scales_with_stiffness_and_mass(void **state)
{
    (void)state;
    const double x[3] = {1, 0.5, 0};
    cipc_dirichlet_penalty stiffer = params;
    stiffer.stiffness = 128;
    assert_true(cipc_dirichlet_penalty_value(x, &params) == 4); /* 1/2 * 64 * 1/2 * 1/4 */
    assert_true(cipc_dirichlet_penalty_value(x, &stiffer) == 8);
    assert_true(cipc_dirichlet_penalty_value(params.target, &params) == 0);
}

static void test_gradient_and_hessian(void **state)
{
    (void)state;
    const double x[3] = {1, 0.5, -0.25};
    double g[3], H[9];
    cipc_dirichlet_penalty_gradient(x, &params, g);
    cipc_dirichlet_penalty_hessian(x, &params, H);
    assert_true(g[0] == 0 && g[1] == 16 && g[2] == -8);
    for (int i = 0; i < 9; i++) assert_true(H[i] == (i % 4 == 0 ? 32 : 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value_scales_with_stiffness_and_mass),
        cmocka_unit_test(test_gradient_and_hessian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
