/* Neo-Hookean tetrahedron: exact energies, forces and stiffnesses, small strains, collapse (SPEC C.6). */
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

static const double rest[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
enum { SIZE = 12 };

static cipc_volume material(void)
{
    cipc_volume params;
    assert_true(cipc_volume_init(&params, rest, 5, 0.3));
    return params;
}

/* The rest tetrahedron under a matrix F, row-major: its columns are the nodes 1, 2, 3. */
static void deform(const double F[9], double x[SIZE])
{
    for (int k = 0; k < 3; k++) {
        x[k] = 0;
        for (int a = 0; a < 3; a++) x[3 * (a + 1) + k] = F[3 * k + a];
    }
}

static void stretch(double a, double b, double c, double x[SIZE])
{
    const double F[9] = {a, 0, 0, 0, b, 0, 0, 0, c};
    deform(F, x);
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* Row and column of the Hessian that belong to F[row][column]. */
static int place(int row, int column)
{
    return 3 * (column + 1) + row;
}

static void test_uniaxial_stretch(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double stretches[] = {1e-6, 0.5, 0.9, 1.1, 1.5, 30};
    for (size_t i = 0; i < sizeof stretches / sizeof stretches[0]; i++) {
        double s = stretches[i], x[SIZE], ln_J = log(s);
        stretch(1, s, 1, x);
        double energy = p.volume * (p.mu / 2 * (s * s - 1) - p.mu * ln_J + p.lambda / 2 * ln_J * ln_J);
        assert_relative(cipc_volume_neo_hookean_value(x, &p), energy, ROUNDINGS / fmin(1, (s - 1) * (s - 1)));
    }
}

static void test_simple_shear_keeps_the_volume(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double shears[] = {1e-6, 0.1, 0.7, 4};
    for (size_t i = 0; i < sizeof shears / sizeof shears[0]; i++) {
        double x[SIZE], shear = shears[i];
        const double F[9] = {1, 0, shear, 0, 1, 0, 0, 0, 1};
        deform(F, x);
        assert_relative(cipc_volume_neo_hookean_value(x, &p), p.volume * p.mu / 2 * shear * shear, ROUNDINGS);
    }
}

/* Two singular values of 1e-5, askew: J = 1e-10 to some digits less than the sixteen, not to none. */
static void test_needle(void **state)
{
    (void)state;
    cipc_volume p = material();
    double thin = 1e-5, x[SIZE], ln_J = 2 * log(thin);
    /* e e^T + thin (1 - e e^T) along e = (2, 1, 2)/3: symmetric, entries rounded */
    const double F[9] = {(4 + 5 * thin) / 9, (2 - 2 * thin) / 9, (4 - 4 * thin) / 9, (2 - 2 * thin) / 9, (1 + 8 * thin) / 9, (2 - 2 * thin) / 9, (4 - 4 * thin) / 9, (2 - 2 * thin) / 9, (4 + 5 * thin) / 9};
    deform(F, x);
    double energy = p.volume * (p.mu / 2 * (1 + 2 * thin * thin - 3) - p.mu * ln_J + p.lambda / 2 * ln_J * ln_J);
    /* Rounding F by u moves both thin values by u, ln J by u/thin each. */
    assert_true(fabs(cipc_volume_neo_hookean_value(x, &p) - energy) <= p.volume * (p.mu + p.lambda * fabs(ln_J)) * ROUNDINGS / thin);
}

/* tr C - 3 - 2 ln J is of second order in the strain; as it stands it would be off by u/strain^2 = 1e-2 of itself here. */
static void test_small_strains_do_not_cancel(void **state)
{
    (void)state;
    cipc_volume p = material();
    double strain = 1e-7, x[SIZE];
    stretch(1 + strain, 1, 1, x);
    assert_relative(cipc_volume_neo_hookean_value(x, &p), p.volume * (p.mu + p.lambda / 2) * strain * strain, 1e-6); /* next order, and rounding of 1 + strain */
}

/* P = mu F + (lambda ln J - mu) F^-T. */
static void test_force_of_unequal_stretches(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double sigma[3] = {1.5, 0.5, 2};
    double x[SIZE], g[SIZE], ln_J = log(1.5);
    stretch(sigma[0], sigma[1], sigma[2], x);
    cipc_volume_neo_hookean_gradient(x, &p, g);
    for (int a = 0; a < 3; a++) {
        double stress = p.volume * (p.mu * sigma[a] + (p.lambda * ln_J - p.mu) / sigma[a]);
        assert_relative(g[place(a, a)], stress, ROUNDINGS);
        assert_relative(g[a], -stress, ROUNDINGS); /* node 0 balances */
    }
    assert_true(fabs(g[place(0, 1)]) <= ROUNDINGS * p.volume * p.mu);
}

/* At rest both volumes are linear elasticity. */
static void test_stiffness_at_rest(void **state)
{
    (void)state;
    cipc_volume p = material();
    double A[SIZE * SIZE], B[SIZE * SIZE];
    cipc_volume_neo_hookean_hessian(rest, &p, A);
    cipc_volume_corotational_hessian(rest, &p, B);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(fabs(A[i] - B[i]) <= ROUNDINGS * p.volume * (p.lambda + 2 * p.mu));
    assert_relative(A[place(0, 0) * SIZE + place(0, 0)], p.volume * (p.lambda + 2 * p.mu), ROUNDINGS);
    assert_relative(A[place(0, 0) * SIZE + place(1, 1)], p.volume * p.lambda, ROUNDINGS);
    assert_relative(A[place(0, 1) * SIZE + place(0, 1)], p.volume * p.mu, ROUNDINGS);
    assert_relative(A[place(0, 1) * SIZE + place(1, 0)], p.volume * p.mu, ROUNDINGS);
}

/* mu + (mu + lambda (1 - ln J)) / sigma^2 along, lambda / (sigma_a sigma_b) between, k/(sigma_a sigma_b) with k = mu - lambda ln J for shears. */
static void test_stiffness_of_unequal_stretches(void **state)
{
    (void)state;
    cipc_volume p = material();
    double x[SIZE], H[SIZE * SIZE], ln_J = log(1.5);
    stretch(1.5, 0.5, 2, x);
    cipc_volume_neo_hookean_hessian(x, &p, H);
    assert_relative(H[place(1, 1) * SIZE + place(1, 1)], p.volume * (p.mu + 4 * (p.mu + p.lambda * (1 - ln_J))), ROUNDINGS);
    assert_relative(H[place(0, 0) * SIZE + place(2, 2)], p.volume * p.lambda / 3, ROUNDINGS);
    assert_relative(H[place(0, 2) * SIZE + place(2, 0)], p.volume * (p.mu - p.lambda * ln_J) / 3, ROUNDINGS);
    assert_relative(H[place(0, 2) * SIZE + place(0, 2)], p.volume * p.mu, ROUNDINGS);
}

static void test_rigid_motion_has_no_energy_and_no_force(void **state)
{
    (void)state;
    cipc_volume p = material();
    /* Rotation by 3-4-5 about an axis, by 5-12-13 about another, and a shift. */
    const double c = 5 / 13.0, s = 12 / 13.0;
    const double x[SIZE] = {7, -2, 1, 7 + 0.6, -2 + 0.8 * c, 1 + 0.8 * s, 7 - 0.8, -2 + 0.6 * c, 1 + 0.6 * s, 7, -2 - s, 1 + c};
    double g[SIZE];
    cipc_volume_neo_hookean_gradient(x, &p, g);
    /* Positions of size 7 round the strain by 7 u. */
    assert_true(cipc_volume_neo_hookean_value(x, &p) < (p.mu + p.lambda) * pow(7 * ROUNDINGS, 2));
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i]) < (p.mu + p.lambda) * 7 * ROUNDINGS);
}

static void test_flat_and_inverted_are_infeasible(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double shear[9] = {1, 0, 1, 0, 1, 1, 1, 1, 2};
    double x[SIZE];
    deform(shear, x);
    assert_true(cipc_volume_neo_hookean_value(x, &p) == INFINITY);
    stretch(1, 1, 0, x);
    assert_true(cipc_volume_neo_hookean_value(x, &p) == INFINITY);
    stretch(1, 1, -1, x);
    assert_true(cipc_volume_neo_hookean_value(x, &p) == INFINITY);
    stretch(1, NAN, 1, x);
    assert_true(cipc_volume_neo_hookean_value(x, &p) == INFINITY);
    stretch(1, 1, 1e-12, x);
    assert_true(isfinite(cipc_volume_neo_hookean_value(x, &p)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniaxial_stretch),
        cmocka_unit_test(test_simple_shear_keeps_the_volume),
        cmocka_unit_test(test_needle),
        cmocka_unit_test(test_small_strains_do_not_cancel),
        cmocka_unit_test(test_force_of_unequal_stretches),
        cmocka_unit_test(test_stiffness_at_rest),
        cmocka_unit_test(test_stiffness_of_unequal_stretches),
        cmocka_unit_test(test_rigid_motion_has_no_energy_and_no_force),
        cmocka_unit_test(test_flat_and_inverted_are_infeasible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
