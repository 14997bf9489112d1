/* Capsules. */
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

static const double pi = 3.14159265358979323846;

/* The solid is the union of balls whose centres and radii go straight from one end to the other: signed distance of a point from it, by
 * halving the interval in which the (convex) distance from the ball at t is least. */
static double distance_from_capsule(const double radii[2], double length, const double x[3])
{
    double low = 0, high = 1, out = hypot(x[0], x[2]), best = INFINITY;
    for (int i = 0; i < 200; i++) {
        double t[2] = {low + (high - low) / 3, high - (high - low) / 3}, d[2];
        for (int k = 0; k < 2; k++) d[k] = hypot(out, x[1] - length * (t[k] - 0.5)) - (radii[0] + t[k] * (radii[1] - radii[0]));
        if (d[0] < d[1])
            high = t[1];
        else
            low = t[0];
        best = fmin(best, fmin(d[0], d[1]));
    }
    return best;
}

static void check_capsule(double lower, double upper, double length, int around, int along)
{
    const double radii[2] = {lower, upper};
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_capsule(&mesh, radii, length, around, along, NULL), CIPC_OK);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(mesh.node_count, around * (along - 1) + 2);
    assert_int_equal(mesh.triangle_count, 2 * around * (along - 1));
    assert_int_equal(p.euler, 2);
    assert_int_equal(p.bad_edges + p.unused_nodes + p.boundary_edges, 0);
    assert_true(p.volume > 0);
    for (int i = 0; i < mesh.node_count; i++) {
        double d = distance_from_capsule(radii, length, mesh.nodes + 3 * i);
        if (!(fabs(d) < 1e-14 * (length + lower + upper))) fail_msg("node %d is %g m from the surface", i, d);
    }
    const double *first = mesh.nodes, *last = mesh.nodes + 3 * (mesh.node_count - 1);
    assert_true(first[0] == 0 && first[1] == -length / 2 - lower && first[2] == 0);
    assert_true(last[0] == 0 && last[1] == length / 2 + upper && last[2] == 0);
    cipc_mesh_free(&mesh);
}

static void test_nodes_lie_on_the_surface(void **state)
{
    (void)state;
    check_capsule(0.1, 0.1, 0.5, 16, 12);
    check_capsule(0.045, 0.08, 0.6, 20, 40);
    check_capsule(0.08, 0.03, 0.06, 9, 31);
    check_capsule(0.08, 0.03, 0.06, 3, 2);
}

/* Rings are equally far apart along the outline, so that halving the steps divides what is missing of the volume by four, to 1 %. */
static void test_the_volume_converges(void **state)
{
    (void)state;
    const double radii[2] = {0.1, 0.1}, want = pi * 0.01 * 0.5 + 4 * pi / 3 * 0.001;
    double missing[2];
    for (int k = 0; k < 2; k++) {
        cipc_mesh mesh;
        assert_int_equal(cipc_mesh_capsule(&mesh, radii, 0.5, 80 << k, 80 << k, NULL), CIPC_OK);
        missing[k] = want - measure_mesh(&mesh).volume;
        cipc_mesh_free(&mesh);
    }
    assert_true(missing[1] > 0 && fabs(missing[0] / missing[1] - 4) < 0.04);
}

static void reject(double lower, double upper, double length, int around, int along, const char *what)
{
    const double radii[2] = {lower, upper};
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_capsule(&mesh, radii, length, around, along, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    reject(0, 1, 2, 8, 4, "radii 0 and 1");
    reject(1, -1, 4, 8, 4, "radii 1 and -1");
    reject(1, (double)NAN, 4, 8, 4, "nan");
    reject(1, 1, 0, 8, 4, "0 m apart");
    reject(1, 1, (double)INFINITY, 8, 4, "inf m apart");
    reject(2, 1, 1, 8, 4, "one holds the other");
    reject(1, 1, 1, 2, 4, "2 nodes around");
    reject(1, 1, 1, 8, 1, "1 strips along");
    reject(1, 1, 1, 8, 2147483647, "at most 10000000 strips");
    reject(1, 1, 1, 2147483647, 4, "at most");
}

static void test_no_memory(void **state)
{
    (void)state;
    const double radii[2] = {1, 1};
    cipc_mesh mesh;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_capsule(&mesh, radii, 1, 8, 4, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    assert_int_equal(n, 4);
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes_lie_on_the_surface),
        cmocka_unit_test(test_the_volume_converges),
        cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
