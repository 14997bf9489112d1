/* Rods along circles. */
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

static cipc_mesh arc(double radius, double angle, int segments)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_arc(&mesh, radius, angle, segments, NULL), CIPC_OK);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    assert_int_equal(mesh.segment_count, segments);
    for (int i = 0; i < mesh.node_count; i++) {
        assert_true(fabs(hypot(mesh.nodes[3 * i], mesh.nodes[3 * i + 1]) / radius - 1) < 4e-16);
        assert_true(mesh.nodes[3 * i + 2] == 0);
    }
    assert_true(fabs(total_length(&mesh) / (2 * radius * segments * sin(0.5 * angle / segments)) - 1) < 1e-14);
    return mesh;
}

static void test_a_quarter(void **state)
{
    (void)state;
    cipc_mesh mesh = arc(2, pi / 2, 10);
    assert_int_equal(mesh.node_count, 11);
    assert_true(mesh.nodes[0] == 2 && mesh.nodes[1] == 0);
    assert_true(fabs(mesh.nodes[30]) < 1e-15 && fabs(mesh.nodes[31] - 2) < 1e-15); /* anticlockwise */
    assert_true(mesh.segments[9][0] == 9 && mesh.segments[9][1] == 10);
    cipc_mesh_free(&mesh);
}

static void test_rings_are_closed(void **state)
{
    (void)state;
    const double angles[3] = {2 * pi, 6.2831853072, 6.2831853071}; /* the last two are 2 pi in ten digits, rounded up and down */
    for (int i = 0; i < 3; i++) {
        cipc_mesh mesh;
        assert_int_equal(cipc_mesh_arc(&mesh, 0.5, angles[i], 12, NULL), CIPC_OK);
        assert_int_equal(mesh.node_count, 12);
        assert_true(mesh.segments[11][0] == 11 && mesh.segments[11][1] == 0);
        cipc_mesh_free(&mesh);
    }
    cipc_mesh ring = arc(0.5, 2 * pi, 12), nearly = arc(0.5, 6.28, 12);
    assert_int_equal(nearly.node_count, 13);
    cipc_mesh_free(&ring);
    cipc_mesh_free(&nearly);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_arc(&mesh, 0, 1, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, (double)INFINITY, 1, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, 0, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, -1, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, 6.3, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, (double)NAN, 4, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, 1, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, 2 * pi, 2, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&mesh, 1, 1, 2147483647, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_arc(&mesh, 1, 1, 3, NULL);
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
        cmocka_unit_test(test_a_quarter),
        cmocka_unit_test(test_rings_are_closed),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
