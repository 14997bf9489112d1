/* The steps of a run when an invariant breaks. The solver does not break one on request, so here the monitors judge by a model that is
 * stricter than the solver's: a larger thickness, a tighter strain limit. */
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

static const char text[] =
    "{\"time_step\": 0.01, \"steps\": 9, \"contact\": {\"dhat\": 1e-3}, \"bodies\": ["
    "{\"name\": \"floor\", \"fixed\": true, \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [2, 2], \"cells\": [1, 1]}}},"
    "{\"name\": \"cloth\", \"material\": \"cotton\", \"strain_limit\": {\"limit\": 1.06}, \"shell\": {\"grid\": {\"size\": [0.2, 0.2], "
    "\"cells\": [2, 2]}},"
    " \"transform\": {\"translate\": [0.13, 0.01, 0.07]}}]}";

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

static void open_simulation(fixture *f)
{
    cipc_error error;
    const path h5 = path_in(&f->folder, "trajectory.h5"), stats = path_in(&f->folder, "stats.jsonl");
    f->request = (cipc_run_request){.scene_name = "s", .directory = f->folder.text, .command = "test", .monitor = true, .quiet = true};
    f->s = (cipc_simulation){.request = &f->request, .begin = cipc_clock()};
    accept(cipc_scene_load(&f->s.scene, f->scene_file.text, 0, NULL, &error), &error);
    f->s.summary = cipc_run_summary_default();
    accept(cipc_stepper_create(&f->s.stepper, f->s.scene->model, &f->s.scene->options, &error), &error);
    accept(cipc_trajectory_create(&f->s.trajectory, h5.text, f->s.scene->model, f->s.scene->state, f->s.scene->resolved, 10, &error),
           &error);
    f->s.stats = fopen(stats.text, "wb");
    assert_non_null(f->s.stats);
}

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    cipc_error error;
    f->folder = folder_make();
    f->scene_file = path_in(&f->folder, "scene.json");
    file_write(&f->scene_file, text, strlen(text));
    open_simulation(f);
    accept(cipc_scene_load(&f->judged_by, f->scene_file.text, 0, NULL, &error), &error);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    cipc_trajectory_close(f->s.trajectory, NULL);
    cipc_stepper_destroy(f->s.stepper);
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

/* Free fall from 10 mm: the fourth step's end is below 3 mm. */
static void test_broken_gap(void **state)
{
    fixture *f = *state;
    f->judged_by->model->bodies[1].offset = 6e-3; /* so the pair's is 3 mm */
    judge(f);
    const cipc_status status = cipc_simulation_steps(&f->s);
    assert_int_equal(status, CIPC_E_VIOLATED_GAP);
    assert_int_equal(f->s.error.status, status);
    const int good_steps = f->s.summary.steps_taken;
    assert_in_range(good_steps, 1, 8);
    char step[64];
    snprintf(step, sizeof step, "step %d, iteration ", good_steps + 1);
    assert_ptr_equal(strstr(f->s.error.place, step), f->s.error.place);
    assert_non_null(strstr(f->s.error.place, "monitor gap"));
    assert_int_equal(cipc_trajectory_frames(f->s.trajectory), good_steps + 1); /* the bad state is not among the frames */

    json_t *violation = load(f, "violation.json");
    assert_string_equal(json_string_value(json_object_get(violation, "status")), "VIOLATED_GAP");
    assert_string_equal(json_string_value(json_object_get(violation, "what")), f->s.error.what);
    assert_int_equal(json_integer_value(json_object_get(violation, "steps_taken")), good_steps);
    json_decref(violation);
    const path failed = path_in(&f->folder, "failed.obj");
    assert_false(file_exists(&failed));

    /* The state written is the one found guilty: its lowest node is nearer than 3 mm, that of the last frame is not. */
    const path obj = path_in(&f->folder, "violation.obj");
    char *lines = file_read(&obj, NULL);
    double y, lowest = 1;
    int node = 0;
    for (const char *line = strstr(lines, "\nv "); line != NULL; line = strstr(line + 1, "\nv ")) {
        assert_int_equal(sscanf(line, "\nv %*f %lf", &y), 1);
        lowest = node++ >= f->s.scene->model->bodies[1].first_node && y < lowest ? y : lowest;
    }
    assert_int_equal(node, f->s.scene->model->node_count);
    assert_true(lowest <= 3e-3);
    free(lines);
}

static void test_summary_and_exit_status_of_a_violation(void **state)
{
    fixture *f = *state;
    cipc_error error;
    f->judged_by->model->bodies[1].offset = 6e-3;
    judge(f);
    f->s.summary.status = cipc_simulation_steps(&f->s);
    f->s.summary.error = &f->s.error;
    accept(cipc_simulation_results(&f->s, &error), &error);
    json_t *summary = load(f, "summary.json");
    const json_t *invariants = json_object_get(summary, "invariants");
    assert_string_equal(json_string_value(json_object_get(invariants, "M1")), "holds");
    assert_string_equal(json_string_value(json_object_get(invariants, "M2")), "violated");
    assert_int_equal(json_integer_value(json_object_get(summary, "exit_status")), 3);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(summary, "error"), "number")), 3002);
    json_decref(summary);
    static const char *const names[] = {"frames.png", "plots.png", "trajectory.xdmf"};
    for (int i = 0; i < 3; i++) {
        const path file = path_in(&f->folder, names[i]);
        assert_true(file_exists(&file));
    }
}

/* A violation before any step is done: at the very first point. */
static void test_broken_strain_at_once(void **state)
{
    fixture *f = *state;
    f->judged_by->model->bodies[1].material.strain_limit = 1 - 1e-3;
    judge(f);
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_E_VIOLATED_STRAIN);
    assert_int_equal(f->s.summary.steps_taken, 0);
    assert_ptr_equal(strstr(f->s.error.place, "step 1, "), f->s.error.place);
    assert_int_equal(f->s.summary.points_checked, 1);
}

static void test_residual_above_the_tolerance(void **state)
{
    fixture *f = *state;
    judge(f);
    f->s.scene->options.newton_tolerance = 1e-300; /* the stepper has its own copy */
    assert_int_equal(cipc_simulation_steps(&f->s), CIPC_E_VIOLATED_ENERGY);
    assert_non_null(strstr(f->s.error.place, "monitor residual"));
    const path obj = path_in(&f->folder, "violation.obj");
    assert_true(file_exists(&obj));
}

/* Gravity, and later the floor, change momentum here, as a force without opposite would. */
static void test_broken_momentum(void **state)
{
    fixture *f = *state;
    judge(f);
    f->s.velocity = cipc_alloc(3 * (size_t)f->s.scene->model->node_count, sizeof *f->s.velocity);
    f->s.summary.status = cipc_simulation_steps(&f->s);
    assert_int_equal(f->s.summary.status, CIPC_E_VIOLATED_MOMENTUM);
    assert_non_null(strstr(f->s.error.place, "monitor momentum"));
    assert_int_equal(f->s.summary.momentum_checks, f->s.summary.steps_taken); /* the one that failed does not count */
    assert_string_equal(cipc_run_summary_verdict(&f->s.summary, 7), "violated");
    const path obj = path_in(&f->folder, "violation.obj");
    assert_true(file_exists(&obj));
    cipc_free(f->s.velocity);
}

static void test_nothing_broken(void **state)
{
    fixture *f = *state;
    judge(f);
    accept(cipc_simulation_steps(&f->s), &f->s.error);
    assert_int_equal(f->s.summary.steps_taken, 9);
    assert_int_equal(cipc_trajectory_frames(f->s.trajectory), 10);
    assert_true(f->s.summary.points_checked >= 9 && f->s.summary.energy_checks > 0);
    const path obj = path_in(&f->folder, "violation.obj");
    assert_false(file_exists(&obj));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_broken_gap, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_summary_and_exit_status_of_a_violation, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_strain_at_once, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_residual_above_the_tolerance, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_momentum, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_nothing_broken, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
