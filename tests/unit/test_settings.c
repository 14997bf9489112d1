/* Time, integrator, solver, contact, monitors, output. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>

#include "support/scene_trial.h"

static cipc_scene *accept_around(const char *root)
{
    char *text = scene_around(root, "");
    cipc_scene *scene = accept_scene(text, NULL);
    free(text);
    return scene;
}

static void test_defaults_are_the_integrators_own(void **state)
{
    (void)state;
    cipc_scene *s = accept_around("");
    cipc_implicit_options want = cipc_implicit_options_default(), *o = &s->options;
    assert_true(o->time_step == 0.01 && s->steps == 2);
    assert_true(o->newton_tolerance == want.newton_tolerance && o->newton_norm == want.newton_norm &&
                o->newton_iterations == want.newton_iterations);
    assert_true(o->line_search_halvings == want.line_search_halvings && o->friction_iterations == want.friction_iterations);
    assert_true(o->friction_cap == want.friction_cap && o->friction_velocity == want.friction_velocity);
    assert_true(o->contact.dhat == want.contact.dhat && o->contact.area_weights == want.contact.area_weights);
    assert_true(o->ccd.slackness == want.ccd.slackness && o->ccd.max_iterations == want.ccd.max_iterations &&
                o->ccd.method == CIPC_CCD_CERTIFIED && !o->ccd.refine && s->monitor_swept);
    assert_true(o->barrier_stiffness == 0 && !o->released && o->integrator.beta == 1 && o->integrator.gamma == 0);
    assert_true(!o->quasistatic && o->strain_coupling == CIPC_STRAIN_COUPLED && s->method == CIPC_METHOD_C_IPC);
    assert_true(s->model->gravity[1] == -9.81 && s->model->gravity[0] == 0);
    assert_true(s->monitor && s->monitor_reach == want.contact.dhat && !s->write_obj && s->camera_zoom == 1 && s->seed == 1);
    assert_string_equal(s->title, "");
    assert_string_equal(s->size, "");
    cipc_scene_destroy(s);
}

static void test_everything_can_be_set(void **state)
{
    (void)state;
    cipc_scene *s = accept_around(
        "\"quasistatic\": true, \"strain_coupling\": \"split\", \"method\": \"c-ipc\", \"title\": \"A test\", \"size\": \"tiny\", \"gravity\": [1, 2, 3], \"seed\": 42, \"integrator\": "
        "\"implicit-midpoint\","
        "\"newton\": {\"tolerance\": 1e-6, \"norm\": \"rms\", \"iterations\": 7, \"line_search_halvings\": 8},"
        "\"contact\": {\"dhat\": 2e-3, \"area_weights\": false, \"barrier_stiffness\": 5, \"friction_iterations\": 0, \"friction_cap\": 3,"
        " \"friction_velocity\": 1e-5, \"slackness\": 0.2, \"ccd_iterations\": 99, \"ccd\": \"cubic\", \"ccd_refine\": true},"
        "\"monitor\": {\"enabled\": false, \"swept\": false, \"reach\": 0.5}, \"output\": {\"obj\": true, \"camera\": {\"azimuth\": 1, \"elevation\": 2, "
        "\"zoom\": 3}},");
    cipc_implicit_options *o = &s->options;
    assert_true(o->quasistatic && o->strain_coupling == CIPC_STRAIN_SPLIT);
    assert_string_equal(s->title, "A test");
    assert_string_equal(s->size, "tiny");
    assert_true(s->model->gravity[0] == 1 && s->model->gravity[2] == 3 && s->seed == 42);
    assert_true(o->integrator.alpha == 1 && o->integrator.beta == 0.5 && o->integrator.gamma == 0.5);
    assert_true(o->newton_tolerance == 1e-6 && o->newton_norm == CIPC_NORM_RMS && o->newton_iterations == 7 &&
                o->line_search_halvings == 8);
    assert_true(o->contact.dhat == 2e-3 && !o->contact.area_weights && o->barrier_stiffness == 5 && o->friction_iterations == 0 &&
                o->friction_cap == 3);
    assert_true(o->friction_velocity == 1e-5 && o->ccd.slackness == 0.2 && o->ccd.max_iterations == 99 && o->ccd.method == CIPC_CCD_CUBIC && o->ccd.refine && !s->monitor_swept);
    assert_true(!s->monitor && s->monitor_reach == 0.5 && s->write_obj && s->camera_azimuth == 1 && s->camera_elevation == 2 &&
                s->camera_zoom == 3);
    cipc_scene_destroy(s);
    s = accept_around("\"integrator\": {\"alpha\": 1, \"beta\": 0.75, \"gamma\": 0.25},");
    assert_true(s->options.integrator.beta == 0.75 && s->options.integrator.gamma == 0.25);
    cipc_scene_destroy(s);
    s = accept_around("\"contact\": {\"ccd\": \"minimum-separation\"},");
    assert_int_equal(s->options.ccd.method, CIPC_CCD_MINIMUM_SEPARATION);
    cipc_scene_destroy(s);
}

/* "released" changes defaults; what the scene says itself stays. */
static void test_released(void **state)
{
    (void)state;
    cipc_scene *s = accept_around("\"compat\": \"released\",");
    assert_true(s->options.released && s->options.newton_norm == CIPC_NORM_RMS && s->options.newton_tolerance == 1e-3 &&
                !s->options.contact.area_weights && s->options.ccd.method == CIPC_CCD_ADDITIVE);
    assert_int_equal(s->model->bodies[0].material.hinge_constant, CIPC_HINGE_CIPC);
    cipc_scene_destroy(s);
    s = accept_around(
        "\"compat\": \"released\", \"newton\": {\"norm\": \"max\", \"tolerance\": 5e-4}, \"contact\": {\"area_weights\": true},");
    assert_true(s->options.released && s->options.newton_norm == CIPC_NORM_MAX && s->options.newton_tolerance == 5e-4 &&
                s->options.contact.area_weights);
    cipc_scene_destroy(s);
    s = accept_around("\"compat\": \"none\",");
    assert_false(s->options.released);
    assert_int_equal(s->model->bodies[0].material.hinge_constant, CIPC_HINGE_PLATE);
    cipc_scene_destroy(s);
}

static void test_required(void **state)
{
    (void)state;
    reject_scene("@{\"steps\": 1, \"bodies\": []}", NULL, CIPC_E_MISSING_KEY, "time_step", "missing");
    reject_scene("@{\"time_step\": 1, \"bodies\": []}", NULL, CIPC_E_MISSING_KEY, "steps", "missing");
    reject_scene("{@\"time_step\": 0, \"steps\": 1, \"bodies\": []}", NULL, CIPC_E_OUT_OF_RANGE, "time_step", "greater than 0");
    reject_scene("{\"time_step\": 1, @\"steps\": -1, \"bodies\": []}", NULL, CIPC_E_OUT_OF_RANGE, "steps", "at least 0");
    reject_scene("{\"time_step\": 1, @\"steps\": 3000000000, \"bodies\": []}", NULL, CIPC_E_OUT_OF_RANGE, "steps", "is 3000000000");
    reject_scene("{\"time_step\": 1, @\"steps\": 1.0, \"bodies\": []}", NULL, CIPC_E_WRONG_TYPE, "steps", "an integer");
}

static void test_rejections(void **state)
{
    (void)state;
    reject_around("@\"tile\": \"x\",", "", CIPC_E_UNKNOWN_KEY, "tile", "unknown key 'tile'; the nearest known key is 'title'");
    reject_around("@\"method\": \"ipc\",", "", CIPC_E_OUT_OF_RANGE, "method", "unknown method 'ipc'; the nearest known one is 'c-ipc'");
    reject_around("@\"title\": 1,", "", CIPC_E_WRONG_TYPE, "title", "a string");
    reject_around("@\"size\": \"a name of too many bytes\",", "", CIPC_E_OUT_OF_RANGE, "size", "at most 15");
    reject_around("@\"compat\": \"relased\",", "", CIPC_E_OUT_OF_RANGE, "compat", "'released'");
    reject_around("\"gravity\": [0, @\"down\", 0],", "", CIPC_E_WRONG_TYPE, "gravity.1", "a number");
    reject_around("@\"seed\": -1,", "", CIPC_E_OUT_OF_RANGE, "seed", "at least 0");
    reject_around("@\"integrator\": \"euler\",", "", CIPC_E_OUT_OF_RANGE, "integrator", "'implicit-euler'");
    reject_around("@\"integrator\": {\"alpha\": 1, \"beta\": 1},", "", CIPC_E_MISSING_KEY, "integrator.gamma", "missing");
    reject_around("\"integrator\": {@\"alpha\": 0, \"beta\": 1, \"gamma\": 0},", "", CIPC_E_OUT_OF_RANGE, "integrator.alpha",
                  "greater than 0");
    reject_around("\"newton\": {@\"tolerance\": 0},", "", CIPC_E_OUT_OF_RANGE, "newton.tolerance", "greater than 0");
    reject_around("\"newton\": {@\"norm\": \"l2\"},", "", CIPC_E_OUT_OF_RANGE, "newton.norm", "unknown norm 'l2'");
    reject_around("\"newton\": {@\"iterations\": 0},", "", CIPC_E_OUT_OF_RANGE, "newton.iterations", "at least 1");
    reject_around("\"newton\": {@\"tol\": 0},", "", CIPC_E_UNKNOWN_KEY, "newton.tol", "nearest known key");
    reject_around("\"contact\": {@\"dhat\": -1},", "", CIPC_E_OUT_OF_RANGE, "contact.dhat", "greater than 0");
    reject_around("\"contact\": {@\"slackness\": 1},", "", CIPC_E_OUT_OF_RANGE, "contact.slackness", "greater than 0 and less than 1");
    reject_around("\"contact\": {@\"friction_iterations\": -1},", "", CIPC_E_OUT_OF_RANGE, "contact.friction_iterations", "at least 0");
    reject_around("\"contact\": {@\"friction_velocity\": 0},", "", CIPC_E_OUT_OF_RANGE, "contact.friction_velocity", "greater than 0");
    reject_around("@\"contact\": [],", "", CIPC_E_WRONG_TYPE, "contact", "an object");
    reject_around("@\"quasistatic\": 1,", "", CIPC_E_WRONG_TYPE, "quasistatic", "true or false");
    reject_around("@\"strain_coupling\": \"splt\",", "", CIPC_E_OUT_OF_RANGE, "strain_coupling", "'split'");
    reject_around("\"monitor\": {@\"enabled\": \"yes\"},", "", CIPC_E_WRONG_TYPE, "monitor.enabled", "true or false");
    reject_around("\"monitor\": {@\"reach\": -1},", "", CIPC_E_OUT_OF_RANGE, "monitor.reach", "at least 0");
    reject_around("\"output\": {\"camera\": {@\"zoom\": 0}},", "", CIPC_E_OUT_OF_RANGE, "output.camera.zoom", "greater than 0");
    reject_around("\"output\": {@\"vtk\": true},", "", CIPC_E_UNKNOWN_KEY, "output.vtk", "nearest known key");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults_are_the_integrators_own),
        cmocka_unit_test(test_everything_can_be_set),
        cmocka_unit_test(test_released),
        cmocka_unit_test(test_required),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
