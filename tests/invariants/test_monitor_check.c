/* The monitors together: the same answers as all pairs in exact arithmetic, with and without kept lists, for any number of threads; their
 * order; lack of memory. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/failing_memory.h"
#include "support/monitor_scene.h"
#include "support/monitor_trial.h"
#include "support/plain_monitor.h"

#define REACH 0.01

static cipc_monitor *create(const hand_model *h, double margin, int threads)
{
    cipc_invariant_options options = cipc_invariant_options_default();
    options.reach = REACH;
    options.margin = margin;
    options.threads = threads;
    cipc_monitor *monitor;
    assert_int_equal(cipc_monitor_create(&monitor, &h->model, &options, NULL), CIPC_OK);
    return monitor;
}

/* One of the monitors by itself agrees with the plain form about the same positions. */
static void compare_with_plain(const hand_model *h, cipc_monitor *monitor, const plain_report *plain)
{
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    assert_int_equal(cipc_monitor_intersection(monitor, h->x, &report, NULL), plain->crossing ? CIPC_E_VIOLATED_INTERSECTION : CIPC_OK);
    assert_int_equal(cipc_monitor_gap(monitor, h->x, &report, NULL), plain->gap_violated ? CIPC_E_VIOLATED_GAP : CIPC_OK);
    assert_int_equal(cipc_monitor_strain(monitor, h->x, &report, NULL), plain->strain_violated ? CIPC_E_VIOLATED_STRAIN : CIPC_OK);
    if (plain->min_gap <= REACH) {
        assert_true(report.min_gap == plain->min_gap);
    } else {
        assert_true(isinf(report.min_gap));
    }
    assert_int_equal(report.pairs_checked, plain->within);
}

/* Everything in the report but lists_made. */
static void assert_same_report(const cipc_invariant_report *a, const cipc_invariant_report *b)
{
    assert_true(a->min_gap == b->min_gap && a->min_gap_kind == b->min_gap_kind);
    assert_memory_equal(a->min_gap_nodes, b->min_gap_nodes, sizeof a->min_gap_nodes);
    assert_true(a->max_stretch == b->max_stretch && a->max_stretch_ratio == b->max_stretch_ratio);
    assert_int_equal(a->max_stretch_triangle, b->max_stretch_triangle);
    assert_int_equal(a->exact_gap_checks, b->exact_gap_checks);
    assert_int_equal(a->exact_strain_checks, b->exact_strain_checks);
    assert_int_equal(a->pairs_checked, b->pairs_checked);
    assert_int_equal(a->crossings_checked, b->crossings_checked);
}

/* A walk of small and large steps, some of them into the forbidden. */
static void test_walk(void **state)
{
    (void)state;
    fail_allocation(0);
    enum { WAYS = 4, STEPS = 24 };
    uint64_t seed = 101;
    hand_model *h = mixed_scene(&seed, 5, 0.02);
    cipc_monitor *ways[WAYS] = {create(h, 0, 1), create(h, 0.004, 1), create(h, 0.004, 2), create(h, 0.02, 5)};
    double *start = calloc(3 * (size_t)h->model.node_count, sizeof *start);
    memcpy(start, h->x, 3 * (size_t)h->model.node_count * sizeof *start);
    long made = 0, kept = 0, seen[4] = {0, 0, 0, 0};
    for (int step = 0; step < STEPS; step++) {
        double length = step % 8 == 7 ? 0.02 : 0.0008; /* now and then far enough to cross */
        for (int i = 0; i < 3 * h->model.node_count; i++) {
            h->x[i] = step % 8 == 0 ? start[i] : h->x[i] + length * random_uniform(&seed, -1, 1);
        }
        plain_report plain = plain_monitor(&h->model, h->x, REACH, true);
        cipc_invariant_report reports[WAYS];
        cipc_status statuses[WAYS];
        cipc_error errors[WAYS];
        for (int w = 0; w < WAYS; w++) {
            statuses[w] = cipc_monitor_check(ways[w], h->x, &reports[w], &errors[w]);
            assert_int_equal(statuses[w], statuses[0]);
            assert_same_report(&reports[w], &reports[0]);
            made += reports[w].lists_made ? 1 : 0;
            kept += reports[w].lists_made ? 0 : 1;
            if (statuses[w] != CIPC_OK) { assert_string_equal(errors[w].what, errors[0].what); }
            compare_with_plain(h, ways[w], &plain);
        }
        seen[0] += statuses[0] == CIPC_OK ? 1 : 0;
        seen[1] += plain.crossing ? 1 : 0;
        seen[2] += plain.within > 0 ? 1 : 0;
        seen[3] += plain.strain_violated ? 1 : 0;
    }
    assert_true(made >= STEPS && kept >= STEPS / 2);
    for (int i = 0; i < 4; i++) { assert_true(seen[i] > 0); }
    for (int w = 0; w < WAYS; w++) { cipc_monitor_destroy(ways[w]); }
    free(start);
    hand_model_destroy(h);
}

/* A state that breaks everything: the monitors speak in their order as one after another is satisfied. */
static void test_order(void **state)
{
    (void)state;
    fail_allocation(0);
    hand_model *h = hand_model_create();
    int cloth = hand_body(h, "cloth", 0.25, 1.5, false), jelly = hand_body(h, "jelly", 0, 0, false);
    hand_new_triangle(h, cloth, (const double[9]){0, 0, 0, 4, 0, 0, 0, 4, 0});
    int a = hand_node(h, jelly, 1, 1, -1), b = hand_node(h, jelly, 1, 1, 1);
    hand_edge(h, a, b);
    hand_node(h, jelly, 2, 1, 9);
    hand_node(h, jelly, 1, 2, 9);
    hand_tetrahedron(h, b, a, 5, 6);
    h->x[3] = 8; /* stretched by two */
    h->x[20] = NAN;
    const cipc_status expected[] = {CIPC_E_VIOLATED_FINITE, CIPC_E_VIOLATED_INTERSECTION, CIPC_E_VIOLATED_GAP,
                                    CIPC_E_VIOLATED_STRAIN, CIPC_E_VIOLATED_INVERSION,    CIPC_OK};
    for (int stage = 0; stage < 6; stage++) {
        monitor_trial t = try_monitor(cipc_monitor_check, h, NULL);
        assert_int_equal(t.status, expected[stage]);
        assert_int_equal(t.report.max_stretch_triangle, stage >= 3 ? 0 : -1); /* filled as far as it got */
        switch (stage) {
        case 0:
            h->x[20] = 9;
            break;
        case 1:
            h->x[11] = 0.1;
            break; /* the edge's lower end: above, but too near */
        case 2:
            h->x[11] = 0.5;
            break;
        case 3:
            h->x[3] = 4;
            break;
        case 4:
            h->model.tetrahedra[0][0] = a;
            h->model.tetrahedra[0][1] = b;
            break;
        default:
            break;
        }
    }
    hand_model_destroy(h);
}

static void test_options(void **state)
{
    (void)state;
    fail_allocation(0);
    hand_model *h = hand_model_create();
    hand_node(h, hand_body(h, "point", 0, 0, false), 0, 0, 0);
    const cipc_invariant_options good = cipc_invariant_options_default();
    assert_true(good.reach == 1e-3 && good.margin == 1e-3 && good.threads == 1 && good.allow_fixed_fixed);
    const double bad[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) {
        cipc_invariant_options reach = good, margin = good;
        reach.reach = margin.margin = bad[i];
        assert_int_equal(try_monitor(cipc_monitor_check, h, &reach).status, CIPC_E_OUT_OF_RANGE);
        assert_int_equal(try_monitor(cipc_monitor_check, h, &margin).status, CIPC_E_OUT_OF_RANGE);
    }
    cipc_invariant_options threads = good;
    threads.threads = 0;
    assert_int_equal(try_monitor(cipc_monitor_check, h, &threads).status, CIPC_E_OUT_OF_RANGE);
    assert_int_equal(try_monitor(cipc_monitor_check, h, &good).status, CIPC_OK);
    assert_int_equal(try_monitor(cipc_monitor_check, h, NULL).status, CIPC_OK);
    cipc_monitor *monitor;
    assert_int_equal(cipc_monitor_create(&monitor, &h->model, NULL, NULL), CIPC_OK);
    assert_int_equal(cipc_monitor_check(monitor, h->x, NULL, NULL), CIPC_OK); /* neither report nor error wanted */
    cipc_monitor_destroy(monitor);
    cipc_monitor_destroy(NULL);
    hand_model_destroy(h);
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 103;
    hand_model *h = mixed_scene(&seed, 3, 0.02);
    long failures = 0;
    for (long n = 1;; n++) {
        fail_allocation(n);
        monitor_trial t = try_monitor(cipc_monitor_check, h, NULL);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(t.status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (!failed) { break; }
        failures++;
    }
    assert_true(failures > 20);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walk),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
