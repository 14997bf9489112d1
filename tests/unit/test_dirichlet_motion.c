/* Prescribed nodes: on target to the bit, by the straight way or by penalty; blocked ones; release; contacts between prescribed nodes. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "implicit/stepper.h"
#include "support/failing_memory.h"
#include "support/sheet_scene.h"

enum { MOST_NODES = 64 };
static const double origin[3] = {0, 0, 0}, along_x[3] = {0.2, 0, 0}, along_z[3] = {0, 0, 0.2};

/* Where the model says that the nodes are to be after the next step. */
static void targets(const sheet_scene *scene, double *target)
{
    bool prescribed[MOST_NODES];
    cipc_dirichlet_targets(scene->model, scene->state->position, scene->state->time, scene->options.time_step, prescribed, target, NULL);
}

static int same_node(const double *a, const double *b, int node)
{
    return sheet_same_bits(a + 3 * node, b + 3 * node, 3);
}

/* A sheet of 3 x 3 nodes whose first row moves and turns, then rests: on target to the bit at every step, velocities are displacements by
 * h; others move freely. */
static void test_free_way(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    sheet_add_grid(&scene, "sheet", origin, along_x, along_z, 2, 2);
    scene.gravity[1] = -9.81;
    sheet_scene_model(&scene);
    static const int row[3] = {0, 1, 2}, corner[1] = {8};
    cipc_motion motion = {
        .begin = 0.013, .end = 0.042, .velocity = {0.3, 0.2, -0.1}, .center = {0.1, 0, 0}, .axis = {1, 2, 3}, .angular_velocity = 2};
    sheet_hold(&scene, row, 3, &motion, INFINITY);
    sheet_hold(&scene, corner, 1, NULL, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_watch(&scene);
    for (int step = 0; step < 7; step++) {
        double target[3 * MOST_NODES], before[3 * MOST_NODES];
        targets(&scene, target);
        memcpy(before, scene.state->position, sizeof(double) * 27);
        sheet_step(&scene);
        for (int k = 0; k < 4; k++) {
            int node = k < 3 ? row[k] : corner[0];
            assert_true(same_node(scene.state->position, target, node));
            for (int i = 3 * node; i < 3 * node + 3; i++)
                assert_true(scene.state->velocity[i] == (target[i] - before[i]) / scene.options.time_step);
        }
        assert_false(same_node(scene.state->position, before, 5));
        /* time step 1, 10 to 20 ms, is the first with motion, step 4 the last; a rest of rounding apart they have left the first place */
        assert_true(same_node(target, before, 0) == (step < 1 || step > 4));
    }
    sheet_scene_free(&scene);
}

/* All nodes prescribed: no unknowns, and they go where they are told. */
static void test_nothing_free(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    sheet_add_grid(&scene, "plate", origin, along_x, along_z, 1, 1)->fixed = true;
    sheet_scene_model(&scene);
    static const int all[4] = {0, 1, 2, 3};
    cipc_motion motion = {.begin = 0, .end = INFINITY, .velocity = {0, 1, 0}};
    sheet_hold(&scene, all, 4, &motion, INFINITY);
    sheet_scene_stepper(&scene);
    for (int step = 1; step <= 3; step++) {
        double target[3 * MOST_NODES];
        targets(&scene, target);
        sheet_step(&scene);
        assert_true(sheet_same_bits(scene.state->position, target, 12));
        assert_true(fabs(scene.state->position[1] - 0.01 * step) <= 1e-16);
    }
    sheet_scene_free(&scene);
}

/* From its release on a node falls with the others; before, it stays to the bit. Both in one body, so that the numbering of unknowns
 * changes under way. */
static void test_release(void **state)
{
    (void)state;
    sheet_scene scene;
    sheet_scene_init(&scene);
    sheet_add_grid(&scene, "sheet", origin, along_x, along_z, 2, 2);
    scene.gravity[1] = -9.81;
    sheet_scene_model(&scene);
    static const int nodes[2] = {0, 4}, late[1] = {4};
    sheet_hold(&scene, nodes, 2, NULL, 0.02);
    sheet_hold(&scene, late, 1, NULL, 0.04);
    sheet_scene_stepper(&scene);
    for (int step = 0; step < 6; step++) {
        double before[3 * MOST_NODES];
        memcpy(before, scene.state->position, sizeof(double) * 27);
        sheet_step(&scene);
        assert_true(same_node(scene.state->position, before, 0) == (step < 2));
        assert_true(same_node(scene.state->position, before, 4) == (step < 4));
    }
    assert_true(scene.state->position[1] < -1e-4);
    sheet_scene_free(&scene);
}

/* --- the way is not free --------------------------------------------------------------------------------------------------------- */

/* A plate of four nodes, body 0, `above` over a wall at height 0, body 1. */
static void plate_over(sheet_scene *scene, double above)
{
    const double corner[3] = {0.03, above, 0.05}, u[3] = {0.12, 0, 0}, v[3] = {0, 0, 0.1};
    sheet_scene_init(scene);
    scene->options.newton_iterations = 200;
    sheet_add_grid(scene, "plate", corner, u, v, 1, 1);
    sheet_add_grid(scene, "below", origin, along_x, along_z, 3, 3)->fixed = true;
}

/* The whole plate is to go down by `depth` in a step. */
static void script_plate(sheet_scene *scene, double depth, double end)
{
    static const int all[4] = {0, 1, 2, 3};
    cipc_motion motion = {.begin = 0, .end = end, .velocity = {0, -depth / scene->options.time_step, 0}};
    sheet_hold(scene, all, 4, &motion, INFINITY);
    sheet_scene_stepper(scene);
    sheet_watch(scene);
}

/* A free cloth lies in the way of a plate: pushed aside, and the plate ends on its target to the bit, at rest or under way, over several
 * steps. */
static void test_penalty_way(void **state)
{
    (void)state;
    for (int depth_case = 0; depth_case < 3; depth_case++) {
        sheet_scene scene;
        double depth = depth_case == 0 ? 0.004 : depth_case == 1 ? 0.01 : 0.03;
        plate_over(&scene, 0.002);
        scene.bodies[1].fixed = false;
        sheet_scene_model(&scene);
        script_plate(&scene, depth, 0.02);
        for (int step = 0; step < 3; step++) {
            double target[3 * MOST_NODES];
            targets(&scene, target);
            sheet_step(&scene);
            for (int node = 0; node < 4; node++) assert_true(same_node(scene.state->position, target, node));
            assert_true(scene.report.incremental.penalty == 0);
        }
        assert_true(scene.state->position[3 * 4 + 1] < 0); /* the cloth gave way */
        assert_true(scene.min_gap > 0 && scene.accepted > 3);
        assert_int_equal(scene.energy_rises, 0);
        sheet_scene_free(&scene);
    }
}

/* A wall in the way: the step ends without convergence, says so, and never has the plate touched the wall; the state is not advanced. */
static void test_blocked(void **state)
{
    (void)state;
    static const double depths[] = {0.004, 0.1, 2.0};
    for (size_t k = 0; k < sizeof depths / sizeof *depths; k++) {
        sheet_scene scene;
        plate_over(&scene, 0.002);
        sheet_scene_model(&scene);
        script_plate(&scene, depths[k], INFINITY);
        for (int again = 0; again < 2; again++) { /* the stepper is usable after a failure */
            cipc_status status = sheet_try_step(&scene);
            assert_true(status == CIPC_E_NO_PROGRESS || status == CIPC_E_NOT_CONVERGED);
            assert_non_null(strstr(scene.error.what, "at nodes"));
            assert_false(scene.report.converged);
            assert_non_null(strstr(scene.error.place, "step 0"));
            assert_int_equal(scene.state->step, 0);
            assert_true(scene.state->time == 0);
            assert_true(scene.min_gap > 0);
            for (int node = 0; node < 4; node++) assert_true(scene.state->position[3 * node + 1] > 0);
        }
        sheet_scene_free(&scene);
    }
}

/* The wall is 0.1 % before the target: the last part of the way is tried, and cut short. */
static void test_blocked_at_the_end(void **state)
{
    (void)state;
    sheet_scene scene;
    plate_over(&scene, 0.9995);
    sheet_scene_model(&scene);
    script_plate(&scene, 1, INFINITY);
    cipc_status status = sheet_try_step(&scene);
    assert_true(status == CIPC_E_NO_PROGRESS || status == CIPC_E_NOT_CONVERGED);
    assert_true(scene.min_gap > 0);
    for (int node = 0; node < 4; node++) assert_true(scene.state->position[3 * node + 1] > 0);
    sheet_scene_free(&scene);
}

/* Obstacles, bodies that are fixed, may be driven into one another: pairs of theirs are not contacts. */
static void test_obstacles_interpenetrate(void **state)
{
    (void)state;
    sheet_scene scene;
    plate_over(&scene, 0.002);
    scene.bodies[0].fixed = true;
    sheet_scene_model(&scene);
    script_plate(&scene, 0.01, INFINITY);
    sheet_step(&scene);
    assert_int_equal(scene.report.newton_iterations, 1);
    assert_true(scene.state->position[1] < 0);
    sheet_scene_free(&scene);
}

/* Pinned nodes of a sheet must not be run over either: the wall, a fixed body, comes up to them. */
static void test_moving_wall_meets_pins(void **state)
{
    (void)state;
    sheet_scene scene;
    static const int pins[2] = {0, 3}, wall[16] = {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    plate_over(&scene, 0.002);
    sheet_scene_model(&scene);
    cipc_motion up = {.begin = 0, .end = INFINITY, .velocity = {0, 0.5, 0}};
    sheet_hold(&scene, pins, 2, NULL, INFINITY);
    sheet_hold(&scene, wall, 16, &up, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_watch(&scene);
    cipc_status status = sheet_try_step(&scene);
    assert_true(status == CIPC_E_NO_PROGRESS || status == CIPC_E_NOT_CONVERGED);
    assert_true(scene.min_gap > 0);
    sheet_scene_free(&scene);
}

/* Pulling a strip by its ends faster than its strain limit allows in one go: the free nodes follow under the penalty, the ends arrive to
 * the bit. */
static void test_strain_limited_way(void **state)
{
    (void)state;
    sheet_scene scene;
    const double u[3] = {0.4, 0, 0}, v[3] = {0, 0, 0.1};
    static const int left[2] = {0, 5};
    sheet_scene_init(&scene);
    cipc_body_description *strip = sheet_add_grid(&scene, "strip", origin, u, v, 4, 1);
    strip->material.strain_limit = 1.05;
    strip->material.strain_activation = 1.01;
    strip->material.strain_stiffness = 1e3;
    sheet_scene_model(&scene);
    cipc_motion motion = {.begin = 0, .end = 0.01, .velocity = {-3, 0, 0}}; /* 30 % of an element in a step */
    sheet_hold(&scene, left, 2, &motion, INFINITY);
    sheet_scene_stepper(&scene);
    sheet_watch(&scene);
    double target[3 * MOST_NODES];
    targets(&scene, target);
    sheet_step(&scene);
    for (int k = 0; k < 2; k++) assert_true(same_node(scene.state->position, target, left[k]));
    assert_true(scene.max_stretch_ratio > 0.2 && scene.max_stretch_ratio < 1);
    sheet_scene_free(&scene);
}

/* Progress is the share of the way done (SPEC C.7). */
static void test_progress(void **state)
{
    (void)state;
    sheet_scene scene;
    plate_over(&scene, 0.002);
    sheet_scene_model(&scene);
    script_plate(&scene, 0.01, INFINITY);
    sheet_begin(&scene);
    cipc_stepper *s = scene.stepper;
    assert_true(cipc_dirichlet_progress(s) == 1); /* no penalty */
    s->penalty = 1e6;
    assert_true(cipc_dirichlet_progress(s) == 0);
    for (int node = 0; node < 4; node++) s->x[3 * node + 1] -= 0.0025;
    assert_true(fabs(cipc_dirichlet_progress(s) - 0.25) < 1e-13);
    memcpy(s->target, s->x_start, sizeof(double) * 12);
    assert_true(cipc_dirichlet_progress(s) == 1); /* nowhere to go */
    sheet_scene_free(&scene);
}

/* Each allocation of a step by penalty may fail; the next attempt is as good as new. */
static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1;
    double first[3 * MOST_NODES];
    for (bool failed = true; failed; n += 7) {
        sheet_scene scene;
        plate_over(&scene, 0.002);
        scene.bodies[1].fixed = false;
        sheet_scene_model(&scene);
        script_plate(&scene, 0.004, INFINITY);
        cipc_stepper_set_monitor(scene.stepper, NULL, NULL); /* its allocations are not ours */
        fail_allocation(n);
        cipc_status status = sheet_try_step(&scene);
        failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (!failed) memcpy(first, scene.state->position, 20 * 3 * sizeof(double));
        sheet_scene_free(&scene);
    }
    assert_true(n > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_way),
        cmocka_unit_test(test_nothing_free),
        cmocka_unit_test(test_release),
        cmocka_unit_test(test_penalty_way),
        cmocka_unit_test(test_blocked),
        cmocka_unit_test(test_blocked_at_the_end),
        cmocka_unit_test(test_obstacles_interpenetrate),
        cmocka_unit_test(test_moving_wall_meets_pins),
        cmocka_unit_test(test_strain_limited_way),
        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
