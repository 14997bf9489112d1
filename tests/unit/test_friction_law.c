/* The laws together: names, levels, the bound of the differential term, each law its own force. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "massspring/friction.h"
#include "support/exact_geometry.h"

static const cipc_friction_force sample = {.sigma0 = 10, .sigma1 = 3, .coulomb = 2, .breakaway = 3, .band = 0.25};

static cipc_friction_force of_law(cipc_friction_law law)
{
    cipc_friction_force force = sample;
    force.law = law;
    return force;
}

static void test_names(void **state)
{
    (void)state;
    const char *const names[CIPC_LAW_COUNT] = {"coulomb", "dahl", "bidirectional", "bidirectional-smooth", "clamped"};
    for (int law = 0; law < CIPC_LAW_COUNT; law++) assert_string_equal(cipc_friction_law_name((cipc_friction_law)law), names[law]);
    assert_string_equal(cipc_friction_law_name(CIPC_LAW_COUNT), "unknown");
}

/* At rest, inside the band, at its edge, just beyond, far beyond. */
static void test_levels(void **state)
{
    (void)state;
    const double speeds[5] = {0, 0.125, 0.25, 0.25 + 0x1p-54, 50}, e = exp(-0.25), f = exp(-1);
    const double levels[CIPC_LAW_COUNT][5] = {{3, 2, 2, 2, 2}, {2, 2, 2, 2, 2}, {3, 3, 3, 2, 2}, {3, 2 + e, 2 + f, 2 + f, 2}, {3, 3, 3, 2, 2}};
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law((cipc_friction_law)law);
        for (int i = 0; i < 5; i++) assert_true(fabs(cipc_friction_level(&force, speeds[i]) - levels[law][i]) <= 4 * UNIT_ROUNDOFF * 3);
        force.band = 0; /* static friction at rest only */
        assert_true(law == CIPC_LAW_DAHL || cipc_friction_level(&force, 0) == 3);
        assert_true(cipc_friction_level(&force, 1e-300) == 2);
    }
}

/* sigma1 |v| <= 4 h, and what is below is left alone. */
static void test_differential(void **state)
{
    (void)state;
    for (int law = CIPC_LAW_BIDIRECTIONAL; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law((cipc_friction_law)law);
        assert_true(massspring_differential(&force, 2, 0) == 3);
        assert_true(massspring_differential(&force, 2, 8.0 / 3) == 3);
        assert_true(massspring_differential(&force, 2, 4) == 2 && massspring_differential(&force, 2, 16) == 0.5);
        assert_true(massspring_differential(&force, 0, 16) == 0);
    }
    cipc_friction_force dahl = of_law(CIPC_LAW_DAHL), coulomb = of_law(CIPC_LAW_COULOMB);
    assert_true(massspring_differential(&dahl, 2, 1) == 0 && massspring_differential(&coulomb, 2, 1) == 0);
}

/* One small step from rest at a slow speed; by hand: b = 0.2 (Dahl), 0.3 (in the band), travel 0.03. */
static void test_each_law_its_own(void **state)
{
    (void)state;
    const double v = 0.125, dt = 0.24, s = 2 + exp(-0.25), dahl = 0.2 * (1 - exp(-0.15)), banded = 0.3 * (1 - exp(-0.1)), smooth = s / 10 * (1 - exp(-0.3 / s));
    const double wanted[CIPC_LAW_COUNT] = {2, 10 * dahl, banded * (10 + 3 / dt), smooth * (10 + 3 / dt), 0.03 * (10 + 3 / dt)};
    for (int law = 0; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law((cipc_friction_law)law);
        double z = 0, back = 0;
        assert_true(fabs(cipc_friction_step(&force, v, dt, &z) - wanted[law]) <= 64 * UNIT_ROUNDOFF * wanted[law]);
        assert_true(fabs(cipc_friction_step(&force, -v, dt, &back) + wanted[law]) <= 64 * UNIT_ROUNDOFF * wanted[law]);
        assert_true(back == -z);
    }
}

/* |z| <= max(h)/sigma0, through any motion, up to one rounding. */
static void test_bound_of_the_state(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int law = CIPC_LAW_DAHL; law < CIPC_LAW_COUNT; law++) {
        cipc_friction_force force = of_law((cipc_friction_law)law);
        double z = 0, most = 0;
        for (int i = 0; i < 100000; i++) {
            double v = pow(10, random_uniform(&seed, -4, 2)) * (random_below(&seed, 2) ? 1 : -1);
            cipc_friction_step(&force, v, pow(10, random_uniform(&seed, -4, 1)), &z);
            most = fmax(most, fabs(z));
        }
        double bound = (law == CIPC_LAW_DAHL ? 2 : 3) / 10.0;
        assert_true(most <= bound * (1 + 4 * UNIT_ROUNDOFF) && most >= 0.9 * bound);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_levels),
        cmocka_unit_test(test_differential),
        cmocka_unit_test(test_each_law_its_own),
        cmocka_unit_test(test_bound_of_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
