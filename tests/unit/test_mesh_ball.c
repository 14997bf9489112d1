/* Balls of tetrahedra. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double pi = 3.14159265358979323846;
static const double radius_tolerance = 1e-15;
static const double degree = 3.14159265358979323846 / 180;

static cipc_mesh ball(double radius, int cells)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_ball(&mesh, radius, cells, NULL), CIPC_OK);
    return mesh;
}

/* The outermost nodes are those of the surface of the lattice, all at the radius; the others lie half a cell or more below. */
static void check_radii(const cipc_mesh *mesh, double radius, int cells)
{
    int on_surface = 0;
    for (int i = 0; i < mesh->node_count; i++) {
        double r = v3_norm(mesh->nodes + 3 * i) / radius;
        if (fabs(r - 1) < radius_tolerance)
            on_surface++;
        else
            assert_true(r < 1 - 1.0 / cells);
    }
    assert_int_equal(on_surface, 6 * cells * cells + 2);
}

static void check_ball(double radius, int cells)
{
    cipc_mesh mesh = ball(radius, cells);
    assert_int_equal(mesh.node_count, (cells + 1) * (cells + 1) * (cells + 1));
    assert_int_equal(mesh.tetrahedron_count, 6 * cells * cells * cells);
    check_radii(&mesh, radius, cells);
    volume_properties p = measure_volume(&mesh);
    double mean = p.volume / mesh.tetrahedron_count;
    assert_true(p.smallest > 0.78 * mean && p.largest < 1.21 * mean);
    assert_true(p.smallest_dihedral > 29 * degree);
    assert_int_equal(p.nodes_unused, 0);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    assert_int_equal(p.surface.euler, 2);
    assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
    assert_int_equal(p.surface_triangles, 12 * cells * cells);
    assert_true(p.surface.smallest_angle > 35 * degree);
    assert_true(fabs(p.surface.volume / p.volume - 1) < 1e-12); /* outward */
    assert_true(p.volume < 4 * pi / 3 * pow(radius, 3));
    cipc_mesh_free(&mesh);
}

static void test_balls(void **state)
{
    (void)state;
    for (int cells = 2; cells <= 20; cells += 2) check_ball(0.3, cells);
    check_ball(1000, 6);
}

/* Volume and area approach those of the ball as the square of the cell: a quarter of the error for twice the cells. */
static void test_it_converges(void **state)
{
    (void)state;
    double volume[5], area[5];
    for (int s = 0; s < 5; s++) {
        cipc_mesh mesh = ball(1, 2 << s);
        volume_properties p = measure_volume(&mesh);
        volume[s] = 4 * pi / 3 - p.volume;
        area[s] = 4 * pi - p.surface.area;
        cipc_mesh_free(&mesh);
    }
    for (int s = 2; s < 5; s++) {
        assert_true(volume[s - 1] / volume[s] > 3.7 && volume[s - 1] / volume[s] < 4.3);
        assert_true(area[s - 1] / area[s] > 3.7 && area[s - 1] / area[s] < 4.3);
    }
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_ball(&mesh, 0, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, (double)NAN, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, (double)INFINITY, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, 1, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, 1, -2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, 1, 2147483646, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&mesh, 1, 5, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "ball");
    assert_non_null(strstr(error.what, "even"));
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_ball(&mesh, 1, 2, NULL);
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
        cmocka_unit_test(test_balls),
        cmocka_unit_test(test_it_converges),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
