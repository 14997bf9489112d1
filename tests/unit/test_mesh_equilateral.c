/* Sheets of equilateral triangles. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static double edge_of(const cipc_mesh *mesh, int triangle, int k)
{
    const double *a = mesh->nodes + 3 * mesh->triangles[triangle][k], *b = mesh->nodes + 3 * mesh->triangles[triangle][(k + 1) % 3];
    return sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) + (b[2] - a[2]) * (b[2] - a[2]));
}

/* An odd and an even number of rows: all edges alike, counts as of a grid, facing up, around the origin. */
static void test_sheets(void **state)
{
    (void)state;
    for (int rows = 4; rows <= 5; rows++) {
        cipc_mesh mesh;
        assert_int_equal(cipc_mesh_equilateral(&mesh, 0.1, 7, rows, NULL), CIPC_OK);
        assert_int_equal(mesh.node_count, 8 * (rows + 1));
        assert_int_equal(mesh.triangle_count, 14 * rows);
        for (int i = 0; i < mesh.triangle_count; i++)
            for (int k = 0; k < 3; k++) assert_true(fabs(edge_of(&mesh, i, k) / 0.1 - 1) < 16 * DBL_EPSILON);
        const mesh_properties p = measure_mesh(&mesh);
        assert_int_equal(p.euler, 1);
        assert_int_equal(p.bad_edges + p.unused_nodes + count_duplicate_nodes(&mesh), 0);
        assert_int_equal(p.boundary_edges, 2 * 7 + 2 * rows);
        assert_true(fabs(p.area / (14 * rows * sqrt(3.0) / 4 * 0.01) - 1) < 1e-14);
        assert_true(p.smallest_up > 1 - 1e-14);
        cipc_mesh_free(&mesh);
    }
}

/* Inside, every node has six neighbours: it belongs to six triangles. */
static void test_six_triangles_meet_inside(void **state)
{
    (void)state;
    cipc_mesh mesh;
    int uses[6 * 6] = {0};
    assert_int_equal(cipc_mesh_equilateral(&mesh, 1, 5, 5, NULL), CIPC_OK);
    for (int i = 0; i < 3 * mesh.triangle_count; i++) uses[mesh.triangles[i / 3][i % 3]]++;
    for (int j = 1; j < 5; j++)
        for (int i = 1; i < 5; i++) assert_int_equal(uses[6 * j + i], 6);
    cipc_mesh_free(&mesh);
}

/* The documented places of the corners; x runs fastest. */
static void test_places(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_equilateral(&mesh, 2, 3, 1, NULL), CIPC_OK);
    const double want[4][3] = {{-3.5, 0, -0.5 * sqrt(3.0)}, {2.5, 0, -0.5 * sqrt(3.0)}, {-2.5, 0, 0.5 * sqrt(3.0)}, {3.5, 0, 0.5 * sqrt(3.0)}};
    static const int corner[4] = {0, 3, 4, 7};
    for (int i = 0; i < 12; i++) assert_true(fabs(mesh.nodes[3 * corner[i / 3] + i % 3] - want[i / 3][i % 3]) < 4 * DBL_EPSILON);
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_equilateral(&mesh, 0, 2, 2, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "equilateral");
    assert_int_equal(cipc_mesh_equilateral(&mesh, (double)NAN, 2, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_equilateral(&mesh, (double)INFINITY, 2, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_equilateral(&mesh, 1, 0, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_equilateral(&mesh, 1, 2, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_equilateral(&mesh, 1, 2147483647, 2147483647, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_equilateral(&mesh, 1, 2, 2, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sheets),
        cmocka_unit_test(test_six_triangles_meet_inside),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
