/* Open cylinders. */
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

static cipc_mesh cylinder(double radius, double length, int around, int along)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_cylinder(&mesh, radius, length, around, along, NULL), CIPC_OK);
    return mesh;
}

/* A triangle between two rings has the base 2 r sin(pi/n) and reaches over the sagitta r (1 - cos(pi/n)) too. */
static void check_cylinder(double radius, double length, int around, int along)
{
    cipc_mesh mesh = cylinder(radius, length, around, along);
    assert_int_equal(mesh.node_count, around * (along + 1));
    assert_int_equal(mesh.triangle_count, 2 * around * along);
    mesh_properties p = measure_mesh(&mesh);
    double half = pi / around, area = 2 * around * along * radius * sin(half) * hypot(length / along, radius * (1 - cos(half)));
    assert_true(fabs(p.area / area - 1) < 1e-12);
    assert_int_equal(p.euler, 0);
    assert_int_equal(p.bad_edges + p.unused_nodes, 0);
    assert_int_equal(p.boundary_edges, 2 * around);
    assert_true(p.volume > 0); /* of cones from the origin: outward */
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    for (int i = 0; i < mesh.node_count; i++) {
        assert_true(fabs(hypot(mesh.nodes[3 * i + 1], mesh.nodes[3 * i + 2]) / radius - 1) < 4e-16);
    }
    assert_true(mesh.nodes[0] == -0.5 * length && mesh.nodes[3 * (mesh.node_count - 1)] == 0.5 * length);
    cipc_mesh_free(&mesh);
}

static void test_cylinders(void **state)
{
    (void)state;
    check_cylinder(0.25, 1, 20, 10);
    check_cylinder(1, 0.1, 3, 1);
    check_cylinder(0.25, 1, 96, 75);
}

/* along = length / (sqrt(3)/2 times the step around): angles near 60 degrees. */
static void test_it_can_be_nearly_equilateral(void **state)
{
    (void)state;
    int around = 64, along = (int)round(1 / (sqrt(3) / 2 * 2 * pi * 0.25 / around));
    cipc_mesh mesh = cylinder(0.25, 1, around, along);
    assert_true(measure_mesh(&mesh).smallest_angle > 59 * pi / 180);
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_cylinder(&mesh, 0, 1, 8, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, 1, (double)NAN, 8, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, (double)INFINITY, 1, 8, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, 1, 1, 2, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, 1, 1, 8, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, 1, 1, 8, 2147483647, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&mesh, 1, 1, 2147483647, 100, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_cylinder(&mesh, 1, 1, 8, 2, NULL);
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
        cmocka_unit_test(test_it_can_be_nearly_equilateral),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
