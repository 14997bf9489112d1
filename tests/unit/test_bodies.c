/* Bodies: names, shapes, starts. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>

#include "scene/bodies.h"
#include "support/scene_trial.h"

#define SHELL "\"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}"

static void test_bodies_keep_their_order_and_get_what_they_say(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"bodies\": [{\"name\": \"ground\", \"fixed\": true, \"friction\": 0.25, " SHELL "},"
                               "{\"name\": \"cloth\", \"material\": \"wool\", \"offset\": 1e-3, \"velocity\": [1, 2, 3], \"transform\": "
                               "{\"translate\": [0, 7, 0]}, " SHELL "}]}");
    scene_cursor root = scene_root(r.root);
    scene_bodies bodies;
    scene_read_bodies(&r, &root, 1, false, &bodies);
    assert_int_equal(r.status, CIPC_OK);
    assert_int_equal(bodies.count, 2);
    const cipc_body_description *ground = &bodies.descriptions[0], *cloth = &bodies.descriptions[1];
    assert_string_equal(ground->name, "ground");
    assert_true(ground->fixed && ground->friction == 0.25 && ground->offset == 0);
    assert_true(ground->material.density == 1000 && ground->material.thickness == 1e-3);
    assert_string_equal(cloth->name, "cloth");
    assert_true(!cloth->fixed && cloth->offset == 1e-3 && cloth->material.thickness == 0.568e-3);
    assert_int_equal(cloth->node_count, 4);
    assert_int_equal(cloth->triangle_count, 2);
    assert_true(cloth->rest[1] == 0 && cloth->position[1] == 7);
    assert_true(cloth->velocity[9] == 1 && cloth->velocity[11] == 3);
    scene_bodies_free(&bodies);
    scene_reader_free(&r);
}

/* One of each kind; the model takes them. */
static void test_bodies_of_every_kind(void **state)
{
    (void)state;
    cipc_scene *s = accept_scene(
        "{\"time_step\": 1, \"steps\": 1, \"bodies\": ["
        "{\"name\": \"rod\", \"rods\": {\"line\": {\"points\": [[0, 0, 0], [1, 0, 0]], \"segments\": 4}}, \"density\": 1300, \"diameter\": 8e-5, "
        "\"young\": 4e8, \"bending_factor\": 0.01, \"damping\": {\"stiffness\": 0.1, \"mass\": 0.2}},"
        "{\"name\": \"sand\", \"particles\": {\"points\": [[0, 1, 0], [0, 2, 0]]}, \"density\": 1600, \"diameter\": 2e-3},"
        "{\"name\": \"ball\", \"volume\": {\"box\": {\"size\": [1, 1, 1], \"cells\": [1, 1, 1]}}, \"density\": 1000, \"young\": 1e4, "
        "\"poisson\": 0.4, \"transform\": {\"translate\": [0, 5, 0]}},"
        "{\"name\": \"needle\", \"fixed\": true, \"rods\": {\"line\": {\"points\": [[0, 3, 0], [1, 3, 0]], \"segments\": 1}}},"
        "{\"name\": \"stone\", \"fixed\": true, \"volume\": {\"box\": {\"size\": [1, 1, 1], \"cells\": [1, 1, 1]}}}]}",
        NULL);
    const cipc_body *b = s->model->bodies;
    assert_int_equal(b[0].kind, CIPC_BODY_RODS);
    assert_int_equal(b[0].segment_count, 4);
    assert_true(b[0].material.thickness == 8e-5 && b[0].material.young == 4e8 && b[0].material.bending_young == 0.01 * 4e8);
    assert_true(b[0].material.damping_stiffness == 0.1 && b[0].material.damping_mass == 0.2 && b[1].material.damping_mass == 0);
    assert_int_equal(b[1].kind, CIPC_BODY_PARTICLES);
    assert_true(b[1].node_count == 2 && b[1].material.thickness == 2e-3);
    assert_int_equal(b[2].kind, CIPC_BODY_VOLUME);
    assert_true(b[2].tetrahedron_count > 0 && b[2].material.young == 1e4 && b[2].material.poisson == 0.4);
    assert_true(b[3].fixed && b[3].segment_count == 1 && b[3].material.density == 1000);
    assert_true(b[4].fixed && b[4].tetrahedron_count > 0 && b[4].material.young == 0);
    cipc_scene_destroy(s);
}

/* "released": obstacles without a material weigh what the first free body weighs, wherever it stands in the list. */
static void test_released_obstacles(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"bodies\": [{\"name\": \"ground\", \"fixed\": true, " SHELL
                               "}, {\"name\": \"cloth\", \"material\": \"wool\", " SHELL "},"
                               "{\"name\": \"other\", \"material\": \"cotton\", " SHELL "}]}");
    scene_cursor root = scene_root(r.root);
    scene_bodies bodies;
    scene_read_bodies(&r, &root, 1, true, &bodies);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(bodies.descriptions[0].material.density == 413.380282 && bodies.descriptions[0].material.thickness == 0.568e-3);
    scene_bodies_free(&bodies);
    scene_reader_free(&r);
}

/* A volume has a density to give, but no thickness. */
static void test_released_obstacles_beside_volumes(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"bodies\": [{\"name\": \"ground\", \"fixed\": true, " SHELL
                               "}, {\"name\": \"ball\", \"density\": 7, \"young\": 1, \"poisson\": 0, \"volume\": {\"box\": "
                               "{\"size\": [1, 1, 1], \"cells\": [1, 1, 1]}}}]}");
    scene_cursor root = scene_root(r.root);
    scene_bodies bodies;
    scene_read_bodies(&r, &root, 1, true, &bodies);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(bodies.descriptions[0].material.density == 7 && bodies.descriptions[0].material.thickness == 1e-3);
    scene_bodies_free(&bodies);
    scene_reader_free(&r);
}

static void test_finding_by_name(void **state)
{
    (void)state;
    scene_reader r = reader_of("{\"a\": \"cloth\", \"b\": \"bal\", \"bodies\": [{\"name\": \"ball\", \"material\": \"wool\", " SHELL "},"
                               "{\"name\": \"cloth\", \"material\": \"wool\", " SHELL "}]}");
    scene_cursor root = scene_root(r.root), a = scene_member(&root, "a"), b = scene_member(&root, "b");
    scene_bodies bodies;
    scene_read_bodies(&r, &root, 1, false, &bodies);
    assert_int_equal(scene_find_body(&r, &a, &bodies), 1);
    scene_find_body(&r, &b, &bodies);
    assert_rejection(&r, CIPC_E_OUT_OF_RANGE, "t.json:1:16 b", "no body is called 'bal'; the nearest is 'ball'");
    scene_bodies_free(&bodies);
    scene_reader_free(&r);
}

static void reject_name(const char *name, const char *shown)
{
    char text[512];
    snprintf(text, sizeof text, "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{@\"name\": \"%s\", \"material\": \"wool\", " SHELL "}]}",
             name);
    char path[200];
    snprintf(path, sizeof path, "bodies.%s.name", name);
    reject_scene(text, NULL, CIPC_E_OUT_OF_RANGE, path, shown);
}

static void test_names(void **state)
{
    (void)state;
    reject_name("", "'' is not a name");
    reject_name("a.b", "'a.b' is not a name");
    reject_name("a=b", "is not a name");
    reject_name("12", "'12' is not a name");
    reject_name("0123456789012345678901234567890123456789012345678901234567890123", "1 to 63 bytes");
    reject_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", " SHELL
                 "}, {@\"name\": \"a\", \"material\": \"wool\", " SHELL "}]}",
                 NULL, CIPC_E_OUT_OF_RANGE, "bodies.a.name", "'a' is the name of body 0 already");
    reject_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [@{\"material\": \"wool\", " SHELL "}]}", NULL, CIPC_E_MISSING_KEY,
                 "bodies.0.name", "missing");
}

static void test_rejections(void **state)
{
    (void)state;
    reject_scene("@{\"time_step\": 1, \"steps\": 1}", NULL, CIPC_E_MISSING_KEY, "bodies", "missing");
    reject_scene("{\"time_step\": 1, \"steps\": 1, @\"bodies\": {}}", NULL, CIPC_E_WRONG_TYPE, "bodies", "an array");
    reject_scene("{\"time_step\": 1, \"steps\": 1, @\"bodies\": []}", NULL, CIPC_E_OUT_OF_RANGE, "bodies", "at least 1");
    reject_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [@3]}", NULL, CIPC_E_WRONG_TYPE, "bodies.0", "an object");
    reject_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [@{\"name\": \"a\", \"material\": \"wool\"}]}", NULL, CIPC_E_MISSING_KEY,
                 "bodies.a", "needs one of shell, rods, particles, volume");
    reject_around("", "@\"thicknes\": 1,", CIPC_E_UNKNOWN_KEY, "bodies.cloth.thicknes", "'thickness'");
    reject_around("", "@\"offset\": -1e-9,", CIPC_E_OUT_OF_RANGE, "bodies.cloth.offset", "at least 0");
    reject_around("", "@\"friction\": -1,", CIPC_E_OUT_OF_RANGE, "bodies.cloth.friction", "at least 0");
    reject_around("", "@\"fixed\": 1,", CIPC_E_WRONG_TYPE, "bodies.cloth.fixed", "true or false");
    reject_around("", "\"velocity\": [0, @null, 0],", CIPC_E_WRONG_TYPE, "bodies.cloth.velocity.1", "but is null");
    reject_around("", "@\"comment\": 1,", CIPC_E_WRONG_TYPE, "bodies.cloth.comment", "a string");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies_keep_their_order_and_get_what_they_say),
        cmocka_unit_test(test_bodies_of_every_kind),
        cmocka_unit_test(test_released_obstacles),
        cmocka_unit_test(test_released_obstacles_beside_volumes),
        cmocka_unit_test(test_finding_by_name),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
