/* Samplers of nodes, triangles and hinges: legal, on the branch aimed at; the classifiers on configurations made by hand. */
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
            assert_true(isfinite(energy->value(x, &params)));
            hits += energy->branch(x, &params) == branch;
        }
        if (hits < SAMPLES * 9 / 10) fail_msg("%s: branch %s hit %d times of %d", name, energy->branch_names[branch], hits, SAMPLES);
    }
    gsl_rng_free(rng);
}

static void test_samplers_hit_their_branches(void **state)
{
    (void)state;
    check_sampler("inertia");
    check_sampler("gravity");
    check_sampler("dirichlet_penalty");
    check_sampler("membrane_neo_hookean");
    check_sampler("membrane_stvk");
    check_sampler("strain_limit");
    check_sampler("hinge_bending");
}

static void assert_branch(const char *energy_name, const double *x, const void *params, const char *branch)
{
    const cipc_energy *energy = cipc_energy_find(energy_name);
    assert_string_equal(energy->branch_names[energy->branch(x, params)], branch);
}

static const double rest[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/* The rest triangle stretched by a and b along its legs. */
static const double *stretched(double a, double b, double x[9])
{
    const double made[9] = {0, 0, 0, a, 0, 0, 0, b, 0};
    for (int i = 0; i < 9; i++) x[i] = made[i];
    return x;
}

static void test_membrane_classifier(void **state)
{
    (void)state;
    cipc_membrane p;
    double x[9];
    assert_true(cipc_membrane_init(&p, rest, 1, 1, 0.3));
    assert_branch("membrane_stvk", rest, &p, "rest");
    assert_branch("membrane_stvk", stretched(1.2, 1, x), &p, "stretched");
    assert_branch("membrane_stvk", stretched(0.8, 1, x), &p, "compressed");
    assert_branch("membrane_stvk", stretched(0.8, 1.1, x), &p, "sheared");
    assert_branch("membrane_stvk", stretched(0.001, 1.1, x), &p, "near_degenerate");
}

static void test_strain_limit_classifier(void **state)
{
    (void)state;
    cipc_strain_limit p;
    double x[9];
    assert_true(cipc_strain_limit_init(&p, rest, 1, 2, 1.5, 1));
    assert_branch("strain_limit", stretched(1.5, 1, x), &p, "inactive");
    assert_branch("strain_limit", stretched(1, 1.500001, x), &p, "threshold");
    assert_branch("strain_limit", stretched(1.2, 1.75, x), &p, "one_active");
    assert_branch("strain_limit", stretched(0, 1.75, x), &p, "one_active_collapsed");
    assert_branch("strain_limit", stretched(1.6, 1.75, x), &p, "both_active");
    assert_branch("strain_limit", stretched(1.75, 1.75, x), &p, "near_equal");
    assert_branch("strain_limit", stretched(1.6, 1.999999, x), &p, "near_limit");
}

static void test_hinge_classifier(void **state)
{
    (void)state;
    const double angles[] = {0, 1e-3, 1, -1, 3.1, -3.1};
    const char *const names[] = {"flat", "small", "large_positive", "large_negative", "near_pi_positive", "near_pi_negative"};
    const cipc_hinge_bending straight = {.stiffness = 1}, curved = {.stiffness = 1, .rest_angle = 0.1};
    for (int i = 0; i < 6; i++) {
        const double x[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -cos(angles[i]), -sin(angles[i])};
        assert_branch("hinge_bending", x, &straight, names[i]);
    }
    const double flat[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0}, sliver[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.001, 0.001};
    assert_branch("hinge_bending", flat, &curved, "flat_curved_rest");
    assert_branch("hinge_bending", sliver, &straight, "sliver");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_membrane_classifier),
        cmocka_unit_test(test_strain_limit_classifier),
        cmocka_unit_test(test_hinge_classifier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
