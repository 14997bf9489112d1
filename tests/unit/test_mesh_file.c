/* Mesh files beside the scene. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh_file.h"
#include "support/scene_trial.h"

static void test_paths_are_relative_to_the_scene(void **state)
{
    (void)state;
    char path[PATH_MAX], *overlong = malloc(PATH_MAX + 1);
    assert_true(scene_resolve_path("a/b/s.json", "m.obj", path));
    assert_string_equal(path, "a/b/m.obj");
    assert_true(scene_resolve_path("s.json", "../m.obj", path));
    assert_string_equal(path, "../m.obj");
    assert_true(scene_resolve_path("a/b/s.json", "/c/m.obj", path));
    assert_string_equal(path, "/c/m.obj");
    memset(overlong, 'x', PATH_MAX);
    overlong[PATH_MAX - 1] = '\0';
    assert_true(scene_resolve_path("s.json", overlong, path)); /* just fits */
    assert_false(scene_resolve_path("a/s.json", overlong, path));
    free(overlong);
}

/* The tree gets the absolute path; errors of the mesh keep their own file and line. */
static void test_files(void **state)
{
    (void)state;
    static const char good[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", bad[] = "v 0 0 0\nf 1 1 1\n";
    char *folder = make_folder(), *good_path = write_file(folder, "good.obj", good, strlen(good)),
         *bad_path = write_file(folder, "bad.obj", bad, strlen(bad));
    char scene_path[600], absolute[PATH_MAX], place[4200];
    snprintf(scene_path, sizeof scene_path, "%s/t.json", folder);
    scene_reader r = reader_of("{\"a\": {\"mesh\": \"good.obj\"}, \"b\": {\"mesh\": \"bad.obj\"}, \"c\": {\"mesh\": \"none.obj\"}, \"d\": {\"mesh\": 1}}");
    r.path = scene_path;
    scene_cursor root = scene_root(r.root), a = scene_member(&root, "a"), b = scene_member(&root, "b"), c = scene_member(&root, "c"),
                 d = scene_member(&root, "d");
    cipc_mesh mesh;
    scene_read_mesh_file(&r, &a, CIPC_MESH_TRIANGLES, &mesh);
    assert_int_equal(r.status, CIPC_OK);
    assert_true(mesh.node_count == 3 && mesh.triangle_count == 1);
    cipc_mesh_free(&mesh);
    assert_non_null(realpath(good_path, absolute));
    assert_string_equal(json_string_value(json_object_get(a.value, "mesh")), absolute);

    scene_read_mesh_file(&r, &b, CIPC_MESH_TRIANGLES, &mesh);
    snprintf(place, sizeof place, "%s:2", bad_path);
    assert_rejection(&r, CIPC_E_BAD_MESH, place, "names a vertex twice");
    scene_read_mesh_file(&r, &c, CIPC_MESH_TRIANGLES, &mesh);
    snprintf(place, sizeof place, "%s:1:61 c.mesh", scene_path);
    assert_rejection(&r, CIPC_E_MISSING_FILE, place, "none.obj' cannot be opened");
    scene_read_mesh_file(&r, &d, CIPC_MESH_TRIANGLES, &mesh);
    snprintf(place, sizeof place, "%s:1:88 d.mesh", scene_path);
    assert_rejection(&r, CIPC_E_WRONG_TYPE, place, "a string");
    assert_null(mesh.nodes);
    scene_reader_free(&r);
    free(good_path);
    free(bad_path);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paths_are_relative_to_the_scene),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
