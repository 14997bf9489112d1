/* Generated rods, surfaces of revolution, lattices and volumes: counts, closed forms, orientation. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/scene.h"
#include "model/mesh_topology.h"
#include "support/failing_memory.h"

static const double pi = 3.14159265358979323846;
static const double ROUNDINGS = 1e-13; /* sums of up to a thousand numbers */

static double length_of(const cipc_mesh *m)
{
    double sum = 0;
    for (int i = 0; i < m->segment_count; i++) {
        double e[3];
        v3_sub(e, m->nodes + 3 * m->segments[i][1], m->nodes + 3 * m->segments[i][0]);
        sum += v3_norm(e);
    }
    return sum;
}

/* Sum and least of the signed volumes. */
static double volume_of(const cipc_mesh *m, double *least)
{
    double sum = 0;
    *least = INFINITY;
    for (int t = 0; t < m->tetrahedron_count; t++) {
        double e[3][3], n[3];
        for (int k = 0; k < 3; k++) v3_sub(e[k], m->nodes + 3 * m->tetrahedra[t][k + 1], m->nodes + 3 * m->tetrahedra[t][0]);
        v3_cross(n, e[0], e[1]);
        double volume = v3_dot(n, e[2]) / 6;
        *least = fmin(*least, volume);
        sum += volume;
    }
    return sum;
}

/* Volume inside triangles that are seen anticlockwise from outside. */
static double enclosed(const double *x, const int (*triangles)[3], int count)
{
    double sum = 0;
    for (int t = 0; t < count; t++) {
        double n[3];
        v3_cross(n, x + 3 * triangles[t][1], x + 3 * triangles[t][2]);
        sum += v3_dot(x + 3 * triangles[t][0], n) / 6;
    }
    return sum;
}

static void assert_near(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_polyline(void **state)
{
    (void)state;
    cipc_mesh m;
    const double corners[3][3] = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
    assert_int_equal(cipc_mesh_polyline(&m, 3, corners, 4, false, NULL), CIPC_OK);
    assert_true(m.node_count == 9 && m.segment_count == 8 && m.triangle_count == 0);
    assert_near(length_of(&m), 7, ROUNDINGS);
    assert_memory_equal(m.nodes + 24, corners[2], sizeof corners[2]);
    cipc_mesh_free(&m);
    assert_int_equal(cipc_mesh_polyline(&m, 3, corners, 4, true, NULL), CIPC_OK);
    assert_true(m.node_count == 12 && m.segment_count == 12 && m.segments[11][1] == 0);
    assert_near(length_of(&m), 12, ROUNDINGS);
    cipc_mesh_free(&m);
}

static void test_arc(void **state)
{
    (void)state;
    cipc_mesh m;
    assert_int_equal(cipc_mesh_arc(&m, 2, pi, 10, NULL), CIPC_OK);
    assert_true(m.node_count == 11 && m.segment_count == 10);
    assert_near(length_of(&m), 10 * 4 * sin(pi / 20), ROUNDINGS);
    cipc_mesh_free(&m);
    assert_int_equal(cipc_mesh_arc(&m, 2, 2 * pi, 12, NULL), CIPC_OK);
    assert_true(m.node_count == 12 && m.segment_count == 12);
    assert_near(length_of(&m), 12 * 4 * sin(pi / 12), ROUNDINGS);
    cipc_mesh_free(&m);
}

static void test_rods(void **state)
{
    (void)state;
    cipc_mesh m;
    const int count[3] = {3, 2, 5};
    const double spacing[3] = {0.1, 2, 0.2};
    assert_int_equal(cipc_mesh_rods(&m, count, spacing, 1, 4, false, NULL), CIPC_OK);
    assert_true(m.node_count == 30 * 5 && m.segment_count == 30 * 4);
    assert_near(length_of(&m), 30, ROUNDINGS);
    assert_near(m.nodes[0], -0.1, ROUNDINGS);
    assert_near(m.nodes[1], -1.5, ROUNDINGS);
    assert_near(m.nodes[2], -0.4, ROUNDINGS);
    assert_true(m.segments[4][0] == 5); /* a new rod */
    cipc_mesh_free(&m);
    const int square[3] = {5, 1, 5};
    assert_int_equal(cipc_mesh_rods(&m, square, spacing, 1, 1, true, NULL), CIPC_OK);
    assert_int_equal(m.segment_count, 13); /* lattice points within a circle of radius 2 */
    cipc_mesh_free(&m);
}

/* Where two rods of the net cross, one is 2 lift above the other, in turn. */
static void test_net(void **state)
{
    (void)state;
    cipc_mesh m;
    assert_int_equal(cipc_mesh_net(&m, 1, 4, 8, 0.01, NULL), CIPC_OK);
    assert_true(m.node_count == 8 * 9 && m.segment_count == 64);
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++) {
            /* rod a along x at z_a meets rod b along z at x_b: node 1 + 2 b of the one, 1 + 2 a of the other */
            const double *p = m.nodes + 3 * (9 * a + 1 + 2 * b), *q = m.nodes + 3 * (9 * (4 + b) + 1 + 2 * a);
            assert_near(p[0] + 1, q[0] + 1, ROUNDINGS);
            assert_near(p[2] + 1, q[2] + 1, ROUNDINGS);
            assert_near(p[1] - q[1], (a + b) % 2 == 0 ? 0.02 : -0.02, 1e-12);
        }
    cipc_mesh_free(&m);
}

static void test_revolution(void **state)
{
    (void)state;
    cipc_mesh m;
    /* A double cone, closed: the volume of two pyramids over regular polygons, of radius 1 and heights 1 and 2. */
    const double profile[3][2] = {{0, -1}, {1, 0}, {0, 2}};
    const int sectors = 7;
    assert_int_equal(cipc_mesh_revolution(&m, 3, profile, sectors, NULL), CIPC_OK);
    assert_true(m.node_count == 9 && m.triangle_count == 14);
    assert_near(enclosed(m.nodes, (const int(*)[3])m.triangles, m.triangle_count), 0.5 * sectors * sin(2 * pi / sectors), ROUNDINGS); /* area * 3/3, outward */
    cipc_mesh_free(&m);
    const double pole[2][2] = {{0, 0}, {0, 1}}, inner[3][2] = {{1, 0}, {0, 1}, {1, 2}};
    assert_int_equal(cipc_mesh_revolution(&m, 2, pole, 7, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_revolution(&m, 3, inner, 7, NULL), CIPC_E_OUT_OF_RANGE);
}

/* Closed by fans over its two ends it has the volume of a prism, or a little less, its rings being turned; and every triangle looks away from the axis. */
static void test_cylinder(void **state)
{
    (void)state;
    cipc_mesh m;
    assert_int_equal(cipc_mesh_cylinder(&m, 2, 3, 12, 4, NULL), CIPC_OK);
    assert_true(m.node_count == 60 && m.triangle_count == 96);
    for (int t = 0; t < m.triangle_count; t++) {
        const double *a = m.nodes + 3 * m.triangles[t][0], *b = m.nodes + 3 * m.triangles[t][1], *c = m.nodes + 3 * m.triangles[t][2];
        double e1[3], e2[3], n[3], out[3] = {0, a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
        v3_sub(e1, b, a);
        v3_sub(e2, c, a);
        v3_cross(n, e1, e2);
        assert_true(v3_dot(n, out) > 0);
        assert_near(hypot(a[1], a[2]), 2, ROUNDINGS);
    }
    cipc_mesh_free(&m);
}

static void test_lattice(void **state)
{
    (void)state;
    cipc_mesh a, b, c;
    const int count[3] = {2, 3, 4};
    const double spacing[3] = {1, 2, 3};
    assert_int_equal(cipc_mesh_lattice(&a, count, spacing, 0, 1, NULL), CIPC_OK);
    assert_true(a.node_count == 24 && a.nodes[0] == -0.5 && a.nodes[1] == -2 && a.nodes[2] == -4.5 && a.nodes[3] == 0.5);
    assert_int_equal(cipc_mesh_lattice(&b, count, spacing, 0.1, 1, NULL), CIPC_OK);
    assert_int_equal(cipc_mesh_lattice(&c, count, spacing, 0.1, 1, NULL), CIPC_OK);
    assert_memory_equal(b.nodes, c.nodes, 72 * sizeof(double));
    double most = 0;
    for (int i = 0; i < 72; i++) most = fmax(most, fabs(a.nodes[i] - b.nodes[i]));
    assert_true(most <= 0.1 && most > 0.05);
    cipc_mesh_free(&c);
    assert_int_equal(cipc_mesh_lattice(&c, count, spacing, 0.1, 2, NULL), CIPC_OK);
    assert_memory_not_equal(b.nodes, c.nodes, 72 * sizeof(double));
    cipc_mesh_free(&a);
    cipc_mesh_free(&b);
    cipc_mesh_free(&c);
}

/* Tetrahedra that fit: the surface that is left encloses the same volume, and has the Euler characteristic of a sphere. */
static void assert_solid(const cipc_mesh *m, double volume, double tolerance)
{
    double least;
    int(*faces)[3], count, used = 0;
    assert_near(volume_of(m, &least), volume, tolerance);
    assert_true(least > 0);
    assert_int_equal(cipc_volume_surface((const int(*)[4])m->tetrahedra, m->tetrahedron_count, "solid", &faces, &count, NULL), CIPC_OK);
    assert_near(enclosed(m->nodes, (const int(*)[3])faces, count), volume_of(m, &least), 1e-12);
    bool *on_surface = cipc_alloc((size_t)m->node_count, sizeof *on_surface);
    for (int f = 0; f < count; f++)
        for (int k = 0; k < 3; k++) on_surface[faces[f][k]] = true;
    for (int i = 0; i < m->node_count; i++) used += on_surface[i];
    assert_int_equal(2 * used - count, 4); /* V - E + F = 2 with E = 3/2 F */
    cipc_free(on_surface);
    cipc_free(faces);
}

static void test_box(void **state)
{
    (void)state;
    cipc_mesh m;
    const double size[3] = {1, 2, 3};
    const int cells[3] = {2, 3, 4};
    assert_int_equal(cipc_mesh_box(&m, size, cells, NULL), CIPC_OK);
    assert_true(m.node_count == 60 && m.tetrahedron_count == 144);
    assert_solid(&m, 6, ROUNDINGS);
    cipc_mesh_free(&m);
}

/* The ball's surface is the icosphere's: its volume nears the ball's as the square of its edges. */
static void test_ball(void **state)
{
    (void)state;
    double missing[2];
    for (int k = 0; k < 2; k++) {
        cipc_mesh m;
        double least, full = 4 * pi / 3 * 8;
        assert_int_equal(cipc_mesh_ball(&m, 2, 2 << k, NULL), CIPC_OK);
        missing[k] = full - volume_of(&m, &least);
        assert_solid(&m, full - missing[k], ROUNDINGS);
        cipc_mesh_free(&m);
    }
    assert_near(missing[0] / missing[1], 4, 0.15);
    assert_true(missing[1] > 0);
}

static void test_solid_cylinder(void **state)
{
    (void)state;
    cipc_mesh m;
    assert_int_equal(cipc_mesh_solid_cylinder(&m, 2, 3, 3, 4, NULL), CIPC_OK);
    assert_true(m.node_count == 5 * 37 && m.tetrahedron_count == 3 * 4 * 54);
    assert_solid(&m, 3 * 0.5 * 18 * 4 * sin(2 * pi / 18), ROUNDINGS); /* a prism over a polygon of 18 sides */
    cipc_mesh_free(&m);
}

static cipc_status make(int which, cipc_mesh *m, cipc_error *error)
{
    const int three[3] = {2, 2, 2};
    const double sizes[3] = {1, 1, 1}, profile[3][2] = {{0, -1}, {1, 0}, {0, 2}}, points[2][3] = {{0, 0, 0}, {1, 0, 0}};
    switch (which) {
    case 0: return cipc_mesh_polyline(m, 2, points, 3, false, error);
    case 1: return cipc_mesh_arc(m, 1, 1, 3, error);
    case 2: return cipc_mesh_rods(m, three, sizes, 1, 2, true, error);
    case 3: return cipc_mesh_net(m, 1, 2, 4, 0.1, error);
    case 4: return cipc_mesh_revolution(m, 3, profile, 5, error);
    case 5: return cipc_mesh_cylinder(m, 1, 1, 5, 2, error);
    case 6: return cipc_mesh_box(m, sizes, three, error);
    case 7: return cipc_mesh_ball(m, 1, 2, error);
    default: return cipc_mesh_solid_cylinder(m, 1, 1, 2, 2, error);
    }
}

static void test_out_of_memory(void **state)
{
    (void)state;
    for (int which = 0; which < 9; which++)
        for (long n = 1;; n++) {
            cipc_mesh m;
            cipc_error error;
            fail_allocation(n);
            cipc_status status = make(which, &m, &error);
            bool failed = allocation_failed();
            fail_allocation(0);
            if (!failed) {
                assert_int_equal(status, CIPC_OK);
                cipc_mesh_free(&m);
                break;
            }
            assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
            assert_true(m.nodes == NULL && n < 20);
        }
}

static void test_bad_sizes(void **state)
{
    (void)state;
    cipc_mesh m;
    const int none[3] = {0, 1, 1}, one[3] = {1, 1, 1}, huge[3] = {100000, 1000, 100000};
    const double sizes[3] = {1, 1, 1}, negative[3] = {1, -1, 1};
    assert_int_equal(cipc_mesh_arc(&m, 0, 1, 3, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_arc(&m, 1, 7, 3, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_rods(&m, none, sizes, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_rods(&m, huge, sizes, 1, 1, false, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&m, huge, sizes, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&m, one, sizes, NAN, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_box(&m, negative, one, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_box(&m, sizes, huge, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_ball(&m, 1, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_solid_cylinder(&m, 1, INFINITY, 1, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_cylinder(&m, 1, 1, 2, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_net(&m, 1, 0, 1, 0.1, NULL), CIPC_E_OUT_OF_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_polyline), cmocka_unit_test(test_arc),     cmocka_unit_test(test_rods), cmocka_unit_test(test_net),
        cmocka_unit_test(test_revolution), cmocka_unit_test(test_cylinder), cmocka_unit_test(test_lattice), cmocka_unit_test(test_box),
        cmocka_unit_test(test_ball),     cmocka_unit_test(test_solid_cylinder), cmocka_unit_test(test_out_of_memory), cmocka_unit_test(test_bad_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
