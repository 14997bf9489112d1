/* Nets. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static cipc_mesh net(double size, int n, int segments, double lift)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_net(&mesh, size, n, segments, lift, NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, 2 * n * (segments + 1));
    assert_int_equal(mesh.segment_count, 2 * n * segments);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    return mesh;
}

/* Height of a rod's polyline where coordinate `axis` is `at`. */
static double height_at(const cipc_mesh *mesh, int rod, int segments, int axis, double at)
{
    for (int s = rod * segments; s < (rod + 1) * segments; s++) {
        const double *a = mesh->nodes + 3 * mesh->segments[s][0], *b = mesh->nodes + 3 * mesh->segments[s][1];
        if (a[axis] <= at && at <= b[axis]) return a[1] + (at - a[axis]) / (b[axis] - a[axis]) * (b[1] - a[1]);
    }
    fail_msg("rod %d does not reach %g", rod, at);
    return 0;
}

/* At every crossing one is a lift above and the other a lift below, and next crossings the other way round. */
static void check_weave(double size, int n, int segments, double lift)
{
    cipc_mesh mesh = net(size, n, segments, lift);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            double x = mesh.nodes[3 * (n + i) * (segments + 1)], z = mesh.nodes[3 * j * (segments + 1) + 2];
            double sign = (i + j) % 2 == 0 ? 1 : -1;
            assert_true(fabs(x - size * ((i + 0.5) / n - 0.5)) < 1e-15 * size && fabs(z - size * ((j + 0.5) / n - 0.5)) < 1e-15 * size);
            assert_true(fabs(height_at(&mesh, j, segments, 0, x) - sign * lift) < 1e-12 * lift);
            assert_true(fabs(height_at(&mesh, n + i, segments, 2, z) + sign * lift) < 1e-12 * lift);
        }
    }
    for (int i = 0; i < mesh.node_count; i++) assert_true(fabs(mesh.nodes[3 * i + 1]) <= lift);
    cipc_mesh_free(&mesh);
}

static void test_it_is_woven_wherever_the_nodes_lie(void **state)
{
    (void)state;
    for (int segments = 40; segments < 90; segments++) check_weave(1, 20, segments, 1e-3);
    check_weave(0.3, 1, 2, 0.01);
    check_weave(0.3, 3, 6, 0.01);
    check_weave(2, 5, 1000, 0.1);
}

static void test_extent_and_straight_ends(void **state)
{
    (void)state;
    cipc_mesh mesh = net(1, 20, 50, 1e-3);
    for (int rod = 0; rod < 40; rod++) {
        const double *a = mesh.nodes + 3 * 51 * rod, *b = a + 150;
        int along = rod < 20 ? 0 : 2;
        assert_true(a[along] == -0.5 && b[along] == 0.5);
        assert_true(a[2 - along] == b[2 - along]);
        assert_true(fabs(a[1]) < 1e-18 && fabs(b[1]) < 1e-18); /* level with the other rods' ends */
    }
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_net(&mesh, 0, 4, 8, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, (double)NAN, 4, 8, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, 1, 4, 8, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, 1, 4, 8, (double)INFINITY, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, 1, 0, 8, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, 1, 1000000000, 2147483647, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&mesh, 1, 4, 7, 1, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.what, "7 segments a rod; 8 are needed, two for each crossing");
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_net(&mesh, 1, 2, 4, 0.1, NULL);
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
        cmocka_unit_test(test_it_is_woven_wherever_the_nodes_lie),
        cmocka_unit_test(test_extent_and_straight_ends),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
