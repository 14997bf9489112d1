/* The order of primitives in the monitors' broad phase: a permutation with the fixed last, bodies together, neighbours close. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "cipc/base.h"
#include "invariant/rest_order.h"
#include "support/failing_memory.h"
#include "support/hand_model.h"

/* A fixed grid, then two moving ones, out of body order. */
static hand_model *three_grids(void)
{
    hand_model *h = hand_model_create();
    int floor = hand_body(h, "floor", 0, 0, true), first = hand_body(h, "first", 0, 0, false), second = hand_body(h, "second", 0, 0, false);
    const double o[3] = {0, 0, 0}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0};
    hand_grid(h, second, o, u, v, 16, 16);
    hand_grid(h, floor, o, u, v, 16, 16);
    hand_grid(h, first, o, u, v, 16, 16);
    return h;
}

static void test_order(void **state)
{
    (void)state;
    fail_allocation(0);
    hand_model *h = three_grids();
    const cipc_model *m = &h->model;
    bool *fixed = calloc((size_t)m->node_count, sizeof *fixed), *seen = calloc((size_t)m->triangle_count, sizeof *seen);
    int *order = calloc((size_t)m->triangle_count, sizeof *order);
    for (int i = 0; i < m->node_count; i++) { fixed[i] = m->bodies[m->node_body[i]].fixed; }
    assert_true(cipc_rest_order(order, m, (const int *)m->triangles, 3, m->triangle_count, fixed));
    double jumps = 0;
    for (int i = 0; i < m->triangle_count; i++) {
        assert_in_range(order[i], 0, m->triangle_count - 1);
        assert_false(seen[order[i]]);
        seen[order[i]] = true;
        int body = m->triangle_body[order[i]], third = i / (m->triangle_count / 3);
        assert_int_equal(body, third == 2 ? 0 : third + 1); /* first, second, floor */
        if (i % (m->triangle_count / 3) != 0) {
            const double *a = &m->rest[3 * m->triangles[order[i]][0]], *b = &m->rest[3 * m->triangles[order[i - 1]][0]];
            jumps += hypot(a[0] - b[0], a[1] - b[1]);
        }
    }
    /* Along a space-filling curve the mean step is about a cell, 1/16; in random order it would be about a half. */
    assert_true(jumps / m->triangle_count < 0.125);
    free(fixed);
    free(seen);
    free(order);
    hand_model_destroy(h);
}

static void test_degenerate_bodies(void **state)
{
    (void)state;
    fail_allocation(0);
    hand_model *h = hand_model_create();
    int body = hand_body(h, "points", 0, 0, false), far = hand_body(h, "far", 0, 0, false);
    for (int i = 0; i < 5; i++) {
        hand_node(h, body, 1, 1, 1);
        hand_node(h, far, i * 1e308 - 1e308, 0, 0); /* the box overflows */
    }
    const int nodes[10] = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
    const bool fixed[10] = {false};
    int order[10], sum = 0;
    assert_true(cipc_rest_order(order, &h->model, nodes, 1, 10, fixed));
    for (int i = 0; i < 10; i++) { sum |= 1 << order[i]; }
    assert_int_equal(sum, 1023);
    const int ties[] = {1, 3, 5, 7, 9}; /* of one place: by index */
    assert_memory_equal(order, ties, sizeof ties);
    assert_true(cipc_rest_order(order, &h->model, nodes, 1, 0, fixed));
    hand_model_destroy(h);
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    hand_model *h = three_grids();
    bool fixed[3 * 17 * 17] = {false};
    int order[512];
    for (long n = 1; n <= 2; n++) {
        fail_allocation(n);
        assert_false(cipc_rest_order(order, &h->model, (const int *)h->model.triangles, 3, 512, fixed));
    }
    fail_allocation(0);
    assert_true(cipc_rest_order(order, &h->model, (const int *)h->model.triangles, 3, 512, fixed));
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_degenerate_bodies),
                                       cmocka_unit_test(test_lack_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
