/* Sides of panels. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/panel_sides.h"

/* Two panels of 3 columns and 2 rows: a square pyramid frustum's halves; nodes 0 to 5 and 6 to 11. */
static cipc_mesh two_panels(void)
{
    cipc_mesh mesh;
    const cipc_panel_ring ring = {.panels = 2, .down = 1, .top = 1, .bottom = 2, .height = 1};
    assert_int_equal(cipc_mesh_gores(&mesh, &ring, 2, NULL), CIPC_OK);
    return mesh;
}

static void test_nodes_of_sides(void **state)
{
    (void)state;
    static const struct {
        scene_side side;
        int length, nodes[2][3];
    } want[] = {
        {SCENE_SIDE_TOP, 3, {{0, 1, 2}, {6, 7, 8}}},
        {SCENE_SIDE_BOTTOM, 3, {{3, 4, 5}, {9, 10, 11}}},
        {SCENE_SIDE_LEFT, 2, {{0, 3}, {6, 9}}},
        {SCENE_SIDE_RIGHT, 2, {{2, 5}, {8, 11}}},
    };
    cipc_mesh mesh = two_panels(), none = {0};
    for (int s = 0; s < 4; s++) {
        assert_int_equal(scene_side_length(&mesh, want[s].side), want[s].length);
        assert_int_equal(scene_side_length(&none, want[s].side), 0);
        for (int p = 0; p < 2; p++) {
            for (int i = 0; i < want[s].length; i++) assert_int_equal(scene_side_node(&mesh, want[s].side, p, i), want[s].nodes[p][i]);
        }
    }
    cipc_mesh_free(&mesh);
}

static void assert_nearest(scene_side side, const double x[3], int except, int a, int b, double ratio, double distance)
{
    cipc_mesh mesh = two_panels();
    scene_side_point p = scene_nearest_on_side(&mesh, mesh.nodes, side, x, except);
    assert_true(p.nodes[0] == a && p.nodes[1] == b);
    assert_true(fabs(p.ratio - ratio) < 1e-15 && fabs(sqrt(p.distance2) - distance) < 1e-15);
    cipc_mesh_free(&mesh);
}

/* The top row runs from (1, 0, 0) over (0, 0, -1), (-1, 0, 0) and (0, 0, 1) back. */
static void test_nearest_points(void **state)
{
    (void)state;
    assert_nearest(SCENE_SIDE_TOP, (const double[3]){0.75, 0.5, -0.25}, -1, 0, 1, 0.25, 0.5); /* inside an edge */
    assert_nearest(SCENE_SIDE_TOP, (const double[3]){0, 0, 3}, -1, 6, 7, 1, 2);       /* beyond a corner: the first edge that has it */
    assert_nearest(SCENE_SIDE_TOP, (const double[3]){0, 0, 3}, 7, 0, 1, 0, sqrt(10)); /* without the edges of that corner */
    assert_nearest(SCENE_SIDE_LEFT, (const double[3]){-1.5, -0.5, 0}, -1, 6, 9, 0.5, 0);
    assert_nearest(SCENE_SIDE_BOTTOM, (const double[3]){0, -9, -2}, -1, 3, 4, 1, 8);
}

static void test_nothing_left(void **state)
{
    (void)state;
    cipc_mesh mesh;
    const cipc_panel_ring ring = {.panels = 1, .down = 1, .top = 1, .bottom = 2, .height = 1};
    assert_int_equal(cipc_mesh_gores(&mesh, &ring, 3, NULL), CIPC_OK);
    scene_side_point p = scene_nearest_on_side(&mesh, mesh.nodes, SCENE_SIDE_LEFT, mesh.nodes, 0);
    assert_true(p.nodes[0] == -1 && isinf(p.distance2));
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes_of_sides),
        cmocka_unit_test(test_nearest_points),
        cmocka_unit_test(test_nothing_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
