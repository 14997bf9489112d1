/* Spheres by splitting an icosahedron. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double pi = 3.14159265358979323846;
/* Normalising a node: a square root, a division, a multiplication, each within half an ulp. */
static const double radius_tolerance = 4e-16;

static void check_sphere(int subdivisions, double radius)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_icosphere(&mesh, radius, subdivisions, NULL), CIPC_OK);
    int faces = 20 << (2 * subdivisions);
    assert_int_equal(mesh.triangle_count, faces);
    assert_int_equal(mesh.node_count, faces / 2 + 2);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(p.euler, 2);
    assert_int_equal(p.bad_edges, 0);
    assert_int_equal(p.boundary_edges, 0);
    assert_int_equal(p.unused_nodes, 0);
    for (int i = 0; i < mesh.node_count; i++) assert_true(fabs(v3_norm(mesh.nodes + 3 * i) / radius - 1) < radius_tolerance);
    assert_true(p.volume > 0); /* normals outward */
    assert_true(p.volume < 4 * pi / 3 * pow(radius, 3) && p.area < 4 * pi * radius * radius);
    assert_true(p.smallest_angle > 0.8); /* 46 degrees: near-equilateral; 0.92 at the most distorted corner */
    cipc_mesh_free(&mesh);
}

static void test_spheres(void **state)
{
    (void)state;
    for (int s = 0; s <= 4; s++) check_sphere(s, 0.15);
    check_sphere(2, 1000);
}

/* The volume of an icosahedron of edge a is 5 (3 + sqrt 5) a^3 / 12; its circumradius a sin(2 pi / 5). */
static void test_icosahedron_has_its_volume(void **state)
{
    (void)state;
    static const double tolerance = 1e-14; /* 20 terms of some 1e-16 each */
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_icosphere(&mesh, 1, 0, NULL), CIPC_OK);
    double edge = 1 / sin(2 * pi / 5), want = 5 * (3 + sqrt(5.0)) / 12 * pow(edge, 3);
    assert_true(fabs(measure_mesh(&mesh).volume / want - 1) < tolerance);
    cipc_mesh_free(&mesh);
}

/* Area and volume approach those of the sphere as the square of the edge: a quarter of the error per splitting. */
static void test_splitting_converges(void **state)
{
    (void)state;
    double error[5];
    for (int s = 0; s < 5; s++) {
        cipc_mesh mesh;
        assert_int_equal(cipc_mesh_icosphere(&mesh, 1, s, NULL), CIPC_OK);
        error[s] = 4 * pi / 3 - measure_mesh(&mesh).volume;
        cipc_mesh_free(&mesh);
    }
    for (int s = 2; s < 5; s++) assert_true(error[s - 1] / error[s] > 3.5 && error[s - 1] / error[s] < 4.5);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_icosphere(&mesh, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_icosphere(&mesh, (double)NAN, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_icosphere(&mesh, (double)INFINITY, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_icosphere(&mesh, 1, -1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_icosphere(&mesh, 1, 9, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_icosphere(&mesh, 1, 1, NULL);
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
        cmocka_unit_test(test_spheres),
        cmocka_unit_test(test_icosahedron_has_its_volume),
        cmocka_unit_test(test_splitting_converges),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
