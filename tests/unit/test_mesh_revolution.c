/* Shells of revolution. */
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

enum { SECTORS = 24 };

static cipc_mesh revolve(int count, const double (*profile)[2])
{
    cipc_mesh mesh;
    cipc_error error;
    if (cipc_mesh_revolution(&mesh, count, profile, SECTORS, &error) != CIPC_OK) fail_msg("%s", error.what);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    return mesh;
}

/* A band between two staggered rings of n nodes, radii r and s, heights h apart: n triangles stand on each ring; the height of one on ring r reaches from the middle of
 * its edge, at r cos(pi/n), to the other ring. */
static double band_area(double r, double s, double h)
{
    double half = pi / SECTORS, base_r = 2 * r * sin(half), base_s = 2 * s * sin(half);
    return 0.5 * SECTORS * (base_r * hypot(s - r * cos(half), h) + base_s * hypot(r - s * cos(half), h));
}

static void test_a_closed_shell(void **state)
{
    (void)state;
    const double profile[5][2] = {{0, -1}, {0.8, -0.6}, {1, 0}, {0.8, 0.6}, {0, 1}};
    cipc_mesh mesh = revolve(5, profile);
    assert_int_equal(mesh.node_count, 3 * SECTORS + 2);
    assert_int_equal(mesh.triangle_count, 6 * SECTORS);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(p.euler, 2);
    assert_int_equal(p.bad_edges + p.boundary_edges + p.unused_nodes, 0);
    double fan = SECTORS * 0.8 * sin(pi / SECTORS) * hypot(0.8 * cos(pi / SECTORS), 0.4);
    assert_true(fabs(p.area / (2 * fan + 2 * band_area(0.8, 1, 0.6)) - 1) < 1e-13);
    assert_true(p.volume > 0); /* the profile goes up: outward */
    cipc_mesh_free(&mesh);
}

/* An angle between radius and normal below a right angle everywhere; and the same profile downwards turns all of them. */
static void test_the_profile_decides_the_side(void **state)
{
    (void)state;
    const double up[3][2] = {{1, 0}, {1.5, 1}, {0.5, 2}}, down[3][2] = {{0.5, 2}, {1.5, 1}, {1, 0}}, outward[2][2] = {{1, 0}, {2, 0}}, inward[2][2] = {{2, 0}, {1, 0}};
    for (int way = 0; way < 2; way++) {
        cipc_mesh mesh = revolve(3, way == 0 ? up : down);
        mesh_properties p = measure_mesh(&mesh);
        assert_int_equal(p.bad_edges, 0);
        assert_int_equal(p.euler, 0); /* as an annulus */
        assert_int_equal(p.boundary_edges, 2 * SECTORS);
        for (int t = 0; t < mesh.triangle_count; t++) {
            const double *a = mesh.nodes + 3 * mesh.triangles[t][0], *b = mesh.nodes + 3 * mesh.triangles[t][1], *c = mesh.nodes + 3 * mesh.triangles[t][2];
            double u[3], v[3], n[3];
            v3_sub(u, b, a);
            v3_sub(v, c, a);
            v3_cross(n, u, v);
            double out = n[0] * (a[0] + b[0] + c[0]) + n[2] * (a[2] + b[2] + c[2]);
            assert_true(way == 0 ? out > 0 : out < 0);
        }
        cipc_mesh_free(&mesh);
    }
    cipc_mesh disc = revolve(2, inward); /* a washer whose profile runs to the axis: right of it is up */
    assert_true(measure_mesh(&disc).smallest_up == 1);
    cipc_mesh_free(&disc);
    disc = revolve(2, outward);
    assert_true(measure_mesh(&disc).smallest_up == -1);
    cipc_mesh_free(&disc);
}

static void test_points_on_the_axis_begin_or_end_it(void **state)
{
    (void)state;
    const double top[3][2] = {{1, 0}, {0.5, 0.5}, {0, 1}}, bottom[3][2] = {{0, 0}, {0.5, 0.5}, {1, 1}};
    for (int way = 0; way < 2; way++) {
        cipc_mesh mesh = revolve(3, way == 0 ? top : bottom);
        mesh_properties p = measure_mesh(&mesh);
        assert_int_equal(mesh.node_count, 2 * SECTORS + 1);
        assert_int_equal(mesh.triangle_count, 3 * SECTORS);
        assert_int_equal(p.euler, 1);
        assert_int_equal(p.bad_edges + p.unused_nodes, 0);
        assert_int_equal(p.boundary_edges, SECTORS);
        cipc_mesh_free(&mesh);
    }
}

/* Nodes of an upper ring stand above the middles of the lower ring's gaps. */
static void test_rings_are_staggered(void **state)
{
    (void)state;
    const double profile[3][2] = {{1, 0}, {1, 1}, {1, 2}};
    cipc_mesh mesh = revolve(3, profile);
    for (int k = 0; k < 3; k++) {
        const double *x = mesh.nodes + 3 * k * SECTORS;
        double angle = atan2(-x[2], x[0]);
        assert_true(fabs(angle - (k == 1 ? pi / SECTORS : 0)) < 1e-15);
        assert_true(x[1] == k);
    }
    cipc_mesh_free(&mesh);
}

static void reject(int count, const double (*profile)[2], int sectors, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_revolution(&mesh, count, profile, sectors, &error), CIPC_E_OUT_OF_RANGE);
    if (strstr(error.what, what) == NULL) fail_msg("\"%s\" does not contain \"%s\"", error.what, what);
    assert_null(mesh.nodes);
}

static void test_bad_profiles(void **state)
{
    (void)state;
    const double good[2][2] = {{1, 0}, {1, 1}}, nan[2][2] = {{1, 0}, {1, (double)NAN}}, negative[2][2] = {{-1, 0}, {1, 1}}, waist[3][2] = {{1, 0}, {0, 1}, {1, 2}};
    const double same[3][2] = {{1, 0}, {1, 0}, {1, 1}}, axis[2][2] = {{0, 0}, {0, 1}}, closed[4][2] = {{1, 0}, {2, 0}, {1, 1}, {1, 0}};
    reject(1, good, 8, "a profile of 1 points");
    reject(2, good, 2, "2 sectors");
    reject(2, good, 2147483647, "at most");
    reject(2, nan, 8, "point 1 of the profile: radius 1, height nan");
    reject(2, negative, 8, "point 0 of the profile: radius -1");
    reject(3, waist, 8, "point 1 of the profile lies on the axis");
    reject(3, same, 8, "points 0 and 1 of the profile have no surface between them");
    reject(2, axis, 8, "points 0 and 1 of the profile have no surface between them");
    reject(4, closed, 8, "ends where it begins");
}

static void test_no_memory(void **state)
{
    (void)state;
    const double profile[2][2] = {{1, 0}, {1, 1}};
    cipc_mesh mesh;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_revolution(&mesh, 2, profile, 8, NULL);
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
        cmocka_unit_test(test_a_closed_shell),
        cmocka_unit_test(test_the_profile_decides_the_side),
        cmocka_unit_test(test_points_on_the_axis_begin_or_end_it),
        cmocka_unit_test(test_rings_are_staggered),
        cmocka_unit_test(test_bad_profiles),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
