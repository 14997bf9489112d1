/* Mesh files: by ending and by kind of element. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "support/mesh_files.h"

#define THREE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void test_the_ending_decides(void **state)
{
    (void)state;
    cipc_mesh mesh = accept_mesh("m.OBJ", THREE "f 1 2 3\n", CIPC_MESH_TRIANGLES);
    assert_int_equal(mesh.triangle_count, 1);
    cipc_mesh_free(&mesh);
    static const char *const names[] = {"m.stl", "m", "m.obj.gz", "obj", "m."};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        reject_mesh(names[i], THREE "f 1 2 3\n", CIPC_MESH_TRIANGLES, CIPC_E_BAD_MESH, "not the name of a mesh file");
    }
    cipc_error error;
    assert_int_equal(cipc_mesh_read(&mesh, "m.stl", CIPC_MESH_TRIANGLES, &error), CIPC_E_BAD_MESH);
    assert_string_equal(error.remedy, "save it as .obj, .seg, .msh (Gmsh, ASCII) or .vtk (legacy, ASCII)");
    assert_int_equal(cipc_mesh_read(&mesh, "m.stl", CIPC_MESH_TRIANGLES, NULL), CIPC_E_BAD_MESH);
}

static void test_a_file_that_is_not_there(void **state)
{
    (void)state;
    static const char *const paths[] = {"/nowhere/m.obj", "/nowhere/m.seg", "/nowhere/m.msh", "/nowhere/m.vtk"};
    for (int i = 0; i < 4; i++) {
        cipc_mesh mesh;
        cipc_error error;
        assert_int_equal(cipc_mesh_read(&mesh, paths[i], CIPC_MESH_TRIANGLES, &error), CIPC_E_MISSING_FILE);
        assert_string_equal(error.place, paths[i]);
        assert_int_equal(cipc_mesh_read(&mesh, paths[i], CIPC_MESH_TRIANGLES, NULL), CIPC_E_MISSING_FILE);
    }
}

/* Nodes 2, 4 and 6 of seven are not part of the triangle; the others keep their order. */
#define SEVEN "v 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 1 0\nv 6 0 0\nv 7 0 0\n"

static void test_unused_nodes_are_left_out(void **state)
{
    (void)state;
    cipc_mesh mesh = accept_mesh("m.obj", SEVEN "f 5 1 3\nl 7 6\n", CIPC_MESH_TRIANGLES);
    assert_int_equal(mesh.node_count, 3);
    assert_true(mesh.nodes[0] == 1 && mesh.nodes[3] == 3 && mesh.nodes[6] == 5 && mesh.nodes[7] == 1);
    const int triangle[3] = {2, 0, 1};
    assert_memory_equal(mesh.triangles[0], triangle, sizeof triangle);
    assert_int_equal(mesh.segment_count, 0);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.obj", SEVEN "f 5 1 3\nl 7 6\n", CIPC_MESH_SEGMENTS);
    assert_int_equal(mesh.node_count, 2);
    assert_true(mesh.nodes[0] == 6 && mesh.nodes[3] == 7);
    assert_true(mesh.segments[0][0] == 1 && mesh.segments[0][1] == 0);
    assert_int_equal(mesh.triangle_count, 0);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.obj", SEVEN "f 5 1 3\nl 7 6\n", CIPC_MESH_NODES);
    assert_int_equal(mesh.node_count, 7);
    assert_int_equal(mesh.triangle_count + mesh.segment_count + mesh.tetrahedron_count, 0);
    cipc_mesh_free(&mesh);
}

static void test_the_wanted_kind_must_be_there(void **state)
{
    (void)state;
    reject_mesh("m.obj", THREE, CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "an empty mesh: 3 vertices and 0 segments");
    reject_mesh("m.obj", THREE "f 1 2 3\n", CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "an empty mesh: 3 vertices and 0 segments, but 1 triangles");
    reject_mesh("m.obj", THREE "f 1 2 3\nl 1 2 3\n", CIPC_MESH_TETRAHEDRA, CIPC_E_BAD_MESH, "0 tetrahedra, but 1 triangles, 2 segments");
    reject_mesh("m.obj", "# nothing\n", CIPC_MESH_NODES, CIPC_E_BAD_MESH, "an empty mesh: no vertices");
}

static void test_segments(void **state)
{
    (void)state;
    cipc_mesh mesh = accept_mesh("m.seg", "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\ns 1 2\ns 3 4\nl -1 -2 -3\n", CIPC_MESH_SEGMENTS);
    const int want[4][2] = {{0, 1}, {2, 3}, {3, 2}, {2, 1}};
    assert_int_equal(mesh.segment_count, 4);
    assert_memory_equal(mesh.segments, want, sizeof want);
    cipc_mesh_free(&mesh);
    mesh = accept_mesh("m.obj", THREE "s off\ns 1\nl 1/1 2/2\np 1\n", CIPC_MESH_SEGMENTS); /* smoothing groups */
    assert_int_equal(mesh.segment_count, 1);
    cipc_mesh_free(&mesh);
    reject_mesh("m.seg", "v 0 0 0\nv 0 1 0\n@s 1\n", CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "a line of 1 vertices; 2 are needed");
    reject_mesh("m.seg", "v 0 0 0\nv 0 1 0\n@s 1 off\n", CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "'off' is not a vertex index");
    reject_mesh("m.seg", "v 0 0 0\nv 0 1 0\ns 1 2\n@s 2 3\n", CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "vertex index 3, but the file has 2 vertices, counted from 1");
    reject_mesh("m.seg", "v 0 0 0\nv 0 1 0\n@s 2 2\n", CIPC_MESH_SEGMENTS, CIPC_E_BAD_MESH, "a segment that names a vertex twice");
}

static void test_binary_files(void **state)
{
    (void)state;
    static const char *const names[] = {"m.obj", "m.seg", "m.msh", "m.vtk"};
    static const char *const want[] = {"zero byte", "zero byte", "binary Gmsh is not read: save as ASCII", "binary VTK is not read: save as ASCII"};
    for (int i = 0; i < 4; i++) {
        cipc_mesh mesh;
        cipc_error error;
        assert_int_equal(try_mesh(names[i], "\1\0\2\0", 4, CIPC_MESH_TRIANGLES, &mesh, &error, NULL), CIPC_E_BAD_MESH);
        assert_non_null(strstr(error.what, want[i]));
        assert_null(mesh.nodes);
    }
}

static void test_maimed_files(void **state)
{
    (void)state;
    static const char good[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1/1 2/2 3/3\nf -1 -2 -3\nl 1 2 3\n";
    maim_mesh_file("m.obj", good, CIPC_MESH_TRIANGLES, (size_t)(strstr(good, "3/3") - good));
    maim_mesh_file("m.seg", good, CIPC_MESH_SEGMENTS, (size_t)(strstr(good, "l 1 2") - good) + 4);
}

static void test_no_memory(void **state)
{
    (void)state;
    starve_mesh_file("m.obj", THREE "f 1 2 3", CIPC_MESH_TRIANGLES);
    starve_mesh_file("m.seg", THREE "l 1 2 3", CIPC_MESH_SEGMENTS);
    starve_mesh_file("m.obj", THREE, CIPC_MESH_NODES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_ending_decides),
        cmocka_unit_test(test_a_file_that_is_not_there),
        cmocka_unit_test(test_unused_nodes_are_left_out),
        cmocka_unit_test(test_the_wanted_kind_must_be_there),
        cmocka_unit_test(test_segments),
        cmocka_unit_test(test_binary_files),
        cmocka_unit_test(test_maimed_files),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
