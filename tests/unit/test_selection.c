/* Selecting the nodes of a Dirichlet set. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/selection.h"
#include "support/scene_trial.h"

/* A flat sheet of 3 x 3 nodes over [-1, 1] x [10, 12], at y = 5; node 3 j + i. */
enum { NODES = 9 };
static const double sheet[3 * NODES] = {-1, 5, 10, 0, 5, 10, 1, 5, 10, -1, 5, 11, 0, 5, 11, 1, 5, 11, -1, 5, 12, 0, 5, 12, 1, 5, 12};

/* A body before it reaches down to y = 0 and out to x = 3, one after it up to y = 10. */
static const scene_selectable body = {sheet, NODES, {{-1, 0, 10}, {3, 5, 12}}, {{-1, 0, 10}, {3, 10, 12}}};

static void assert_selected(const char *text, int count, const int *want)
{
    int nodes[NODES];
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    int found = scene_select_nodes(&r, &root, &body, nodes);
    if (r.status != CIPC_OK) fail_msg("%s: %s", r.error.place, r.error.what);
    assert_int_equal(found, count);
    assert_memory_equal(nodes, want, (size_t)count * sizeof *nodes);
    scene_reader_free(&r);
}

static void assert_refused(const char *text, cipc_status status, const char *place, const char *what)
{
    int nodes[NODES];
    scene_reader r = reader_of(text);
    scene_cursor root = scene_root(r.root);
    scene_select_nodes(&r, &root, &body, nodes);
    assert_rejection(&r, status, place, what);
    scene_reader_free(&r);
}

static void test_boxes(void **state)
{
    (void)state;
    assert_selected("{\"box\": {\"max\": [0, 1, 1]}}", 3, (int[]){0, 3, 6});
    assert_selected("{\"box\": {\"min\": [1, 0, 0]}}", 3, (int[]){2, 5, 8});
    assert_selected("{\"box\": {\"min\": [0.5, 0, 0.5]}}", 4, (int[]){4, 5, 7, 8});
    assert_selected("{\"box\": {\"min\": [0.4, 0.3, 0.4], \"max\": [0.6, 0.7, 0.6], \"tolerance\": 0.1}}", 1, (int[]){4});
    assert_selected("{\"box\": {\"min\": [0.4, 0, 0.4], \"max\": [0.6, 1, 0.6], \"tolerance\": 0.41}}", 9,
                    (int[]){0, 1, 2, 3, 4, 5, 6, 7, 8});
}

/* The sheet has no extent along y: its plane is at both ends of [0, 1]. */
static void test_flat_directions(void **state)
{
    (void)state;
    assert_selected("{\"box\": {\"min\": [0, 0, 0], \"max\": [0, 0, 0]}}", 1, (int[]){0});
    assert_selected("{\"box\": {\"min\": [0, 1, 0], \"max\": [0, 1, 0]}}", 1, (int[]){0});
}

static void test_boxes_relative_to_other_bodies(void **state)
{
    (void)state;
    assert_selected("{\"box\": {\"max\": [0.25, 1, 1], \"relative_to\": \"scene\"}}", 6, (int[]){0, 1, 3, 4, 6, 7});
    assert_selected("{\"box\": {\"max\": [0.25, 1, 1], \"relative_to\": \"body\"}}", 3, (int[]){0, 3, 6});
    assert_selected("{\"box\": {\"min\": [0, 1, 0.5], \"relative_to\": \"so-far\"}}", 6, (int[]){3, 4, 5, 6, 7, 8});
    assert_selected("{\"box\": {\"min\": [0, 0.5, 0.5], \"max\": [1, 0.5, 1], \"relative_to\": \"scene\"}}", 6, (int[]){3, 4, 5, 6, 7, 8});
    assert_refused("{\"box\": {\"min\": [0, 1, 0], \"relative_to\": \"scene\"}}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "selects none");
    assert_refused("{\"box\": {\"relative_to\": \"so_far\"}}", CIPC_E_OUT_OF_RANGE, "t.json:1:10 box.relative_to", "'so-far'");
}

static void test_rings(void **state)
{
    (void)state;
    assert_selected("{\"ring\": {\"end\": \"min\"}}", 3, (int[]){0, 3, 6});
    assert_selected("{\"ring\": {\"end\": \"max\"}}", 3, (int[]){2, 5, 8});
    assert_selected("{\"ring\": {\"axis\": [0, 0, 3], \"end\": \"max\"}}", 3, (int[]){6, 7, 8});
    assert_selected("{\"ring\": {\"axis\": [1, 0, 1], \"end\": \"min\"}}", 1, (int[]){0});
    assert_selected("{\"ring\": {\"axis\": [1, 0, 1], \"end\": \"min\", \"tolerance\": 0.3}}", 3, (int[]){0, 1, 3});
    assert_refused("{\"ring\": {\"axis\": [1, 0, 1]}}", CIPC_E_MISSING_KEY, "t.json:1:2 ring.end", "missing");
    assert_refused("{\"ring\": {\"end\": \"low\"}}", CIPC_E_OUT_OF_RANGE, "t.json:1:11 ring.end", "unknown end 'low'");
    assert_refused("{\"ring\": {\"end\": \"min\", \"axis\": [0, 0, 0]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:25 ring.axis", "not a direction");
    assert_refused("{\"ring\": {\"end\": \"min\", \"tolerance\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:25 ring.tolerance", "at least 0");
}

static void test_bounding_boxes(void **state)
{
    (void)state;
    static const double other[6] = {0, 7, 11, -2, 6, 11};
    scene_box a = scene_box_of(sheet, NODES), b = scene_box_of(other, 2), both = scene_box_around(&a, &b);
    assert_true(a.low[0] == -1 && a.high[0] == 1 && a.low[1] == 5 && a.high[1] == 5 && a.high[2] == 12);
    assert_true(both.low[0] == -2 && both.high[0] == 1 && both.low[1] == 5 && both.high[1] == 7 && both.low[2] == 10 && both.high[2] == 12);
}

static void test_lists_nearest_and_all(void **state)
{
    (void)state;
    assert_selected("{\"nodes\": [7, 1, 7]}", 2, (int[]){1, 7});
    assert_selected("{\"nearest\": [0.9, 0, 11.2]}", 1, (int[]){5});
    assert_selected("{\"nearest\": [0.5, 5, 10]}", 1, (int[]){1}); /* as near as node 2: the first of them */
    assert_selected("{\"all\": true}", 9, (int[]){0, 1, 2, 3, 4, 5, 6, 7, 8});
}

static void test_rejections(void **state)
{
    (void)state;
    assert_refused("{}", CIPC_E_MISSING_KEY, "t.json:1:1", "needs one of box, nodes, nearest, ring, all");
    assert_refused("{\"all\": true, \"nodes\": [1]}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "has 2 of");
    assert_refused("{\"nodes\": [1, 9]}", CIPC_E_OUT_OF_RANGE, "t.json:1:15 nodes.1", "is 9, but must be at least 0 and at most 8");
    assert_refused("{\"nodes\": [-1]}", CIPC_E_OUT_OF_RANGE, "t.json:1:12 nodes.0", "is -1");
    assert_refused("{\"nodes\": [1.0]}", CIPC_E_WRONG_TYPE, "t.json:1:12 nodes.0", "an integer");
    assert_refused("{\"nodes\": []}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "selects none of the body's 9 nodes");
    assert_refused("{\"box\": {\"min\": [0.1, 0, 0], \"max\": [0.4, 1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:1", "selects none");
    assert_refused("{\"box\": {\"min\": [0.5, 0, 0], \"max\": [0.4, 1, 1]}}", CIPC_E_OUT_OF_RANGE, "t.json:1:2 box", "an empty box");
    assert_refused("{\"box\": {\"tolerance\": -1}}", CIPC_E_OUT_OF_RANGE, "t.json:1:10 box.tolerance", "at least 0");
    assert_refused("{\"box\": {\"mix\": 1}}", CIPC_E_UNKNOWN_KEY, "t.json:1:10 box.mix", "'min'");
    assert_refused("{\"all\": false}", CIPC_E_WRONG_TYPE, "t.json:1:2 all", "must be true");
    assert_refused("{\"nearest\": 1}", CIPC_E_WRONG_TYPE, "t.json:1:2 nearest", "an array of 3 numbers");
    assert_refused("{\"sphere\": 1}", CIPC_E_UNKNOWN_KEY, "t.json:1:2 sphere", "nearest known key");
    assert_refused("[]", CIPC_E_WRONG_TYPE, "t.json:1:1", "an object");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_flat_directions),
        cmocka_unit_test(test_boxes_relative_to_other_bodies),
        cmocka_unit_test(test_rings),
        cmocka_unit_test(test_bounding_boxes),
        cmocka_unit_test(test_lists_nearest_and_all),
        cmocka_unit_test(test_rejections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
