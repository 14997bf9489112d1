/* Regular sheets. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/mesh_properties.h"

/* Areas are sums of a few hundred terms of the same sign, each with a relative error of a few 2^-53. */
static const double sum_tolerance = 1e-13;

static void check_sheet(double size_x, double size_z, int cells_x, int cells_z, bool alternate)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_grid(&mesh, size_x, size_z, cells_x, cells_z, alternate, NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, (cells_x + 1) * (cells_z + 1));
    assert_int_equal(mesh.triangle_count, 2 * cells_x * cells_z);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(p.euler, 1);
    assert_int_equal(p.bad_edges, 0);
    assert_int_equal(p.unused_nodes, 0);
    assert_int_equal(p.boundary_edges, 2 * (cells_x + cells_z));
    assert_true(p.smallest_up == 1);
    assert_true(fabs(p.area / (size_x * size_z) - 1) < sum_tolerance);
    const double *last = mesh.nodes + 3 * (mesh.node_count - 1);
    assert_true(mesh.nodes[0] == -0.5 * size_x && mesh.nodes[1] == 0 && mesh.nodes[2] == -0.5 * size_z);
    assert_true(last[0] == 0.5 * size_x && last[1] == 0 && last[2] == 0.5 * size_z);
    cipc_mesh_free(&mesh);
}

static void test_sheets(void **state)
{
    (void)state;
    check_sheet(1, 1, 1, 1, false);
    check_sheet(1, 2, 3, 5, false);
    check_sheet(0.3, 0.7, 6, 4, true);
    check_sheet(1, 1, 20, 20, false);
}

static int degree(const cipc_mesh *mesh, int node)
{
    int count = 0;
    for (int t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++) count += mesh->triangles[t][k] == node;
    }
    return count;
}

/* Union jack: every other node has all eight neighbours; one diagonal everywhere: six triangles at every inner node. */
static void test_alternate_diagonals(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, 4, 4, true, NULL), CIPC_OK);
    assert_int_equal(degree(&mesh, 1 * 5 + 1), 8);
    assert_int_equal(degree(&mesh, 1 * 5 + 2), 4);
    assert_int_equal(degree(&mesh, 2 * 5 + 2), 8);
    cipc_mesh_free(&mesh);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, 4, 4, false, NULL), CIPC_OK);
    assert_int_equal(degree(&mesh, 1 * 5 + 1), 6);
    assert_int_equal(degree(&mesh, 1 * 5 + 2), 6);
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_grid(&mesh, 0, 1, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, -1, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, (double)NAN, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, (double)INFINITY, 1, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, 0, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, 1, -3, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_grid(&mesh, 1, 1, 2147483647, 2147483647, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_null(mesh.nodes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sheets),
        cmocka_unit_test(test_alternate_diagonals),
        cmocka_unit_test(test_bad_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
