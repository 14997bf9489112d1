/* Reading Wavefront OBJ, good and bad. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

static cipc_status read_bytes(const char *text, size_t length, cipc_mesh *mesh, cipc_error *error, char *place)
{
    char *folder = make_folder(), *path = write_file(folder, "m.obj", text, length);
    cipc_status status = cipc_mesh_read_obj(mesh, path, error);
    if (place != NULL) snprintf(place, 600, "%s", path);
    free(path);
    remove_folder(folder);
    return status;
}

static cipc_mesh accept(const char *text)
{
    cipc_mesh mesh;
    cipc_error error;
    if (read_bytes(text, strlen(text), &mesh, &error, NULL) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    return mesh;
}

/* line 0: the place is the file as a whole. */
static void reject(const char *text, int line, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    char path[600], place[640];
    assert_int_equal(read_bytes(text, strlen(text), &mesh, &error, path), CIPC_E_BAD_MESH);
    if (line > 0)
        snprintf(place, sizeof place, "%s:%d", path, line);
    else
        snprintf(place, sizeof place, "%s", path);
    assert_string_equal(error.place, place);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(strchr(error.what, '\n'));
    assert_null(mesh.nodes);
}

static void test_a_plain_file(void **state)
{
    (void)state;
    cipc_mesh mesh = accept("# comment\nv 0 0 0\nv 1 0 0\nv 0 1.5 -2e-3\nf 1 2 3\n");
    assert_int_equal(mesh.node_count, 3);
    assert_int_equal(mesh.triangle_count, 1);
    assert_true(mesh.nodes[7] == 1.5 && mesh.nodes[8] == -2e-3);
    assert_int_equal(mesh.triangles[0][2], 2);
    cipc_mesh_free(&mesh);
}

static void test_all_that_is_allowed(void **state)
{
    (void)state;
    cipc_mesh mesh = accept("mtllib a.mtl\r\no thing\r\n\r\n  v 0 0 0 1.0\r\n\tv\t1 0 0 0.5 0.5 0.5\r\nvt 0 0\r\nvn 0 0 1\r\nv 1 1 0\r\nv "
                            "0 1 0\r\ng\r\ns off\r\n"
                            "usemtl x\r\nf 1/1 2/1 3/1\r\nf -4//1 -2//1 -1//1\r\nf 1/1/1 2/1/1 3/1/1 4/1/1");
    assert_int_equal(mesh.node_count, 4);
    assert_int_equal(mesh.triangle_count, 4);
    const int want[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}};
    assert_memory_equal(mesh.triangles, want, sizeof want);
    cipc_mesh_free(&mesh);
}

static void test_faces_may_come_before_their_vertices(void **state)
{
    (void)state;
    cipc_mesh mesh = accept("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    assert_int_equal(mesh.triangles[0][1], 1);
    cipc_mesh_free(&mesh);
}

static void test_polygons_are_fanned(void **state)
{
    (void)state;
    cipc_mesh mesh = accept("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n");
    const int want[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    assert_int_equal(mesh.triangle_count, 3);
    assert_memory_equal(mesh.triangles, want, sizeof want);
    cipc_mesh_free(&mesh);
}

/* Unlike cipc_mesh_read, this keeps every vertex under the number that the file gives it. */
static void test_all_vertices_are_kept(void **state)
{
    (void)state;
    cipc_mesh mesh = accept("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\nl 1 2\n");
    assert_int_equal(mesh.node_count, 4);
    assert_int_equal(mesh.triangles[0][0], 1);
    assert_int_equal(mesh.segment_count, 0);
    cipc_mesh_free(&mesh);
}

#define THREE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void test_bad_vertices(void **state)
{
    (void)state;
    reject("v 0 0 0\nv 1 nan 0\n", 2, "coordinate 2 is not a finite number");
    reject("v inf 0 0\n", 1, "not a finite number");
    reject("v 1e999 0 0\n", 1, "not a finite number");
    reject("v 0 0\n", 1, "a vertex of 2 coordinates");
    reject("v 0 0x 0\n", 1, "'0x' is not a number");
    reject("v 0 zero 0\n", 1, "'zero' is not a number");
    reject("v 0 0 0 red\n", 1, "'red' is not a number");
}

static void test_bad_faces(void **state)
{
    (void)state;
    reject(THREE "f 1 2 4\n", 4, "vertex index 4, but the file has 3");
    reject(THREE "f 0 1 2\n", 4, "vertex index 0");
    reject(THREE "f -4 -1 -2\n", 4, "vertex index -4");
    reject(THREE "f 1 2 99999999999999999999\n", 4, "vertex index");
    reject(THREE "f 1 2 2147483649\n", 4, "vertex index");
    reject(THREE "l 1\nf 1 2 3\n", 4, "a line of 1 vertices");
    reject(THREE "f 1 2\n", 4, "a face of 2 vertices");
    reject(THREE "f 1 2 three\n", 4, "'three' is not a vertex index");
    reject(THREE "f 1 2 3.5\n", 4, "'3.5' is not a vertex index");
    reject(THREE "f 1 2 2\n", 4, "names a vertex twice");
    reject(THREE "f 1 2 3\nf 1 3 1\n", 5, "names a vertex twice");
}

static void test_bad_files(void **state)
{
    (void)state;
    reject("", 0, "an empty mesh: 0 vertices and 0 triangles");
    reject(THREE, 0, "an empty mesh: 3 vertices and 0 triangles");
    reject("f 1 2 3\n", 0, "an empty mesh: 0 vertices");
    reject(THREE "curv 1 2\n", 4, "unknown statement 'curv'");
    reject("\x7f"
           "ELF\n",
           1, "unknown statement");
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(read_bytes("v 0 0 0\0v 1 1 1\n", 16, &mesh, &error, NULL), CIPC_E_BAD_MESH);
    assert_non_null(strstr(error.what, "zero byte"));
    assert_int_equal(cipc_mesh_read_obj(&mesh, "/nowhere/at/all.obj", &error), CIPC_E_MISSING_FILE);
    assert_int_equal(cipc_mesh_read_obj(&mesh, "/nowhere/at/all.obj", NULL), CIPC_E_MISSING_FILE);
    assert_int_equal(cipc_mesh_read_obj(&mesh, "/", &error), CIPC_E_MISSING_FILE);
}

static void test_no_memory(void **state)
{
    (void)state;
    char *folder = make_folder(), *path = write_file(folder, "m.obj", THREE "f 1 2 3", strlen(THREE "f 1 2 3"));
    cipc_mesh mesh;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_read_obj(&mesh, path, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
    free(path);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_plain_file),
        cmocka_unit_test(test_all_that_is_allowed),
        cmocka_unit_test(test_faces_may_come_before_their_vertices),
        cmocka_unit_test(test_polygons_are_fanned),
        cmocka_unit_test(test_all_vertices_are_kept),
        cmocka_unit_test(test_bad_vertices),
        cmocka_unit_test(test_bad_faces),
        cmocka_unit_test(test_bad_files),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
