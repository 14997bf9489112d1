/* What a method does not know is refused where the scene asks for it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "support/scene_trial.h"

#define ASYNCHRONOUS "\"method\": \"asynchronous\", "
#define GRID         "\"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}"
#define SCENE(root, body)                                                                                                                                  \
    "{\"time_step\": 1, \"steps\": 1, " root "\"bodies\": [{\"name\": \"first\", " GRID ", \"material\": \"wool\", \"transform\": {\"translate\": [0, 1, 0]}}, "  \
    "{\"name\": \"cloth\", " GRID ", " body "}]}"

static void test_names(void **state)
{
    (void)state;
    assert_string_equal(cipc_method_name(CIPC_METHOD_C_IPC), "c-ipc");
    assert_string_equal(cipc_method_name(CIPC_METHOD_ASYNCHRONOUS), "asynchronous");
    assert_string_equal(cipc_method_name(CIPC_METHOD_MASS_SPRING), "mass-spring");
    assert_string_equal(cipc_method_name(CIPC_METHOD_COUNT), "unknown");
    assert_string_equal(cipc_method_name((cipc_method)-1), "unknown");
    reject_scene(SCENE("@\"method\": \"asynchronos\", ", "\"material\": \"wool\""), NULL, CIPC_E_OUT_OF_RANGE, "method", "'asynchronous'");
}

static void test_what_both_know(void **state)
{
    (void)state;
    static const char text[] = SCENE("", "\"material\": \"wool\", \"damping\": {\"stiffness\": 0.1}, \"friction\": 0.3");
    const char *const overrides[] = {"method=c-ipc", "method=asynchronous"};
    for (int i = 0; i < 2; i++) {
        cipc_scene *s = accept_scene(text, overrides[i]);
        assert_int_equal(s->method, i);
        cipc_scene_destroy(s);
    }
}

static void test_what_c_ipc_does_not_know(void **state)
{
    (void)state;
    reject_scene(SCENE("@\"loads\": [{\"body\": \"cloth\", \"select\": {\"all\": true}, \"force\": [0, 0, 1]}], ", "\"material\": \"wool\""), NULL, CIPC_E_OUT_OF_RANGE,
                 "loads", "the method c-ipc knows no loads");
    reject_scene(SCENE("", "\"material\": \"wool\", \"membrane\": {@\"model\": \"springs\"}"), NULL, CIPC_E_OUT_OF_RANGE, "bodies.cloth.membrane.model",
                 "the method c-ipc knows no membrane of springs");
    cipc_scene *s = accept_scene(SCENE(ASYNCHRONOUS, "\"material\": \"wool\", \"membrane\": {\"model\": \"springs\"}"), NULL);
    assert_int_equal(s->model->bodies[1].material.membrane, CIPC_MEMBRANE_SPRINGS);
    cipc_scene_destroy(s);
    s = accept_scene(SCENE("\"loads\": [], ", "\"material\": \"wool\""), NULL);
    cipc_scene_destroy(s);
}

static void test_what_asynchronous_does_not_know(void **state)
{
    (void)state;
    const struct { const char *text, *path, *what; } cases[] = {
        {SCENE(ASYNCHRONOUS, "\"material\": \"wool\", @\"strain_limit\": \"material\""), "bodies.cloth.strain_limit", "knows no strain limits"},
        {SCENE(ASYNCHRONOUS, "\"density\": 1, \"thickness\": 1, \"membrane\": {\"young\": 1, \"poisson\": 0}, \"bending\": {\"young\": 0}, @\"strain_limit\": {\"lower\": 0.8}"),
         "bodies.cloth.strain_limit", "knows no strain limits"},
        {SCENE(ASYNCHRONOUS, "\"membrane\": {@\"model\": \"orthotropic\", \"fabric\": \"wool\"}"), "bodies.cloth.membrane.model", "knows no orthotropic membrane"},
        {SCENE(ASYNCHRONOUS, "\"material\": \"wool\", \"damping\": {@\"mass\": 0.1}"), "bodies.cloth.damping.mass", "knows no damping by mass"},
        {SCENE(ASYNCHRONOUS "@\"quasistatic\": true, ", "\"material\": \"wool\""), "quasistatic", "knows no quasistatic steps"},
        {SCENE(ASYNCHRONOUS "@\"compat\": \"released\", ", "\"material\": \"wool\""), "compat", "of the method c-ipc"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        reject_scene(cases[i].text, NULL, CIPC_E_OUT_OF_RANGE, cases[i].path, cases[i].what);
        marked_text unmarked = take_mark(cases[i].text);
        cipc_scene *s = accept_scene(unmarked.text, "method=c-ipc"); /* which knows it */
        cipc_scene_destroy(s);
        free(unmarked.text);
    }
}

#define MASS_SPRING "\"method\": \"mass-spring\", "
#define SPRINGS     "\"membrane\": {\"model\": \"springs\"}"
/* The first body is fixed, whatever it is. */
#define HUNG(root, body)                                                                                                                                   \
    "{\"time_step\": 1, \"steps\": 1, " root "\"bodies\": [{\"name\": \"first\", \"fixed\": true, " GRID ", \"material\": \"wool\", \"strain_limit\": \"material\", "  \
    "\"damping\": {\"mass\": 0.1}, \"transform\": {\"translate\": [0, 1, 0]}}, {\"name\": \"cloth\", " body "}]}"

static void test_what_mass_spring_does_not_know(void **state)
{
    (void)state;
    static const char good[] = HUNG("", GRID ", \"material\": \"wool\", " SPRINGS);
    cipc_scene *s = accept_scene(good, "method=mass-spring");
    cipc_scene_destroy(s);
    const struct { const char *text, *path, *what; } cases[] = {
        {HUNG(MASS_SPRING, GRID ", \"material\": \"wool\", " SPRINGS ", @\"strain_limit\": \"material\""), "bodies.cloth.strain_limit", "knows no strain limits"},
        {HUNG(MASS_SPRING, GRID ", \"material\": \"wool\", \"membrane\": {@\"model\": \"stvk\"}"), "bodies.cloth.membrane.model", "whose membrane is springs"},
        {HUNG(MASS_SPRING, GRID ", \"material\": \"wool\", " SPRINGS ", \"damping\": {@\"mass\": 0.1}"), "bodies.cloth.damping.mass", "knows no damping by mass"},
        {HUNG(MASS_SPRING, "@\"volume\": {\"box\": {\"size\": [1, 1, 1], \"cells\": [1, 1, 1]}}, \"density\": 1, \"young\": 1, \"poisson\": 0"), "bodies.cloth.volume", "moves shells, and nothing else"},
        {HUNG(MASS_SPRING "@\"quasistatic\": true, ", GRID ", \"material\": \"wool\", " SPRINGS), "quasistatic", "mass-spring knows no quasistatic steps"},
        {HUNG(MASS_SPRING "@\"compat\": \"released\", ", GRID ", \"material\": \"wool\", " SPRINGS), "compat", "of the method c-ipc, not mass-spring"},
        {HUNG(MASS_SPRING "@\"loads\": [{\"body\": \"cloth\", \"select\": {\"all\": true}, \"force\": [0, 0, 1]}], ", GRID ", \"material\": \"wool\", " SPRINGS), "loads", "knows no loads"},
        {HUNG(MASS_SPRING "@\"friction\": [{\"between\": [\"first\", \"cloth\"], \"mu\": 0.1}], ", GRID ", \"material\": \"wool\", " SPRINGS), "friction", "no friction between two bodies"},
        {HUNG("@\"colliders\": [{\"name\": \"floor\", \"plane\": {\"point\": [0, -1, 0], \"normal\": [0, 1, 0]}}], ", GRID ", \"material\": \"wool\""), "colliders", "of the method mass-spring"},
        {HUNG(ASYNCHRONOUS "@\"colliders\": [{\"name\": \"floor\", \"plane\": {\"point\": [0, -1, 0], \"normal\": [0, 1, 0]}}], ", GRID ", \"material\": \"wool\""), "colliders", "of the method mass-spring"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) reject_scene(cases[i].text, NULL, CIPC_E_OUT_OF_RANGE, cases[i].path, cases[i].what);
    reject_scene(HUNG(MASS_SPRING, GRID ", \"material\": \"wool\""), NULL, CIPC_E_OUT_OF_RANGE, "bodies.cloth.membrane", "whose membrane is springs"); /* by default it is not */
}

static void test_fixed_bodies(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE(ASYNCHRONOUS, "\"material\": \"wool\", \"fixed\": true, \"strain_limit\": \"material\", \"damping\": {\"mass\": 0.1}"), NULL);
    cipc_scene_destroy(s);
}

/* The remedy is one: what it says makes the scene good. */
static void test_remedies(void **state)
{
    (void)state;
    static const char text[] = SCENE(ASYNCHRONOUS, "\"material\": \"wool\", \"strain_limit\": \"material\"");
    cipc_scene *s = NULL;
    cipc_error error;
    assert_int_equal(try_scene(text, NULL, &s, &error), CIPC_E_OUT_OF_RANGE);
    char *override = strstr(error.remedy, "bodies.cloth.strain_limit=null");
    assert_non_null(override);
    override[strlen("bodies.cloth.strain_limit=null")] = '\0';
    s = accept_scene(text, override);
    assert_true(s->model->bodies[1].material.strain_limit == 0);
    cipc_scene_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_what_both_know),
        cmocka_unit_test(test_what_c_ipc_does_not_know),
        cmocka_unit_test(test_what_asynchronous_does_not_know),
        cmocka_unit_test(test_what_mass_spring_does_not_know),
        cmocka_unit_test(test_fixed_bodies),
        cmocka_unit_test(test_remedies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
