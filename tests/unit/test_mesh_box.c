/* Boxes of tetrahedra. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double sum_tolerance = 1e-13; /* sums of some hundred terms of one sign */

static cipc_mesh box(double x, double y, double z, int i, int j, int k)
{
    cipc_mesh mesh;
    const double size[3] = {x, y, z};
    const int cells[3] = {i, j, k};
    assert_int_equal(cipc_mesh_box(&mesh, size, cells, NULL), CIPC_OK);
    return mesh;
}

static void check_box(double x, double y, double z, int i, int j, int k)
{
    cipc_mesh mesh = box(x, y, z, i, j, k);
    assert_int_equal(mesh.node_count, (i + 1) * (j + 1) * (k + 1));
    assert_int_equal(mesh.tetrahedron_count, 6 * i * j * k);
    assert_int_equal(mesh.triangle_count + mesh.segment_count, 0);
    volume_properties p = measure_volume(&mesh);
    double one = x * y * z / (6 * i * j * k);
    assert_true(fabs(p.smallest / one - 1) < sum_tolerance && fabs(p.largest / one - 1) < sum_tolerance);
    assert_true(fabs(p.volume / (x * y * z) - 1) < sum_tolerance);
    assert_int_equal(p.nodes_unused, 0);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    /* The cells conform: no face but those of the box belongs to one tetrahedron only. */
    assert_true(fabs(p.surface.area / (2 * (x * y + y * z + z * x)) - 1) < sum_tolerance);
    assert_true(fabs(p.surface.volume / (x * y * z) - 1) < sum_tolerance); /* outward */
    assert_int_equal(p.surface.euler, 2);
    assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
    assert_int_equal(p.surface.unused_nodes, (i - 1) * (j - 1) * (k - 1));
    cipc_mesh_free(&mesh);
}

static void test_boxes(void **state)
{
    (void)state;
    check_box(1, 1, 1, 1, 1, 1);
    check_box(1, 2, 3, 2, 3, 4);
    check_box(0.3, 0.1, 0.7, 5, 1, 3);
    check_box(2, 2, 2, 6, 6, 6);
}

static void test_nodes_lie_in_order(void **state)
{
    (void)state;
    cipc_mesh mesh = box(2, 4, 6, 1, 2, 3);
    const double first[3] = {-1, -2, -3}, second[3] = {1, -2, -3}, third[3] = {-1, -2, -1}, above[3] = {-1, 0, -3};
    assert_memory_equal(mesh.nodes, first, sizeof first);
    assert_memory_equal(mesh.nodes + 3, second, sizeof second);
    assert_memory_equal(mesh.nodes + 6, third, sizeof third);
    assert_memory_equal(mesh.nodes + 24, above, sizeof above);
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    const double size[3] = {1, 1, 1}, bad[4][3] = {{0, 1, 1}, {1, -1, 1}, {1, 1, (double)NAN}, {1, (double)INFINITY, 1}};
    const int cells[3] = {2, 2, 2}, none[3] = {2, 0, 2}, huge[3] = {2147483647, 2147483647, 2147483647}, many[3] = {300, 300, 300};
    for (int i = 0; i < 4; i++) assert_int_equal(cipc_mesh_box(&mesh, bad[i], cells, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_box(&mesh, size, none, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_box(&mesh, size, huge, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_box(&mesh, size, many, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_box(&mesh, size, cells, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
        assert_null(mesh.tetrahedra);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_nodes_lie_in_order),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
