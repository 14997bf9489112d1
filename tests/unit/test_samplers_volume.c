/* Sampler of tetrahedra: legal, on the branch aimed at; the classifier on configurations made by hand. */
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
    check_sampler("volume_corotational");
    check_sampler("volume_neo_hookean");
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
    assert_branch("volume_neo_hookean", rest, &p, "rest");
    assert_branch("volume_neo_hookean", deformed(1.001, 1, 1, 0, x), &p, "strained");
    assert_branch("volume_neo_hookean", deformed(1.5, 1.2, 4, 0, x), &p, "stretched");
    assert_branch("volume_neo_hookean", deformed(0.5, 0.2, 0.9, 0, x), &p, "compressed");
    assert_branch("volume_neo_hookean", deformed(0.5, 2, 1, 0, x), &p, "mixed");
    assert_branch("volume_neo_hookean", deformed(1, 1, 1, 1, x), &p, "mixed"); /* stretches of a shear by 1: 1.618 and its inverse */
    assert_branch("volume_neo_hookean", deformed(1, 1, 1, 20000, x), &p, "needle"); /* 2e4, 1, 5e-5 */
    assert_branch("volume_neo_hookean", deformed(1, 0.9, 1e-6, 0.1, x), &p, "flattened");
    assert_branch("volume_neo_hookean", deformed(1, 1e-3, 1e-3, 0, x), &p, "needle");
    assert_branch("volume_neo_hookean", deformed(2, 2, 2, 0, x), &p, "near_equal");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_classifier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
