/* Bodies repeated: where copies lie, what they are called, and who can be meant by their common name. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "support/scene_trial.h"

#define GRID "\"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"material\": \"wool\""
#define SCENE(bodies, rest) "{\"time_step\": 0.5, \"steps\": 1, \"bodies\": [" bodies "]" rest "}"
#define BODY(name, more) "{\"name\": \"" name "\", " more GRID "}"
#define STACK "\"copies\": {\"count\": 3, \"translate\": [0, 2, 0], \"rotate\": {\"angle\": 1.5707963267948966}}, \"transform\": {\"translate\": [5, 1, 0]}, "

/* A node at (x, y, z) turned by i quarters about y is at (x, y, z), (z, y, -x), (-x, y, -z). Loaded again from the resolved scene: the same bits. */
static void test_places_and_names(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE(BODY("sheet", STACK) "," BODY("last", ""), ""), NULL), *t = accept_scene(s->resolved, NULL);
    static const char *const names[] = {"sheet-1", "sheet-2", "sheet-3", "last"};
    assert_int_equal(s->model->body_count, 4);
    for (int b = 0; b < 4; b++) assert_string_equal(s->model->bodies[b].name, names[b]);
    const double *x = s->state->position;
    for (int n = 0; n < 4; n++) {
        const double *first = x + 3 * n, *second = x + 3 * (n + 4), *third = x + 3 * (n + 8);
        assert_true(fabs(second[0] - first[2]) < 1e-15 * 8 && second[1] == 3 && fabs(second[2] + first[0]) < 1e-15 * 8);
        assert_true(fabs(third[0] + first[0]) < 1e-15 * 8 && third[1] == 5 && fabs(third[2] + first[2]) < 1e-15 * 8);
    }
    assert_memory_equal(x, t->state->position, 3 * (size_t)s->model->node_count * sizeof *x);
    assert_memory_equal(s->model->rest, s->model->rest + 12, 12 * sizeof *x);
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
}

/* Between all copies and themselves; between copies and another body; one copy by its own name. */
static void test_friction_among_copies(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE(BODY("a", STACK) "," BODY("b", ""),
                                       ", \"friction\": [{\"between\": [\"a\", \"a\"], \"mu\": 0.1}, {\"between\": [\"b\", \"a\"], \"mu\": 0.2}]"), NULL);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) assert_true(s->model->pair_friction[4 * i + j] == (i < 3 && j < 3 ? 0.1 : i == 3 && j == 3 ? 0 : 0.2));
    }
    cipc_scene_destroy(s);
    s = accept_scene(SCENE(BODY("a", STACK), ", \"collisions\": [{\"between\": [\"a-2\", \"a-3\"], \"enabled\": false}]"), NULL);
    for (int k = 0; k < 9; k++) assert_int_equal(s->model->pair_apart[k], k == 5 || k == 7);
    cipc_scene_destroy(s);
    reject_scene(SCENE(BODY("a", STACK), ", \"friction\": [{\"between\": [\"a\", \"a\"], \"mu\": 1}, @{\"between\": [\"a-3\", \"a-1\"], \"mu\": 1}]"), NULL,
                 CIPC_E_OUT_OF_RANGE, "friction.1", "the pair a-3, a-1 is given twice");
}

/* Released one after the other, in the order of the copies. */
static void test_dirichlet_sets_of_copies(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE(BODY("a", STACK) "," BODY("b", ""),
                                       ", \"dirichlet\": [{\"bodies\": [\"b\", \"a\"], \"select\": {\"nodes\": [1]}, \"release\": 1, \"release_interval\": 2}]"), NULL);
    static const int nodes[] = {13, 1, 5, 9};
    assert_int_equal(s->model->dirichlet_count, 4);
    for (int i = 0; i < 4; i++) {
        const cipc_dirichlet_set *set = &s->model->dirichlet[i];
        assert_true(set->node_count == 1 && set->nodes[0] == nodes[i] && set->release == 1 + 2 * i);
    }
    cipc_scene_destroy(s);
    reject_scene(SCENE(BODY("a", STACK), ", \"dirichlet\": [{@\"body\": \"a\", \"select\": {\"all\": true}}]"), NULL, CIPC_E_OUT_OF_RANGE, "dirichlet.0.body",
                 "'a' is the name of 3 copies; name one of them, 'a-1' for the first");
}

static void test_subject_of_the_pictures(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(SCENE(BODY("b", "") "," BODY("a", STACK) "," BODY("c", ""), ", \"output\": {\"camera\": {\"subject\": [\"a\", \"c\"]}}"), NULL);
    for (int b = 0; b < 5; b++) assert_int_equal(s->camera_subject[b], b > 0);
    cipc_scene_destroy(s);
    s = accept_scene(SCENE(BODY("b", ""), ""), NULL);
    assert_null(s->camera_subject);
    cipc_scene_destroy(s);
    reject_around("\"output\": {\"camera\": {\"subject\": [@\"cloht\"]}},", "", CIPC_E_OUT_OF_RANGE, "output.camera.subject.0", "nearest is 'cloth'");
    reject_around("\"output\": {\"camera\": {@\"subject\": []}},", "", CIPC_E_OUT_OF_RANGE, "output.camera.subject", "has 0 elements");
}

/* What the model finds wrong with a body behind copies is said at that body. */
static void test_place_of_what_the_model_rejects(void **state)
{
    (void)state;
    reject_scene(SCENE(BODY("a", STACK) ", {\"name\": \"flat\", @\"rods\": {\"polyline\": {\"points\": [[0, 0, 0], [1, 0, 0], [0, 0, 0]], \"segments\": 1}}, \"density\": 1, "
                       "\"diameter\": 1, \"young\": 1, \"rest\": {\"scale\": 1e-320}}", ""), NULL, CIPC_E_BAD_MESH, "bodies.flat.rods", "");
}

/* Copies of a garment have its pattern as rest shape and its sides: a lower tier sewn under the upper one, row by row. */
static void test_copies_of_garments(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene("{\"time_step\": 0.5, \"steps\": 1, \"bodies\": [{\"name\": \"tier\", \"material\": \"wool\", \"rest\": \"flat\", \"shell\": {\"gores\": {\"top\": 0.1, "
                                 "\"bottom\": 0.1, \"height\": 0.2, \"cells\": [5, 1]}}, \"copies\": {\"count\": 2, \"translate\": [0, -0.25, 0]}}],"
                                 "\"stitches\": [{\"body_a\": \"tier-1\", \"side_a\": \"bottom\", \"body_b\": \"tier-2\", \"side_b\": \"top\"}]}", NULL);
    assert_int_equal(s->model->node_count, 24);
    assert_int_equal(s->model->stitch_count, 6);
    for (int i = 0; i < 6; i++) {
        const int *nodes = s->model->stitches[i].nodes;
        assert_true(nodes[0] == 6 + i && nodes[1] >= 12 && nodes[1] < 18 && nodes[2] >= 12 && nodes[2] < 18);
    }
    for (int k = 0; k < 36; k++) assert_true(s->model->rest[k] == s->model->rest[36 + k]);
    cipc_scene_destroy(s);
}

static void test_rejections(void **state)
{
    (void)state;
    reject_around("", "\"copies\": {@\"count\": 0},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.copies.count", "at least 1");
    reject_around("", "@\"copies\": {},", CIPC_E_MISSING_KEY, "bodies.cloth.copies.count", "missing");
    reject_around("", "\"copies\": {\"count\": 2, @\"translat\": [0, 0, 0]},", CIPC_E_UNKNOWN_KEY, "bodies.cloth.copies.translat", "'translate'");
    reject_around("", "\"copies\": {\"count\": 2, \"rotate\": {@\"axis\": [0, 0, 0]}},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.copies.rotate.axis", "not a direction");
    reject_scene(SCENE(BODY("a", STACK) ", {@\"name\": \"a-2\", " GRID "}", ""), NULL, CIPC_E_OUT_OF_RANGE, "bodies.a-2.name", "body 0, 'a'");
    reject_scene(SCENE(BODY("a-2", "") ", {@\"name\": \"a\", " STACK GRID "}", ""), NULL, CIPC_E_OUT_OF_RANGE, "bodies.a.name", "body 0, 'a-2'");
    cipc_scene_destroy(accept_scene(SCENE(BODY("a", STACK) "," BODY("a-4", "") "," BODY("a-02", ""), ""), NULL));
    reject_around("", "\"copies\": {@\"count\": 10001},", CIPC_E_OUT_OF_RANGE, "bodies.cloth.copies.count", "at most 10000");
    reject_scene(SCENE("{@\"name\": \"0123456789012345678901234567890123456789012345678901234567\", " STACK GRID "}", ""), NULL, CIPC_E_OUT_OF_RANGE,
                 "bodies.0123456789012345678901234567890123456789012345678901234567.name", "1 to 57 bytes");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places_and_names),
        cmocka_unit_test(test_friction_among_copies),
        cmocka_unit_test(test_dirichlet_sets_of_copies),
        cmocka_unit_test(test_copies_of_garments),
        cmocka_unit_test(test_subject_of_the_pictures),
        cmocka_unit_test(test_place_of_what_the_model_rejects),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
