/* Dirichlet sets: of one body or several, held, moved, released. */
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
    reject_around("\"dirichlet\": [@{\"select\": {\"all\": true}}],", "", CIPC_E_MISSING_KEY, "dirichlet.0", "needs one of body, bodies");
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

#define TWO "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", " GRID "}, {\"name\": \"b\", " GRID ", \"transform\": {\"translate\": [0, 1, 0]}}], "

/* One set a body, in the order of the names, each released an interval after the one before. */
static void test_sets_of_several_bodies(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(TWO "\"dirichlet\": [{\"bodies\": [\"b\", \"a\"], \"select\": {\"nodes\": [1, 3]}, \"release\": 2, \"release_interval\": 0.5, "
                                     "\"motion\": [{\"velocity\": [0, 1, 0]}]}, {\"bodies\": [\"a\"], \"select\": {\"all\": true}}]}",
                                 NULL);
    assert_int_equal(s->model->dirichlet_count, 3);
    const cipc_dirichlet_set *set = s->model->dirichlet;
    assert_true(set[0].node_count == 2 && set[0].nodes[0] == 4 + 1 && set[0].nodes[1] == 4 + 3 && set[0].release == 2);
    assert_true(set[1].node_count == 2 && set[1].nodes[0] == 1 && set[1].nodes[1] == 3 && set[1].release == 2.5);
    assert_true(set[0].motion_count == 1 && set[1].motion_count == 1 && set[1].motions[0].velocity[1] == 1);
    assert_true(set[2].node_count == 4 && isinf(set[2].release));
    cipc_scene *t = accept_scene(s->resolved, NULL);
    assert_true(t->model->dirichlet[1].release == 2.5 && t->model->dirichlet_count == 3);
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
}

static void test_rejections_of_several_bodies(void **state)
{
    (void)state;
    reject_scene(TWO "\"dirichlet\": [{\"bodies\": [\"a\", @\"c\"], \"select\": {\"all\": true}}]}", NULL, CIPC_E_OUT_OF_RANGE, "dirichlet.0.bodies.1",
                 "no body is called 'c'");
    reject_scene(TWO "\"dirichlet\": [{@\"bodies\": [], \"select\": {\"all\": true}}]}", NULL, CIPC_E_OUT_OF_RANGE, "dirichlet.0.bodies", "at least 1");
    reject_scene(TWO "\"dirichlet\": [@{\"bodies\": [\"a\"], \"body\": \"a\", \"select\": {\"all\": true}}]}", NULL, CIPC_E_OUT_OF_RANGE, "dirichlet.0",
                 "has 2 of body, bodies");
    reject_scene(TWO "\"dirichlet\": [{\"bodies\": [\"a\"], \"select\": {\"all\": true}, @\"release_interval\": 1}]}", NULL, CIPC_E_MISSING_KEY,
                 "dirichlet.0.release_interval", "'release' is never");
    reject_scene(TWO "\"dirichlet\": [{\"bodies\": [\"a\"], \"select\": {\"all\": true}, \"release\": 1, @\"release_interval\": -1}]}", NULL,
                 CIPC_E_OUT_OF_RANGE, "dirichlet.0.release_interval", "at least 0");
    reject_scene(TWO "\"dirichlet\": [{\"body\": \"a\", \"select\": {\"all\": true}, \"release\": 1, @\"release_interval\": 1}]}", NULL, CIPC_E_MISSING_KEY,
                 "dirichlet.0.release_interval", "there is no 'bodies'");
    reject_scene(TWO "\"dirichlet\": [{\"bodies\": [\"a\"], \"select\": {\"all\": true}, @\"track\": {}}]}", NULL, CIPC_E_OUT_OF_RANGE,
                 "dirichlet.0.track", "which 'body' must name");
    reject_scene(TWO "\"dirichlet\": [{\"body\": \"a\", \"select\": {\"all\": true}, \"motion\": [{}], @\"track\": {}}]}", NULL, CIPC_E_OUT_OF_RANGE,
                 "dirichlet.0.track", "cannot stand beside motion");
}

/* The box of the bodies so far is that of the bodies that the scene lists up to this one. */
static void test_boxes_of_bodies_so_far(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(
        TWO "\"dirichlet\": [{\"body\": \"a\", \"select\": {\"box\": {\"min\": [0, 1, 0], \"relative_to\": \"so-far\"}}}, "
            "{\"body\": \"b\", \"select\": {\"box\": {\"min\": [0, 1, 0], \"max\": [0, 1, 1], \"relative_to\": \"scene\"}}}]}",
        NULL);
    assert_int_equal(s->model->dirichlet[0].node_count, 4); /* a alone is flat */
    assert_int_equal(s->model->dirichlet[1].node_count, 2);
    cipc_scene_destroy(s);
    reject_scene(TWO "\"dirichlet\": [{\"body\": \"a\", @\"select\": {\"box\": {\"min\": [0, 1, 0], \"relative_to\": \"scene\"}}}]}", NULL,
                 CIPC_E_OUT_OF_RANGE, "dirichlet.0.select", "selects none");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets_and_motions),       cmocka_unit_test(test_nodes_of_a_later_body),
        cmocka_unit_test(test_sets_of_several_bodies), cmocka_unit_test(test_boxes_of_bodies_so_far),
        cmocka_unit_test(test_dirichlet_rejections),   cmocka_unit_test(test_rejections_of_several_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
