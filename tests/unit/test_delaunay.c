/* Triangulation by qhull. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "scene/delaunay.h"

static double orientation(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* > 0: d inside the circle through the counter-clockwise a, b, c. */
static double in_circle(const double *a, const double *b, const double *c, const double *d)
{
    double ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0], cy = c[1] - d[1];
    return (ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay) +
           (cx * cx + cy * cy) * (ax * by - bx * ay);
}

static void test_circles_are_empty_and_triangles_turn_left(void **state)
{
    (void)state;
    enum { N = 60 };
    static const double rounding = 1e-12; /* of in_circle, for coordinates up to 1: some tens of operations of 1e-16 */
    double points[2 * N], area = 0;
    int triangles[2 * N][3], count;
    for (int i = 0; i < N; i++) {
        points[2 * i] = fmod(0.5 + i * 0.7548776662466927, 1);
        points[2 * i + 1] = fmod(0.5 + i * 0.5698402909980532, 1);
    }
    const double corners[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    for (int i = 0; i < 8; i++) points[i] = corners[i];
    assert_int_equal(scene_delaunay(points, N, 1e-12, triangles, &count, NULL), CIPC_OK);
    assert_int_equal(count, 2 * N - 2 - 4);
    for (int t = 0; t < count; t++) {
        const double *a = points + 2 * triangles[t][0], *b = points + 2 * triangles[t][1], *c = points + 2 * triangles[t][2];
        assert_true(orientation(a, b, c) > 0);
        area += 0.5 * orientation(a, b, c);
        for (int i = 0; i < N; i++) assert_true(in_circle(a, b, c, points + 2 * i) < rounding);
    }
    assert_true(fabs(area - 1) < rounding);
}

static void test_points_on_a_circle(void **state)
{
    (void)state;
    double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    int triangles[8][3], count;
    assert_int_equal(scene_delaunay(square, 4, 1e-12, triangles, &count, NULL), CIPC_OK);
    assert_int_equal(count, 2);
}

/* Points on the edge of the hull, rounded, may span flat triangles: none is given back. */
static void test_points_along_a_side(void **state)
{
    (void)state;
    enum { N = 41 };
    double points[2 * N];
    int triangles[2 * N][3], count;
    for (int i = 0; i < N - 1; i++) {
        points[2 * i] = i / (double)(N - 2);
        points[2 * i + 1] = 0.1;
    }
    points[2 * N - 2] = 0.5;
    points[2 * N - 1] = 1;
    assert_int_equal(scene_delaunay(points, N, 1e-9, triangles, &count, NULL), CIPC_OK);
    assert_int_equal(count, N - 2);
}

static void test_no_triangulation(void **state)
{
    (void)state;
    double line[10] = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4};
    int triangles[10][3], count;
    cipc_error error;
    assert_int_equal(scene_delaunay(line, 2, 0, triangles, &count, &error), CIPC_E_BAD_MESH);
    assert_int_equal(scene_delaunay(line, 5, 1e-12, triangles, &count, &error) == CIPC_OK ? count : 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_circles_are_empty_and_triangles_turn_left),
        cmocka_unit_test(test_points_on_a_circle),
        cmocka_unit_test(test_points_along_a_side),
        cmocka_unit_test(test_no_triangulation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
