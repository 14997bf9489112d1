/* Edges and hinges of triangle meshes: unique and ordered edges, flat hinges of angle 0 whatever the triangles' orientation, none at
 * borders and where three triangles meet. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/energy.h"
#include "model/mesh_topology.h"
#include "support/cloth_soup.h"
#include "support/failing_memory.h"

/* Some twenty operations a number. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

/* Corners of the unit square in the plane z = 0, then two more beside the diagonal 0 2, out of that plane. */
static double nodes[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 0.5, 0.5, -1};

/* All triangles are of one shell. */
static cipc_body shell = {.kind = CIPC_BODY_SHELL};
static int triangle_body[8];

static void topology(cipc_model *m, int triangle_count, int (*triangles)[3])
{
    assert_true(triangle_count <= 8);
    memset(m, 0, sizeof *m);
    m->bodies = &shell;
    m->triangle_body = triangle_body;
    m->rest = nodes;
    m->node_count = 6;
    m->triangles = triangles;
    m->triangle_count = triangle_count;
    assert_int_equal(cipc_mesh_topology(m, NULL), CIPC_OK);
}

static void free_topology(cipc_model *m)
{
    cipc_free(m->edges);
    cipc_free(m->edge_area);
    cipc_free(m->hinges);
}

static double hinge_angle(const cipc_model *m, const double *x, int hinge)
{
    double y[12];
    soup_stencil(x, m->hinges[hinge], y);
    return cipc_hinge_angle(y);
}

static void test_square(void **state)
{
    (void)state;
    int triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    cipc_model m;
    topology(&m, 2, triangles);
    const int edges[5][2] = {{0, 1}, {2, 0}, {3, 0}, {1, 2}, {2, 3}}; /* by lower, then higher node; as in their first triangle */
    const double area[5] = {1.0 / 6, 1.0 / 3, 1.0 / 6, 1.0 / 6, 1.0 / 6};
    assert_int_equal(m.edge_count, 5);
    assert_memory_equal(m.edges, edges, sizeof edges);
    for (int e = 0; e < 5; e++) assert_true(fabs(m.edge_area[e] - area[e]) <= ROUNDINGS);
    assert_int_equal(m.hinge_count, 1);
    const int hinge[4] = {2, 0, 1, 3};
    assert_memory_equal(m.hinges[0], hinge, sizeof hinge);
    free_topology(&m);
}

/* All four ways to orient the two triangles, and all rotations of their nodes: flat is 0, and a fold down of the fourth node has one
 * size. */
static void test_flat_is_zero_for_every_orientation(void **state)
{
    (void)state;
    static const double FOLD = 0.3;
    double folded[sizeof nodes / sizeof *nodes];
    memcpy(folded, nodes, sizeof nodes);
    /* node 3 turned about the diagonal 0 2, out of (-1, 1, 0)/2 about the point (1, 1, 0)/2 */
    folded[9] = 0.5 - 0.5 * cos(FOLD), folded[10] = 0.5 + 0.5 * cos(FOLD), folded[11] = -sqrt(0.5) * sin(FOLD);
    for (int way = 0; way < 36; way++) {
        int triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
        for (int t = 0; t < 2; t++) {
            int turns = t ? way / 6 : way % 6, turned[3];
            for (int k = 0; k < 3; k++) turned[k] = triangles[t][turns < 3 ? (k + turns) % 3 : (turns - k) % 3];
            memcpy(triangles[t], turned, sizeof turned);
        }
        cipc_model m;
        topology(&m, 2, triangles);
        assert_int_equal(m.edge_count, 5);
        assert_int_equal(m.hinge_count, 1);
        assert_true(hinge_angle(&m, nodes, 0) == 0);
        assert_true(fabs(fabs(hinge_angle(&m, folded, 0)) - FOLD) <= ROUNDINGS);
        free_topology(&m);
    }
}

/* The triangles of a hinge are (v0,v1,v2) and (v1,v0,v3) when they are oriented alike. */
static void test_hinge_follows_its_first_triangle(void **state)
{
    (void)state;
    int triangles[2][3] = {{2, 1, 0}, {2, 0, 3}};
    cipc_model m;
    topology(&m, 2, triangles);
    const int hinge[4] = {0, 2, 1, 3};
    assert_memory_equal(m.hinges[0], hinge, sizeof hinge);
    free_topology(&m);
}

static void test_three_triangles_on_an_edge_have_no_hinge(void **state)
{
    (void)state;
    int triangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}};
    cipc_model m;
    topology(&m, 3, triangles);
    assert_int_equal(m.edge_count, 7);
    assert_int_equal(m.hinge_count, 0);
    double area = 0; /* each triangle gives a third of its area to each of its sides */
    for (int e = 0; e < 7; e++) area += m.edge_area[e];
    assert_true(fabs(area - (0.5 + 0.5 + sqrt(0.5))) <= ROUNDINGS);
    free_topology(&m);
}

static void test_coincident_triangles_have_no_hinge(void **state)
{
    (void)state;
    int triangles[2][3] = {{0, 1, 2}, {0, 2, 1}};
    cipc_model m;
    topology(&m, 2, triangles);
    assert_int_equal(m.edge_count, 3);
    assert_int_equal(m.hinge_count, 0);
    free_topology(&m);
}

/* A closed surface: every edge is a hinge; Euler's formula. */
static void test_closed_surface(void **state)
{
    (void)state;
    int triangles[6][3] = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {1, 0, 5}, {2, 1, 5}, {0, 2, 5}};
    cipc_model m;
    topology(&m, 6, triangles);
    assert_int_equal(m.edge_count, 9); /* nodes - edges + triangles = 5 - 9 + 6 = 2 */
    assert_int_equal(m.hinge_count, 9);
    free_topology(&m);
}

/* The sheets of a soup: counts of a grid, order of the edges, and rest angle 0 of every hinge. */
static void test_grids(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 41);
    const cipc_model *m = s.model;
    int n = shape.cells, sheets = shape.sheets;
    assert_int_equal(m->edge_count, sheets * (3 * n * n + 2 * n));
    assert_int_equal(m->hinge_count, sheets * (3 * n * n - 2 * n));
    for (int e = 1; e < m->edge_count; e++) {
        const int *a = m->edges[e - 1], *b = m->edges[e];
        int low[2] = {a[0] < a[1] ? a[0] : a[1], b[0] < b[1] ? b[0] : b[1]}, high[2] = {a[0] + a[1] - low[0], b[0] + b[1] - low[1]};
        assert_true(low[0] < low[1] || (low[0] == low[1] && high[0] < high[1]));
    }
    /* A rest sheet's heights above its plane are an ulp or two of its coordinates, below 2; a cell is shape.size / n wide. */
    for (int h = 0; h < m->hinge_count; h++) assert_true(fabs(hinge_angle(m, m->rest, h)) <= 16 * DBL_EPSILON * n);
    double area = 0;
    for (int e = 0; e < m->edge_count; e++) area += m->edge_area[e];
    assert_true(fabs(area - sheets) <= 1e3 * DBL_EPSILON); /* sum of some 1e3 roundings */
    soup_destroy(&s);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    int triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    cipc_error error;
    for (long n = 1;; n++) {
        cipc_model m = {.bodies = &shell, .triangle_body = triangle_body, .rest = nodes, .node_count = 6, .triangles = triangles, .triangle_count = 2};
        fail_allocation(n);
        cipc_status status = cipc_mesh_topology(&m, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        free_topology(&m);
        if (!failed) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_true(n < 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_square),
        cmocka_unit_test(test_flat_is_zero_for_every_orientation),
        cmocka_unit_test(test_hinge_follows_its_first_triangle),
        cmocka_unit_test(test_three_triangles_on_an_edge_have_no_hinge),
        cmocka_unit_test(test_coincident_triangles_have_no_hinge),
        cmocka_unit_test(test_closed_surface),
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
