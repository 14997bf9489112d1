/* The block "asynchronous": read and checked whatever the method. */
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

static void test_defaults(void **state)
{
    (void)state;
    const cipc_asynchronous_options want = cipc_asynchronous_options_default();
    static const char *const methods[] = {"\"contact\": {\"dhat\": 3e-3},", "\"contact\": {\"dhat\": 3e-3}, \"method\": \"asynchronous\","};
    for (int i = 0; i < 2; i++) {
        cipc_scene *s = accept_around(methods[i]);
        const cipc_asynchronous_options *o = &s->asynchronous;
        assert_int_equal(s->method, i == 0 ? CIPC_METHOD_C_IPC : CIPC_METHOD_ASYNCHRONOUS);
        assert_true(o->frame == 0.01 && o->thickness == 3e-3 && s->monitor_reach == 3e-3);
        assert_true(o->stiffness == want.stiffness && o->layer_factor == want.layer_factor && o->element_factor == want.element_factor);
        assert_true(o->gravity_step == want.gravity_step && o->script_step == want.script_step && o->restitution == want.restitution);
        assert_true(o->clocks == want.clocks && o->event_limit == want.event_limit && o->always_layers == 0 && o->mirror == 0);
        cipc_scene_destroy(s);
    }
}

#define EVERYTHING \
    "\"contact\": {\"dhat\": 3e-3}, \"asynchronous\": {\"thickness\": 2e-3, \"stiffness\": 1000, \"layer_factor\": 1, \"element_factor\": 0.25, \"gravity_step\": 1e-3, " \
    "\"script_step\": 2e-3, \"restitution\": 1, \"clocks\": \"own\", \"events\": 2000000000},"

static void assert_everything(const cipc_asynchronous_options *o)
{
    assert_true(o->frame == 0.01 && o->thickness == 2e-3 && o->stiffness == 1000 && o->layer_factor == 1 && o->element_factor == 0.25);
    assert_true(o->gravity_step == 1e-3 && o->script_step == 2e-3 && o->restitution == 1 && o->clocks == CIPC_CLOCKS_OWN && o->event_limit == 2000000000);
}

/* One file serves both methods; the reach of the monitors is that of the method's contact. */
static void test_everything_can_be_set(void **state)
{
    (void)state;
    char *text = scene_around(EVERYTHING, "");
    cipc_scene *s = accept_scene(text, "method=asynchronous"), *t = accept_scene(s->resolved, NULL), *other = accept_scene(text, NULL);
    assert_everything(&s->asynchronous);
    assert_everything(&t->asynchronous);
    assert_everything(&other->asynchronous);
    assert_int_equal(t->method, CIPC_METHOD_ASYNCHRONOUS);
    assert_string_equal(s->resolved, t->resolved);
    assert_true(s->monitor_reach == 2e-3 && t->monitor_reach == 2e-3 && other->monitor_reach == 3e-3);
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
    cipc_scene_destroy(other);
    free(text);
}

static void test_refused(void **state)
{
    (void)state;
    const struct { const char *root, *path, *what; cipc_status status; } cases[] = {
        {"@\"asynchronous\": [],", "asynchronous", "an object", CIPC_E_WRONG_TYPE},
        {"\"asynchronous\": {@\"thicknes\": 1},", "asynchronous.thicknes", "'thickness'", CIPC_E_UNKNOWN_KEY},
        {"\"asynchronous\": {@\"thickness\": 0},", "asynchronous.thickness", "greater than 0", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"stiffness\": -1},", "asynchronous.stiffness", "at least 0", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"layer_factor\": 0},", "asynchronous.layer_factor", "greater than 0 and at most 1", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"layer_factor\": 1.5},", "asynchronous.layer_factor", "greater than 0 and at most 1", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"element_factor\": 0},", "asynchronous.element_factor", "greater than 0 and at most 1", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"gravity_step\": -1},", "asynchronous.gravity_step", "at least 0", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"script_step\": -1},", "asynchronous.script_step", "at least 0", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"restitution\": 1.1},", "asynchronous.restitution", "at most 1", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"restitution\": -0.1},", "asynchronous.restitution", "at least 0", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"clocks\": \"owm\"},", "asynchronous.clocks", "'own'", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"events\": 0},", "asynchronous.events", "at least 1", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"events\": 2000000001},", "asynchronous.events", "at most 2000000000", CIPC_E_OUT_OF_RANGE},
        {"\"asynchronous\": {@\"events\": 1.5},", "asynchronous.events", "an integer", CIPC_E_WRONG_TYPE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) reject_around(cases[i].root, "", cases[i].status, cases[i].path, cases[i].what);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_everything_can_be_set),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
