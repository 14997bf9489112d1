/* Rods through given points. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double corners[4][3] = {{0, 0, 0.1}, {3, 0, 0.1}, {3, 4, 0.1}, {0, 4, 0.1}};

static cipc_mesh through(int count, const double (*points)[3], int segments, bool closed)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_polyline(&mesh, count, points, segments, closed, NULL), CIPC_OK);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    return mesh;
}

static void test_open(void **state)
{
    (void)state;
    cipc_mesh mesh = through(4, corners, 5, false);
    assert_int_equal(mesh.node_count, 16);
    assert_int_equal(mesh.segment_count, 15);
    assert_true(fabs(total_length(&mesh) - 10) < 1e-14);
    for (int i = 0; i < 4; i++) assert_memory_equal(mesh.nodes + 15 * i, corners[i], sizeof corners[i]);
    for (int i = 0; i < 16; i++) assert_true(mesh.nodes[3 * i + 2] == 0.1);
    for (int s = 0; s < 15; s++) assert_true(mesh.segments[s][0] == s && mesh.segments[s][1] == s + 1);
    for (int s = 0; s < 15; s++) {
        const double *a = mesh.nodes + 3 * s, *b = a + 3;
        assert_true(fabs(hypot(b[0] - a[0], b[1] - a[1]) - (s / 5 == 1 ? 0.8 : 0.6)) < 1e-15);
    }
    cipc_mesh_free(&mesh);
}

static void test_closed(void **state)
{
    (void)state;
    cipc_mesh mesh = through(4, corners, 2, true);
    assert_int_equal(mesh.node_count, 8);
    assert_int_equal(mesh.segment_count, 8);
    assert_true(fabs(total_length(&mesh) - 14) < 1e-14);
    assert_true(mesh.segments[7][0] == 7 && mesh.segments[7][1] == 0);
    assert_true(mesh.nodes[21] == 0 && mesh.nodes[22] == 2);
    cipc_mesh_free(&mesh);
}

static void test_a_single_segment(void **state)
{
    (void)state;
    cipc_mesh mesh = through(2, corners, 1, false);
    assert_int_equal(mesh.node_count, 2);
    assert_int_equal(mesh.segment_count, 1);
    assert_memory_equal(mesh.nodes, corners, sizeof corners[0] * 2);
    cipc_mesh_free(&mesh);
}

static void reject(int count, const double (*points)[3], int segments, bool closed, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_polyline(&mesh, count, points, segments, closed, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    const double twice[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, back[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, nan[2][3] = {{0, 0, 0}, {1, (double)NAN, 0}};
    reject(1, corners, 1, false, "1 points; 2 are needed");
    reject(2, corners, 1, true, "2 points; 3 are needed");
    reject(4, corners, 0, false, "0 segments");
    reject(4, corners, 2147483647, false, "at most");
    reject(3, twice, 1, false, "points 1 and 2 are the same");
    reject(3, back, 1, true, "points 2 and 0 are the same");
    reject(2, nan, 1, false, "point 1 is (1, nan, 0)");
    cipc_mesh mesh;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_polyline(&mesh, 4, corners, 3, false, NULL);
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
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_a_single_segment),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
