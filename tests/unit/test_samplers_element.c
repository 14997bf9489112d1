/* Samplers of nodes, triangles and hinges: legal, on the branch aimed at; the classifiers on configurations made by hand. */
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
    sampler_check("inertia");
    sampler_check("gravity");
    sampler_check("dirichlet_penalty");
    sampler_check("membrane_neo_hookean");
    sampler_check("membrane_stvk");
    sampler_check("strain_limit");
    sampler_check("hinge_bending");
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
    sampler_assert_branch("membrane_stvk", rest, &p, "rest");
    sampler_assert_branch("membrane_stvk", stretched(1.2, 1, x), &p, "stretched");
    sampler_assert_branch("membrane_stvk", stretched(0.8, 1, x), &p, "compressed");
    sampler_assert_branch("membrane_stvk", stretched(0.8, 1.1, x), &p, "sheared");
    sampler_assert_branch("membrane_stvk", stretched(0.001, 1.1, x), &p, "near_degenerate");
}

static void test_strain_limit_classifier(void **state)
{
    (void)state;
    cipc_strain_limit p;
    double x[9];
    assert_true(cipc_strain_limit_init(&p, rest, 1, 2, 1.5, 1));
    sampler_assert_branch("strain_limit", stretched(1.5, 1, x), &p, "inactive");
    sampler_assert_branch("strain_limit", stretched(1, 1.500001, x), &p, "threshold");
    sampler_assert_branch("strain_limit", stretched(1.2, 1.75, x), &p, "one_active");
    sampler_assert_branch("strain_limit", stretched(0, 1.75, x), &p, "one_active_collapsed");
    sampler_assert_branch("strain_limit", stretched(1.6, 1.75, x), &p, "both_active");
    sampler_assert_branch("strain_limit", stretched(1.75, 1.75, x), &p, "near_equal");
    sampler_assert_branch("strain_limit", stretched(1.6, 1.999999, x), &p, "near_limit");
}

static void test_hinge_classifier(void **state)
{
    (void)state;
    const double angles[] = {0, 1e-3, 1, -1, 3.1, -3.1};
    const char *const names[] = {"flat", "small", "large_positive", "large_negative", "near_pi_positive", "near_pi_negative"};
    const cipc_hinge_bending straight = {.stiffness = 1}, curved = {.stiffness = 1, .rest_angle = 0.1};
    for (int i = 0; i < 6; i++) {
        const double x[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -cos(angles[i]), -sin(angles[i])};
        sampler_assert_branch("hinge_bending", x, &straight, names[i]);
    }
    const double flat[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0}, sliver[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.001, 0.001};
    sampler_assert_branch("hinge_bending", flat, &curved, "flat_curved_rest");
    sampler_assert_branch("hinge_bending", sliver, &straight, "sliver");
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
