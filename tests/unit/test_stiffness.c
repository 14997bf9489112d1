/* The barrier stiffness: both rules against their formulas, the values of the released code, scaling, and supports shorter than the
 * probing gap. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/contact.h"

/* A dozen operations, a logarithm among them. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* b_DD of SPEC C.4, as it is written there. */
static double second_derivative(double D, double Dhat)
{
    return -2 * log(D / Dhat) - 4 * (D - Dhat) / D + (D - Dhat) * (D - Dhat) / (D * D);
}

/* SPEC C.7: 1e11 * 3 m / (4e-16 b_DD(1e-16; dhat^2)). For dhat = 1e-3 b_DD is 1e20 (1 + 4e-10), so kappa = 7.5e6 m. */
static void test_released_rule(void **state)
{
    (void)state;
    cipc_stiffness_range r = cipc_barrier_stiffness_range_released(2, 1e-3);
    assert_relative(r.minimum, 1e11 * 3 * 2 / (4e-16 * second_derivative(1e-16, 1e-6)), ROUNDINGS);
    assert_relative(r.minimum, 7.5e6 * 2, 1e-9);
    assert_true(r.maximum == 100 * r.minimum);
}

/* The scene drape29: two squares of 1 m^2 and a sphere of 0.2904478 m^2 (the area of its triangles), all of 472.641509 kg/m^3 and 0.318
 * mm: 0.344254 kg on 2521 nodes. The released code prints 1024.16. */
static void test_released_value(void **state)
{
    (void)state;
    static const double PRINTED_DIGITS = 0.005 / 1024;
    double mass = (1 + 1 + 0.2904478) * 472.641509 * 0.318e-3;
    assert_relative(cipc_barrier_stiffness_range_released(mass / 2521, 1e-3).minimum, 1024.16, PRINTED_DIGITS);
    assert_relative(cipc_barrier_stiffness_range_released(0.344255 / 2521, 1e-3).minimum, 1024.16, PRINTED_DIGITS);
    /* SPEC E4: mean mass 1e-5 kg, three times of it in the rule's mean: 25 for a third */
    assert_relative(cipc_barrier_stiffness_range_released(1e-5 / 3, 1e-3).minimum, 25, 1e-8);
}

/* SPEC D.4, with thickness: 1e11 m / (4 (1e-8 l + xi)^2 b_DD((1e-8 l + xi)^2 - xi^2, Dhat)). */
static void test_bounding_box_rule(void **state)
{
    (void)state;
    const double diagonals[] = {0.5, 1, 20}, offsets[] = {0, 1e-4, 1e-2};
    for (int i = 0; i < 9; i++) {
        double l = diagonals[i / 3], xi = offsets[i % 3], dhat = 1e-3, d = 1e-8 * l + xi;
        double D = 1e-16 * l * l + 2e-8 * l * xi, want = 1e11 * 0.25 / (4 * d * d * second_derivative(D, dhat * dhat + 2 * dhat * xi));
        cipc_stiffness_range r = cipc_barrier_stiffness_range(l, 0.25, xi, dhat);
        assert_relative(r.minimum, want, ROUNDINGS);
        assert_true(r.maximum == 100 * r.minimum);
    }
}

/* The released rule is that of a box of diagonal 1 m without thickness, with three times the mass. */
static void test_rules_agree(void **state)
{
    (void)state;
    for (double dhat = 1e-5; dhat < 1; dhat *= 10)
        assert_relative(cipc_barrier_stiffness_range_released(0.1, dhat).minimum, 3 * cipc_barrier_stiffness_range(1, 0.1, 0, dhat).minimum,
                        ROUNDINGS);
}

/* What the rule is for: at the gap 1e-8 l the barrier's stiffness along the normal, kappa b_DD (2 d)^2, is 1e11 m. */
static void test_meaning(void **state)
{
    (void)state;
    const double l = 2, m = 0.5, dhat = 1e-3, d = 1e-8 * l;
    double b[3];
    cipc_barrier(d * d, dhat * dhat, b);
    assert_relative(cipc_barrier_stiffness_range(l, m, 0, dhat).minimum * b[2] * 4 * d * d, 1e11 * m, ROUNDINGS);
}

static void test_proportional_to_mass(void **state)
{
    (void)state;
    assert_relative(cipc_barrier_stiffness_range(3, 8, 1e-3, 1e-3).minimum, 8 * cipc_barrier_stiffness_range(3, 1, 1e-3, 1e-3).minimum,
                    ROUNDINGS);
    assert_relative(cipc_barrier_stiffness_range_released(8, 1e-3).minimum, 8 * cipc_barrier_stiffness_range_released(1, 1e-3).minimum,
                    ROUNDINGS);
}

/* A support that the probing gap fills, or exceeds, would give no barrier and a stiffness of infinity: it is probed at a hundredth then. */
static void test_small_dhat(void **state)
{
    (void)state;
    const double offsets[] = {0, 1e-4};
    for (int i = 0; i < 2; i++) {
        double before = INFINITY;
        for (double dhat = 1e-12; dhat < 1e-2; dhat *= 10) {
            cipc_stiffness_range r = cipc_barrier_stiffness_range(10, 1, offsets[i], dhat);
            assert_true(r.minimum > 0 && isfinite(r.maximum));
            assert_true(r.minimum <= before); /* a wider support never asks for more */
            before = r.minimum;
        }
    }
    double dhat = 1e-9; /* l = 10: D = 1e-14 > dhat^2 */
    assert_relative(cipc_barrier_stiffness_range(10, 1, 0, dhat).minimum, 1e11 / (4 * 0.01 * dhat * dhat * second_derivative(0.01, 1)),
                    ROUNDINGS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_released_rule), cmocka_unit_test(test_released_value), cmocka_unit_test(test_bounding_box_rule),
        cmocka_unit_test(test_rules_agree),   cmocka_unit_test(test_meaning),        cmocka_unit_test(test_proportional_to_mass),
        cmocka_unit_test(test_small_dhat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
