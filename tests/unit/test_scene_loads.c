/* "loads": which nodes they take, what each of them gets, when; and what is refused. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "support/scene_trial.h"

#define METHOD "\"method\": \"asynchronous\", "

static cipc_scene *accept_around(const char *root)
{
    char *text = scene_around(root, "");
    cipc_scene *scene = accept_scene(text, NULL);
    free(text);
    return scene;
}

static void test_the_force_is_shared_evenly(void **state)
{
    (void)state;
    cipc_scene *s = accept_around(METHOD "\"loads\": [{\"body\": \"cloth\", \"select\": {\"nodes\": [8, 0]}, \"force\": [3, -1, 0.5], \"begin\": 0.5, \"end\": 2},"
                                  "{\"name\": \"pull\", \"body\": \"cloth\", \"select\": {\"ring\": {\"end\": \"max\"}}, \"force\": [3, 0, 0]}],");
    assert_int_equal(s->model->load_count, 2);
    const cipc_load *load = s->model->loads;
    assert_true(load[0].node_count == 2 && load[0].nodes[0] == 0 && load[0].nodes[1] == 8);
    assert_true(load[0].force[0] == 1.5 && load[0].force[1] == -0.5 && load[0].force[2] == 0.25 && load[0].begin == 0.5 && load[0].end == 2);
    assert_true(load[1].node_count == 3 && load[1].force[0] == 1 && load[1].begin == 0 && isinf(load[1].end));
    cipc_scene *t = accept_scene(s->resolved, NULL); /* nothing is divided twice */
    assert_true(t->model->load_count == 2 && t->model->loads[0].force[0] == 1.5 && isinf(t->model->loads[1].end));
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
}

#define GRID "\"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"material\": \"wool\""
#define TWO(load) \
    "{\"time_step\": 1, \"steps\": 1, " METHOD "\"bodies\": [{\"name\": \"a\", \"fixed\": true, " GRID "}, {\"name\": \"b\", " GRID "}], \"loads\": [" load "]}"

/* Nodes are counted from the body's own first node in the file, from the model's in the model; boxes are the scene's too. */
static void test_nodes_of_a_later_body(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(TWO("{\"body\": \"b\", \"select\": {\"box\": {\"max\": [0.1, 1, 1], \"relative_to\": \"scene\"}}, \"force\": [0, 1, 0]}"), NULL);
    assert_true(s->model->loads[0].node_count == 2 && s->model->loads[0].nodes[0] == 4 && s->model->loads[0].nodes[1] == 4 + 2);
    cipc_scene_destroy(s);
}

#define LOAD METHOD "\"loads\": [{\"body\": \"cloth\", \"select\": {\"all\": true}, "

static void test_refused(void **state)
{
    (void)state;
    reject_around(METHOD "@\"loads\": {},", "", CIPC_E_WRONG_TYPE, "loads", "an array");
    reject_around(METHOD "\"loads\": [@{\"select\": {\"all\": true}, \"force\": [0, 0, 1]}],", "", CIPC_E_MISSING_KEY, "loads.0.body", "missing");
    reject_around(METHOD "\"loads\": [{@\"body\": \"sheet\", \"select\": {\"all\": true}, \"force\": [0, 0, 1]}],", "", CIPC_E_OUT_OF_RANGE, "loads.0.body", "'cloth'");
    reject_around(METHOD "\"loads\": [@{\"body\": \"cloth\", \"force\": [0, 0, 1]}],", "", CIPC_E_MISSING_KEY, "loads.0.select", "missing");
    reject_around(METHOD "\"loads\": [{\"name\": \"pull\", \"body\": \"cloth\", @\"select\": {\"nodes\": []}, \"force\": [0, 0, 1]}],", "", CIPC_E_OUT_OF_RANGE,
                  "loads.pull.select", "selects none");
    reject_around(METHOD "\"loads\": [@{\"body\": \"cloth\", \"select\": {\"all\": true}}],", "", CIPC_E_MISSING_KEY, "loads.0.force", "missing");
    reject_around(LOAD "\"force\": [0, 0, @\"x\"]}],", "", CIPC_E_WRONG_TYPE, "loads.0.force.2", "a number");
    reject_around(LOAD "@\"force\": 3}],", "", CIPC_E_WRONG_TYPE, "loads.0.force", "an array of 3 numbers");
    reject_around(LOAD "\"force\": [0, 0, 1], \"begin\": 1, @\"end\": 1}],", "", CIPC_E_OUT_OF_RANGE, "loads.0.end", "must be after the begin at 1");
    reject_around(LOAD "\"force\": [0, 0, 1], @\"end\": \"later\"}],", "", CIPC_E_WRONG_TYPE, "loads.0.end", "\"never\"");
    reject_around(LOAD "\"force\": [0, 0, 1], @\"nodes\": [1]}],", "", CIPC_E_UNKNOWN_KEY, "loads.0.nodes", "nearest known key");
    reject_around(LOAD "\"force\": [0, 0, 1], @\"name\": 1}],", "", CIPC_E_WRONG_TYPE, "loads.0.name", "a string");
    reject_scene(TWO("{@\"body\": \"a\", \"select\": {\"all\": true}, \"force\": [0, 1, 0]}"), NULL, CIPC_E_OUT_OF_RANGE, "loads.0.body", "no force moves it");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_force_is_shared_evenly),
        cmocka_unit_test(test_nodes_of_a_later_body),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
