/* Samplers of the lower strain limit and the orthotropic membrane: legal, on the branch aimed at; the classifiers on configurations made by hand. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/energy.h"

enum { SAMPLES = 200, MAX_N = 12, MAX_PARAMS = 512 };

/* Every draw is feasible, and at least nine in ten land where they are aimed (rounding moves some at the edges of the narrow branches). */
static void check_sampler(const char *name)
{
    const cipc_energy *energy = cipc_energy_find(name);
    union {
        double align;
        unsigned char bytes[MAX_PARAMS];
    } params;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    assert_true(energy->params_size <= sizeof params);
    for (int branch = 0; branch < energy->branch_count; branch++) {
        int hits = 0;
        for (int k = 0; k < SAMPLES; k++) {
            double x[MAX_N];
            energy->sample(rng, branch, x, &params);
            if (!isfinite(energy->value(x, &params))) fail_msg("%s: branch %s: infeasible", name, energy->branch_names[branch]);
            hits += energy->branch(x, &params) == branch;
        }
        if (hits < SAMPLES * 9 / 10) fail_msg("%s: branch %s hit %d times of %d", name, energy->branch_names[branch], hits, SAMPLES);
    }
    gsl_rng_free(rng);
}

static void assert_branch(const char *energy_name, const double *x, const void *params, const char *branch)
{
    const cipc_energy *energy = cipc_energy_find(energy_name);
    assert_string_equal(energy->branch_names[energy->branch(x, params)], branch);
}

static void test_samplers_hit_their_branches(void **state)
{
    (void)state;
    check_sampler("strain_limit_lower");
    check_sampler("membrane_orthotropic");
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
    assert_branch("strain_limit_lower", strained(0.75, 0, 1, x), &p, "inactive");
    assert_branch("strain_limit_lower", strained(1, 0, 0.749999, x), &p, "threshold");
    assert_branch("strain_limit_lower", strained(0.6, 0, 0.8, x), &p, "one_active");
    assert_branch("strain_limit_lower", strained(0.6, 0, 0.7, x), &p, "both_active");
    assert_branch("strain_limit_lower", strained(0.625, 0, 0.625, x), &p, "near_equal");
    assert_branch("strain_limit_lower", strained(0.6, 0, 0.500001, x), &p, "near_limit");
}

static void test_orthotropic_classifier(void **state)
{
    (void)state;
    const double moduli[4] = {1, 1, 1, 1}, limits[3] = {0.5, 0.25, 0.125}, warp[3] = {1, 0, 0}, weft[3] = {0.1, 1, 0};
    cipc_orthotropic p;
    double x[9];
    assert_true(cipc_orthotropic_init(&p, rest, 1, warp, NULL, moduli, limits));
    assert_branch("membrane_orthotropic", rest, &p, "rest");
    assert_branch("membrane_orthotropic", strained(1.2, 0, 1.1, x), &p, "stretched");
    assert_branch("membrane_orthotropic", strained(0.9, 0, 0.9, x), &p, "compressed");
    assert_branch("membrane_orthotropic", strained(0.9, 0, 1.1, x), &p, "mixed");
    assert_branch("membrane_orthotropic", strained(1, 0.1, 1, x), &p, "sheared");
    assert_branch("membrane_orthotropic", strained(sqrt(2) - 1e-6, 0, 1, x), &p, "near_limit");
    assert_branch("membrane_orthotropic", strained(1, -0.249999, 1, x), &p, "near_shear_limit");
    assert_true(cipc_orthotropic_init(&p, rest, 1, warp, weft, moduli, limits));
    assert_branch("membrane_orthotropic", rest, &p, "rest_skew");
    assert_branch("membrane_orthotropic", strained(0.9, 0, 0.9, x), &p, "compressed_skew");
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
