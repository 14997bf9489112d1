/* Sampler of tetrahedra: legal, on the branch aimed at; the classifier on configurations made by hand. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/energy.h"
#include "support/sampler_trial.h"

static void test_samplers_hit_their_branches(void **state)
{
    (void)state;
    sampler_check("volume_corotational");
    sampler_check("volume_neo_hookean");
}

/* Simple shear after the stretches a, b, c: the classifier has to find stretches, not lengths. */
static const double *deformed(double a, double b, double c, double shear, double x[12])
{
    const double made[12] = {0, 0, 0, a, 0, 0, shear * b, b, 0, 0, 0, c};
    for (int i = 0; i < 12; i++) x[i] = made[i];
    return x;
}

static void test_classifier(void **state)
{
    (void)state;
    const double rest[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    cipc_volume p;
    double x[12];
    assert_true(cipc_volume_init(&p, rest, 1, 0.3));
    sampler_assert_branch("volume_neo_hookean", rest, &p, "rest");
    sampler_assert_branch("volume_neo_hookean", deformed(1.001, 1, 1, 0, x), &p, "strained");
    sampler_assert_branch("volume_neo_hookean", deformed(1.5, 1.2, 4, 0, x), &p, "stretched");
    sampler_assert_branch("volume_neo_hookean", deformed(0.5, 0.2, 0.9, 0, x), &p, "compressed");
    sampler_assert_branch("volume_neo_hookean", deformed(0.5, 2, 1, 0, x), &p, "mixed");
    sampler_assert_branch("volume_neo_hookean", deformed(1, 1, 1, 1, x), &p, "mixed"); /* stretches of a shear by 1: 1.618 and its inverse */
    sampler_assert_branch("volume_neo_hookean", deformed(1, 1, 1, 20000, x), &p, "needle"); /* 2e4, 1, 5e-5 */
    sampler_assert_branch("volume_neo_hookean", deformed(1, 0.9, 1e-6, 0.1, x), &p, "flattened");
    sampler_assert_branch("volume_neo_hookean", deformed(1, 1e-3, 1e-3, 0, x), &p, "needle");
    sampler_assert_branch("volume_neo_hookean", deformed(2, 2, 2, 0, x), &p, "near_equal");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_classifier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
