/* Neo-Hookean membrane: exact energies of one triangle, rigid motions, small strains, collapse (SPEC C.6, E6). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

/* Some twenty operations on numbers of size one. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static const double rest[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
enum { SIZE = 9 };

static cipc_membrane material(void)
{
    cipc_membrane params;
    assert_true(cipc_membrane_init(&params, rest, 0.1, 5, 0.3));
    return params;
}

/* The rest triangle under F = [[a, b], [0, c]] in its own plane. */
static void deform(double a, double b, double c, double x[SIZE])
{
    const double deformed[SIZE] = {0, 0, 0, a, 0, 0, b, c, 0};
    for (int i = 0; i < SIZE; i++) x[i] = deformed[i];
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_uniaxial_stretch(void **state)
{
    (void)state;
    cipc_membrane p = material();
    const double stretches[] = {0.01, 0.5, 0.9, 1.1, 1.5, 3};
    for (size_t i = 0; i < sizeof stretches / sizeof stretches[0]; i++) {
        double s = stretches[i], x[SIZE], ln_J = log(s);
        deform(s, 0, 1, x);
        double energy = p.volume * (p.mu / 2 * (s * s - 1 - 2 * ln_J) + p.lambda / 2 * ln_J * ln_J);
        assert_relative(cipc_membrane_neo_hookean_value(x, &p), energy, ROUNDINGS / fmin(1, (s - 1) * (s - 1)));
    }
}

static void test_simple_shear_keeps_the_area(void **state)
{
    (void)state;
    cipc_membrane p = material();
    const double shears[] = {1e-6, 0.1, 0.7, 4};
    for (size_t i = 0; i < sizeof shears / sizeof shears[0]; i++) {
        double x[SIZE], shear = shears[i];
        deform(1, shear, 1, x);
        assert_relative(cipc_membrane_neo_hookean_value(x, &p), p.volume * p.mu / 2 * shear * shear, ROUNDINGS);
    }
}

static void test_dilation(void **state)
{
    (void)state;
    cipc_membrane p = material();
    double s = 1.25, x[SIZE], g[SIZE], ln_J = 2 * log(s);
    deform(s, 0, s, x);
    assert_relative(cipc_membrane_neo_hookean_value(x, &p), p.volume * (p.mu / 2 * (2 * s * s - 2 - 2 * ln_J) + p.lambda / 2 * ln_J * ln_J),
                    ROUNDINGS);
    /* dE/dF = V [mu F + (lambda ln J - mu) F^-T] is a multiple of the identity; nodes 1 and 2 take its columns. */
    double stress = p.volume * (p.mu * s + (p.lambda * ln_J - p.mu) / s);
    cipc_membrane_neo_hookean_gradient(x, &p, g);
    const double want[SIZE] = {-stress, -stress, 0, stress, 0, 0, 0, stress, 0};
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i] - want[i]) <= ROUNDINGS * fabs(stress));
}

/* tr C - 2 - 2 ln J is of second order in the strain. Computed as it stands it would be off by u/strain^2 = 1e-2 of itself here; the
 * gradient, of first order, and the positions allow u/strain = 1e-9, and the series stops at strain = 1e-7. */
static void test_small_strains_do_not_cancel(void **state)
{
    (void)state;
    cipc_membrane p = material();
    double strain = 1e-7, x[SIZE];
    deform(1 + strain, 0, 1, x);
    assert_relative(cipc_membrane_neo_hookean_value(x, &p), p.volume * (p.mu + p.lambda / 2) * strain * strain, 1e-6);
}

static void test_rigid_motion_has_no_energy_and_no_force(void **state)
{
    (void)state;
    cipc_membrane p = material();
    /* Rotation by 3-4-5 about an axis and by 5-12-13 about another, and a shift. */
    const double x[SIZE] = {7, -2, 1, 7 + 0.6, -2 + 0.8 * 5 / 13.0, 1 + 0.8 * 12 / 13.0, 7 - 0.8, -2 + 0.6 * 5 / 13.0, 1 + 0.6 * 12 / 13.0};
    double g[SIZE];
    cipc_membrane_neo_hookean_gradient(x, &p, g);
    /* Positions of size 7 round the strain by 7 u. */
    assert_true(cipc_membrane_neo_hookean_value(x, &p) < p.mu * pow(7 * ROUNDINGS, 2));
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i]) < p.mu * 7 * ROUNDINGS);
}

static void test_a_collapsed_triangle_is_infeasible(void **state)
{
    (void)state;
    cipc_membrane p = material();
    double x[SIZE];
    deform(1, 0.5, 0, x);
    assert_true(cipc_membrane_neo_hookean_value(x, &p) == INFINITY);
    deform(0, 0, 1, x);
    assert_true(cipc_membrane_neo_hookean_value(x, &p) == INFINITY);
}

static void test_hessian_at_rest_is_that_of_linear_elasticity(void **state)
{
    (void)state;
    /* Both membrane models linearise to the same plane-stress material. */
    cipc_membrane p = material();
    double A[SIZE * SIZE], B[SIZE * SIZE];
    cipc_membrane_neo_hookean_hessian(rest, &p, A);
    cipc_membrane_stvk_hessian(rest, &p, B);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(fabs(A[i] - B[i]) < ROUNDINGS);
    assert_relative(A[3 * SIZE + 3], p.volume * (p.lambda + 2 * p.mu), ROUNDINGS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniaxial_stretch),
        cmocka_unit_test(test_simple_shear_keeps_the_area),
        cmocka_unit_test(test_dilation),
        cmocka_unit_test(test_small_strains_do_not_cancel),
        cmocka_unit_test(test_rigid_motion_has_no_energy_and_no_force),
        cmocka_unit_test(test_a_collapsed_triangle_is_infeasible),
        cmocka_unit_test(test_hessian_at_rest_is_that_of_linear_elasticity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
