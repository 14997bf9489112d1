/* Samplers of the lower strain limit and the orthotropic membrane: legal, on the branch aimed at; the classifiers on configurations made by hand. */
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
    sampler_check("strain_limit_lower");
    sampler_check("membrane_orthotropic");
}

static const double rest[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/* f1 = (a, 0, 0), f2 = (b, c, 0) of the rest triangle. */
static const double *strained(double a, double b, double c, double x[9])
{
    const double made[9] = {0, 0, 0, a, 0, 0, b, c, 0};
    for (int i = 0; i < 9; i++) x[i] = made[i];
    return x;
}

static void test_strain_limit_lower_classifier(void **state)
{
    (void)state;
    cipc_strain_limit p;
    double x[9];
    assert_true(cipc_strain_limit_lower_init(&p, rest, 1, 0.5, 0.75, 1));
    sampler_assert_branch("strain_limit_lower", strained(0.75, 0, 1, x), &p, "inactive");
    sampler_assert_branch("strain_limit_lower", strained(1, 0, 0.749999, x), &p, "threshold");
    sampler_assert_branch("strain_limit_lower", strained(0.6, 0, 0.8, x), &p, "one_active");
    sampler_assert_branch("strain_limit_lower", strained(0.6, 0, 0.7, x), &p, "both_active");
    sampler_assert_branch("strain_limit_lower", strained(0.625, 0, 0.625, x), &p, "near_equal");
    sampler_assert_branch("strain_limit_lower", strained(0.6, 0, 0.500001, x), &p, "near_limit");
}

static void test_orthotropic_classifier(void **state)
{
    (void)state;
    const double moduli[4] = {1, 1, 1, 1}, limits[3] = {0.5, 0.25, 0.125}, warp[3] = {1, 0, 0}, weft[3] = {0.1, 1, 0};
    cipc_orthotropic p;
    double x[9];
    assert_true(cipc_orthotropic_init(&p, rest, 1, warp, NULL, moduli, limits));
    sampler_assert_branch("membrane_orthotropic", rest, &p, "rest");
    sampler_assert_branch("membrane_orthotropic", strained(1.2, 0, 1.1, x), &p, "stretched");
    sampler_assert_branch("membrane_orthotropic", strained(0.9, 0, 0.9, x), &p, "compressed");
    sampler_assert_branch("membrane_orthotropic", strained(0.9, 0, 1.1, x), &p, "mixed");
    sampler_assert_branch("membrane_orthotropic", strained(1, 0.1, 1, x), &p, "sheared");
    sampler_assert_branch("membrane_orthotropic", strained(sqrt(2) - 1e-6, 0, 1, x), &p, "near_limit");
    sampler_assert_branch("membrane_orthotropic", strained(1, -0.249999, 1, x), &p, "near_shear_limit");
    assert_true(cipc_orthotropic_init(&p, rest, 1, warp, weft, moduli, limits));
    sampler_assert_branch("membrane_orthotropic", rest, &p, "rest_skew");
    sampler_assert_branch("membrane_orthotropic", strained(0.9, 0, 0.9, x), &p, "compressed_skew");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_strain_limit_lower_classifier),
        cmocka_unit_test(test_orthotropic_classifier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
