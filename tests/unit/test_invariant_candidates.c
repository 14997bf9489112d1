/* Candidate lists of the monitors: complete against all pairs, each pair once, independent of threads, and valid for as long as they
 * claim. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/geometry.h"
#include "cipc/oracle.h"
#include "invariant/candidates.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"
#include "support/hand_model.h"
#include "support/monitor_scene.h"
#include "support/plain_monitor.h"

/* How often each pair of one kind is listed: times[first * second_count + second]. */
static unsigned char *count_pairs(const invariant_candidates *c, invariant_candidate_kind kind, int first_count, int second_count)
{
    unsigned char *times = calloc((size_t)first_count * (size_t)second_count, 1);
    for (int i = 0; i < c->part_count; i++) {
        for (int p = 0; c->parts[i].kind == kind && p < c->parts[i].count; p++) {
            const int *pair = c->parts[i].pairs[p];
            assert_in_range(pair[0], 0, first_count - 1);
            assert_in_range(pair[1], 0, second_count - 1);
            times[(size_t)pair[0] * (size_t)second_count + (size_t)pair[1]]++;
        }
    }
    return times;
}

/* Every pair that must not touch and is within xi + reach at x is listed once, every other such pair at most once, nothing else at all. */
static void check_gap_pairs(const invariant_candidates *c, cipc_pair_kind kind, const double *x, bool skip_fixed, long *near)
{
    const cipc_model *m = c->model;
    int first = plain_side_count(m, kind, 0), second = plain_side_count(m, kind, 1), nodes[4];
    unsigned char *times = count_pairs(c, (invariant_candidate_kind)kind, first, second);
    for (int i = 0; i < first; i++) {
        for (int j = 0; j < second; j++) {
            int listed = times[(size_t)i * (size_t)second + (size_t)j];
            if (!plain_is_pair(m, kind, i, j, skip_fixed)) {
                assert_int_equal(listed, 0);
                continue;
            }
            double stencil[12], xi = plain_pair_nodes(m, kind, i, j, nodes);
            plain_stencil(kind, x, nodes, stencil);
            bool within = cipc_exact_distance_sign(kind, stencil, xi + c->reach) <= 0;
            assert_true(within ? listed == 1 : listed <= 1);
            *near += within ? 1 : 0;
        }
    }
    free(times);
}

static void check_crossing_pairs(const invariant_candidates *c, const double *x, bool skip_fixed, long *crossings)
{
    const cipc_model *m = c->model;
    unsigned char *times = count_pairs(c, CIPC_CANDIDATE_EDGE_TRIANGLE, m->edge_count, m->triangle_count);
    for (int i = 0; i < m->edge_count; i++) {
        for (int j = 0; j < m->triangle_count; j++) {
            int listed = times[(size_t)i * (size_t)m->triangle_count + (size_t)j];
            double edge[6], triangle[9];
            cipc_gather(edge, x, m->edges[i], 2);
            cipc_gather(triangle, x, m->triangles[j], 3);
            bool exempt = plain_is_exempt(m, m->edges[i], 2, m->triangles[j], 3, skip_fixed),
                 meets = !exempt && cipc_edge_triangle_intersect(edge, triangle);
            assert_true(exempt ? listed == 0 : meets ? listed == 1 : listed <= 1);
            *crossings += meets ? 1 : 0;
        }
    }
    free(times);
}

/* near: by kind of pair. */
static void check_all(const invariant_candidates *c, const double *x, bool skip_fixed, long near[CIPC_PAIR_KIND_COUNT], long *crossings)
{
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) { check_gap_pairs(c, (cipc_pair_kind)kind, x, skip_fixed, &near[kind]); }
    check_crossing_pairs(c, x, skip_fixed, crossings);
}

static void jiggle(uint64_t *seed, double *x, const double *from, int node_count, double length)
{
    for (int i = 0; i < node_count; i++) {
        double d[3];
        do {
            random_fill(seed, d, 3, 1);
        } while (norm3(d) > 1);
        for (int k = 0; k < 3; k++) { x[3 * i + k] = from[3 * i + k] + length * d[k]; }
    }
}

static void test_complete_while_valid(void **state)
{
    (void)state;
    fail_allocation(0);
    uint64_t seed = 71;
    long near[CIPC_PAIR_KIND_COUNT] = {0}, crossings = 0;
    for (int round = 0; round < 4; round++) {
        hand_model *h = mixed_scene(&seed, 7, 0.02);
        bool skip_fixed = round % 2 == 0, made;
        double margin = 0.01, *x = calloc(3 * (size_t)h->model.node_count, sizeof *x);
        invariant_candidates c;
        assert_true(invariant_candidates_init(&c, &h->model, 0.015, margin, 1 + round % 3, skip_fixed));
        assert_true(invariant_candidates_update(&c, h->x, &made) && made);
        check_all(&c, h->x, skip_fixed, near, &crossings);
        for (int move = 0; move < 3; move++) {
            jiggle(&seed, x, h->x, h->model.node_count, 0.5 * margin * (1 - 0x1p-30));
            assert_true(invariant_candidates_update(&c, x, &made) && !made); /* kept ... */
            check_all(&c, x, skip_fixed, near, &crossings);                 /* ... and still complete */
        }
        x[5] = h->x[5] + 0.5 * margin * (1 + 0x1p-30);
        assert_true(invariant_candidates_update(&c, x, &made) && made); /* one node too far */
        check_all(&c, x, skip_fixed, near, &crossings);
        invariant_candidates_free(&c);
        free(x);
        hand_model_destroy(h);
    }
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) { assert_true(near[kind] > 100); }
    assert_true(crossings > 100); /* the bump pierces the floor; jiggled layers pierce one another */
}

static void test_without_margin(void **state)
{
    (void)state;
    fail_allocation(0);
    uint64_t seed = 73;
    hand_model *h = crumpled_scene(&seed, 4, 0.02);
    invariant_candidates c;
    bool made;
    assert_true(invariant_candidates_init(&c, &h->model, 0.015, 0, 1, true));
    assert_true(invariant_candidates_update(&c, h->x, &made) && made);
    assert_true(invariant_candidates_update(&c, h->x, &made) && !made); /* the very same positions */
    h->x[7] = nextafter(h->x[7], INFINITY);
    assert_true(invariant_candidates_update(&c, h->x, &made) && made);
    invariant_candidates_free(&c);
    hand_model_destroy(h);
}

static void test_same_lists_for_any_number_of_threads(void **state)
{
    (void)state;
    fail_allocation(0);
    uint64_t seed = 79;
    hand_model *h = mixed_scene(&seed, 12, 0.02);
    invariant_candidates c[3];
    for (int t = 0; t < 3; t++) {
        bool made;
        assert_true(invariant_candidates_init(&c[t], &h->model, 0.01, 0.01, t == 2 ? 7 : t + 1, true));
        assert_true(invariant_candidates_update(&c[t], h->x, &made));
        assert_int_equal(c[t].part_count, c[0].part_count);
        long total = 0;
        for (int i = 0; i < c[t].part_count; i++) {
            assert_int_equal(c[t].parts[i].count, c[0].parts[i].count);
            assert_memory_equal(c[t].parts[i].pairs, c[0].parts[i].pairs, (size_t)c[t].parts[i].count * sizeof *c[t].parts[i].pairs);
            total += c[t].parts[i].count;
        }
        assert_true(total > 100);
    }
    for (int t = 0; t < 3; t++) { invariant_candidates_free(&c[t]); }
    hand_model_destroy(h);
}

/* Coordinates where boxes overflow to infinity, and a scene of nothing. */
static void test_extreme_positions(void **state)
{
    (void)state;
    fail_allocation(0);
    hand_model *h = hand_model_create();
    int body = hand_body(h, "huge", 0, 0, false);
    hand_new_triangle(h, body, (const double[9]){-1e308, -1e308, 0, 1e308, -1e308, 0, 0, 1e308, 0});
    hand_node(h, body, 0, 0, 0);
    invariant_candidates c;
    long near[CIPC_PAIR_KIND_COUNT] = {0}, crossings = 0;
    bool made;
    assert_true(invariant_candidates_init(&c, &h->model, 1e-3, 1e-3, 1, true));
    assert_true(invariant_candidates_update(&c, h->x, &made));
    check_all(&c, h->x, true, near, &crossings);
    assert_int_equal(near[CIPC_POINT_TRIANGLE], 1);
    invariant_candidates_free(&c);
    hand_model_destroy(h);

    h = hand_model_create();
    double nothing[1] = {0};
    assert_true(invariant_candidates_init(&c, &h->model, 1e-3, 1e-3, 1, true));
    assert_true(invariant_candidates_update(&c, nothing, &made));
    invariant_candidates_free(&c);
    hand_model_destroy(h);
}

/* Reaches so long that boxes have no bounds: such a box meets the empty places at the end of the last patch too, which are no primitives. Several sizes, so that these are several. */
static void test_extreme_reaches(void **state)
{
    (void)state;
    fail_allocation(0);
    for (int cells = 2; cells < 6; cells++) {
        uint64_t seed = 81;
        hand_model *h = mixed_scene(&seed, cells, 0.02);
        const double reaches[] = {1e30, 1e100, 1e300};
        for (size_t r = 0; r < sizeof reaches / sizeof reaches[0]; r++) {
            invariant_candidates c;
            long near[CIPC_PAIR_KIND_COUNT] = {0}, crossings = 0;
            bool made;
            assert_true(invariant_candidates_init(&c, &h->model, reaches[r], 0, 1, true));
            assert_true(invariant_candidates_update(&c, h->x, &made));
            if (reaches[r] < 1e200) { check_all(&c, h->x, true, near, &crossings); } /* beyond, the square of the reach that this holds the pairs against is no number */
            invariant_candidates_free(&c);
        }
        hand_model_destroy(h);
    }
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 83;
    hand_model *h = crumpled_scene(&seed, 4, 0.02);
    long failures = 0;
    for (long n = 1;; n++) {
        invariant_candidates c;
        bool made, ok;
        fail_allocation(n);
        ok = invariant_candidates_init(&c, &h->model, 0.01, 0.01, 1, true) && invariant_candidates_update(&c, h->x, &made);
        assert_int_equal(ok, !allocation_failed());
        if (!ok && c.parts != NULL && c.made_at != NULL) {
            fail_allocation(0);
            assert_true(invariant_candidates_update(&c, h->x, &made) && made); /* it can be asked again */
        }
        fail_allocation(0);
        invariant_candidates_free(&c);
        if (ok) { break; }
        failures++;
    }
    assert_true(failures > 20);
    hand_model_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_complete_while_valid),
        cmocka_unit_test(test_without_margin),
        cmocka_unit_test(test_same_lists_for_any_number_of_threads),
        cmocka_unit_test(test_extreme_positions),
        cmocka_unit_test(test_extreme_reaches),
        cmocka_unit_test(test_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
