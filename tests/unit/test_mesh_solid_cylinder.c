/* Cylinders of tetrahedra. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double pi = 3.14159265358979323846;
static const double degree = 3.14159265358979323846 / 180;
static const double sum_tolerance = 1e-12; /* sums of some thousand terms */

/* Across, a regular polygon of 4 * cells sides inscribed in the circle. */
static void check_cylinder(double radius, double length, int across, int along)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, radius, length, across, along, NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, (across + 1) * (across + 1) * (along + 1));
    assert_int_equal(mesh.tetrahedron_count, 6 * across * across * along);
    volume_properties p = measure_volume(&mesh);
    double half = pi / (4 * across), base = 4 * across * radius * radius * sin(half) * cos(half), side = 8 * across * radius * sin(half) * length;
    assert_true(fabs(p.volume / (base * length) - 1) < sum_tolerance);
    assert_true(fabs(p.surface.area / (2 * base + side) - 1) < sum_tolerance);
    assert_true(fabs(p.surface.volume / p.volume - 1) < sum_tolerance);
    assert_true(p.smallest > 0.7 * p.volume / mesh.tetrahedron_count);
    assert_int_equal(p.surface.euler, 2);
    assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
    assert_int_equal(p.nodes_unused, 0);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    int on_side = 0;
    for (int i = 0; i < mesh.node_count; i++) on_side += fabs(hypot(mesh.nodes[3 * i], mesh.nodes[3 * i + 2]) / radius - 1) < 1e-15;
    assert_int_equal(on_side, 4 * across * (along + 1));
    const double *last = mesh.nodes + 3 * (mesh.node_count - 1);
    assert_true(mesh.nodes[1] == -0.5 * length && last[1] == 0.5 * length);
    cipc_mesh_free(&mesh);
}

static void test_cylinders(void **state)
{
    (void)state;
    check_cylinder(1, 1, 2, 1);
    check_cylinder(0.2, 1, 4, 10);
    check_cylinder(3, 0.1, 8, 1);
    check_cylinder(0.5, 1, 16, 16);
}

static void test_cells_as_high_as_wide_are_not_flat(void **state)
{
    (void)state;
    for (int across = 2; across <= 32; across *= 2) {
        cipc_mesh mesh;
        assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, 2, across, across, NULL), CIPC_OK);
        assert_true(measure_volume(&mesh).smallest_dihedral > 29 * degree);
        cipc_mesh_free(&mesh);
    }
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 0, 1, 4, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, -1, 4, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, (double)NAN, 1, 4, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, (double)INFINITY, 4, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, 1, 3, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, 1, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&mesh, 1, 1, 4, 0, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_solid_cylinder(&mesh, 1, 1, 2, 1, NULL);
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
        cmocka_unit_test(test_cylinders),
        cmocka_unit_test(test_cells_as_high_as_wide_are_not_flat),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
