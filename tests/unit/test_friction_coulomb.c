/* Coulomb's law: its two values, rest, and that it remembers nothing. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/massspring.h"

static const cipc_friction_force coulomb = {.law = CIPC_LAW_COULOMB, .coulomb = 2, .breakaway = 3, .sigma1 = 7};

static void test_against_the_motion(void **state)
{
    (void)state;
    const double speeds[] = {5e-324, 1e-3, 1, 1e300};
    for (int i = 0; i < 4; i++) {
        double z = 0.25;
        assert_true(cipc_friction_step(&coulomb, speeds[i], 0.01, &z) == 2);
        assert_true(cipc_friction_step(&coulomb, -speeds[i], 0.01, &z) == -2);
        assert_true(z == 0.25);
    }
}

/* At rest there is no force of its own; what the load may be is the level. */
static void test_at_rest(void **state)
{
    (void)state;
    double z = 0.25;
    assert_true(cipc_friction_step(&coulomb, 0, 0.01, &z) == 0 && z == 0.25);
    assert_true(cipc_friction_step(&coulomb, -0.0, 0.01, &z) == 0);
    assert_true(cipc_friction_level(&coulomb, 0) == 3 && cipc_friction_level(&coulomb, 5e-324) == 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_the_motion),
        cmocka_unit_test(test_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
