/* Friction of pairs of bodies, and which of them meet. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/scene_trial.h"

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

#define THREE(a, b, c, rest) \
    "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", " a GRID "}, {\"name\": \"b\", " b GRID "}, {\"name\": \"c\", " c GRID "}]" rest "}"
#define GROUP(name) "\"collision_group\": \"" name "\", "

/* `want` has 9 letters: '-' where the pair is apart, row by row. */
static void assert_apart(const char *text, const char *want)
{
    cipc_scene *s = accept_scene(text, NULL), *t = accept_scene(s->resolved, NULL);
    for (int i = 0; i < 9; i++) {
        assert_int_equal(s->model->pair_apart[i], want[i] == '-');
        assert_int_equal(t->model->pair_apart[i], want[i] == '-');
    }
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
}

static void test_all_bodies_meet_unless_said(void **state)
{
    (void)state;
    assert_apart(THREE("", "", "", ""), "+++++++++");
    assert_apart(THREE("", "", "", ", \"collisions\": [{\"between\": [\"c\", \"a\"], \"enabled\": false}]"), "++-+++-++");
    assert_apart(THREE("", "", "", ", \"collisions\": [{\"between\": [\"b\", \"b\"], \"enabled\": false}]"), "++++-++++");
}

/* Bodies of a group meet themselves, and each other only where a pair is listed. */
static void test_groups(void **state)
{
    (void)state;
    assert_apart(THREE(GROUP("x"), "", GROUP("x"), ""), "++-+++-++");
    assert_apart(THREE(GROUP("x"), GROUP("y"), "", ""), "+++++++++");
    assert_apart(THREE(GROUP("x"), GROUP("x"), GROUP("x"), ", \"collisions\": [{\"between\": [\"b\", \"a\"], \"enabled\": true}]"), "++-++---+");
    assert_apart(THREE(GROUP("x"), GROUP("x"), "", ", \"collisions\": [{\"between\": [\"a\", \"a\"], \"enabled\": false}]"), "--+-+++++");
}

static void test_collision_rejections(void **state)
{
    (void)state;
    reject_around("\"collisions\": [{\"between\": [\"cloth\", @\"clth\"], \"enabled\": false}],", "", CIPC_E_OUT_OF_RANGE, "collisions.0.between.1",
                  "no body is called 'clth'; the nearest is 'cloth'");
    reject_around("\"collisions\": [@{\"between\": [\"cloth\", \"cloth\"]}],", "", CIPC_E_MISSING_KEY, "collisions.0.enabled", "true or false");
    reject_around("\"collisions\": [{\"between\": [\"cloth\", \"cloth\"], @\"enabled\": 0}],", "", CIPC_E_WRONG_TYPE, "collisions.0.enabled",
                  "true or false");
    reject_around("\"collisions\": [@{\"enabled\": true}],", "", CIPC_E_MISSING_KEY, "collisions.0.between", "names of two bodies");
    reject_around("\"collisions\": [{\"between\": [\"cloth\", \"cloth\"], \"enabled\": true}, @{\"between\": [\"cloth\", \"cloth\"], \"enabled\": "
                  "false}],",
                  "", CIPC_E_OUT_OF_RANGE, "collisions.1", "the pair cloth, cloth is given twice");
    reject_around("\"collisions\": [{@\"mu\": 1}],", "", CIPC_E_UNKNOWN_KEY, "collisions.0.mu", "nearest known key");
    reject_around("", "@\"collision_group\": 1,", CIPC_E_WRONG_TYPE, "bodies.cloth.collision_group", "a string");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_friction_of_pairs), cmocka_unit_test(test_friction_rejections),  cmocka_unit_test(test_all_bodies_meet_unless_said),
        cmocka_unit_test(test_groups),            cmocka_unit_test(test_collision_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
