/* Stitch: a spring between a node and a place on an edge; forces of the three nodes, both ends of the edge, digits far from the origin. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "cipc/energy.h"

enum { SIZE = 9 };

/* The gap from (1, 0, 0), a quarter of the way, to the node is (-1, 3, -2). All numbers are exact. */
static const double x[SIZE] = {0, 3, -2, 0, 0, 0, 4, 0, 0};
static const cipc_stitch quarter = {.stiffness = 2, .ratio = 0.25};

static void test_value(void **state)
{
    (void)state;
    assert_true(cipc_stitch_value(x, &quarter) == 14);
    assert_true(cipc_stitch_value(x, &(cipc_stitch){2, 0}) == 13);
    assert_true(cipc_stitch_value(x, &(cipc_stitch){2, 1}) == 29);
}

/* The edge's nodes share the reaction as a lever does; both ends of it are the nodes themselves. */
static void test_forces(void **state)
{
    (void)state;
    const double gap[3][3] = {{-1, 3, -2}, {0, 3, -2}, {-4, 3, -2}}, ratios[3] = {0.25, 0, 1};
    for (int r = 0; r < 3; r++) {
        double g[SIZE];
        cipc_stitch_gradient(x, &(cipc_stitch){2, ratios[r]}, g);
        for (int k = 0; k < 3; k++) {
            assert_true(g[k] == 2 * gap[r][k]);
            assert_true(g[3 + k] == -2 * (1 - ratios[r]) * gap[r][k]);
            assert_true(g[6 + k] == -2 * ratios[r] * gap[r][k]);
        }
    }
}

static void test_hessian(void **state)
{
    (void)state;
    const double w[3] = {1, -0.75, -0.25};
    double H[SIZE * SIZE];
    cipc_stitch_hessian(x, &quarter, H);
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) assert_true(H[SIZE * i + j] == (i % 3 == j % 3 ? 2 * w[i / 3] * w[j / 3] : 0));
    }
}

/* A closed stitch does nothing, wherever it is: (1-r) x1 + r x2 would round there, differences of nodes do not. */
static void test_closed_far_away(void **state)
{
    (void)state;
    const double place[3] = {1e12 / 3, -0.1, 1e6 / 7};
    double closed[SIZE], g[SIZE];
    for (int i = 0; i < SIZE; i++) closed[i] = place[i % 3];
    for (int k = 1; k < 100; k++) {
        const cipc_stitch stitch = {.stiffness = 1, .ratio = k / 100.0};
        assert_true(cipc_stitch_value(closed, &stitch) == 0);
        cipc_stitch_gradient(closed, &stitch, g);
        for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),
        cmocka_unit_test(test_forces),
        cmocka_unit_test(test_hessian),
        cmocka_unit_test(test_closed_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
