/* Monitor M5 for paths with breaks: what happens while every node turns at times of its own. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/invariant.h"
#include "cipc/oracle.h"
#include "support/failing_memory.h"
#include "support/monitor_scene.h"
#include "support/plain_monitor.h"

enum { MOST_NUMBERS = 3000, MOST_BREAKS = 6000 };

/* Paths from h->x, to begin with of nodes that stay where they are. */
typedef struct window {
    const hand_model *h;
    cipc_paths paths;
    double to[MOST_NUMBERS];
    cipc_path_break breaks[MOST_BREAKS];
} window;

static window *open_window(const hand_model *h, double begin, double end)
{
    window *w = malloc(sizeof *w);
    assert_non_null(w);
    assert_in_range(3 * h->model.node_count, 1, MOST_NUMBERS);
    memcpy(w->to, h->x, 3 * (size_t)h->model.node_count * sizeof *w->to);
    w->h = h;
    w->paths = (cipc_paths){.begin = begin, .end = end, .node_count = h->model.node_count, .from = h->x, .to = w->to, .breaks = w->breaks};
    return w;
}

/* Add a break after those that are not later. */
static void add_break(window *w, double time, int node, double x, double y, double z)
{
    assert_in_range(w->paths.break_count, 0, MOST_BREAKS - 1);
    long b = w->paths.break_count++;
    for (; b > 0 && w->breaks[b - 1].time > time; b--) { w->breaks[b] = w->breaks[b - 1]; }
    w->breaks[b] = (cipc_path_break){time, node, {x, y, z}};
}

/* A break by so much away from where the node is at the begin. */
static void move_away(window *w, double time, int node, double x, double y, double z)
{
    const double *at = &w->h->x[3 * node];
    add_break(w, time, node, at[0] + x, at[1] + y, at[2] + z);
}

static void end_at(window *w, int node, double x, double y, double z)
{
    w->to[3 * node] = x;
    w->to[3 * node + 1] = y;
    w->to[3 * node + 2] = z;
}

typedef struct trial {
    cipc_status status;
    cipc_invariant_report report;
    cipc_error error;
} trial;

/* A new monitor looks at the window. */
static trial look(const window *w, int threads)
{
    trial t;
    cipc_monitor *monitor;
    cipc_invariant_options options = cipc_invariant_options_default();
    options.threads = threads;
    cipc_invariant_report_init(&t.report);
    t.error.what[0] = '\0';
    t.status = cipc_monitor_create(&monitor, &w->h->model, &options, &t.error);
    if (t.status == CIPC_OK) { t.status = cipc_monitor_paths(monitor, &w->paths, &t.report, &t.error); }
    cipc_monitor_destroy(monitor);
    return t;
}

/* And the other monitor at its ends alone. */
static trial look_at_ends(const window *w)
{
    trial t;
    cipc_monitor *monitor;
    cipc_invariant_report_init(&t.report);
    t.status = cipc_monitor_create(&monitor, &w->h->model, NULL, &t.error);
    if (t.status == CIPC_OK) { t.status = cipc_monitor_swept(monitor, w->paths.from, w->paths.to, &t.report, &t.error); }
    cipc_monitor_destroy(monitor);
    return t;
}

static void expect_clear(const window *w)
{
    trial t = look(w, 1);
    if (t.status != CIPC_OK) { fail_msg("not clear: %s", t.error.what); }
}

/* Violated at just this time, %.17g. */
static void expect_violation(const window *w, const char *time)
{
    trial t = look(w, 1);
    char text[80];
    snprintf(text, sizeof text, "at the time %s s", time);
    assert_int_equal(t.status, CIPC_E_VIOLATED_SWEPT);
    if (strstr(t.error.what, text) == NULL) { fail_msg("not %s: %s", text, t.error.what); }
}

/* A point (node 3) above a triangle, thickness xi. */
static hand_model *point_over_triangle(double xi, double height)
{
    hand_model *h = hand_model_create();
    int sheet = hand_body(h, "sheet", xi, 0, false), dust = hand_body(h, "dust", xi, 0, false);
    hand_new_triangle(h, sheet, (const double[9]){0, 0, 0, 1, 0, 0, 0, 1, 0});
    hand_node(h, dust, 0.25, 0.25, height);
    return h;
}

/* The point dips through the triangle and comes back: nothing has happened at the ends. So does the triangle, all of it or one corner, past the point; and a dip
 * beside the triangle is none. */
static void test_dips_are_rejected(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1);
    window *w = open_window(h, 10, 12);
    move_away(w, 10.5, 3, 0, 0, -2);
    move_away(w, 11, 3, 0, 0, 0);
    assert_int_equal(look_at_ends(w).status, CIPC_OK);
    expect_violation(w, "10.25");
    trial t = look(w, 1);
    assert_non_null(strstr(t.error.what, "node 3 (body \"dust\") and triangle (nodes 0 1 2, body \"sheet\")"));
    assert_true(t.report.paths_checked >= 1 && t.report.exact_path_checks >= 1);
    w->paths.break_count = 0;
    move_away(w, 11, 3, 0, 0, -4); /* at the end of four metres in one second */
    expect_violation(w, "10.25");
    w->paths.break_count = 0;
    move_away(w, 10.5, 3, 2, 0, -2);
    expect_clear(w);
    w->paths.break_count = 0;
    for (int i = 0; i < 3; i++) { move_away(w, 11, i, 0, 0, 2); }
    expect_violation(w, "10.5");
    w->paths.break_count = 0;
    move_away(w, 11, 0, 0, 0, 4); /* the corner at the origin weighs a half at the point's foot */
    expect_violation(w, "10.5");
    free(w);
    hand_model_destroy(h);
}

/* The dip is at the very beginning or at the very end of a long walk. */
static void test_dips_anywhere_in_a_walk(void **state)
{
    (void)state;
    enum { BREAKS = 256 };
    hand_model *h = point_over_triangle(0, 1);
    for (int dip = 0; dip < BREAKS; dip += 51) {
        window *w = open_window(h, 0, 1);
        for (int b = 0; b < BREAKS; b++) {
            move_away(w, (b + 0.5) / BREAKS, b == dip ? 3 : b % 4, 0, 0, b == dip ? -1.5 : 0.001 * (b % 3));
            if (b == dip) { move_away(w, (b + 0.75) / BREAKS, 3, 0, 0, 0); }
        }
        trial t = look(w, 1);
        assert_int_equal(t.status, CIPC_E_VIOLATED_SWEPT);
        const char *at = strstr(t.error.what, "at the time ");
        assert_non_null(at);
        double time = strtod(at + strlen("at the time "), NULL);
        assert_true(time < (dip + 0.5) / BREAKS && time > (dip - 6) / (double)BREAKS);
        free(w);
    }
    hand_model_destroy(h);
}

/* The point comes down to a height above xi and turns: by 1e-9 and by one ulp more than xi it passes, at xi exactly and below it does not. At 0.3 s, which no instant
 * of the slices is, and with a corner of the triangle that has breaks of its own. */
static void test_turns(void **state)
{
    (void)state;
    for (int n = 0; n < 4; n++) {
        double xi = n % 2 == 0 ? 0 : 0.25;
        const double turns[] = {xi + 1e-9, xi + 4 * DBL_EPSILON, nextafter(xi, 1), xi, nextafter(xi, -1), xi - 1e-9};
        for (int i = 0; i < 6; i++) {
            hand_model *h = point_over_triangle(xi, 1);
            window *w = open_window(h, 0, 1);
            add_break(w, 0.3, 3, 0.25, 0.25, turns[i]);
            if (n >= 2) {
                for (int b = 1; b < 10; b++) { move_away(w, 0.1 * b, 0, -0.01 * b, 0, 0); }
            }
            trial t = look(w, 1);
            assert_int_equal(t.status, i < 3 ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
            if (i == 3) { expect_violation(w, "0.29999999999999999"); }
            free(w);
            hand_model_destroy(h);
        }
    }
}

/* Edge a (nodes 0, 1) comes down through the place where b (nodes 2, 3) lies at first; b goes aside. */
static hand_model *crossing_edges(void)
{
    hand_model *h = hand_model_create();
    int a = hand_body(h, "a", 0, 0, false), b = hand_body(h, "b", 0, 0, false);
    int first = hand_node(h, a, -1, 0, 1);
    hand_edge(h, first, hand_node(h, a, 1, 0, 1));
    int second = hand_node(h, b, 0, -1, 0);
    hand_edge(h, second, hand_node(h, b, 0, 1, 0));
    return h;
}

/* Moves of the two edges that begin and end at times of their own. */
static window *crossing_window(const hand_model *h, double down, double down_end, double aside, double aside_end, double how_far)
{
    window *w = open_window(h, 0, 1);
    end_at(w, 0, -1, 0, -1);
    end_at(w, 1, 1, 0, -1);
    end_at(w, 2, how_far, -1, 0);
    end_at(w, 3, how_far, 1, 0);
    for (int i = 0; i < 2; i++) {
        if (down > 0) { add_break(w, down, i, i == 0 ? -1 : 1, 0, 1); }
        if (down_end < 1) { add_break(w, down_end, i, i == 0 ? -1 : 1, 0, -1); }
        if (aside > 0) { add_break(w, aside, 2 + i, 0, i == 0 ? -1 : 1, 0); }
        if (aside_end < 1) { add_break(w, aside_end, 2 + i, how_far, i == 0 ? -1 : 1, 0); }
    }
    return w;
}

/* The same places in the same order: only when each edge goes there makes the difference. */
static void test_timing_decides(void **state)
{
    (void)state;
    hand_model *h = crossing_edges();
    struct {
        double down, down_end, aside, aside_end, how_far;
        const char *time; /* NULL: clear */
    } cases[] = {
        {0, 1, 0, 1, 1.5, "0.5"},          /* together: b is at 0.75 when a comes through */
        {0.5, 1, 0, 0.5, 1.5, NULL},       /* b first */
        {0.25, 0.75, 0, 0.5, 1.5, NULL},   /* b at 1.5 when a comes through */
        {0.25, 0.75, 0.25, 0.75, 1.5, "0.5"},
        {0, 1, 0, 1, 3, NULL},             /* together, further: b is at 1.5 */
        {0, 1, 0.25, 1, 3, "0.5"},         /* b at 1 exactly, (0.5 - 0.25)/0.75 3: touching counts */
        {0, 1, 0x1.fffffffffffffp-3, 1, 3, NULL}, /* b a hair further */
        {0, 1, 0.375, 1, 3, "0.5"},        /* b too late */
        {0, 0.5, 0.5, 1, 3, "0.25"},       /* a first */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        window *w = crossing_window(h, cases[i].down, cases[i].down_end, cases[i].aside, cases[i].aside_end, cases[i].how_far);
        if (cases[i].time == NULL) { expect_clear(w); }
        else { expect_violation(w, cases[i].time); }
        bool straight_clear = cases[i].how_far == 3;
        assert_int_equal(look_at_ends(w).status, straight_clear ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        free(w);
    }
    hand_model_destroy(h);
}

/* The edges cross in space a hair's breadth apart in time: the second one's end leaves the place of crossing just before, or just after, the first one is there.
 * The places in between are thirds and sevenths. */
static void test_timing_by_a_hair(void **state)
{
    (void)state;
    hand_model *h = crossing_edges();
    for (int late = 0; late < 2; late++) {
        window *w = open_window(h, 0, 21);
        for (int i = 0; i < 2; i++) { /* a is at z = 1 - 2t/7, so at 0 at 3.5 */
            end_at(w, i, i == 0 ? -1 : 1, 0, -1);
            add_break(w, 7, i, i == 0 ? -1 : 1, 0, -1);
        }
        /* b's ends at x = 1.5 at one third of its way of 4.5: beyond a's end, x = 1, from 7/3 on if it starts at 0; delayed by 7/6 it is there with a. */
        double delay = 7.0 / 6 + (late ? 1e-15 : -1e-14);
        for (int i = 2; i < 4; i++) {
            double y = i == 2 ? -1 : 1;
            end_at(w, i, 4.5, y, 0);
            add_break(w, delay, i, 0, y, 0);
            add_break(w, delay + 10.5, i, 4.5, y, 0);
        }
        trial t = look(w, 1); /* at 3.5 b is at 4.5 (3.5 - delay)/10.5 = 1 - 3/7 (delay - 7/6) */
        assert_int_equal(t.status, late ? CIPC_E_VIOLATED_SWEPT : CIPC_OK);
        free(w);
    }
    hand_model_destroy(h);
}

/* Far from the origin places between breaks are rounded by more than what the separation's own bound allows for: a particle passes another on a slope, nearer than xi
 * by very little, or further. What is between the ends of a piece decides, and rounded ends are of no help. */
static void test_rounded_places(void **state)
{
    (void)state;
    uint64_t seed = 23;
    const double far = 0x1p20, aside = 0.25, nearest = aside * 2 / sqrt(5);
    for (int n = 0; n < 200; n++) {
        bool inside = n % 4 != 0;
        double xi = nearest * (inside ? 1 + 1e-12 : 1 - 1e-12);
        hand_model *h = hand_model_create();
        int a = hand_body_of(h, CIPC_BODY_PARTICLES, "a", xi, false), b = hand_body_of(h, CIPC_BODY_PARTICLES, "b", xi, false);
        hand_node(h, a, far - 1, far - 0.5 + aside, 0);
        hand_node(h, b, far, far, 0);
        window *w = open_window(h, 0, 1);
        end_at(w, 0, far + 1, far + 0.5 + aside, 0);
        for (int i = -1; i <= 1; i += 2) { add_break(w, 0.45 + 1e-6 * i * random_uniform(&seed, 0.1, 1), 1, far, far, 0); } /* nearest at 0.45 */
        assert_int_equal(look(w, 1).status, inside ? CIPC_E_VIOLATED_SWEPT : CIPC_OK);
        free(w);
        hand_model_destroy(h);
    }
}

/* An instant only: what touches then is violated, what does not is not. */
static void test_instant(void **state)
{
    (void)state;
    for (int touching = 0; touching < 2; touching++) {
        hand_model *h = point_over_triangle(0.25, touching ? 0.25 : 0.5);
        window *w = open_window(h, 3, 3);
        if (touching) { expect_violation(w, "3"); }
        else { expect_clear(w); }
        for (int i = 0; i < 10; i++) { move_away(w, 3, 3, 0, 0, 0); }
        if (touching) { expect_violation(w, "3"); }
        else { expect_clear(w); }
        free(w);
        hand_model_destroy(h);
    }
}

/* Breaks at the ends of the window, at one time, by one ulp inside, and many at one instant of all nodes. */
static void test_breaks_at_the_ends(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1);
    window *w = open_window(h, 0, 1);
    for (int node = 0; node < 4; node++) {
        move_away(w, 0, node, 0, 0, 0);
        move_away(w, 0x1p-1074, node, 0, 0, 0);
        move_away(w, 0.5, node, 0.1, 0, 0.1 * node);
        move_away(w, 0.5, node, 0.1, 0, 0.1 * node);
        move_away(w, nextafter(1, 0), node, 0, 0, 0);
        move_away(w, 1, node, 0, 0, 0);
    }
    expect_clear(w);
    move_away(w, nextafter(0.5, 1), 3, 0.1, 0, -2); /* down within an ulp of time */
    expect_violation(w, "0.5");
    free(w);
    hand_model_destroy(h);
}

/* Coordinates and times at the ends of their range: no direction is trusted, exact arithmetic decides. */
static void test_extreme_numbers(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int a = hand_body_of(h, CIPC_BODY_PARTICLES, "a", 1, false), b = hand_body_of(h, CIPC_BODY_PARTICLES, "b", 1, false);
    hand_node(h, a, -1.5e308, 0.875, 0.875);
    hand_node(h, b, 0, 0, 0);
    for (int hits = 0; hits < 2; hits++) {
        window *w = open_window(h, -0x1p1021, 0x1p1021);
        end_at(w, 0, 1.5e308, 0.875, 0.875);
        add_break(w, 0, 0, 0, hits ? 0.25 : 0.875, 0.875);
        trial t = look(w, 1);
        assert_int_equal(t.status, hits ? CIPC_E_VIOLATED_SWEPT : CIPC_OK);
        assert_int_equal(t.report.exact_path_checks, 1);
        free(w);
    }
    hand_model_destroy(h);
    h = point_over_triangle(0, 0x1p-1070);
    window *w = open_window(h, 0, 0x1p-1060);
    expect_clear(w);
    move_away(w, 0x1p-1061, 3, 0, 0, -0x1p-1069);
    expect_violation(w, "2.0236928853657458e-320");
    free(w);
    hand_model_destroy(h);
}

static void expect_status(window *w, cipc_status status, const char *what)
{
    trial t = look(w, 1);
    assert_int_equal(t.status, status);
    if (strstr(t.error.what, what) == NULL) { fail_msg("not %s: %s", what, t.error.what); }
}

static void test_malformed(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1);
    window *w = open_window(h, 0, 1);
    const cipc_path_break good[2] = {{0.25, 3, {0.25, 0.25, 2}}, {0.5, 0, {0, 0, 0}}};
    struct {
        cipc_path_break first, second;
        cipc_status status;
        const char *what;
    } cases[] = {
        {good[0], good[1], CIPC_OK, ""},
        {good[1], good[0], CIPC_E_OUT_OF_RANGE, "break 1 is at 0.25 s"},
        {good[0], {1.5, 0, {0, 0, 0}}, CIPC_E_OUT_OF_RANGE, "break 1 is at 1.5 s"},
        {{-0.5, 0, {0, 0, 0}}, good[1], CIPC_E_OUT_OF_RANGE, "break 0 is at -0.5 s"},
        {good[0], {0.5, 4, {0, 0, 0}}, CIPC_E_OUT_OF_RANGE, "break 1 is of node 4"},
        {{0.5, -1, {0, 0, 0}}, good[1], CIPC_E_OUT_OF_RANGE, "break 0 is of node -1"},
        {good[0], {0.25, 3, {0.25, 0.25, 3}}, CIPC_E_OUT_OF_RANGE, "node 3 is at two places"},
        {good[0], {1, 0, {0, 0, 1}}, CIPC_E_OUT_OF_RANGE, "node 0 is at two places"},
        {{0, 3, {0.25, 0.25, 2}}, good[1], CIPC_E_OUT_OF_RANGE, "node 3 is at two places"},
        {good[0], {NAN, 0, {0, 0, 0}}, CIPC_E_VIOLATED_FINITE, "break 1, of node 0"},
        {good[0], {INFINITY, 0, {0, 0, 0}}, CIPC_E_VIOLATED_FINITE, "break 1, of node 0"},
        {good[0], {0.5, 0, {0, NAN, 0}}, CIPC_E_VIOLATED_FINITE, "break 1, of node 0 of body \"sheet\""},
        {{0.5, 3, {0, 0, -INFINITY}}, good[1], CIPC_E_VIOLATED_FINITE, "break 0, of node 3"},
    };
    w->paths.break_count = 2;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        w->breaks[0] = cases[i].first;
        w->breaks[1] = cases[i].second;
        expect_status(w, cases[i].status, cases[i].what);
    }
    w->paths.break_count = 0;
    const cipc_paths paths = w->paths;
    w->paths.begin = 2;
    expect_status(w, CIPC_E_OUT_OF_RANGE, "begin at 2 s and end at 1 s");
    w->paths = paths;
    w->paths.begin = NAN;
    expect_status(w, CIPC_E_VIOLATED_FINITE, "begin at time");
    w->paths = paths;
    w->paths.end = INFINITY;
    expect_status(w, CIPC_E_VIOLATED_FINITE, "end at inf");
    w->paths.begin = -(w->paths.end = DBL_MAX);
    expect_status(w, CIPC_E_OUT_OF_RANGE, "begin at");
    w->paths = paths;
    w->paths.node_count = 3;
    expect_status(w, CIPC_E_OUT_OF_RANGE, "paths of 3 nodes");
    w->paths = paths;
    w->paths.break_count = -1;
    expect_status(w, CIPC_E_OUT_OF_RANGE, "-1 breaks");
    w->paths = paths;
    w->paths.begin = w->paths.end = 0;
    w->to[2] = 1;
    expect_status(w, CIPC_E_OUT_OF_RANGE, "node 0 is at two places");
    w->paths = paths;
    w->to[2] = NAN;
    expect_status(w, CIPC_E_VIOLATED_FINITE, "coordinate z of node 0");
    w->to[2] = 0;
    h->x[7] = INFINITY;
    expect_status(w, CIPC_E_VIOLATED_FINITE, "coordinate y of node 2");
    free(w);
    hand_model_destroy(h);
}

/* Lists kept from an earlier look serve if no break is further than half their margin from where they were made; else the pair that meets is on none of them. */
static void test_kept_lists(void **state)
{
    (void)state;
    const double heights[3] = {1e-4, 0.9, 0.9}, dips[3] = {-2e-4, -0.8, -1}; /* near: served; far: above the sheet; far: through it */
    for (int n = 0; n < 3; n++) {
        hand_model *h = point_over_triangle(0, heights[n]);
        window *w = open_window(h, 0, 1);
        cipc_monitor *monitor;
        cipc_error error;
        cipc_invariant_report report;
        assert_int_equal(cipc_monitor_create(&monitor, &h->model, NULL, &error), CIPC_OK);
        assert_int_equal(cipc_monitor_check(monitor, h->x, &report, &error), CIPC_OK);
        assert_int_equal(cipc_monitor_paths(monitor, &w->paths, &report, &error), CIPC_OK);
        assert_int_equal(report.paths_checked, n == 0 ? 1 : 0);
        move_away(w, 0.5, 3, 0, 0, dips[n]);
        assert_int_equal(cipc_monitor_paths(monitor, &w->paths, &report, &error), n == 1 ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        cipc_monitor_destroy(monitor);
        free(w);
        hand_model_destroy(h);
    }
}

/* --- random paths --- */

static bool is_fixed(const hand_model *h, int node) { return h->model.bodies[h->model.node_body[node]].fixed; }

/* Without breaks: the verdict, and the number of pairs, are those of the other monitor; from 0 s to 1 s times are the parts of the path that it names. */
static void test_without_breaks(void **state)
{
    (void)state;
    uint64_t seed = 31;
    int clear = 0, blocked = 0;
    for (int n = 0; n < 40; n++) {
        hand_model *h = mixed_scene(&seed, 2, 0.2);
        window *w = open_window(h, 0, 1);
        double motion = pow(10, random_uniform(&seed, -5, -0.3));
        for (int i = 0; i < 3 * h->model.node_count; i++) { w->to[i] += is_fixed(h, i / 3) ? 0 : motion * random_uniform(&seed, -1, 1); }
        trial want = look_at_ends(w), got = look(w, 1);
        assert_int_equal(got.status, want.status);
        assert_int_equal(got.report.paths_checked, want.report.paths_checked);
        assert_int_equal(got.report.exact_path_checks, want.report.exact_path_checks);
        if (want.status != CIPC_OK) {
            const char *at = strstr(want.error.what, " at "), *pair_end = strstr(want.error.what, ": on the way");
            assert_true(at != NULL && pair_end != NULL);
            assert_memory_equal(got.error.what, want.error.what, (size_t)(pair_end - want.error.what));
            assert_true(strtod(at + 4, NULL) == strtod(strstr(got.error.what, "at the time ") + strlen("at the time "), NULL));
        }
        clear += want.status == CIPC_OK;
        blocked += want.status != CIPC_OK;
        free(w);
        hand_model_destroy(h);
    }
    assert_true(clear >= 10 && blocked >= 10);
}

static void expect_same(const window *w, cipc_status status)
{
    trial one = look(w, 1), three = look(w, 3);
    if (one.status != status) { fail_msg("status %d, not %d: %s", (int)one.status, (int)status, one.error.what); }
    assert_int_equal(three.status, one.status);
    assert_int_equal(three.report.paths_checked, one.report.paths_checked);
    assert_int_equal(three.report.exact_path_checks, one.report.exact_path_checks);
    if (status != CIPC_OK) { assert_string_equal(one.error.what, three.error.what); }
}

/* Breaks at the middle of the window, of its halves, and so on, for as long as a coin says, to places that are multiples of 2^-30 m: all places at all times of
 * breaks of any node are doubles, except that a coin may take a break away where the node is to go straight on. */
static void bisect(window *w, uint64_t *seed, int node, int depth, double t0, const double a[3], double t1, const double b[3], double motion)
{
    if (depth == 0 || random_below(seed, 4) == 0) { return; }
    double middle[3], t = 0.5 * (t0 + t1);
    for (int k = 0; k < 3; k++) { middle[k] = 0.5 * (a[k] + b[k]) + ldexp(round(ldexp(motion * random_uniform(seed, -1, 1), 30)), -30); }
    bisect(w, seed, node, depth - 1, t0, a, t, middle, motion);
    add_break(w, t, node, middle[0], middle[1], middle[2]);
    bisect(w, seed, node, depth - 1, t, middle, t1, b, motion);
}

/* All nodes at a time at which their places are doubles. */
static void places_at(const window *w, double time, double *x)
{
    for (int i = 0; i < w->paths.node_count; i++) {
        double t0 = w->paths.begin, t1 = w->paths.end;
        const double *a = &w->paths.from[3 * i], *b = &w->paths.to[3 * i];
        for (long n = 0; n < w->paths.break_count; n++) {
            const cipc_path_break *at = &w->breaks[n];
            if (at->node == i && at->time <= time) {
                t0 = at->time;
                a = at->x;
            } else if (at->node == i && at->time < t1) {
                t1 = at->time;
                b = at->x;
            }
        }
        for (int k = 0; k < 3; k++) { x[3 * i + k] = a[k] + (time - t0) / (t1 - t0) * (b[k] - a[k]); }
    }
}

/* The plain form: all pairs, exactly, from every time at which any node turns to the next. */
static bool synchronised_clear(const window *w)
{
    double here[MOST_NUMBERS], there[MOST_NUMBERS];
    memcpy(here, w->paths.from, 3 * (size_t)w->paths.node_count * sizeof *here);
    for (long b = 0; b <= w->paths.break_count; b++) {
        double time = b < w->paths.break_count ? w->breaks[b].time : w->paths.end;
        if (b > 0 && time == w->breaks[b - 1].time) { continue; }
        places_at(w, time, there);
        if (!plain_path_clear(&w->h->model, here, there, true)) { return false; }
        memcpy(here, there, sizeof here);
    }
    return true;
}

static void round_places(double *x, int count)
{
    for (int i = 0; i < count; i++) { x[i] = ldexp(round(ldexp(x[i], 30)), -30); }
}

/* Bodies of every kind, nodes that turn at times of their own: the verdict is that of the plain form, whatever the number of threads. */
static void test_against_synchronised_paths(void **state)
{
    (void)state;
    uint64_t seed = 37;
    int clear = 0, blocked = 0, unseen = 0;
    for (int n = 0; n < 24; n++) {
        hand_model *h = mixed_scene(&seed, 1, 0.2);
        int numbers = 3 * h->model.node_count;
        round_places(h->x, numbers);
        window *w = open_window(h, 4, 5);
        double motion = pow(10, random_uniform(&seed, -2.3, -0.9));
        for (int i = 0; i < numbers / 3; i++) {
            if (is_fixed(h, i)) { continue; }
            for (int k = 0; k < 3; k++) { w->to[3 * i + k] += motion * random_uniform(&seed, -1, 1); }
            round_places(&w->to[3 * i], 3);
            bisect(w, &seed, i, 1 + n % 3, 4, &h->x[3 * i], 5, &w->to[3 * i], motion);
        }
        bool want = synchronised_clear(w);
        expect_same(w, want ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        clear += want;
        blocked += !want;
        unseen += !want && look_at_ends(w).status == CIPC_OK;
        free(w);
        hand_model_destroy(h);
    }
    assert_true(clear >= 8 && blocked >= 8 && unseen >= 2);
}

/* One pair on one piece between two times of breaks, each node on its own straight part of the path, exactly. */
static bool piece_clear(const window *w, cipc_pair_kind kind, const int nodes[4], double xi, double begin, double end)
{
    cipc_stencil_piece piece = {.kind = kind, .begin = begin, .end = end};
    for (int i = 0; i < cipc_pair_nodes(kind); i++) {
        const double *a = &w->paths.from[3 * nodes[i]], *b = &w->paths.to[3 * nodes[i]];
        piece.start[i] = w->paths.begin;
        piece.stop[i] = w->paths.end;
        for (long n = 0; n < w->paths.break_count; n++) {
            const cipc_path_break *at = &w->breaks[n];
            if (at->node == nodes[i] && at->time <= begin) {
                piece.start[i] = at->time;
                a = at->x;
            } else if (at->node == nodes[i] && at->time < piece.stop[i]) {
                piece.stop[i] = at->time;
                b = at->x;
            }
        }
        memcpy(&piece.x[3 * i], a, 3 * sizeof *a);
        memcpy(&piece.p[3 * i], b, 3 * sizeof *b);
    }
    return cipc_exact_piece_toi(&piece, xi).verdict == CIPC_NO;
}

static bool all_pieces_clear(const window *w)
{
    const cipc_model *m = &w->h->model;
    double begin = w->paths.begin;
    int nodes[4];
    for (long n = 0; n <= w->paths.break_count; n++) {
        double end = n < w->paths.break_count ? w->breaks[n].time : w->paths.end;
        for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) {
            cipc_pair_kind kind = (cipc_pair_kind)k;
            for (int a = 0; a < plain_side_count(m, kind, 0); a++) {
                for (int b = 0; b < plain_side_count(m, kind, 1); b++) {
                    if (!plain_is_pair(m, kind, a, b, true)) { continue; }
                    double xi = plain_pair_nodes(m, kind, a, b, nodes);
                    if (!piece_clear(w, kind, nodes, xi, begin, end)) { return false; }
                }
            }
        }
        begin = end;
    }
    return true;
}

/* Random times, so that hardly any place is a double: the verdict is that of all pairs on all pieces in exact arithmetic. Few nodes, in ropes, grains and a sheet. */
static void test_against_all_pieces(void **state)
{
    (void)state;
    uint64_t seed = 41;
    int clear = 0, blocked = 0;
    for (int n = 0; n < 60; n++) {
        double xi = 0.01 * (n % 3);
        hand_model *h = hand_model_create();
        int sheet = hand_body(h, "sheet", xi, 0, false), grain = hand_body_of(h, CIPC_BODY_PARTICLES, "grain", xi, false),
            rope = hand_body_of(h, CIPC_BODY_RODS, "rope", 0.01, false);
        hand_new_triangle(h, sheet, (const double[9]){0, 0, 0, 1, 0, 0, 0, 1, 0});
        hand_node(h, grain, 0.25, 0.25, 0.1);
        hand_node(h, grain, 0.3, 0.25, 0.1);
        hand_rope(h, rope, (const double[3]){-0.5, 0.4, 0.2}, (const double[3]){1, 0.2, 0.2}, 1);
        window *w = open_window(h, 1e3 / 3, 1e3 / 3 + 0.1);
        double motion = pow(10, random_uniform(&seed, -2, -0.5));
        for (int i = 0; i < 3 * h->model.node_count; i++) { w->to[i] += motion * random_uniform(&seed, -1, 1); }
        for (int b = 0; b < 4 + 6 * (n % 6); b++) {
            double t = w->paths.begin + 0.1 * random_uniform(&seed, 0, 0.99);
            move_away(w, t, random_below(&seed, h->model.node_count), motion * random_uniform(&seed, -1, 1), motion * random_uniform(&seed, -1, 1),
                      motion * random_uniform(&seed, -1, 1));
        }
        bool want = all_pieces_clear(w);
        expect_same(w, want ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        clear += want;
        blocked += !want;
        free(w);
        hand_model_destroy(h);
    }
    assert_true(clear >= 15 && blocked >= 15);
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 43;
    hand_model *h = mixed_scene(&seed, 2, 0.2);
    window *w = open_window(h, 0, 1);
    for (int b = 0; b < 300; b++) { move_away(w, b / 300.0, b % 9, 1e-3 * (b % 2), 0, 0); }
    cipc_monitor *monitor;
    cipc_error error;
    long failures = 0;
    for (long n = 1;; n++) {
        fail_allocation(0);
        assert_int_equal(cipc_monitor_create(&monitor, &h->model, NULL, &error), CIPC_OK);
        fail_allocation(n);
        cipc_status status = cipc_monitor_paths(monitor, &w->paths, NULL, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (failed) { assert_int_equal(cipc_monitor_paths(monitor, &w->paths, NULL, &error), CIPC_OK); } /* as if nothing had been */
        cipc_monitor_destroy(monitor);
        if (!failed) { break; }
        failures++;
    }
    assert_true(failures > 10);
    free(w);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dips_are_rejected),  cmocka_unit_test(test_dips_anywhere_in_a_walk),    cmocka_unit_test(test_turns),
        cmocka_unit_test(test_timing_decides),     cmocka_unit_test(test_timing_by_a_hair),           cmocka_unit_test(test_rounded_places),
        cmocka_unit_test(test_instant),            cmocka_unit_test(test_breaks_at_the_ends),         cmocka_unit_test(test_extreme_numbers),
        cmocka_unit_test(test_malformed),          cmocka_unit_test(test_kept_lists),                 cmocka_unit_test(test_without_breaks),
        cmocka_unit_test(test_against_synchronised_paths), cmocka_unit_test(test_against_all_pieces), cmocka_unit_test(test_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
