/* Monitor M5: what happens between two good states. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/invariant.h"
#include "support/monitor_scene.h"
#include "support/plain_monitor.h"

typedef struct trial {
    cipc_status status;
    cipc_invariant_report report;
    cipc_error error;
} trial;

/* A new monitor looks at the path from h->x to `to`. */
static trial sweep(const hand_model *h, const double *to, int threads)
{
    trial t;
    cipc_monitor *monitor;
    cipc_invariant_options options = cipc_invariant_options_default();
    options.threads = threads;
    cipc_invariant_report_init(&t.report);
    t.status = cipc_monitor_create(&monitor, &h->model, &options, &t.error);
    if (t.status == CIPC_OK) t.status = cipc_monitor_swept(monitor, h->x, to, &t.report, &t.error);
    cipc_monitor_destroy(monitor);
    return t;
}

/* A point above a triangle, thickness xi. */
static hand_model *point_over_triangle(double xi, double height)
{
    hand_model *h = hand_model_create();
    int sheet = hand_body(h, "sheet", xi, 0, false), dust = hand_body(h, "dust", xi, 0, false);
    hand_new_triangle(h, sheet, (const double[9]){0, 0, 0, 1, 0, 0, 0, 1, 0});
    hand_node(h, dust, 0.25, 0.25, height);
    return h;
}

/* Both ends are good, and the point has gone through. */
static void test_tunnelling_is_rejected(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1);
    double to[12];
    memcpy(to, h->x, sizeof to);
    to[11] = -1;
    trial t = sweep(h, to, 1);
    assert_int_equal(t.status, CIPC_E_VIOLATED_SWEPT);
    assert_non_null(strstr(t.error.what, "0.5 ("));
    assert_non_null(strstr(t.error.what, "\"dust\""));
    to[9] = to[10] = 2; /* past the triangle's side */
    assert_int_equal(sweep(h, to, 1).status, CIPC_OK);
    hand_model_destroy(h);
}

/* A point passes a corner at exactly the thickness, half way: rejected; at one ulp more: accepted. */
static void test_by_one_ulp(void **state)
{
    (void)state;
    for (int above = 0; above < 2; above++) {
        double xi = 0.25;
        hand_model *h = point_over_triangle(xi, 0);
        double y = above ? nextafter(-0.25, -1) : -0.25;
        h->x[9] = -1, h->x[10] = y;
        double to[12];
        memcpy(to, h->x, sizeof to);
        to[9] = 1;
        trial t = sweep(h, to, 1);
        assert_int_equal(t.status, above ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        if (above) assert_true(t.report.paths_checked >= 1);
        hand_model_destroy(h);
    }
}

/* Edges that cross on the way and are apart at both ends. */
static void test_edges(void **state)
{
    (void)state;
    hand_model *h = hand_model_create();
    int a = hand_body(h, "a", 0, 0, false), b = hand_body(h, "b", 0, 0, false);
    hand_edge(h, hand_node(h, a, -1, 0, 1), hand_node(h, a, 1, 0, 1));
    hand_edge(h, hand_node(h, b, 0, -1, 0), hand_node(h, b, 0, 1, 0));
    double to[12];
    memcpy(to, h->x, sizeof to);
    to[2] = to[5] = -3;
    trial t = sweep(h, to, 1);
    assert_int_equal(t.status, CIPC_E_VIOLATED_SWEPT);
    assert_non_null(strstr(t.error.what, "0.25 ("));
    to[8] = to[11] = -4; /* the other one gets out of the way */
    assert_int_equal(sweep(h, to, 1).status, CIPC_OK);
    hand_model_destroy(h);
}

/* A particle that passes the end of a rope, or another particle, at exactly the thickness half way: rejected; at one ulp more: accepted. */
static void test_points_by_one_ulp(void **state)
{
    (void)state;
    for (int trial_number = 0; trial_number < 4; trial_number++) {
        bool rope = trial_number % 2 == 0, above = trial_number / 2 == 1;
        hand_model *h = hand_model_create();
        int dust = hand_body_of(h, CIPC_BODY_PARTICLES, "dust", 0.25, false),
            other = hand_body_of(h, rope ? CIPC_BODY_RODS : CIPC_BODY_PARTICLES, "other", 0.25, false);
        hand_node(h, dust, -1, above ? nextafter(-0.25, -1) : -0.25, 0);
        int a = hand_node(h, other, 0, 0, 0);
        if (rope) hand_segment(h, a, hand_node(h, other, 0, 2, 0));
        double to[9];
        memcpy(to, h->x, 3 * (size_t)h->model.node_count * sizeof *to);
        to[0] = 1;
        trial t = sweep(h, to, 1);
        assert_int_equal(t.status, above ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        assert_int_equal(t.report.paths_checked, 1);
        if (!above) assert_non_null(strstr(t.error.what, rope ? "node 0 (body \"dust\") and edge (nodes 1 2, body \"other\")" : "and node 1 (body \"other\")"));
        hand_apart(h, dust, other); /* and where the scene lets them pass, nothing is looked at */
        t = sweep(h, to, 1);
        assert_true(t.status == CIPC_OK && t.report.paths_checked == 0);
        hand_model_destroy(h);
    }
}

/* No motion, and motion of all together, break nothing that was good. */
static void test_common_motion(void **state)
{
    (void)state;
    uint64_t seed = 3;
    hand_model *h = crumpled_scene(&seed, 5, 0.2);
    enum { MOST = 3000 };
    double to[MOST];
    int n = 3 * h->model.node_count;
    assert_in_range(n, 1, MOST);
    for (int i = 0; i < n; i++) to[i] = h->x[i] + (i % 3 == 0 ? 8 : 0);
    assert_int_equal(sweep(h, h->x, 1).status, CIPC_OK);
    for (int i = 0; i < h->model.node_count; i++) /* fixed bodies stay: move what is above the floor upwards */
        for (int k = 0; k < 3; k++) to[3 * i + k] = h->x[3 * i + k] + (k == 2 && !h->model.bodies[h->model.node_body[i]].fixed ? 8 : 0);
    assert_int_equal(sweep(h, to, 1).status, CIPC_OK);
    hand_model_destroy(h);
}

static void test_not_finite(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1);
    double to[12];
    memcpy(to, h->x, sizeof to);
    to[4] = NAN;
    assert_int_equal(sweep(h, to, 1).status, CIPC_E_VIOLATED_FINITE);
    hand_model_destroy(h);
}

/* Bodies of every kind with small and large random motions: the verdict is the plain form's, on one thread and on three. */
static void test_against_the_plain_form(void **state)
{
    (void)state;
    enum { MOST = 3000 };
    uint64_t seed = 17;
    int clear = 0, blocked = 0;
    for (int trial_number = 0; trial_number < 60; trial_number++) {
        hand_model *h = mixed_scene(&seed, 2, 0.2);
        double to[MOST], motion = pow(10, random_uniform(&seed, -5, -0.3));
        int n = 3 * h->model.node_count;
        assert_in_range(n, 1, MOST);
        for (int i = 0; i < n; i++) {
            bool fixed = h->model.bodies[h->model.node_body[i / 3]].fixed;
            to[i] = h->x[i] + (fixed ? 0 : motion * random_uniform(&seed, -1, 1));
        }
        bool want = plain_path_clear(&h->model, h->x, to, true);
        trial one = sweep(h, to, 1), three = sweep(h, to, 3);
        assert_int_equal(one.status, want ? CIPC_OK : CIPC_E_VIOLATED_SWEPT);
        assert_int_equal(three.status, one.status);
        assert_int_equal(three.report.paths_checked, one.report.paths_checked);
        assert_int_equal(three.report.exact_path_checks, one.report.exact_path_checks);
        if (!want) assert_string_equal(one.error.what, three.error.what);
        clear += want;
        blocked += !want;
        hand_model_destroy(h);
    }
    assert_true(clear >= 15 && blocked >= 10);
}

/* Lists kept from an earlier look serve for short paths, and give the same verdict. */
static void test_kept_lists(void **state)
{
    (void)state;
    hand_model *h = point_over_triangle(0, 1e-4);
    cipc_monitor *monitor;
    cipc_error error;
    double to[12];
    memcpy(to, h->x, sizeof to);
    assert_int_equal(cipc_monitor_create(&monitor, &h->model, NULL, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_check(monitor, h->x, NULL, &error), CIPC_OK);
    to[11] = 5e-5;
    assert_int_equal(cipc_monitor_swept(monitor, h->x, to, NULL, &error), CIPC_OK);
    to[11] = -5e-5;
    assert_int_equal(cipc_monitor_swept(monitor, h->x, to, NULL, &error), CIPC_E_VIOLATED_SWEPT);
    cipc_monitor_destroy(monitor);
    hand_model_destroy(h);
}

/* Lists that serve for one end only are not used for the path: the pair that meets on the way is on none of them. */
static void test_lists_of_one_end_do_not_serve(void **state)
{
    (void)state;
    for (int looked_at_end = 0; looked_at_end < 2; looked_at_end++) {
        hand_model *h = point_over_triangle(0, 1);
        cipc_monitor *monitor;
        cipc_error error;
        double to[12];
        memcpy(to, h->x, sizeof to);
        to[11] = -1;
        assert_int_equal(cipc_monitor_create(&monitor, &h->model, NULL, &error), CIPC_OK);
        assert_int_equal(cipc_monitor_check(monitor, looked_at_end ? to : h->x, NULL, &error), CIPC_OK);
        assert_int_equal(cipc_monitor_swept(monitor, h->x, to, NULL, &error), CIPC_E_VIOLATED_SWEPT);
        cipc_monitor_destroy(monitor);
        hand_model_destroy(h);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tunnelling_is_rejected), cmocka_unit_test(test_by_one_ulp),  cmocka_unit_test(test_edges), cmocka_unit_test(test_points_by_one_ulp),
        cmocka_unit_test(test_common_motion),          cmocka_unit_test(test_not_finite),  cmocka_unit_test(test_against_the_plain_form),
        cmocka_unit_test(test_kept_lists),             cmocka_unit_test(test_lists_of_one_end_do_not_serve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
