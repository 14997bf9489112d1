/* Split strain limits: the limit holds at every point that is shown, the predictor's stretch is lost, and without active limits nothing changes. What splitting costs: tests/scenes/test_splitting.c. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "support/sheet_scene.h"

/* A sheet of 4 x 4 cells hung by one side, soft enough to stretch far beyond its limit under gravity. */
static void hang(sheet_scene *scene, double limit, double activation, cipc_strain_coupling coupling)
{
    const double corner[3] = {0, 0, 0}, u[3] = {0.4, 0, 0}, v[3] = {0, -0.4, 0};
    const int held[] = {0, 1, 2, 3, 4};
    sheet_scene_init(scene);
    scene->gravity[1] = -9.81;
    scene->options.time_step = 0.02;
    scene->options.newton_tolerance = 1e-5;
    scene->options.strain_coupling = coupling;
    cipc_body_description *body = sheet_add_grid(scene, "sheet", corner, u, v, 4, 4);
    body->material.membrane_young = 1e3;
    body->material.strain_limit = limit;
    body->material.strain_activation = activation;
    body->material.strain_stiffness = 1;
    sheet_scene_model(scene);
    sheet_hold(scene, held, 5, NULL, INFINITY);
    sheet_scene_stepper(scene);
    sheet_watch(scene);
}

/* Largest distance of the two scenes' nodes. */
static double difference(const sheet_scene *a, const sheet_scene *b)
{
    double most = 0;
    for (int i = 0; i < 3 * a->model->node_count; i++) most = fmax(most, fabs(a->state->position[i] - b->state->position[i]));
    return most;
}

static void test_limit_holds(void **state)
{
    (void)state;
    sheet_scene free_of_limits, split, coupled;
    hang(&free_of_limits, 0, 0, CIPC_STRAIN_COUPLED);
    hang(&split, 1.05, 1, CIPC_STRAIN_SPLIT);
    hang(&coupled, 1.05, 1, CIPC_STRAIN_COUPLED);
    sheet_steps(&free_of_limits, 12);
    sheet_steps(&split, 12);
    sheet_steps(&coupled, 12);
    assert_true(free_of_limits.state->position[3 * 24 + 1] < -0.45); /* beyond 5 % */
    assert_true(split.accepted > 12 && split.energy_rises == 0);
    if (!(split.max_stretch_ratio < 1 && split.max_stretch_ratio > 0.5)) fail_msg("largest use of the limit: %g, coupled %g", split.max_stretch_ratio, coupled.max_stretch_ratio);
    assert_true(difference(&split, &free_of_limits) > 1e-2);
    /* Two integrators of one motion: near each other, but not the same. */
    assert_true(difference(&split, &coupled) > 1e-5 && difference(&split, &coupled) < 2e-2);
    sheet_scene_free(&free_of_limits);
    sheet_scene_free(&split);
    sheet_scene_free(&coupled);
}

/* Limits far away: the predictor is the step, and the projection has nowhere to go. */
static void test_inactive_limit_changes_nothing(void **state)
{
    (void)state;
    sheet_scene split, coupled;
    hang(&split, 10, 9, CIPC_STRAIN_SPLIT);
    hang(&coupled, 10, 9, CIPC_STRAIN_COUPLED);
    for (int n = 0; n < 5; n++) {
        sheet_step(&split);
        sheet_step(&coupled);
        /* Newton steps below tolerance * h = 2e-7 m are left out of each step. */
        assert_true(difference(&split, &coupled) <= 1e-6);
    }
    sheet_scene_free(&split);
    sheet_scene_free(&coupled);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limit_holds),
        cmocka_unit_test(test_inactive_limit_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
