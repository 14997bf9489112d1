/* The steps of a run of the method asynchronous when an invariant breaks. The integrator does not break one on request, so here the monitors judge by a model that is
 * stricter than the integrator's: a larger thickness; or by a momentum that gravity changes. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/simulation.h"
#include "support/sample_run.h"

/* Free fall from 10 mm: at frame k it is at 10 mm - 1/2 g (k / 100 s)^2, at 4 frames 2.2 mm. */
static const char text[] =
    "{\"method\": \"asynchronous\", \"time_step\": 0.01, \"steps\": 9, \"contact\": {\"dhat\": 1e-3}, \"bodies\": ["
    "{\"name\": \"floor\", \"fixed\": true, \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [2, 2], \"cells\": [1, 1]}}},"
    "{\"name\": \"cloth\", \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.13, 0.01, 0.07]}}]}";

typedef struct fixture {
    path folder, scene_file;
    cipc_run_request request;
    cipc_scene *judged_by; /* its model is the monitors' */
    cipc_simulation s;
} fixture;

static void accept(cipc_status status, const cipc_error *error)
{
    if (status != CIPC_OK) {
        fail_msg("%s: %s", error->place, error->what);
    }
}

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    cipc_error error;
    f->folder = folder_make();
    f->scene_file = path_in(&f->folder, "scene.json");
    file_write(&f->scene_file, text, strlen(text));
    const path h5 = path_in(&f->folder, "trajectory.h5"), stats = path_in(&f->folder, "stats.jsonl");
    f->request = (cipc_run_request){.scene_name = "s", .directory = f->folder.text, .command = "test", .monitor = true, .quiet = true};
    f->s = (cipc_simulation){.request = &f->request, .begin = cipc_clock(), .summary = cipc_run_summary_default()};
    f->s.summary.method = CIPC_METHOD_ASYNCHRONOUS;
    f->s.summary.swept = true;
    accept(cipc_scene_load(&f->s.scene, f->scene_file.text, 0, NULL, &error), &error);
    accept(cipc_scene_load(&f->judged_by, f->scene_file.text, 0, NULL, &error), &error);
    accept(cipc_asynchronous_create(&f->s.integrator, f->s.scene->model, &f->s.scene->asynchronous, &error), &error);
    accept(cipc_trajectory_create(&f->s.trajectory, h5.text, f->s.scene->model, f->s.scene->state, f->s.scene->resolved, 10, &error), &error);
    f->s.stats = fopen(stats.text, "wb");
    assert_non_null(f->s.stats);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    cipc_trajectory_close(f->s.trajectory, NULL);
    cipc_asynchronous_destroy(f->s.integrator);
    cipc_monitor_destroy(f->s.monitor);
    cipc_scene_destroy(f->s.scene);
    cipc_scene_destroy(f->judged_by);
    fclose(f->s.stats);
    folder_remove(&f->folder);
    free(f);
    return 0;
}

static void judge(fixture *f)
{
    cipc_error error;
    accept(cipc_monitor_create(&f->s.monitor, f->judged_by->model, NULL, &error), &error);
}

static json_t *load(const fixture *f, const char *name)
{
    const path file = path_in(&f->folder, name);
    json_t *object = json_load_file(file.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(object);
    return object;
}

static void window_of(const json_t *violation, double window[2])
{
    const json_t *times = json_object_get(violation, "window");
    window[0] = json_number_value(json_object_get(times, "begin"));
    window[1] = json_number_value(json_object_get(times, "end"));
}

/* The frame after 4 steps is nearer than 3 mm: that one is named and written, and not among the frames. */
static void test_broken_gap_at_a_frame(void **state)
{
    fixture *f = *state;
    double window[2];
    f->judged_by->model->bodies[1].offset = 6e-3; /* so the pair's is 3 mm */
    f->s.scene->monitor_swept = f->s.summary.swept = false;
    judge(f);
    f->s.summary.status = cipc_simulation_steps(&f->s);
    assert_int_equal(f->s.summary.status, CIPC_E_VIOLATED_GAP);
    assert_ptr_equal(strstr(f->s.error.place, "step 4, frame at 0.04 s, monitor gap"), f->s.error.place);
    assert_int_equal(f->s.summary.steps_taken, 3);
    assert_int_equal(cipc_trajectory_frames(f->s.trajectory), 4);
    assert_true(f->s.summary.points_checked == 4 && f->s.summary.windows_checked == 0);
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 1), "holds");
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 2), "violated");
    json_t *violation = load(f, "violation.json");
    assert_string_equal(json_string_value(json_object_get(violation, "what")), f->s.error.what);
    assert_int_equal(json_integer_value(json_object_get(violation, "steps_taken")), 3);
    assert_true(json_real_value(json_object_get(violation, "time_before")) == 0.03);
    window_of(violation, window);
    assert_true(window[0] == 0.04 && window[1] == 0.04);
    json_decref(violation);
    const path failed = path_in(&f->folder, "failed.obj"), obj = path_in(&f->folder, "violation.obj");
    assert_true(!file_exists(&failed) && file_exists(&obj));
}

/* On the way to that frame, the monitor of paths finds it first; no frame was wrong. */
static void test_broken_gap_on_the_way(void **state)
{
    fixture *f = *state;
    double window[2];
    f->judged_by->model->bodies[1].offset = 6e-3;
    judge(f);
    f->s.summary.status = cipc_simulation_steps(&f->s);
    assert_int_equal(f->s.summary.status, CIPC_E_VIOLATED_SWEPT);
    assert_ptr_equal(strstr(f->s.error.place, "step 4, paths from 0.03"), f->s.error.place);
    assert_int_equal(f->s.summary.steps_taken, 3);
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 5), "violated");
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 2), "holds");
    json_t *violation = load(f, "violation.json");
    window_of(violation, window);
    assert_true(window[0] >= 0.03 && window[0] < window[1] && window[1] <= 0.04);
    json_decref(violation);
    const path obj = path_in(&f->folder, "violation.obj");
    assert_true(file_exists(&obj));
}

/* Gravity changes momentum here, as a force without opposite would. */
static void test_broken_momentum(void **state)
{
    fixture *f = *state;
    judge(f);
    f->s.velocity = cipc_alloc(3 * (size_t)f->s.scene->model->node_count, sizeof *f->s.velocity);
    f->s.summary.status = cipc_simulation_steps(&f->s);
    assert_int_equal(f->s.summary.status, CIPC_E_VIOLATED_MOMENTUM);
    assert_non_null(strstr(f->s.error.place, "step 1, frame at 0.01 s, monitor momentum"));
    assert_int_equal(f->s.summary.momentum_checks, 0);
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 7), "violated");
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 1), "holds");
    cipc_free(f->s.velocity);
}

static void test_nothing_broken(void **state)
{
    fixture *f = *state;
    judge(f);
    accept(cipc_simulation_steps(&f->s), &f->s.error);
    assert_int_equal(f->s.summary.steps_taken, 9);
    assert_int_equal(cipc_trajectory_frames(f->s.trajectory), 10);
    assert_true(f->s.summary.points_checked - f->s.summary.windows_checked == 9 && f->s.summary.windows_checked >= 9 && f->s.summary.paths_checked > 0);
    assert_true(f->s.summary.asynchronous.layers > 0 && f->s.summary.converged);
    assert_true(f->s.scene->state->barrier_stiffness == 0);
    const path obj = path_in(&f->folder, "violation.obj");
    assert_false(file_exists(&obj));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_broken_gap_at_a_frame, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_gap_on_the_way, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_momentum, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_nothing_broken, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
