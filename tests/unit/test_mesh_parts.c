/* From nodes and elements to a mesh. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "model/measures.h"
#include "scene/mesh_parts.h"
#include "support/failing_memory.h"

static cipc_error error;
static scene_scan scan = {.path = "f.txt", .at = "", .line = 9, .error = &error};

/* Corners of a cube, node 4 not used by the tetrahedra below. */
static scene_parts cube(cipc_mesh_kind kind)
{
    scene_parts parts = scene_parts_of(kind);
    for (int i = 0; i < 8; i++) {
        const double x[3] = {i & 1, i >> 1 & 1, i >> 2 & 1};
        assert_int_equal(scene_parts_add_node(&parts, &scan, x), CIPC_OK);
    }
    return parts;
}

static void add(scene_parts *parts, int line, cipc_mesh_kind kind, long long a, long long b, long long c, long long d)
{
    const long long corners[4] = {a, b, c, d};
    assert_int_equal(scene_parts_add(parts, &scan, line, kind, corners), CIPC_OK);
}

static void reject(scene_parts *parts, const char *place, const char *what)
{
    cipc_mesh mesh;
    assert_int_equal(scene_parts_finish(parts, &scan, false, &mesh), CIPC_E_BAD_MESH);
    assert_string_equal(error.place, place);
    assert_string_equal(error.what, what);
    assert_null(mesh.nodes);
    assert_null(mesh.tetrahedra);
    scene_parts_free(parts);
}

static void test_tetrahedra_are_turned_to_positive_volume(void **state)
{
    (void)state;
    scene_parts parts = cube(CIPC_MESH_TETRAHEDRA);
    add(&parts, 1, CIPC_MESH_TETRAHEDRA, 0, 1, 2, 7); /* positive */
    add(&parts, 2, CIPC_MESH_TETRAHEDRA, 0, 2, 1, 7); /* its mirror image */
    cipc_mesh mesh;
    assert_int_equal(scene_parts_finish(&parts, &scan, false, &mesh), CIPC_OK);
    scene_parts_free(&parts);
    assert_int_equal(mesh.node_count, 4);
    const int first[4] = {0, 1, 2, 3}, second[4] = {0, 2, 3, 1};
    assert_memory_equal(mesh.tetrahedra[0], first, sizeof first);
    assert_memory_equal(mesh.tetrahedra[1], second, sizeof second);
    for (int t = 0; t < 2; t++) {
        const int *v = mesh.tetrahedra[t];
        double volume = cipc_tetrahedron_volume(mesh.nodes + 3 * v[0], mesh.nodes + 3 * v[1], mesh.nodes + 3 * v[2], mesh.nodes + 3 * v[3]);
        assert_true(volume == 1.0 / 6);
    }
    cipc_mesh_free(&mesh);
}

static void test_flat_tetrahedra_are_refused(void **state)
{
    (void)state;
    scene_parts parts = cube(CIPC_MESH_TETRAHEDRA);
    parts.first = 1;
    add(&parts, 4, CIPC_MESH_TETRAHEDRA, 0, 1, 2, 7);
    add(&parts, 5, CIPC_MESH_TETRAHEDRA, 0, 1, 7, 6); /* a diagonal rectangle */
    reject(&parts, "f.txt:5", "a tetrahedron without volume: nodes 1, 2, 8 and 7 lie in a plane");
}

static void test_bad_elements(void **state)
{
    (void)state;
    scene_parts parts = cube(CIPC_MESH_TRIANGLES);
    add(&parts, 6, CIPC_MESH_TRIANGLES, 0, 1, 8, 0);
    reject(&parts, "f.txt:6", "node index 8, but the file has 8 nodes, counted from 0");
    parts = cube(CIPC_MESH_TRIANGLES);
    add(&parts, 7, CIPC_MESH_TRIANGLES, 0, -1, 2, 0);
    reject(&parts, "f.txt:7", "node index -1, but the file has 8 nodes, counted from 0");
    parts = cube(CIPC_MESH_SEGMENTS);
    add(&parts, 8, CIPC_MESH_SEGMENTS, 3, 3, 0, 0);
    reject(&parts, "f.txt:8", "a segment that names a node twice");
}

static void test_polygons_and_polylines(void **state)
{
    (void)state;
    const long long corners[5] = {4, 0, 1, 3, 2};
    scene_parts parts = cube(CIPC_MESH_TRIANGLES);
    assert_int_equal(scene_parts_add_polygon(&parts, &scan, 1, corners, 5), CIPC_OK);
    assert_int_equal(scene_parts_add_polyline(&parts, &scan, 1, corners, 5), CIPC_OK); /* counted only */
    assert_true(parts.element_count == 3 && parts.seen[CIPC_MESH_TRIANGLES] == 3 && parts.seen[CIPC_MESH_SEGMENTS] == 4);
    cipc_mesh mesh;
    assert_int_equal(scene_parts_finish(&parts, &scan, true, &mesh), CIPC_OK);
    const int want[3][3] = {{4, 0, 1}, {4, 1, 3}, {4, 3, 2}};
    assert_int_equal(mesh.node_count, 8); /* all kept */
    assert_memory_equal(mesh.triangles, want, sizeof want);
    cipc_mesh_free(&mesh);
    scene_parts_free(&parts);
    parts = cube(CIPC_MESH_SEGMENTS);
    assert_int_equal(scene_parts_add_polyline(&parts, &scan, 1, corners, 5), CIPC_OK);
    assert_int_equal(scene_parts_finish(&parts, &scan, false, &mesh), CIPC_OK);
    const int chain[4][2] = {{4, 0}, {0, 1}, {1, 3}, {3, 2}};
    assert_int_equal(mesh.node_count, 5);
    assert_memory_equal(mesh.segments, chain, sizeof chain);
    cipc_mesh_free(&mesh);
    scene_parts_free(&parts);
}

static void test_what_there_is_instead(void **state)
{
    (void)state;
    scene_parts parts = cube(CIPC_MESH_TETRAHEDRA);
    reject(&parts, "f.txt", "an empty mesh: 8 nodes and 0 tetrahedra");
    parts = cube(CIPC_MESH_TETRAHEDRA);
    add(&parts, 1, CIPC_MESH_TRIANGLES, 0, 1, 2, 0);
    add(&parts, 1, CIPC_MESH_NODES, 0, 0, 0, 0);
    scene_parts_skip(&parts, "type 5", 2);
    scene_parts_skip(&parts, "type 6", 1);
    reject(&parts, "f.txt", "an empty mesh: 8 nodes and 0 tetrahedra, but 1 triangles, 3 elements of types that are not read (first: type 5)");
    parts = scene_parts_of(CIPC_MESH_NODES);
    reject(&parts, "f.txt", "an empty mesh: no nodes");
}

static void test_no_memory(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        scene_parts parts = scene_parts_of(CIPC_MESH_SEGMENTS);
        const double x[3] = {0};
        const long long corners[2] = {0, 1};
        cipc_mesh mesh = {0};
        fail_allocation(n);
        cipc_status status = scene_parts_add_node(&parts, &scan, x);
        if (status == CIPC_OK) status = scene_parts_add_node(&parts, &scan, x);
        if (status == CIPC_OK) status = scene_parts_add(&parts, &scan, 1, CIPC_MESH_SEGMENTS, corners);
        if (status == CIPC_OK) status = scene_parts_finish(&parts, &scan, false, &mesh);
        bool failed = allocation_failed();
        fail_allocation(0);
        scene_parts_free(&parts);
        if (!failed) {
            assert_int_equal(n, 7); /* nodes, corners, lines; numbers, and the mesh's two arrays */
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tetrahedra_are_turned_to_positive_volume),
        cmocka_unit_test(test_flat_tetrahedra_are_refused),
        cmocka_unit_test(test_bad_elements),
        cmocka_unit_test(test_polygons_and_polylines),
        cmocka_unit_test(test_what_there_is_instead),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
