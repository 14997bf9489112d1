/* Samplers of rods, stitches and damping: legal, on the branch aimed at; the classifiers on configurations made by hand. */
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
    sampler_check("rod_stretching");
    sampler_check("rod_bending");
    sampler_check("stitch");
    sampler_check("damping");
}

static void test_stretching_classifier(void **state)
{
    (void)state;
    const cipc_rod_stretching p = {.stiffness = 1, .length = 2};
    const double lengths[] = {2, 2.1, 1.9, 0.01};
    const char *const names[] = {"rest", "stretched", "compressed", "near_collapsed"};
    for (int i = 0; i < 4; i++) sampler_assert_branch("rod_stretching", (double[]){0, 0, 0, 0, lengths[i], 0}, &p, names[i]);
}

static void test_bending_classifier(void **state)
{
    (void)state;
    const double angles[] = {0, 1e-3, 1, 3.1};
    const char *const names[] = {"straight", "small", "large", "near_folded"};
    const char *const curved_names[] = {"small_curved_rest", "small_curved_rest", "large_curved_rest", "near_folded_curved_rest"};
    const cipc_rod_bending straight = {.stiffness = 1}, curved = {.stiffness = 1, .rest_curvature = 2};
    for (int i = 0; i < 4; i++) {
        const double x[9] = {-1, 0, 0, 0, 0, 0, cos(angles[i]), 0, sin(angles[i])};
        sampler_assert_branch("rod_bending", x, &straight, names[i]);
        sampler_assert_branch("rod_bending", x, &curved, curved_names[i]);
    }
    const double right[9] = {-1, 0, 0, 0, 0, 0, 0, 1, 0}, brief[9] = {-1, 0, 0, 0, 0, 0, 0, 0.01, 0};
    sampler_assert_branch("rod_bending", right, &curved, "at_curved_rest");
    sampler_assert_branch("rod_bending", brief, &curved, "short_segment_curved_rest");
    sampler_assert_branch("rod_bending", brief, &straight, "short_segment");
}

static void test_stitch_classifier(void **state)
{
    (void)state;
    const double x[9] = {1, 1, 0, 0, 0, 0, 4, 0, 0}, closed[9] = {1, 0, 0, 0, 0, 0, 4, 0, 0};
    sampler_assert_branch("stitch", x, &(cipc_stitch){1, 0}, "at_first");
    sampler_assert_branch("stitch", x, &(cipc_stitch){1, 1}, "at_second");
    sampler_assert_branch("stitch", x, &(cipc_stitch){1, 0.25}, "inside");
    sampler_assert_branch("stitch", closed, &(cipc_stitch){1, 0.25}, "closed");
    sampler_assert_branch("stitch", closed, &(cipc_stitch){1, 0}, "at_first");
}

static void test_damping_classifier(void **state)
{
    (void)state;
    /* A spring along x between the nodes 0 and `last`. */
    static const char *const names[] = {"two_nodes", "three_nodes", "four_nodes"};
    for (int last = 1; last <= 3; last++) {
        double H[144] = {0}, start[12] = {0}, x[12] = {0};
        int n = 3 * (last + 1), j = 3 * last + 2;
        cipc_damping p;
        H[2 * n + 2] = H[j * n + j] = 1;
        H[2 * n + j] = H[j * n + 2] = -1;
        cipc_damping_init(&p, 1, last + 1, start, H);
        sampler_assert_branch("damping", x, &p, "at_start");
        x[1] = 1;
        sampler_assert_branch("damping", x, &p, names[last - 1]);
        for (int i = 1; i < n; i += 3) x[i] = 1 + 0.001 * i;
        sampler_assert_branch("damping", x, &p, "in_flight");
        x[1] = 2;
        H[2 * n + 2] = 2;
        cipc_damping_init(&p, 1, last + 1, start, H);
        sampler_assert_branch("damping", x, &p, "grounded");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_stretching_classifier),
        cmocka_unit_test(test_bending_classifier),
        cmocka_unit_test(test_stitch_classifier),
        cmocka_unit_test(test_damping_classifier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
