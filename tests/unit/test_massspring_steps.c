/* The steps of a run of the method mass-spring: frames that break M1 or M2 are counted, and neither stops the run; what else the monitors say does. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/simulation.h"
#include "cli/steps.h"
#include "support/sample_run.h"

/* A cloth thrown at a wall that it does not feel: 0.1 m away from it, 0.06 m a step, 0.2 m wide. */
static const char text[] = "{\"method\": \"mass-spring\", \"time_step\": 0.01, \"steps\": 8, \"gravity\": [0, 0, 0], \"bodies\": ["
                           "{\"name\": \"wall\", \"fixed\": true, \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"transform\": {\"rotate\": {\"axis\": [0, 0, 1], "
                           "\"angle\": 1.5}}}, {\"name\": \"cloth\", \"material\": \"cotton\", \"membrane\": {\"model\": \"springs\"}, \"velocity\": [-6, 0, 0], \"shell\": {\"grid\": {\"size\": [0.2, 0.2], "
                           "\"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.2, 0, 0.02]}}]}";

typedef struct fixture {
    path folder;
    cipc_run_request request;
    cipc_simulation s;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    cipc_error error;
    f->folder = folder_make();
    const path scene = path_in(&f->folder, "scene.json"), h5 = path_in(&f->folder, "trajectory.h5"), stats = path_in(&f->folder, "stats.jsonl");
    file_write(&scene, text, strlen(text));
    f->request = (cipc_run_request){.scene_name = "s", .directory = f->folder.text, .command = "test", .monitor = true, .quiet = true};
    f->s = (cipc_simulation){.request = &f->request, .begin = cipc_clock(), .summary = cipc_run_summary_default()};
    f->s.summary.method = CIPC_METHOD_MASS_SPRING;
    if (cipc_scene_load(&f->s.scene, scene.text, 0, NULL, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    assert_int_equal(cipc_massspring_steps.create(&f->s, &error), CIPC_OK);
    assert_int_equal(cipc_trajectory_create(&f->s.trajectory, h5.text, f->s.scene->model, f->s.scene->state, f->s.scene->resolved, 10, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_create(&f->s.monitor, f->s.scene->model, NULL, &error), CIPC_OK);
    f->s.stats = fopen(stats.text, "wb");
    assert_non_null(f->s.stats);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    cipc_trajectory_close(f->s.trajectory, NULL);
    cipc_massspring_destroy(f->s.massspring);
    cipc_monitor_destroy(f->s.monitor);
    cipc_scene_destroy(f->s.scene);
    fclose(f->s.stats);
    folder_remove(&f->folder);
    free(f);
    return 0;
}

/* It is through the wall from the second step, at 0.08 m, to the fifth, when its other side has passed. */
static void test_intersections_are_counted(void **state)
{
    fixture *f = *state;
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_OK);
    const cipc_massspring_totals *t = &f->s.summary.massspring;
    assert_int_equal(f->s.summary.steps_taken, 8);
    assert_true(t->frames == 8 && t->intersecting.frames >= 3 && t->intersecting.frames <= 4 && t->intersecting.first_step == 2);
    assert_non_null(strstr(t->intersecting.first.what, "body \"cloth\""));
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 1), "counted");
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 8), "holds");
    const path violation = path_in(&f->folder, "violation.obj");
    assert_false(file_exists(&violation));
}

/* M2 has a count of its own: with thick cloth frames before and after those that intersect are too near as well. */
static void test_gaps_are_counted(void **state)
{
    fixture *f = *state;
    for (int b = 0; b < 2; b++) f->s.scene->model->bodies[b].offset = 0.05;
    f->s.scene->model->pair_apart[3] = true; /* the cloth from itself */
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_OK);
    const cipc_massspring_totals *t = &f->s.summary.massspring;
    assert_true(t->too_near.frames > t->intersecting.frames && t->too_near.first_step == 1 && t->intersecting.first_step == 2);
    assert_non_null(strstr(t->too_near.first.what, "body \"wall\""));
}

/* Without numbers there is nothing to count. */
static void test_no_longer_finite(void **state)
{
    fixture *f = *state;
    f->s.scene->state->velocity[3 * 4] = 1e308 * 10;
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_E_NO_PROGRESS);
    assert_true(!f->s.summary.converged && f->s.summary.massspring.frames == 0 && f->s.summary.steps_taken == 0);
}

/* A strain limit is of no scene of this method; were there one, it would be demanded, and told with its place. */
static void test_other_monitors_are_not_counted(void **state)
{
    fixture *f = *state;
    f->s.scene->model->bodies[1].material.strain_limit = 1.0000001;
    f->s.scene->state->velocity[3 * 4] += 3;
    cipc_error error;
    cipc_monitor_destroy(f->s.monitor); /* it lists limited triangles when it is made */
    assert_int_equal(cipc_monitor_create(&f->s.monitor, f->s.scene->model, NULL, &error), CIPC_OK);
    f->s.summary.limited_triangles = cipc_invariant_limited_triangles(f->s.scene->model);
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_E_VIOLATED_STRAIN);
    assert_ptr_equal(strstr(f->s.error.place, "step 1, frame at 0.01 s, monitor"), f->s.error.place);
    const path violation = path_in(&f->folder, "violation.json"), obj = path_in(&f->folder, "violation.obj");
    assert_true(file_exists(&violation) && file_exists(&obj));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_intersections_are_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_gaps_are_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_no_longer_finite, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_other_monitors_are_not_counted, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
