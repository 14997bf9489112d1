/* Friction of pairs, Dirichlet sets and their motion. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "support/scene_trial.h"

static cipc_scene *accept_around(const char *root)
{
    char *text = scene_around(root, "");
    cipc_scene *scene = accept_scene(text, NULL);
    free(text);
    return scene;
}

#define GRID "\"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"material\": \"wool\""

static void test_friction_of_pairs(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"friction\": 0.5, " GRID
                                 "}, {\"name\": \"b\", \"friction\": 0.3, " GRID "}],"
                                 "\"friction\": [{\"between\": [\"b\", \"b\"], \"mu\": 0.1}]}",
                                 NULL);
    const double *mu = s->model->pair_friction;
    assert_true(mu[0] == 0.5 && mu[1] == 0.3 && mu[2] == 0.3 && mu[3] == 0.1); /* the smaller of the two bodies', unless said */
    cipc_scene_destroy(s);
    s = accept_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", " GRID "}, {\"name\": \"b\", " GRID "}],"
                     "\"friction\": [{\"between\": [\"b\", \"a\"], \"mu\": 0.7}]}",
                     NULL);
    mu = s->model->pair_friction;
    assert_true(mu[0] == 0 && mu[1] == 0.7 && mu[2] == 0.7 && mu[3] == 0);
    cipc_scene_destroy(s);
}

static void test_friction_rejections(void **state)
{
    (void)state;
    reject_around("\"friction\": [{\"between\": [\"cloth\", @\"clth\"], \"mu\": 1}],", "", CIPC_E_OUT_OF_RANGE, "friction.0.between.1",
                  "no body is called 'clth'; the nearest is 'cloth'");
    reject_around("\"friction\": [@{\"between\": [\"cloth\", \"cloth\"]}],", "", CIPC_E_MISSING_KEY, "friction.0.mu", "missing");
    reject_around("\"friction\": [@{\"mu\": 1}],", "", CIPC_E_MISSING_KEY, "friction.0.between", "names of two bodies");
    reject_around("\"friction\": [{@\"between\": [\"cloth\"], \"mu\": 1}],", "", CIPC_E_OUT_OF_RANGE, "friction.0.between", "must have 2");
    reject_around("\"friction\": [{\"between\": [\"cloth\", @1], \"mu\": 1}],", "", CIPC_E_WRONG_TYPE, "friction.0.between.1", "a string");
    reject_around("\"friction\": [{\"between\": [\"cloth\", \"cloth\"], @\"mu\": -0.1}],", "", CIPC_E_OUT_OF_RANGE, "friction.0.mu",
                  "at least 0");
    reject_around("\"friction\": [{\"between\": [\"cloth\", \"cloth\"], \"mu\": 1}, @{\"between\": [\"cloth\", \"cloth\"], \"mu\": 1}],",
                  "", CIPC_E_OUT_OF_RANGE, "friction.1", "the pair cloth, cloth is given twice");
    reject_around("@\"friction\": 0.4,", "", CIPC_E_WRONG_TYPE, "friction", "an array");
}

static void test_sets_and_motions(void **state)
{
    (void)state;
    cipc_scene *s = accept_around(
        "\"dirichlet\": [{\"body\": \"cloth\", \"select\": {\"nodes\": [8, 0]}, \"release\": 2.5, \"motion\": ["
        "{\"end\": 1, \"velocity\": [1, 2, 3]}, {\"begin\": 1, \"angular_velocity\": -2, \"axis\": [0, 0, 3], \"center\": [4, 5, 6]}]},"
        "{\"name\": \"rest\", \"body\": \"cloth\", \"select\": {\"all\": true}}],");
    assert_int_equal(s->model->dirichlet_count, 2);
    const cipc_dirichlet_set *set = &s->model->dirichlet[0];
    assert_int_equal(set->node_count, 2);
    assert_true(set->nodes[0] == 0 && set->nodes[1] == 8 && set->release == 2.5);
    assert_int_equal(set->motion_count, 2);
    const cipc_motion *first = &set->motions[0], *second = &set->motions[1];
    assert_true(first->begin == 0 && first->end == 1 && first->velocity[1] == 2 && first->angular_velocity == 0);
    assert_true(second->begin == 1 && isinf(second->end) && second->angular_velocity == -2 && second->center[2] == 6);
    assert_true(second->axis[0] == 0 && second->axis[1] == 0 && second->axis[2] == 1);
    set = &s->model->dirichlet[1];
    assert_true(set->node_count == 9 && isinf(set->release) && set->motion_count == 0);
    cipc_scene_destroy(s);
}

/* Nodes are counted from the body's own first node in the file, from the model's in the model. */
static void test_nodes_of_a_later_body(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(
        "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", " GRID "}, {\"name\": \"b\", \"fixed\": true, " GRID "}],"
        "\"dirichlet\": [{\"body\": \"b\", \"select\": {\"nodes\": [2]}, \"motion\": [{\"velocity\": [0, 1, 0]}]}]}",
        NULL);
    assert_int_equal(s->model->dirichlet_count, 2); /* the fixed body's own set first */
    assert_int_equal(s->model->dirichlet[1].nodes[0], 4 + 2);
    cipc_scene_destroy(s);
}

#define SET "\"dirichlet\": [{\"body\": \"cloth\", \"select\": {\"all\": true}, "

static void test_dirichlet_rejections(void **state)
{
    (void)state;
    reject_around("\"dirichlet\": [{@\"body\": \"sheet\", \"select\": {\"all\": true}}],", "", CIPC_E_OUT_OF_RANGE, "dirichlet.0.body",
                  "no body is called 'sheet'");
    reject_around("\"dirichlet\": [@{\"select\": {\"all\": true}}],", "", CIPC_E_MISSING_KEY, "dirichlet.0.body", "missing");
    reject_around("\"dirichlet\": [@{\"body\": \"cloth\"}],", "", CIPC_E_MISSING_KEY, "dirichlet.0.select", "missing");
    reject_around(
        "\"dirichlet\": [{\"name\": \"top\", \"body\": \"cloth\", @\"select\": {\"box\": {\"min\": [0.1, 0, 0], \"max\": [0.2, 1, 1]}}}],",
        "", CIPC_E_OUT_OF_RANGE, "dirichlet.top.select", "selects none of the body's 9 nodes");
    reject_around("\"dirichlet\": [{\"body\": \"cloth\", \"select\": {\"nodes\": [0, @9]}}],", "", CIPC_E_OUT_OF_RANGE,
                  "dirichlet.0.select.nodes.1", "at most 8");
    reject_around("\"dirichlet\": [{\"body\": \"cloth\", \"select\": {\"all\": true}, @\"name\": 1}],", "", CIPC_E_WRONG_TYPE,
                  "dirichlet.0.name", "a string");
    reject_around(SET "@\"relase\": 1}],", "", CIPC_E_UNKNOWN_KEY, "dirichlet.0.relase", "'release'");
    reject_around(SET "@\"release\": \"later\"}],", "", CIPC_E_WRONG_TYPE, "dirichlet.0.release", "a number or \"never\"");
    reject_around(SET "@\"motion\": {}}],", "", CIPC_E_WRONG_TYPE, "dirichlet.0.motion", "an array");
    reject_around(SET "\"motion\": [{\"begin\": 1, @\"end\": 1}]}],", "", CIPC_E_OUT_OF_RANGE, "dirichlet.0.motion.0.end",
                  "must be after the begin at 1");
    reject_around(SET "\"motion\": [{@\"axis\": [0, 0, 0]}]}],", "", CIPC_E_OUT_OF_RANGE, "dirichlet.0.motion.0.axis", "not a direction");
    reject_around(SET "\"motion\": [{@\"speed\": [0, 0, 0]}]}],", "", CIPC_E_UNKNOWN_KEY, "dirichlet.0.motion.0.speed",
                  "nearest known key");
    reject_around(SET "\"motion\": [{\"velocity\": [0, 0, @\"x\"]}]}],", "", CIPC_E_WRONG_TYPE, "dirichlet.0.motion.0.velocity.2",
                  "a number");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_friction_of_pairs),     cmocka_unit_test(test_friction_rejections),  cmocka_unit_test(test_sets_and_motions),
        cmocka_unit_test(test_nodes_of_a_later_body), cmocka_unit_test(test_dirichlet_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
