/* Dahl's law: the exact step against MPFR, tiny and huge steps, steady motion, no load. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "massspring/friction.h"
#include "support/exact_friction.h"
#include "support/exact_geometry.h"

/* In units of 2^-53 of |z| e^-u + b(1 - e^-u), b = Fc/sigma0, |z| <= b: travel and b round once each, their quotient once (1.5 in all, and u e^-u <= 1 - e^-u), expm1 2, b - z and the product 1 each:
 * 7 of |b - z|(1 - e^-u) <= 2 b(1 - e^-u); b itself 1, the sum 1, the reference 1. */
static const double ROUNDINGS = 17 * UNIT_ROUNDOFF;

static cipc_friction_force dahl(double coulomb, double sigma0)
{
    return (cipc_friction_force){.law = CIPC_LAW_DAHL, .sigma0 = sigma0, .coulomb = coulomb, .breakaway = coulomb};
}

static double power(uint64_t *seed, double low, double high) { return pow(10, random_uniform(seed, low, high)); }

/* Velocities from 1e-250 to 1e250: z' comes down to 1e-259, and exponents overflow. */
static void test_against_high_precision(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int tiny = 0, saturated = 0, turned = 0;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        double decades = i % 2 ? 250 : 6;
        cipc_friction_force force = dahl(power(&seed, -9, 6), power(&seed, -3, 9));
        double bound = force.coulomb / force.sigma0, dt = power(&seed, -9, 3), v = power(&seed, -decades, decades) * (i % 4 < 2 ? 1 : -1);
        if (i % 3 == 0) v = copysign(bound / dt * power(&seed, -3, 2), v); /* where the exponential bends */
        double z = i % 5 == 0 ? 0 : i % 5 == 1 ? copysign(bound, v) * (i % 10 == 1 ? -1 : 0.999) : random_uniform(&seed, -1, 1) * bound, got = z;
        exact_friction want = exact_friction_step(force.coulomb, force.sigma0, v, dt, z);
        double F = cipc_friction_step(&force, v, dt, &got), off = fabs(got - want.z) / (ROUNDINGS * want.size);
        if (!(off <= 1)) fail_msg("Fc %.17g sigma0 %.17g v %.17g dt %.17g z %.17g: got %.17g, wanted %.17g", force.coulomb, force.sigma0, v, dt, z, got, want.z);
        assert_true(F == force.sigma0 * got);
        worst = fmax(worst, off);
        tiny += want.size < 1e-200;
        saturated += fabs(want.z) >= bound * (1 - 1e-15);
        turned += z * want.z < 0;
    }
    print_message("exact step: %.2g of the bound; %d below 1e-200, %d saturated, %d turned round\n", worst, tiny, saturated, turned);
    assert_true(tiny > 100 && saturated > 1000 && turned > 500);
}

/* From 0 the force of a small displacement has all its digits, and so has the rate, of which sigma1 makes a force. */
static void test_digits_of_a_small_change(void **state)
{
    (void)state;
    cipc_friction_force force = dahl(2, 5);
    double z = 0;
    assert_true(fabs(cipc_friction_step(&force, 1e-20, 1, &z) - 5e-20) <= ROUNDINGS * 5e-20);
    exact_friction want = exact_friction_step(2, 5, 1e-20, 1, 0.1);
    assert_true(fabs(massspring_dahl_change(1e-20, 1, 0.4, 0.1) - want.change) <= ROUNDINGS * want.change);
    assert_true(fabs(massspring_dahl_share(1e-30, 1) - 1e-30) <= ROUNDINGS * 1e-30);
}

static void test_two_halves_are_the_step(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 1000; i++) {
        cipc_friction_force force = dahl(2, 5);
        double v = power(&seed, -4, 2) * (i % 2 ? 1 : -1), whole = random_uniform(&seed, -0.4, 0.4), halves = whole;
        cipc_friction_step(&force, v, 0.25, &whole);
        cipc_friction_step(&force, v, 0.125, &halves);
        cipc_friction_step(&force, v, 0.125, &halves);
        assert_true(fabs(whole - halves) <= 3 * ROUNDINGS * 0.4);
    }
}

/* No step, no velocity: nothing moves. The steady state is left by not one bit. Nothing is hidden that is not a number. */
static void test_rest_and_steady_motion(void **state)
{
    (void)state;
    cipc_friction_force force = dahl(2, 5);
    double z = 0.3;
    assert_true(cipc_friction_step(&force, 0, 1, &z) == 5 * 0.3 && z == 0.3);
    for (int sign = -1; sign < 2; sign += 2) {
        double bound = sign * (force.coulomb / force.sigma0);
        z = bound;
        for (int i = 0; i < 100; i++) assert_true(cipc_friction_step(&force, sign * (0.01 + i), 0.01, &z) == 5 * bound && z == bound);
    }
    assert_true(isnan(cipc_friction_step(&force, NAN, 1, &z)));
}

static void test_no_load_no_force(void **state)
{
    (void)state;
    cipc_friction_force force = dahl(0, 5);
    double z = 0.3;
    assert_true(cipc_friction_step(&force, 1e-9, 1e-3, &z) == 0 && z == 0);
    assert_true(cipc_friction_step(&force, -1e-200, 1e-200, &z) == 0 && z == 0); /* a travel that underflows */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_high_precision),
        cmocka_unit_test(test_digits_of_a_small_change),
        cmocka_unit_test(test_two_halves_are_the_step),
        cmocka_unit_test(test_rest_and_steady_motion),
        cmocka_unit_test(test_no_load_no_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
