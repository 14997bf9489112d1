/* Dispatch by kind, and the true distances of primitives. (Their accuracy is tested with the features.) */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/exact_geometry.h"

/* docs/theory/distance.md 6: a clear angle costs 4 u / sin < 40 u of the stencil's size, candidates and formula 8 u each. */
#define DISTANCE_TOLERANCE (56.0 * UNIT_ROUNDOFF)
#define SAMPLES 500

static void test_dispatch_is_the_function_of_the_kind(void **state)
{
    (void)state;
    uint64_t seed = 51;
    double x[12], g[12], H[144], g_want[12], H_want[144];
    random_fill(&seed, x, 12, 1.0);

    assert_true(cipc_distance2_value(CIPC_POINT_POINT, x) == cipc_point_point_distance2_value(x));
    cipc_distance2_gradient(CIPC_POINT_POINT, x, g), cipc_point_point_distance2_gradient(x, g_want);
    cipc_distance2_hessian(CIPC_POINT_POINT, x, H), cipc_point_point_distance2_hessian(x, H_want);
    assert_memory_equal(g, g_want, 6 * sizeof g[0]);
    assert_memory_equal(H, H_want, 36 * sizeof H[0]);

    assert_true(cipc_distance2_value(CIPC_POINT_EDGE, x) == cipc_point_line_distance2_value(x));
    cipc_distance2_gradient(CIPC_POINT_EDGE, x, g), cipc_point_line_distance2_gradient(x, g_want);
    cipc_distance2_hessian(CIPC_POINT_EDGE, x, H), cipc_point_line_distance2_hessian(x, H_want);
    assert_memory_equal(g, g_want, 9 * sizeof g[0]);
    assert_memory_equal(H, H_want, 81 * sizeof H[0]);

    assert_true(cipc_distance2_value(CIPC_POINT_TRIANGLE, x) == cipc_point_plane_distance2_value(x));
    cipc_distance2_gradient(CIPC_POINT_TRIANGLE, x, g), cipc_point_plane_distance2_gradient(x, g_want);
    cipc_distance2_hessian(CIPC_POINT_TRIANGLE, x, H), cipc_point_plane_distance2_hessian(x, H_want);
    assert_memory_equal(g, g_want, sizeof g);
    assert_memory_equal(H, H_want, sizeof H);

    assert_true(cipc_distance2_value(CIPC_EDGE_EDGE, x) == cipc_line_line_distance2_value(x));
    cipc_distance2_gradient(CIPC_EDGE_EDGE, x, g), cipc_line_line_distance2_gradient(x, g_want);
    cipc_distance2_hessian(CIPC_EDGE_EDGE, x, H), cipc_line_line_distance2_hessian(x, H_want);
    assert_memory_equal(g, g_want, sizeof g);
    assert_memory_equal(H, H_want, sizeof H);
}

static void check_true_distance(cipc_pair_kind kind, int n, double (*distance2)(const double *))
{
    uint64_t seed = 52 + (uint64_t)kind;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12];
        random_fill(&seed, x, n, 1.0);
        double exact = exact_true_distance(kind, x);
        assert_true(fabs(sqrt(distance2(x)) - exact) <= DISTANCE_TOLERANCE * stencil_size(x, n));
    }
}

static double point_edge(const double *x) { return cipc_point_edge_distance2(x); }
static double point_triangle(const double *x) { return cipc_point_triangle_distance2(x); }
static double edge_edge(const double *x) { return cipc_edge_edge_distance2(x); }

static void test_true_distances(void **state)
{
    (void)state;
    check_true_distance(CIPC_POINT_EDGE, 9, point_edge);
    check_true_distance(CIPC_POINT_TRIANGLE, 12, point_triangle);
    check_true_distance(CIPC_EDGE_EDGE, 12, edge_edge);
}

/* The derivatives of a true distance are those of its closest feature, in the places of that feature's nodes, and 0 elsewhere. Returns the feature's node count. */
static int check_derivatives(const cipc_feature *feature, const double *x, int n, const double *g, const double *H)
{
    double y[12] = {0}, part_g[12], part_H[144], want_g[12] = {0}, want_H[144] = {0};
    int m = 3 * feature->count;
    for (int i = 0; i < m; i++) y[i] = x[3 * feature->local[i / 3] + i % 3];
    cipc_distance2_gradient(feature->kind, y, part_g);
    cipc_distance2_hessian(feature->kind, y, part_H);
    for (int i = 0; i < m; i++) {
        int row = 3 * feature->local[i / 3] + i % 3;
        want_g[row] = part_g[i];
        for (int j = 0; j < m; j++) want_H[n * row + 3 * feature->local[j / 3] + j % 3] = part_H[m * i + j];
    }
    for (int i = 0; i < n; i++) assert_true(g[i] == want_g[i]);
    for (int i = 0; i < n * n; i++) assert_true(H[i] == want_H[i]);
    return feature->count;
}

static void test_derivatives_of_true_distances(void **state)
{
    (void)state;
    uint64_t seed = 57;
    int seen[3][5] = {{0}};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], g[12], H[144];
        random_fill(&seed, x, 12, 1.0);
        cipc_feature feature = cipc_point_edge_feature(x);
        cipc_point_edge_distance2_gradient(x, g);
        cipc_point_edge_distance2_hessian(x, H);
        seen[0][check_derivatives(&feature, x, 9, g, H)]++;
        feature = cipc_point_triangle_feature(x);
        cipc_point_triangle_distance2_gradient(x, g);
        cipc_point_triangle_distance2_hessian(x, H);
        seen[1][check_derivatives(&feature, x, 12, g, H)]++;
        feature = cipc_edge_edge_feature(x);
        cipc_edge_edge_distance2_gradient(x, g);
        cipc_edge_edge_distance2_hessian(x, H);
        seen[2][check_derivatives(&feature, x, 12, g, H)]++;
    }
    assert_true(seen[0][2] > 9 && seen[0][3] > 9);
    for (int kind = 1; kind < 3; kind++) assert_true(seen[kind][2] > 9 && seen[kind][3] > 9 && seen[kind][4] > 9);
}

/* Distances that can be done by hand: 2 above the middle of a side, 3-4-5 off a corner, parallel edges at 1, crossing ones at 0.5. */
static void test_by_hand(void **state)
{
    (void)state;
    const double over_edge[9] = {1, 2, 0, 0, 0, 0, 2, 0, 0}, off_corner[12] = {-3, -4, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    const double parallel[12] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 3, 1, 0}, crossing[12] = {-1, 0, 0, 1, 0, 0, 0, -1, 0.5, 0, 1, 0.5};
    assert_true(cipc_point_edge_distance2(over_edge) == 4.0);
    assert_true(cipc_point_triangle_distance2(off_corner) == 25.0);
    assert_true(cipc_edge_edge_distance2(parallel) == 1.0);
    assert_true(cipc_edge_edge_distance2(crossing) == 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dispatch_is_the_function_of_the_kind),
        cmocka_unit_test(test_true_distances), cmocka_unit_test(test_derivatives_of_true_distances),
        cmocka_unit_test(test_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
