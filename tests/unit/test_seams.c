/* Stitches and seams. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/failing_memory.h"
#include "support/scene_trial.h"

/* Two squares of four nodes each: a's are 0 to 3, b's 4 to 7. */
#define BODY(name)     "{\"name\": \"" name "\", \"material\": \"wool\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}}"
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
                     "{\"name\": \"last\", \"node\": {\"body\": \"b\", \"index\": 3}, \"edge\": {\"body\": \"a\", \"indices\": [2, 3]}, "
                     "\"ratio\": 1, "
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
    assert_sewn(SEWN("{\"body_a\": \"a\", \"nodes_a\": [0, 1, 2], \"body_b\": \"b\", \"nodes_b\": [0, 0, 1], \"stiffness\": 7}"), 3,
                gathered);
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
    refuse("[@{" EDGE ", \"ratio\": 0}]", CIPC_E_MISSING_KEY, "stitches.0", "needs one of node, nodes_a, side_a");
    refuse("[@{" NODE ", \"ratio\": 0}]", CIPC_E_MISSING_KEY, "stitches.0.edge", "missing");
    refuse("[@{" NODE ", " EDGE "}]", CIPC_E_MISSING_KEY, "stitches.0.ratio", "missing");
    refuse("[{" NODE ", " EDGE ", @\"ratio\": 1.5}]", CIPC_E_OUT_OF_RANGE, "stitches.0.ratio", "at most 1");
    refuse("[{" NODE ", " EDGE ", \"ratio\": 1, @\"stiffness\": 0}]", CIPC_E_OUT_OF_RANGE, "stitches.0.stiffness", "greater than 0");
    refuse("[{\"node\": {\"body\": \"a\", @\"index\": 4}, " EDGE ", \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.node.index",
           "at most 3");
    refuse("[{\"node\": {@\"body\": \"c\", \"index\": 1}, " EDGE ", \"ratio\": 1}]", CIPC_E_OUT_OF_RANGE, "stitches.0.node.body",
           "no body is called 'c'");
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

/* A skirt of two panels, each with nodes 0 1 2 at the top and 3 4 5 below (then 6 to 11), a band of one panel 5 mm above it, whose six upper and
 * six lower nodes (12 to 18, 19 to 25) begin and end at +x. */
#define GARMENT(name, gores, y)                                                                                                            \
    "{\"name\": \"" name "\", \"material\": \"wool\", \"shell\": {\"gores\": " gores "}, \"transform\": {\"translate\": [0, " y ", 0]}}"
#define SKIRT                       GARMENT("skirt", "{\"panels\": 2, \"top\": 1, \"bottom\": 2, \"height\": 1, \"cells\": [2, 1]}", "0")
#define BAND                        GARMENT("band", "{\"top\": 1, \"bottom\": 1, \"height\": 0.1, \"cells\": [6, 1]}", "0.105")
#define DRESS(stitches)             "{\"time_step\": 1, \"steps\": 1, \"bodies\": [" SKIRT ", " BAND ", " BODY("a") "], \"stitches\": [" stitches "]}"
#define SIDES(a, side_a, b, side_b) "\"body_a\": \"" a "\", \"side_a\": \"" side_a "\", \"body_b\": \"" b "\", \"side_b\": \"" side_b "\""

/* Every panel's right side to the next one's left, the last one's to the first one's: the sides start at the same place, so ratios are 0 and 1. */
static void test_sides_of_one_garment(void **state)
{
    (void)state;
    const cipc_stitching want[] = {{{2, 6, 9}, 0, 1000}, {{5, 6, 9}, 1, 1000}, {{8, 0, 3}, 0, 1000}, {{11, 0, 3}, 1, 1000}};
    assert_sewn(DRESS("{" SIDES("skirt", "right", "skirt", "left") ", \"stiffness\": 1000}"), 4, want);
}

/* The skirt's top corners lie a quarter turn apart, the band's a sixth: (0, 0, -1) is below the middle of the band's second edge. The skirt's own
 * nodes at +x and -x each occur in both panels. */
static void test_sides_of_different_resolution(void **state)
{
    (void)state;
    static const int edges[6] = {19, 20, 21, 21, 23, 19};
    static const double ratios[6] = {0, 0.5, 1, 1, 0.5, 0};
    cipc_scene *s = accept_scene(DRESS("{" SIDES("skirt", "top", "band", "bottom") "}"), NULL);
    assert_int_equal(s->model->stitch_count, 6);
    for (int i = 0; i < 6; i++) {
        const cipc_stitching *p = &s->model->stitches[i];
        assert_int_equal(p->nodes[0], i < 3 ? i : i + 3);
        assert_true(p->nodes[1] == edges[i] && p->nodes[2] == edges[i] + 1);
        assert_true(fabs(p->ratio - ratios[i]) < 1e-14 && p->stiffness == 10);
    }
    cipc_scene_destroy(s);
}

/* Two sides of one panel share a corner, which is sewn to an edge that it is no end of: here the last one, where the band closes. */
static void test_sides_that_share_a_corner(void **state)
{
    (void)state;
    const cipc_stitching want[] = {{{12, 17, 18}, 1, 10}, {{19, 12, 13}, 0, 10}};
    assert_sewn(DRESS("{" SIDES("band", "left", "band", "top") "}"), 2, want);
}

static void refuse_sides(const char *seam, cipc_status status, const char *path, const char *what)
{
    char text[2048];
    snprintf(text, sizeof text, DRESS("%s"), seam);
    reject_scene(text, NULL, status, path, what);
}

static void test_rejections_of_sides(void **state)
{
    (void)state;
    refuse_sides("{" SIDES("skirt", "left", "skirt", "left") "}", CIPC_E_OUT_OF_RANGE, "stitches.0.side_b",
                 "is the side that is to be sewn to it");
    refuse_sides("{" SIDES("skirt", "left", "a", "top") "}", CIPC_E_OUT_OF_RANGE, "stitches.0.body_b",
                 "'a' has no sides: only gores and pleats");
    refuse_sides("{" SIDES("skirt", "hem", "band", "top") "}", CIPC_E_OUT_OF_RANGE, "stitches.0.side_a", "unknown side 'hem'");
    refuse_sides("{" SIDES("skirts", "top", "band", "top") "}", CIPC_E_OUT_OF_RANGE, "stitches.0.body_a", "no body is called 'skirts'");
    refuse_sides("{\"body_a\": \"skirt\", \"side_a\": \"top\", \"body_b\": \"band\"}", CIPC_E_MISSING_KEY, "stitches.0.side_b", "missing");
    refuse_sides("{" SIDES("skirt", "top", "band", "top") ", \"ratio\": 0}", CIPC_E_UNKNOWN_KEY, "stitches.0.ratio", "unknown key");
    refuse_sides("{" SIDES("skirt", "top", "band", "top") ", \"nodes_a\": [1]}", CIPC_E_OUT_OF_RANGE, "stitches.0",
                 "has 2 of node, nodes_a, side_a");
    refuse_sides("{" SIDES("band", "top", "band", "left") "}", CIPC_E_OUT_OF_RANGE, "stitches.0", "belongs to all of the side");
}

#define ROWS(a, b) "\"body_a\": \"a\", \"nodes_a\": [" a "], \"body_b\": \"b\", \"nodes_b\": [" b "]"

static void test_rejections_of_seams(void **state)
{
    (void)state;
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0, 1], \"body_b\": \"b\", @\"nodes_b\": [0, 1, 2]}]", CIPC_E_OUT_OF_RANGE,
           "stitches.0.nodes_b", "has 3 nodes, but nodes_a has 2");
    refuse("[{" ROWS("0, @4", "0, 1") "}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_a.1", "at most 3");
    refuse("[{\"body_a\": \"a\", @\"nodes_a\": [], \"body_b\": \"b\", \"nodes_b\": []}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_a",
           "at least 1");
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0], \"body_b\": \"b\", @\"nodes_b\": [0]}]", CIPC_E_OUT_OF_RANGE, "stitches.0.nodes_b",
           "needs a second node");
    refuse("[{\"body_a\": \"a\", \"nodes_a\": [0, @1, 2], \"body_b\": \"a\", \"nodes_b\": [3, 1, 0]}]", CIPC_E_OUT_OF_RANGE,
           "stitches.0.nodes_a.1", "is to be sewn to itself");
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
        cmocka_unit_test(test_no_stitches),
        cmocka_unit_test(test_single_stitches),
        cmocka_unit_test(test_seams),
        cmocka_unit_test(test_seams_that_gather),
        cmocka_unit_test(test_rejections_of_seams),
        cmocka_unit_test(test_rejections_of_single_stitches),
        cmocka_unit_test(test_no_memory),
        cmocka_unit_test(test_sides_of_one_garment),
        cmocka_unit_test(test_sides_of_different_resolution),
        cmocka_unit_test(test_sides_that_share_a_corner),
        cmocka_unit_test(test_rejections_of_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
