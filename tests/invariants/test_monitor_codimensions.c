/* Monitors M2 and M5 on rods and particles: pairs of points and edges, rejected by one ulp, on the way too; pairs that the model lets pass, and nodes inside volumes, left out. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/invariant.h"
#include "support/hand_model.h"

/* Thickness of both bodies; pairs need more. */
static const double offset = 0.25;

typedef struct trial {
    hand_model *h;
    cipc_monitor *monitor;
    cipc_invariant_report report;
    cipc_error error;
} trial;

static void start(trial *t)
{
    t->h = hand_model_create();
    for (int b = 0; b < 2; b++) hand_body(t->h, b ? "second" : "first", offset, 0, false);
}

static void open_monitor(trial *t)
{
    assert_int_equal(cipc_monitor_create(&t->monitor, &t->h->model, NULL, &t->error), CIPC_OK);
}

static void end(trial *t)
{
    cipc_monitor_destroy(t->monitor);
    hand_model_destroy(t->h);
}

static cipc_status check(trial *t) { return cipc_monitor_check(t->monitor, t->h->x, &t->report, &t->error); }

static void make_segment(trial *t, int body, double height)
{
    int a = hand_node(t->h, body, -1, height, 0), b = hand_node(t->h, body, 1, height, 0);
    cipc_model *m = &t->h->model;
    m->bodies[body].kind = CIPC_BODY_RODS;
    hand_edge(t->h, a, b);
    m->segment_count++;
}

/* A particle above the inside of a segment. */
static void make_point_edge(trial *t, double height)
{
    start(t);
    t->h->model.bodies[0].kind = CIPC_BODY_PARTICLES;
    hand_node(t->h, 0, 0.125, height, 0);
    make_segment(t, 1, 0);
    open_monitor(t);
}

static void make_point_point(trial *t, double height)
{
    start(t);
    for (int b = 0; b < 2; b++) t->h->model.bodies[b].kind = CIPC_BODY_PARTICLES;
    hand_node(t->h, 0, 0, height, 0);
    hand_node(t->h, 1, 0, 0, 0);
    open_monitor(t);
}

static void (*const makers[2])(trial *, double) = {make_point_edge, make_point_point};

static void test_one_ulp_decides(void **state)
{
    (void)state;
    static const char *const words[2] = {"segment", "and node"};
    for (int kind = 0; kind < 2; kind++) {
        trial t;
        makers[kind](&t, nextafter(offset, 1));
        assert_int_equal(check(&t), CIPC_OK);
        assert_true(t.report.min_gap == nextafter(offset, 1) - offset);
        assert_int_equal(t.report.min_gap_kind, kind == 0 ? CIPC_POINT_EDGE : CIPC_POINT_POINT);
        assert_true(t.report.min_gap_nodes[0] == 0 && t.report.min_gap_nodes[1] == 1 && t.report.min_gap_nodes[3] == -1);
        t.h->x[1] = offset;
        assert_int_equal(check(&t), CIPC_E_VIOLATED_GAP);
        assert_non_null(strstr(t.error.what, words[kind]));
        t.h->x[1] = 0;
        assert_int_equal(check(&t), CIPC_E_VIOLATED_GAP);
        end(&t);
    }
}

/* Far enough at both ends, not on the way. */
static void test_on_the_way(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        trial t;
        double to[9];
        makers[kind](&t, 2);
        memcpy(to, t.h->x, 3 * (size_t)t.h->model.node_count * sizeof *to);
        to[1] = -2;
        assert_int_equal(cipc_monitor_swept(t.monitor, t.h->x, to, &t.report, &t.error), CIPC_E_VIOLATED_SWEPT);
        to[1] = nextafter(offset, 1);
        assert_int_equal(cipc_monitor_swept(t.monitor, t.h->x, to, &t.report, &t.error), CIPC_OK);
        to[1] = offset;
        assert_int_equal(cipc_monitor_swept(t.monitor, t.h->x, to, &t.report, &t.error), CIPC_E_VIOLATED_SWEPT);
        end(&t);
    }
}

/* Bodies that are set apart, and nodes that are sewn together, are not looked at. */
static void test_pairs_that_do_not_meet(void **state)
{
    (void)state;
    trial t;
    bool apart[4] = {false, true, true, false};
    make_point_edge(&t, 0.1);
    cipc_monitor_destroy(t.monitor);
    t.h->model.pair_apart = apart;
    open_monitor(&t);
    assert_int_equal(check(&t), CIPC_OK);
    cipc_monitor_destroy(t.monitor);
    t.h->model.pair_apart = NULL;
    int links[2][2] = {{0, 2}, {2, 0}};
    t.h->model.links = links;
    t.h->model.link_count = 2;
    open_monitor(&t);
    assert_int_equal(check(&t), CIPC_OK);
    cipc_monitor_destroy(t.monitor);
    t.h->model.link_count = 0;
    open_monitor(&t);
    assert_int_equal(check(&t), CIPC_E_VIOLATED_GAP);
    end(&t);
}

/* A node that nothing touches may be anywhere; the same node on a surface may not. */
static void test_inner_nodes(void **state)
{
    (void)state;
    trial t;
    const double triangle[9] = {-1, 0, -1, 1, 0, -1, 0, 0, 1};
    start(&t);
    hand_node(t.h, 0, 0, 0.1, 0);
    hand_new_triangle(t.h, 1, triangle);
    bool interior[4] = {true, false, false, false};
    t.h->model.interior = interior;
    open_monitor(&t);
    assert_int_equal(check(&t), CIPC_OK);
    cipc_monitor_destroy(t.monitor);
    interior[0] = false;
    open_monitor(&t);
    assert_int_equal(check(&t), CIPC_E_VIOLATED_GAP);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_ulp_decides),
        cmocka_unit_test(test_on_the_way),
        cmocka_unit_test(test_pairs_that_do_not_meet),
        cmocka_unit_test(test_inner_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
