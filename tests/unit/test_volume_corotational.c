/* Fixed corotational tetrahedron: exact energies, forces and stiffnesses in principal stretches, rotated ones, collapse. */
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

static double energy_of(const cipc_volume *p, double a, double b, double c)
{
    double J = a * b * c, shape = (a - 1) * (a - 1) + (b - 1) * (b - 1) + (c - 1) * (c - 1);
    return p->volume * (p->mu * shape + p->lambda / 2 * (J - 1) * (J - 1));
}

static void test_energy_of_stretches(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double stretches[][3] = {{1.5, 0.5, 2}, {3, 3, 3}, {1, 1, 1e-6}, {1, 1e-4, 2e-4}, {1.25, 1, 1}};
    for (size_t i = 0; i < sizeof stretches / sizeof *stretches; i++) {
        const double *s = stretches[i];
        double x[SIZE];
        stretch(s[0], s[1], s[2], x);
        assert_relative(cipc_volume_corotational_value(x, &p), energy_of(&p, s[0], s[1], s[2]), ROUNDINGS);
    }
}

/* R diag(2, 3, 0.5) with R the rotation by 3-4-5, and turned by half a circle. */
static void test_rotation_costs_nothing(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double turned[9] = {1.2, -2.4, 0, 1.6, 1.8, 0, 0, 0, 0.5}, half[9] = {-2, 0, 0, 0, -3, 0, 0, 0, 0.5};
    double x[SIZE];
    deform(turned, x);
    assert_relative(cipc_volume_corotational_value(x, &p), energy_of(&p, 2, 3, 0.5), ROUNDINGS);
    deform(half, x);
    assert_relative(cipc_volume_corotational_value(x, &p), energy_of(&p, 2, 3, 0.5), ROUNDINGS);
}

/* Simple shear by 2 tan a is the rotation by -a after stretches of the roots of C: sum of stretches 2 sec a + 1. */
static void test_simple_shear(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double F[9] = {1, 1.5, 0, 0, 1, 0, 0, 0, 1}; /* 2 tan a = 3/2, sec a = 5/4, stretches 2 and 1/2 */
    double x[SIZE];
    deform(F, x);
    assert_relative(cipc_volume_corotational_value(x, &p), energy_of(&p, 2, 0.5, 1), ROUNDINGS);
}

/* P = 2 mu (sigma - 1) + lambda (J - 1) J / sigma. */
static void test_force_of_unequal_stretches(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double sigma[3] = {1.5, 0.5, 2};
    double x[SIZE], g[SIZE], J = 1.5;
    stretch(sigma[0], sigma[1], sigma[2], x);
    cipc_volume_corotational_gradient(x, &p, g);
    for (int a = 0; a < 3; a++) {
        double stress = p.volume * (2 * p.mu * (sigma[a] - 1) + p.lambda * (J - 1) * J / sigma[a]);
        assert_relative(g[place(a, a)], stress, ROUNDINGS);
        assert_relative(g[a], -stress, ROUNDINGS); /* node 0 balances */
    }
    assert_true(fabs(g[place(0, 1)]) <= ROUNDINGS * p.volume * p.mu);
}

/* 2 mu + lambda (J/sigma_a)^2 along, lambda (2 J - 1) sigma_c between; of shears 2 mu (1 - 1/(sigma_a + sigma_b)) each and
 * 2 mu/(sigma_a + sigma_b) - lambda (J - 1) sigma_c between two of one plane. */
static void test_stiffness_of_unequal_stretches(void **state)
{
    (void)state;
    cipc_volume p = material();
    double x[SIZE], H[SIZE * SIZE], J = 1.5;
    stretch(1.5, 0.5, 2, x);
    cipc_volume_corotational_hessian(x, &p, H);
    assert_relative(H[place(1, 1) * SIZE + place(1, 1)], p.volume * (2 * p.mu + p.lambda * 9), ROUNDINGS);
    assert_relative(H[place(0, 0) * SIZE + place(2, 2)], p.volume * p.lambda * (2 * J - 1) * 0.5, ROUNDINGS);
    assert_relative(H[place(0, 2) * SIZE + place(0, 2)], p.volume * 2 * p.mu * (1 - 1 / 3.5), ROUNDINGS);
    assert_relative(H[place(0, 2) * SIZE + place(2, 0)], p.volume * (2 * p.mu / 3.5 - p.lambda * (J - 1) * 0.5), ROUNDINGS);
    assert_relative(H[place(1, 2) * SIZE + place(2, 1)], p.volume * (2 * p.mu / 2.5 - p.lambda * (J - 1) * 1.5), ROUNDINGS);
}

/* Below sigma_a + sigma_b = 1 a shear has negative stiffness: the Hessian is exact, not projected. */
static void test_compression_is_not_convex(void **state)
{
    (void)state;
    cipc_volume p = material();
    double x[SIZE], H[SIZE * SIZE];
    stretch(0.25, 0.25, 1, x);
    cipc_volume_corotational_hessian(x, &p, H);
    assert_relative(H[place(0, 1) * SIZE + place(0, 1)], -2 * p.volume * p.mu, ROUNDINGS);
}

static void test_rigid_motion_has_no_energy_and_no_force(void **state)
{
    (void)state;
    cipc_volume p = material();
    /* Rotation by 3-4-5 about an axis, by 5-12-13 about another, and a shift. */
    const double c = 5 / 13.0, s = 12 / 13.0;
    const double x[SIZE] = {7, -2, 1, 7 + 0.6, -2 + 0.8 * c, 1 + 0.8 * s, 7 - 0.8, -2 + 0.6 * c, 1 + 0.6 * s, 7, -2 - s, 1 + c};
    double g[SIZE];
    cipc_volume_corotational_gradient(x, &p, g);
    /* Positions of size 7 round the strain by 7 u. */
    assert_true(cipc_volume_corotational_value(x, &p) < (p.mu + p.lambda) * pow(7 * ROUNDINGS, 2));
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i]) < (p.mu + p.lambda) * 7 * ROUNDINGS);
}

static void test_flat_and_inverted_are_infeasible(void **state)
{
    (void)state;
    cipc_volume p = material();
    const double shear[9] = {1, 0, 1, 0, 1, 1, 1, 1, 2};
    double x[SIZE];
    deform(shear, x);
    assert_true(cipc_volume_corotational_value(x, &p) == INFINITY);
    stretch(1, 1, 0, x);
    assert_true(cipc_volume_corotational_value(x, &p) == INFINITY);
    stretch(1, 1, -1, x);
    assert_true(cipc_volume_corotational_value(x, &p) == INFINITY);
    stretch(1, NAN, 1, x);
    assert_true(cipc_volume_corotational_value(x, &p) == INFINITY);
    stretch(1, 1, 1e-12, x);
    assert_true(isfinite(cipc_volume_corotational_value(x, &p)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_energy_of_stretches),
        cmocka_unit_test(test_rotation_costs_nothing),
        cmocka_unit_test(test_simple_shear),
        cmocka_unit_test(test_force_of_unequal_stretches),
        cmocka_unit_test(test_stiffness_of_unequal_stretches),
        cmocka_unit_test(test_compression_is_not_convex),
        cmocka_unit_test(test_rigid_motion_has_no_energy_and_no_force),
        cmocka_unit_test(test_flat_and_inverted_are_infeasible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
