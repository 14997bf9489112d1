/* R1 and R1s: state and force against MPFR, the level that falls with speed, the band. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "massspring/friction.h"
#include "support/exact_friction.h"
#include "support/exact_geometry.h"

static cipc_friction_force random_force(uint64_t *seed, int smooth)
{
    double coulomb = pow(10, random_uniform(seed, -3, 3));
    return (cipc_friction_force){.law = smooth ? CIPC_LAW_BIDIRECTIONAL_SMOOTH : CIPC_LAW_BIDIRECTIONAL, .sigma0 = pow(10, random_uniform(seed, 0, 6)), .sigma1 = pow(10, random_uniform(seed, -3, 3)),
                                 .coulomb = coulomb, .breakaway = coulomb * random_uniform(seed, 1, 2), .band = 1e-3};
}

/* As for Dahl's law (test_friction_dahl.c), but |z| <= 2 b: 7 roundings of |b - z| share <= 3 b share, and 3. The rate has 8 of (|z| + b) share. */
static void test_against_high_precision(void **state)
{
    (void)state;
    uint64_t seed = 3;
    int limited = 0, falling = 0;
    for (int i = 0; i < 20000; i++) {
        cipc_friction_force force = random_force(&seed, i % 2);
        double v = pow(10, random_uniform(&seed, -6, 2)) * (i % 4 < 2 ? 1 : -1), level = cipc_friction_level(&force, fabs(v)), bound = level / force.sigma0;
        double dt = bound / fabs(v) * pow(10, random_uniform(&seed, -6, 2)), z = random_uniform(&seed, -1, 1) * force.breakaway / force.sigma0, got = z;
        exact_friction want = exact_friction_step(level, force.sigma0, v, dt, z);
        double F = cipc_friction_step(&force, v, dt, &got), differential = fmin(force.sigma1, 4 * level / fabs(v));
        double share = massspring_dahl_share(fabs(v) * dt, bound), rate_off = 9 * UNIT_ROUNDOFF * (fabs(z) + bound) * share, off = 24 * UNIT_ROUNDOFF * want.size;
        assert_true(fabs(got - want.z) <= off);
        double damping = differential * want.change / dt, allowed = force.sigma0 * off + differential * rate_off / dt + 4 * UNIT_ROUNDOFF * (fabs(damping) + fabs(force.sigma0 * want.z));
        if (!(fabs(F - (force.sigma0 * want.z + damping)) <= allowed)) fail_msg("got %.17g, wanted %.17g", F, force.sigma0 * want.z + damping);
        limited += differential < force.sigma1;
        falling += fabs(z) > bound && z * v > 0;
    }
    assert_true(limited > 1000 && falling > 1000);
}

/* Built up slowly to Fs, then faster than the band: the force falls to Fc, and on the way the differential term is negative. */
static void test_the_level_falls_with_speed(void **state)
{
    (void)state;
    for (int smooth = 0; smooth < 2; smooth++) {
        cipc_friction_force force = {.law = smooth ? CIPC_LAW_BIDIRECTIONAL_SMOOTH : CIPC_LAW_BIDIRECTIONAL, .sigma0 = 100, .sigma1 = 1, .coulomb = 1, .breakaway = 1.5, .band = 1e-3};
        double z = 0, slow = smooth ? 1e-12 : 1e-3;
        (void)cipc_friction_step(&force, slow, 100 / slow, &z);
        assert_true(fabs(100 * z - 1.5) <= 8 * UNIT_ROUNDOFF);
        double falling = cipc_friction_step(&force, 1, 0.001, &z), left = exp(-0.1);
        assert_true(fabs(falling - (1 + 0.5 * left - 5 * (1 - left))) <= 1e-12); /* z goes from 0.015 to 0.01 + 0.005 e^-0.1 within a millisecond */
        assert_true(fabs(cipc_friction_step(&force, 1, 100, &z) - 1) <= 1e-4); /* the mean rate of these 100 s is not yet 0 */
        assert_true(fabs(100 * z - 1) <= 4 * UNIT_ROUNDOFF);
    }
}

/* A differential term resists also where z does not: right after turning round. */
static void test_turning_round(void **state)
{
    (void)state;
    cipc_friction_force force = {.law = CIPC_LAW_BIDIRECTIONAL, .sigma0 = 100, .sigma1 = 1, .coulomb = 1, .breakaway = 1, .band = 0};
    double z = 0.01, F = cipc_friction_step(&force, -1, 1e-6, &z);
    assert_true(fabs(F - (1 - 2)) <= 1e-3); /* sigma0 z = Fc still, dz/dt = v (1 + 1) */
    assert_true(cipc_friction_step(&force, 0, 1, &z) == 100 * z);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_high_precision),
        cmocka_unit_test(test_the_level_falls_with_speed),
        cmocka_unit_test(test_turning_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
