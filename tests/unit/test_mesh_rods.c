/* Bundles and beds of rods. */
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

static cipc_mesh rods(int x, int y, int z, const double spacing[3], double length, int segments, bool round)
{
    cipc_mesh mesh;
    cipc_error error;
    const int count[3] = {x, y, z};
    if (cipc_mesh_rods(&mesh, count, spacing, length, segments, round, &error) != CIPC_OK) fail_msg("%s", error.what);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    return mesh;
}

static void assert_near(const double *x, double a, double b, double c)
{
    assert_true(fabs(x[0] - a) < 1e-15 && fabs(x[1] - b) < 1e-15 && fabs(x[2] - c) < 1e-15);
}

static void test_order_and_places(void **state)
{
    (void)state;
    const double spacing[3] = {0.1, 1, 0.2};
    cipc_mesh mesh = rods(3, 2, 2, spacing, 0.5, 4, false);
    assert_int_equal(mesh.node_count, 12 * 5);
    assert_int_equal(mesh.segment_count, 12 * 4);
    assert_near(mesh.nodes, -0.1, -0.75, -0.1);
    assert_near(mesh.nodes + 3 * 4, -0.1, -0.25, -0.1);
    assert_near(mesh.nodes + 3 * 5, 0, -0.75, -0.1);   /* x fastest */
    assert_near(mesh.nodes + 3 * 15, -0.1, -0.75, 0.1); /* then z */
    assert_near(mesh.nodes + 3 * 30, -0.1, 0.25, -0.1); /* then y */
    assert_near(mesh.nodes + 3 * 59, 0.1, 0.75, 0.1);
    assert_true(fabs(total_length(&mesh) - 6) < 1e-13);
    for (int s = 0; s < mesh.segment_count; s++) {
        int first = s / 4 * 5 + s % 4;
        assert_true(mesh.segments[s][0] == first && mesh.segments[s][1] == first + 1);
    }
    cipc_mesh_free(&mesh);
}

/* Numbers of points of a square lattice in the circle through the outermost of the middle rows. */
static void test_round_bundles(void **state)
{
    (void)state;
    const double spacing[3] = {3e-4, 1, 3e-4};
    const int side[7] = {1, 2, 3, 4, 5, 7, 30}, want[7] = {1, 0, 5, 4, 13, 29, 648};
    for (int i = 0; i < 7; i++) {
        if (want[i] == 0) continue;
        cipc_mesh mesh = rods(side[i], 1, side[i], spacing, 0.15, 1, true);
        assert_int_equal(mesh.segment_count, want[i]);
        for (int n = 0; n < mesh.node_count; n++) {
            assert_true(hypot(mesh.nodes[3 * n], mesh.nodes[3 * n + 2]) <= 0.5 * (side[i] - 1) * 3e-4 * (1 + 1e-15));
        }
        cipc_mesh_free(&mesh);
    }
}

static void test_round_is_an_ellipse_of_unequal_sides(void **state)
{
    (void)state;
    const double spacing[3] = {1, 1, 1};
    cipc_mesh mesh = rods(5, 2, 3, spacing, 0.5, 1, true);
    assert_int_equal(mesh.segment_count, 14); /* rows of 1, 5 and 1 a layer: (1/2)^2 + 1 > 1 */
    cipc_mesh_free(&mesh);
    mesh = rods(5, 1, 1, spacing, 0.5, 1, true);
    assert_int_equal(mesh.segment_count, 5);
    cipc_mesh_free(&mesh);
}

static void reject(int x, int y, int z, double spacing, double length, int segments, bool round, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    const int count[3] = {x, y, z};
    const double all[3] = {spacing, spacing, spacing};
    assert_int_equal(cipc_mesh_rods(&mesh, count, all, length, segments, round, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    reject(0, 1, 1, 1, 1, 1, false, "0 by 1 by 1 rods");
    reject(2, 1, 1, 0, 1, 1, false, "2 rods with a spacing of 0 m");
    reject(2, 1, 1, (double)NAN, 1, 1, false, "spacing of nan");
    reject(1, 1, 1, 1, -1, 1, false, "rods of -1 m");
    reject(1, 1, 1, 1, 1, 0, false, "0 segments");
    reject(1, 2, 1, 1, 1, 1, false, "would touch");
    reject(2, 1, 2, 1, 1, 1, true, "no rods");
    reject(2147483647, 1, 2147483647, 1, 1, 1, true, "at most");
    reject(10, 2147483647, 10, 1, 0.1, 2147483647, false, "at most");
    const int count[3] = {2, 2, 2};
    const double spacing[3] = {1, 1, 1};
    cipc_mesh mesh;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_rods(&mesh, count, spacing, 0.5, 2, false, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

/* The upper ends stay, the lower ones move up by different lengths of at most what may be lost, and segments stay equal. */
static void test_shortened_rods(void **state)
{
    (void)state;
    enum { RODS = 100, SEGMENTS = 4 };
    const double spacing[3] = {1, 1, 1}, length = 0.2, shorten = 0.04;
    cipc_mesh whole = rods(10, 1, 10, spacing, length, SEGMENTS, false), cut = rods(10, 1, 10, spacing, length, SEGMENTS, false);
    assert_int_equal(cipc_mesh_shorten_rods(&cut, length, SEGMENTS, shorten, 3, NULL), CIPC_OK);
    double sum = 0, least = 1, most = 0;
    for (int i = 0; i < RODS; i++) {
        const double *w = whole.nodes + 3 * i * (SEGMENTS + 1), *c = cut.nodes + 3 * i * (SEGMENTS + 1), lost = c[1] - w[1];
        assert_true(c[0] == w[0] && c[2] == w[2] && c[3 * SEGMENTS + 1] == w[3 * SEGMENTS + 1]);
        for (int s = 0; s < SEGMENTS; s++) assert_true(fabs(c[3 * s + 4] - c[3 * s + 1] - (length - lost) / SEGMENTS) < 1e-16);
        sum += lost;
        least = fmin(least, lost);
        most = fmax(most, lost);
    }
    assert_true(least >= 0 && most < shorten && least < 0.1 * shorten && most > 0.9 * shorten);
    assert_true(fabs(sum / RODS - shorten / 2) < 4 * shorten / sqrt(12.0 * RODS)); /* four standard errors of the mean of RODS uniform numbers */
    assert_int_equal(cipc_mesh_shorten_rods(&cut, length, SEGMENTS, -1e-9, 3, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_shorten_rods(&cut, length, SEGMENTS, (double)NAN, 3, NULL), CIPC_E_OUT_OF_RANGE);
    cipc_mesh_free(&whole);
    cipc_mesh_free(&cut);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_and_places),
        cmocka_unit_test(test_round_bundles),
        cmocka_unit_test(test_round_is_an_ellipse_of_unequal_sides),
        cmocka_unit_test(test_shortened_rods),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
