/* Rest shapes from a mesh of their own. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/rest_mesh.h"
#include "support/scene_trial.h"

static const char body_mesh[] = "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nf 1 3 2\nf 2 3 4\n";

/* A folder with a mesh for the body (drape.obj), one for its rest shape (flat.obj), and scenes that name both. */
typedef struct trial {
    char *folder, *files[2];
} trial;

static trial set_up(const char *rest_mesh)
{
    trial t = {make_folder(), {NULL, NULL}};
    t.files[0] = write_file(t.folder, "drape.obj", body_mesh, strlen(body_mesh));
    t.files[1] = write_file(t.folder, "flat.obj", rest_mesh, strlen(rest_mesh));
    return t;
}

static void tear_down(trial *t)
{
    free(t->files[0]);
    free(t->files[1]);
    remove_folder(t->folder);
}

static cipc_status load(const trial *t, const char *body, cipc_scene **scene, cipc_error *error)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"shell\": {\"mesh\": "
             "\"drape.obj\"}, %s}]}",
             body);
    char *path = write_file(t->folder, "s.json", text, strlen(text));
    cipc_status status = cipc_scene_load(scene, path, 0, NULL, error);
    free(path);
    return status;
}

/* The rest mesh is scaled as the body is unless it says otherwise, and neither turned nor moved. */
static void test_the_rest_shape_is_the_other_mesh(void **state)
{
    (void)state;
    trial t = set_up("v 5 0 5\nv 7 0 5\nv 5 0 6\nv 7 0 6\nf 1 3 2\nf 2 3 4\n");
    static const struct {
        const char *body;
        double scale;
    } cases[] = {
        {"\"rest\": {\"mesh\": \"flat.obj\"}", 1},
        {"\"rest\": {\"mesh\": \"flat.obj\"}, \"transform\": {\"scale\": 0.5, \"translate\": [0, 9, 0]}", 0.5},
        {"\"rest\": {\"mesh\": \"flat.obj\", \"scale\": 2}, \"transform\": {\"scale\": 0.5}", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_scene *scene, *again;
        cipc_error error;
        if (load(&t, cases[i].body, &scene, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
        assert_true(scene->model->rest[0] == 5 * cases[i].scale && scene->model->rest[3] == 7 * cases[i].scale &&
                    scene->model->rest[1] == 0);
        assert_true(scene->state->position[0] == 0);
        again = accept_scene(scene->resolved, NULL);
        assert_memory_equal(scene->model->rest, again->model->rest, 12 * sizeof(double));
        assert_memory_equal(scene->state->position, again->state->position, 12 * sizeof(double));
        cipc_scene_destroy(scene);
        cipc_scene_destroy(again);
    }
    tear_down(&t);
}

static void refuse(const char *rest_mesh, cipc_status status, const char *what)
{
    trial t = set_up(rest_mesh);
    cipc_scene *scene;
    cipc_error error;
    assert_int_equal(load(&t, "\"rest\": {\"mesh\": \"flat.obj\"}", &scene, &error), status);
    assert_null(scene);
    if (strstr(error.place, "bodies.a.rest.mesh") == NULL) fail_msg("place: %s", error.place);
    if (strstr(error.what, what) == NULL) fail_msg("what: %s", error.what);
    tear_down(&t);
}

static void test_other_meshes_are_refused(void **state)
{
    (void)state;
    refuse("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n", CIPC_E_BAD_MESH, "has 3 nodes and 1 triangles, but the body has 4 and 2");
    refuse("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nf 1 3 2\nf 2 4 3\n", CIPC_E_BAD_MESH, "must be the same nodes in the same order");
}

#define TUBE "{\"gores\": {\"top\": 0.1, \"bottom\": 0.2, \"height\": 0.3, \"cells\": [4, 1]}}"
#define GARMENT(rest, transform)                                                                                                           \
    "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"shell\": " TUBE ", " rest                   \
    ", \"transform\": " transform "}]}"

/* A garment that starts turned and moved, and larger, has its pattern as large for its rest shape, and so starts without stretch. */
static void test_flat_is_the_pattern(void **state)
{
    (void)state;
    const cipc_panel_ring ring = {.panels = 1, .down = 1, .top = 0.1, .bottom = 0.2, .height = 0.3};
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_gores(&mesh, &ring, 4, NULL), CIPC_OK);
    cipc_scene *scene =
        accept_scene(GARMENT("\"rest\": \"flat\"", "{\"scale\": 2, \"rotate\": {\"angle\": 1}, \"translate\": [0, 1, 0]}"), NULL);
    cipc_scene *again = accept_scene(scene->resolved, NULL);
    for (int i = 0; i < 30; i++) assert_true(scene->model->rest[i] == 2 * mesh.pattern[i]);
    assert_memory_equal(scene->model->rest, again->model->rest, 30 * sizeof(double));
    assert_memory_equal(scene->state->position, again->state->position, 30 * sizeof(double));
    cipc_mesh_free(&mesh);
    cipc_scene_destroy(scene);
    cipc_scene_destroy(again);
}

static void test_rejections_of_flat(void **state)
{
    (void)state;
    reject_around("", "@\"rest\": \"flat\",", CIPC_E_OUT_OF_RANGE, "bodies.cloth.rest", "only gores, pleats and ribbons have one");
    reject_around("", "@\"rest\": \"flet\",", CIPC_E_OUT_OF_RANGE, "bodies.cloth.rest", "flat");
    reject_scene(GARMENT("@\"rest\": \"flat\"", "{\"scale\": [1, 1, 2]}"), NULL, CIPC_E_OUT_OF_RANGE, "bodies.a.rest", "one scale for all");
}

static void test_rejections(void **state)
{
    (void)state;
    reject_around("", "\"rest\": {@\"mesh\": \"none.obj\"},", CIPC_E_MISSING_FILE, "bodies.cloth.rest.mesh", "none.obj' cannot be opened");
    reject_around("", "\"rest\": {@\"mesh\": 1},", CIPC_E_WRONG_TYPE, "bodies.cloth.rest.mesh", "a string");
    reject_around("", "\"rest\": {@\"mash\": \"a.obj\"},", CIPC_E_UNKNOWN_KEY, "bodies.cloth.rest.mash", "'mesh'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_rest_shape_is_the_other_mesh),
        cmocka_unit_test(test_other_meshes_are_refused),
        cmocka_unit_test(test_flat_is_the_pattern),
        cmocka_unit_test(test_rejections_of_flat),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
