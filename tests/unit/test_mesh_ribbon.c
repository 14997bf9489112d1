/* Ribbons along curves. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"
#include "support/scene_trial.h"

static const double pi = 3.14159265358979323846;
enum { POINTS_MAX = 65 };

/* Natural splines are straight at both ends. On a curve that is not, with points h apart, this turns the tangent by 0.21 h curvature there, 0.27 times less at each further point
 * (the recursion of the spline's second derivatives), and leaves the points between less than a chord's height off. */
static double end_turn(double h, double curvature) { return 0.22 * h * curvature; }
static double chord_height(double h, double curvature) { return h * h * curvature / 8; }

static cipc_mesh make(const cipc_ribbon *ribbon)
{
    cipc_mesh mesh;
    cipc_error error;
    if (cipc_mesh_ribbon(&mesh, ribbon, &error) != CIPC_OK) fail_msg("%s", error.what);
    assert_int_equal(mesh.node_count, (ribbon->along + 1) * (ribbon->across + 1));
    assert_int_equal(mesh.triangle_count, 2 * ribbon->along * ribbon->across);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(p.euler, 1);
    assert_int_equal(p.bad_edges + p.unused_nodes, 0);
    assert_int_equal(p.boundary_edges, 2 * (ribbon->along + ribbon->across));
    return mesh;
}

static cipc_ribbon ribbon_of(int count, const double (*points)[3], double width, int along, int across)
{
    return (cipc_ribbon){.count = count, .points = points, .normal = {0, 1, 0}, .width = width, .along = along, .across = across};
}

static void test_straight(void **state)
{
    (void)state;
    static const double points[2][3] = {{-0.5, 0.25, 0}, {0.5, 0.25, 0}};
    cipc_ribbon ribbon = ribbon_of(2, points, 0.5, 4, 2);
    cipc_mesh mesh = make(&ribbon);
    mesh_properties p = measure_mesh(&mesh);
    assert_true(p.smallest_up == 1 && fabs(p.area - 0.5) < 1e-15);
    for (int i = 0; i <= 4; i++) {
        for (int j = 0; j <= 2; j++) {
            const double *x = mesh.nodes + 3 * (3 * i + j);
            assert_true(fabs(x[0] - (-0.5 + 0.25 * i)) < 1e-15 && x[1] == 0.25 && fabs(x[2] - (-0.25 + 0.25 * j)) < 1e-15);
        }
    }
    /* Alternating diagonals: node 4, in the middle of the first two sections' cells, has all eight triangles round it or four. */
    int around[15] = {0};
    for (int t = 0; t < mesh.triangle_count; t++) {
        for (int k = 0; k < 3; k++) around[mesh.triangles[t][k]]++;
    }
    assert_true(around[4] + around[7] == 12 && around[7] + around[10] == 12 && around[4] != around[7]);
    cipc_mesh_free(&mesh);
}

/* Points on an arc in the x-z plane. */
static void arc_points(double points[POINTS_MAX][3], int n, double radius, double angle)
{
    for (int i = 0; i <= n; i++) {
        points[i][0] = radius * sin(angle * i / n);
        points[i][1] = 0;
        points[i][2] = -radius * cos(angle * i / n);
    }
}

/* Flat on the plane of an arc: half a ring, of the area w R pi whatever the width; along the arc's normal in the plane: a strip of a cylinder. */
static void test_half_rings(void **state)
{
    (void)state;
    double points[POINTS_MAX][3], normals[POINTS_MAX][3];
    arc_points(points, 64, 2, pi);
    cipc_ribbon ribbon = ribbon_of(65, (const double(*)[3])points, 0.5, 128, 4);
    cipc_mesh flat = make(&ribbon);
    mesh_properties p = measure_mesh(&flat);
    const double off = chord_height(2 * pi / 64, 0.5);
    /* Inscribed: short by (angle of a cell)^2 / 6 of the area, 1.0e-4. */
    assert_true(p.smallest_up > 1 - 1e-12 && p.area < pi && p.area > pi * (1 - 1.1e-4));
    for (int i = 0; i <= 128; i++) {
        const double *first = flat.nodes + 15 * i, *last = first + 12;
        assert_true(fabs(v3_norm(first) - 2.25) < off || fabs(v3_norm(first) - 1.75) < off);
        assert_true(fabs(v3_norm(first) + v3_norm(last) - 4) < 2 * off);
    }
    for (int i = 0; i < 65; i++) v3_copy(normals[i], points[i]);
    ribbon.normals = (const double(*)[3])normals;
    cipc_mesh upright = make(&ribbon);
    for (int i = 0; i < upright.node_count; i++) {
        const double *x = upright.nodes + 3 * i;
        assert_true(fabs(hypot(x[0], x[2]) - 2) < off);
        assert_true(fabs(fabs(x[1]) - 0.125 * abs(i % 5 - 2)) < 1e-12);
    }
    cipc_mesh_free(&flat);
    cipc_mesh_free(&upright);
}

/* Along a helix of radius 1 and pitch 2 pi c the frame of least rotation lags behind Frenet's by the torsion, c / (1 + c^2) a length; the end's width direction is compared
 * with that closed form. */
static void test_least_rotation(void **state)
{
    (void)state;
    enum { N = 64 };
    const double c = 0.3, speed = sqrt(1 + c * c), end = pi;
    double points[POINTS_MAX][3];
    for (int i = 0; i <= N; i++) {
        double t = end * i / N;
        points[i][0] = cos(t);
        points[i][1] = sin(t);
        points[i][2] = c * t;
    }
    cipc_ribbon ribbon = ribbon_of(N + 1, (const double(*)[3])points, 0.1, 400, 1);
    ribbon.normal[0] = -1; /* Frenet's normal at the begin */
    ribbon.normal[1] = 0;
    cipc_mesh mesh = make(&ribbon);
    double across[3];
    v3_sub(across, mesh.nodes + 3 * (2 * 400 + 1), mesh.nodes + 3 * (2 * 400));
    v3_scale(across, 1 / v3_norm(across), across);
    /* Frenet at t = pi: tangent (0, -1, c)/speed, normal (1, 0, 0), binormal (0, c, 1)/speed. The ribbon's normal is turned back by the torsion's angle, width = tangent x it. */
    double angle = c / (speed * speed) * end * speed, want[3];
    const double normal[3] = {1, 0, 0}, binormal[3] = {0, c / speed, 1 / speed};
    for (int a = 0; a < 3; a++) want[a] = cos(angle) * binormal[a] + sin(angle) * normal[a];
    v3_sub(want, want, across);
    double off = 2 * end_turn(end * speed / N, 1 / (speed * speed)); /* at the begin and at the end */
    if (!(v3_norm(want) < off)) fail_msg("off by %g, more than %g", v3_norm(want), off);
    assert_true(sin(angle) > 20 * off); /* Frenet's own frame would not do */
    cipc_mesh_free(&mesh);
}

/* Normals turn with the curve from up to sideways. */
static void test_twist(void **state)
{
    (void)state;
    static const double points[3][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, normals[3][3] = {{0, 3, 0}, {0, 1, 1}, {0.5, 0, 1}};
    cipc_ribbon ribbon = ribbon_of(3, points, 0.2, 40, 2);
    ribbon.normals = normals;
    cipc_mesh mesh = make(&ribbon);
    const double *first = mesh.nodes, *last = mesh.nodes + 3 * (3 * 40);
    assert_true(fabs(first[1]) < 1e-15 && fabs(first[2] + 0.1) < 1e-15); /* x cross up = z */
    assert_true(fabs(last[1] - 0.1) < 1e-15 && fabs(last[2]) < 1e-15);   /* x cross z = -y: begins at +y */
    assert_true(fabs(last[0] - 2) < 1e-14);                              /* what points along the curve does not count */
    cipc_mesh_free(&mesh);
}

/* Of a strip of a cylinder the pattern is the unfolding: every side of every triangle is as long as in space, and no two points of the pattern coincide. */
static void test_the_pattern_unfolds(void **state)
{
    (void)state;
    double points[POINTS_MAX][3];
    arc_points(points, 64, 2, pi);
    cipc_ribbon ribbon = ribbon_of(65, (const double(*)[3])points, 0.5, 50, 3);
    v3_copy(ribbon.normal, points[0]);
    cipc_mesh mesh = make(&ribbon);
    for (int t = 0; t < mesh.triangle_count; t++) {
        for (int k = 0; k < 3; k++) {
            int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            double in_space[3], flat[3];
            v3_sub(in_space, mesh.nodes + 3 * a, mesh.nodes + 3 * b);
            v3_sub(flat, mesh.pattern + 3 * a, mesh.pattern + 3 * b);
            assert_true(flat[1] == 0 && fabs(v3_norm(flat) / v3_norm(in_space) - 1) < 1e-12);
        }
    }
    assert_true(mesh.pattern[0] == -mesh.pattern[3 * (mesh.node_count - 1)] && mesh.pattern[2] == -0.25);
    cipc_mesh_free(&mesh);
}

static const char bent[] = "{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"rest\": %s, \"transform\": {\"scale\": %s, \"translate\": [0, 1, 0]},"
                           " \"shell\": {\"ribbon\": {\"points\": [[0, 0, 0], [1, 1, 0], [2, 0, 0]], \"width\": 0.5, \"along\": 8, \"across\": 1}}}]}";

static double largest_rest_height(const char *rest)
{
    char text[600];
    double highest = 0;
    snprintf(text, sizeof text, bent, rest, "2");
    cipc_scene *scene = accept_scene(text, NULL);
    for (int i = 0; i < scene->model->node_count; i++) highest = fmax(highest, fabs(scene->model->rest[3 * i + 1]));
    cipc_scene_destroy(scene);
    return highest;
}

static void test_flat_at_rest(void **state)
{
    (void)state;
    char text[600];
    assert_true(largest_rest_height("\"initial\"") > 1.9); /* as it starts: at twice the size, before it is moved up */
    assert_true(largest_rest_height("\"flat\"") == 0);
    snprintf(text, sizeof text, bent, "\"flat\"", "[1, 2, 1]");
    reject_scene(text, NULL, CIPC_E_OUT_OF_RANGE, "bodies.a.rest", "one scale");
    reject_scene("{\"time_step\": 1, \"steps\": 1, \"bodies\": [{\"name\": \"a\", \"material\": \"wool\", \"rest\": \"flat\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}}]}", NULL,
                 CIPC_E_OUT_OF_RANGE, "bodies.a.rest", "no flat pattern");
}

static void refuse(const cipc_ribbon *ribbon, const char *what)
{
    cipc_mesh mesh;
    cipc_error error;
    assert_int_equal(cipc_mesh_ribbon(&mesh, ribbon, &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "ribbon");
    if (strstr(error.what, what) == NULL) fail_msg("%s", error.what);
    assert_null(mesh.nodes);
}

/* Half a ring of radius 1 wider than 2: the inner edge runs backwards. Beside its straight ends the spline is bent 1.27 times more than the circle. */
static void test_too_sharp_a_bend(void **state)
{
    (void)state;
    double points[POINTS_MAX][3];
    arc_points(points, 64, 1, pi);
    cipc_ribbon ribbon = ribbon_of(65, (const double(*)[3])points, 1.5, 60, 1);
    cipc_mesh mesh = make(&ribbon);
    cipc_mesh_free(&mesh);
    ribbon.width = 2.02;
    refuse(&ribbon, "bends too sharply");
    ribbon.across = 4;
    refuse(&ribbon, "bends too sharply");
}

static void test_rejections_and_no_memory(void **state)
{
    (void)state;
    static const double points[3][3] = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}, back[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {2, 0, 0}};
    cipc_ribbon ribbon = ribbon_of(3, points, 0, 2, 1), bad;
    refuse(&ribbon, "width");
    ribbon.width = (double)NAN;
    refuse(&ribbon, "width");
    ribbon.width = 0.1;
    bad = ribbon;
    bad.along = 0;
    refuse(&bad, "0 by 1 cells");
    bad.along = bad.across = 2147483647;
    refuse(&bad, "at most");
    bad = ribbon;
    bad.normal[1] = 0;
    refuse(&bad, "no direction");
    bad.normal[0] = 1;
    refuse(&bad, "no direction");
    bad = ribbon;
    bad.count = 1;
    refuse(&bad, "2 are needed");
    bad = ribbon_of(4, back, 0.1, 100, 1);
    refuse(&bad, "bends too sharply");
    bad = ribbon;
    bad.normals = (const double[3][3]){{0, 1, 0}, {0, 0, 0}, {0, -1, 0}};
    refuse(&bad, "no direction");
    bad.normals = (const double[3][3]){{0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    for (long n = 1;; n++) {
        cipc_mesh mesh;
        fail_allocation(n);
        cipc_status status = cipc_mesh_ribbon(&mesh, &bad, NULL);
        if (!allocation_failed()) {
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight),
        cmocka_unit_test(test_half_rings),
        cmocka_unit_test(test_least_rotation),
        cmocka_unit_test(test_twist),
        cmocka_unit_test(test_the_pattern_unfolds),
        cmocka_unit_test(test_flat_at_rest),
        cmocka_unit_test(test_too_sharp_a_bend),
        cmocka_unit_test(test_rejections_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
