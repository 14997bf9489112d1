/* Stitches and seams. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/failing_memory.h"
#include "support/scene_trial.h"

/* Two squares of four nodes each: a's are 0 to 3, b's 4 to 7. */
#define BODY(name) "{\"name\": \"" name "\", \"material\": \"wool\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}}"
#define SEWN(stitches) "{\"time_step\": 1, \"steps\": 1, \"bodies\": [" BODY("a") ", " BODY("b") "], \"stitches\": [" stitches "]}"

/* The scene's stitches are these, and again when it is loaded as resolved. */
static void assert_sewn(const char *text, int count, const cipc_stitching *want)
{
    cipc_scene *s = accept_scene(text, NULL), *t = accept_scene(s->resolved, NULL);
    assert_int_equal(s->model->stitch_count, count);
    assert_int_equal(t->model->stitch_count, count);
    for (int i = 0; i < count; i++) {
        const cipc_stitching *p = &s->model->stitches[i], *q = &t->model->stitches[i];
        assert_memory_equal(p->nodes, want[i].nodes, sizeof p->nodes);
        assert_memory_equal(q->nodes, want[i].nodes, sizeof q->nodes);
        assert_true(p->ratio == want[i].ratio && p->stiffness == want[i].stiffness);
        assert_true(q->ratio == want[i].ratio && q->stiffness == want[i].stiffness);
    }
    cipc_scene_destroy(s);
    cipc_scene_destroy(t);
}

static void test_no_stitches(void **state)
{
    (void)state;
    assert_sewn(SEWN(""), 0, NULL);
}

static void test_single_stitches(void **state)
{
    (void)state;
    const cipc_stitching want[] = {{{1, 4, 6}, 0.25, 10}, {{7, 2, 3}, 1, 1000}};
    assert_sewn(SEWN("{\"node\": {\"body\": \"a\", \"index\": 1}, \"edge\": {\"body\": \"b\", \"indices\": [0, 2]}, \"ratio\": 0.25}, "
                     "{\"name\": \"last\", \"node\": {\"body\": \"b\", \"index\": 3}, \"edge\": {\"body\": \"a\", \"indices\": [2, 3]}, \"ratio\": 1, "
                     "\"stiffness\": 1000}"),
                2, want);
}

/* Each node of a to the node of b beside it: ratio 0 to an edge that goes on along the row, or back from its end. */
static void test_seams(void **state)
{
    (void)state;
    const cipc_stitching want[] = {{{0, 4, 5}, 0, 10}, {{1, 5, 7}, 0, 10}, {{3, 7, 5}, 0, 10}};
    assert_sewn(SEWN("{\"body_a\": \"a\", \"nodes_a\": [0, 1, 3], \"body_b\": \"b\", \"nodes_b\": [0, 1, 3]}"), 3, want);
}

/* Gathers: many nodes to one. The edge's other end must be neither the node sewn to nor the node sewn. */
static void test_seams_that_gather(void **state)
{
    (void)state;
    const cipc_stitching gathered[] = {{{0, 4, 5}, 0, 7}, {{1, 4, 5}, 0, 7}, {{2, 5, 4}, 0, 7}};
    assert_sewn(SEWN("{\"body_a\": \"a\", \"nodes_a\": [0, 1, 2], \"body_b\": \"b\", \"nodes_b\": [0, 0, 1], \"stiffness\": 7}"), 3, gathered);
    const cipc_stitching closed[] = {{{1, 0, 2}, 0, 10}, {{3, 1, 2}, 0, 10}, {{0, 2, 1}, 0, 10}}; /* a body sewn to itself */
    assert_sewn(SEWN("{\"body_a\": \"a\", \"nodes_a\": [1, 3, 0], \"body_b\": \"a\", \"nodes_b\": [0, 1, 2]}"), 3, closed);
}

static void refuse(const char *stitches, cipc_status status, const char *path, const char *what)
{
    char text[2048];
    snprintf(text, sizeof text, "{\"time_step\": 1, \"steps\": 1, \"bodies\": [" BODY("a") ", " BODY("b") "], \"stitches\": %s}", stitches);
    reject_scene(text, NULL, status, path, what);
}

#define NODE "\"node\": {\"body\": \"a\", \"index\": 1}"
#define EDGE "\"edge\": {\"body\": \"b\", \"indices\": [0, 2]}"

static void test_rejections_of_single_stitches(void **state)
{
    (void)state;
    refuse("[@{" EDGE ", \"ratio\": 0}]", CIPC_E_MISSING_KEY, "stitches.0", "needs one of node, nodes_a");
    refuse("[@{" NODE ", \"ratio\": 0}]", CIPC_E_MISSING_KEY, "stitches.0.edge", "missing");
    refuse("[@{" NODE ", " EDGE "}]", CIPC_E_MISSING_KEY, "stitches.0.ratio", "missing");
    refuse("[{" NODE ", " EDGE ", @\"ratio\": 1.5}]", CIPC_E_OUT_OF_RANGE, "stitches.0.ratio", "at most 1");
    refuse("[{" NODE ", " EDGE ", \"ratio\": 1, @\"stiffness\": 0}]", CIPC_E_OUT_OF_RANGE, "stitches.0.stiffness", "greater than 0");
    refuse("[{\"node\": {\"body\": \"a\", @\"index\": 4}, " EDGE ", \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.node.index", "at most 3");
    refuse("[{\"node\": {@\"body\": \"c\", \"index\": 1}, " EDGE ", \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.node.body", "no body is called 'c'");
    refuse("[{@\"node\": {\"index\": 1}, " EDGE ", \"ratio\": 1}]", CIPC_E_MISSING_KEY, "stitches.0.node.body", "missing");
    refuse("[{\"name\": \"hem\", " NODE ", \"edge\": {\"body\": \"b\", \"indices\": [0, @4]}, \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE,
           "stitches.hem.edge.indices.1", "at most 3");
    refuse("[{" NODE ", \"edge\": {\"body\": \"b\", @\"indices\": [2, 2]}, \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.edge.indices",
           "the same node 2 twice");
    refuse("[{@" NODE ", \"edge\": {\"body\": \"a\", \"indices\": [0, 1]}, \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.node",
           "is an end of the edge");
    refuse("[{" NODE ", " EDGE ", \"ratio\": 1, @\"ration\": 1}]", CIPC_E_UNKNOWN_KEY, "stitches.0.ration", "'ratio'");
    refuse("[{" NODE ", " EDGE ", \"ratio\": 1, @\"nodes_b\": [1]}]", CIPC_E_UNKNOWN_KEY, "stitches.0.nodes_b", "unknown key");
    refuse("[@3]", CIPC_E_WRONG_TYPE, "stitches.0", "an object");
}

#define ROWS(a, b) "\"body_a\": \"a\", \"nodes_a\": [" a "], \"body_b\": \"b\", \"nodes_b\": [" b "]"

static void test_rejections_of_seams(void **state)
{
    (void)state;
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0, 1], \"body_b\": \"b\", @\"nodes_b\": [0, 1, 2]}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_b",
           "has 3 nodes, but nodes_a has 2");
    refuse("[{" ROWS("0, @4", "0, 1") "}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_a.1", "at most 3");
    refuse("[{\"body_a\": \"a\", @\"nodes_a\": [], \"body_b\": \"b\", \"nodes_b\": []}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_a", "at least 1");
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0], \"body_b\": \"b\", @\"nodes_b\": [0]}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_b",
           "needs a second node");
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0, @1, 2], \"body_b\": \"a\", \"nodes_b\": [3, 1, 0]}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_a.1",
           "is to be sewn to itself");
    refuse("[{" ROWS("0, 1", "0, 1") ", @\"ratio\": 0}]", CIPC_E_UNKNOWN_KEY, "stitches.0.ratio", "unknown key");
    refuse("[@{\"body_a\": \"a\", \"nodes_a\": [0, 1], \"body_b\": \"b\"}]", CIPC_E_MISSING_KEY, "stitches.0.nodes_b", "missing");
    refuse("[{@\"body_a\": \"c\", \"nodes_a\": [0, 1], \"body_b\": \"b\", \"nodes_b\": [0, 1]}]", CIPC_E_OUT_OF_RANGE, "stitches.0.body_a",
           "no body is called 'c'");
}

static void test_no_memory(void **state)
{
    (void)state;
    const char *text = SEWN("{" ROWS("0, 1", "0, 1") "}, {" NODE ", " EDGE ", \"ratio\": 0.5}");
    char *folder = make_folder(), *path = write_file(folder, "s.json", text, strlen(text));
    for (long n = 1;; n++) {
        cipc_scene *s;
        fail_allocation(n);
        cipc_status status = cipc_scene_load(&s, path, 0, NULL, NULL);
        bool failed = allocation_failed();
        if (!failed) {
            assert_int_equal(s->model->stitch_count, 3);
            cipc_scene_destroy(s);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(s);
    }
    fail_allocation(0);
    free(path);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_stitches),         cmocka_unit_test(test_single_stitches),
        cmocka_unit_test(test_seams),               cmocka_unit_test(test_seams_that_gather),
        cmocka_unit_test(test_rejections_of_seams), cmocka_unit_test(test_rejections_of_single_stitches),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
