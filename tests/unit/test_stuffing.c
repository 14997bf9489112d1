/* Tetrahedra that fill solids. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "base/vector.h"
#include "scene/stuffing.h"
#include "support/mesh_properties.h"

static const double pi = 3.14159265358979323846, degree = 3.14159265358979323846 / 180;
static const double least_dihedral = 10.7; /* degrees: Labelle and Shewchuk's bound */

static double in_ball(const void *radius, const double x[3])
{
    return *(const double *)radius - v3_norm(x);
}

/* About z, of the middle radius 0.4. */
static double in_ring(const void *radius, const double x[3])
{
    return *(const double *)radius - hypot(hypot(x[0], x[1]) - 0.4, x[2]);
}

/* The mesh is one of the quality that the algorithm promises; its surface is closed, has the Euler number and encloses the whole volume. */
static volume_properties check(const cipc_mesh *mesh, int euler)
{
    volume_properties p = measure_volume(mesh);
    assert_true(p.smallest > 0);
    assert_true(p.smallest_dihedral > least_dihedral * degree);
    assert_int_equal(p.nodes_unused, 0);
    assert_int_equal(count_duplicate_nodes(mesh), 0);
    assert_int_equal(p.surface.bad_edges + p.surface.boundary_edges, 0);
    assert_int_equal(p.surface.euler, euler);
    assert_true(fabs(p.surface.volume / p.volume - 1) < mesh->tetrahedron_count * DBL_EPSILON); /* no gap and no overlap within, to the rounding of the sum */
    return p;
}

static void test_balls(void **state)
{
    (void)state;
    const double radius = 0.3, low[3] = {-radius, -radius, -radius}, high[3] = {radius, radius, radius};
    double missing[3];
    for (int k = 0; k < 3; k++) {
        cipc_mesh mesh;
        assert_int_equal(scene_stuff(&mesh, in_ball, &radius, low, high, 0.06 / (1 << k), "test", NULL), CIPC_OK);
        volume_properties p = check(&mesh, 2);
        missing[k] = 4 * pi / 3 * radius * radius * radius - p.volume;
        cipc_mesh_free(&mesh);
    }
    /* Nodes on the surface, triangles below it: short by the square of the cell. */
    for (int k = 0; k < 2; k++) assert_true(missing[k] / missing[k + 1] > 3.2 && missing[k] / missing[k + 1] < 4.8);
}

static void test_a_ring(void **state)
{
    (void)state;
    const double radius = 0.12, low[3] = {-0.52, -0.52, -0.12}, high[3] = {0.52, 0.52, 0.12};
    cipc_mesh mesh;
    assert_int_equal(scene_stuff(&mesh, in_ring, &radius, low, high, 0.03, "test", NULL), CIPC_OK);
    volume_properties p = check(&mesh, 0);
    assert_true(fabs(p.volume / (2 * pi * 0.4 * pi * radius * radius) - 1) < 0.03);
    cipc_mesh_free(&mesh);
}

/* Wherever the ball lies in the lattice: every way in which tetrahedra are cut. */
static void test_every_place(void **state)
{
    (void)state;
    const double radius = 0.3;
    for (int i = 0; i < 40; i++) {
        const double shift[3] = {0.01 * i, 0.0137 * i, 0.0171 * i};
        double low[3], high[3];
        for (int a = 0; a < 3; a++) {
            low[a] = -radius - fmod(shift[a], 0.1);
            high[a] = radius;
        }
        cipc_mesh mesh;
        assert_int_equal(scene_stuff(&mesh, in_ball, &radius, low, high, 0.05 + 0.001 * i, "test", NULL), CIPC_OK);
        check(&mesh, 2);
        cipc_mesh_free(&mesh);
    }
}

static void test_nothing_inside(void **state)
{
    (void)state;
    const double radius = 0.01, low[3] = {0.3, 0.3, 0.3}, high[3] = {1.1, 1.1, 1.1};
    cipc_mesh mesh;
    assert_int_equal(scene_stuff(&mesh, in_ball, &radius, low, high, 0.25, "test", NULL), CIPC_E_OUT_OF_RANGE);
    assert_null(mesh.nodes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_balls),
        cmocka_unit_test(test_a_ring),
        cmocka_unit_test(test_every_place),
        cmocka_unit_test(test_nothing_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
