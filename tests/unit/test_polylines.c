/* Paths with breaks made ready: corners in order, places and deviations against rationals, boxes, jumps, lack of memory. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "invariant/polylines.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { NODES = 5, MOST_BREAKS = 400 };

/* Paths with room for their numbers. */
typedef struct trial {
    cipc_paths paths;
    double from[3 * NODES], to[3 * NODES];
    cipc_path_break breaks[MOST_BREAKS];
} trial;

static int by_time(const void *a, const void *b)
{
    double x = ((const cipc_path_break *)a)->time, y = ((const cipc_path_break *)b)->time;
    return (x > y) - (x < y);
}

/* Some nodes with many breaks, some with few, the last with none; every third break is a place that the node stays at. */
static void random_trial(trial *t, uint64_t *seed, int breaks, double begin, double end, double shift)
{
    t->paths = (cipc_paths){.begin = begin, .end = end, .node_count = NODES, .from = t->from, .to = t->to, .break_count = breaks, .breaks = t->breaks};
    random_fill(seed, t->from, 3 * NODES, 1);
    random_fill(seed, t->to, 3 * NODES, 1);
    for (int i = 0; i < 3 * NODES; i++) {
        t->from[i] += shift;
        t->to[i] += shift;
    }
    for (int b = 0; b < breaks; b++) {
        int node = random_below(seed, NODES - 1);
        node = random_below(seed, 2) == 0 ? 0 : node;
        t->breaks[b] = (cipc_path_break){.time = begin + (end - begin) * random_uniform(seed, 0, 1), .node = node};
        for (int k = 0; k < 3; k++) { t->breaks[b].x[k] = shift + random_uniform(seed, -1, 1); }
    }
    qsort(t->breaks, (size_t)breaks, sizeof *t->breaks, by_time);
}

/* x = from + (t - a)/(b - a) (to - from). */
static void exact_place(mpq_t x[3], double t, double a, double b, const double *from, const double *to)
{
    mpq_t share, term;
    mpq_inits(share, term, NULL);
    mpq_set_d(share, t);
    mpq_set_d(term, a);
    mpq_sub(share, share, term);
    mpq_set_d(x[0], b);
    mpq_sub(term, x[0], term);
    if (mpq_sgn(term) != 0) { mpq_div(share, share, term); }
    for (int k = 0; k < 3; k++) {
        mpq_set_d(x[k], from[k]);
        mpq_set_d(term, to[k]);
        mpq_sub(term, term, x[k]);
        mpq_mul(term, term, share);
        mpq_add(x[k], x[k], term);
    }
    mpq_clears(share, term, NULL);
}

/* Where a node is, from the breaks as given. */
static void exact_place_of(mpq_t x[3], const trial *t, int node, double time)
{
    double a = t->paths.begin, b = t->paths.end;
    const double *from = &t->from[3 * node], *to = &t->to[3 * node];
    for (long i = 0; i < t->paths.break_count; i++) {
        const cipc_path_break *at = &t->breaks[i];
        if (at->node != node) { continue; }
        if (at->time <= time) {
            a = at->time;
            from = at->x;
        } else if (at->time < b) {
            b = at->time;
            to = at->x;
        }
    }
    exact_place(x, time, a, b, from, to);
}

/* |a - b| <= bound, decided exactly; *ratio grows to how much of a bound was used. */
static void expect_within(mpq_t a[3], mpq_t b[3], double bound, double *ratio)
{
    mpq_t sum, term;
    mpq_inits(sum, term, NULL);
    for (int k = 0; k < 3; k++) {
        mpq_sub(term, a[k], b[k]);
        mpq_mul(term, term, term);
        mpq_add(sum, sum, term);
    }
    double distance = sqrt(mpq_get_d(sum));
    mpq_set_d(term, bound);
    mpq_mul(term, term, term);
    assert_true(mpq_cmp(sum, term) <= 0);
    if (bound > 0) { *ratio = fmax(*ratio, distance / bound); }
    mpq_clears(sum, term, NULL);
}

static const double *place_at(const cipc_polylines *p, int j, int node) { return &p->places[3 * (j * p->node_count + node)]; }

/* The deviation of a node in a slice is no less than what it strays at any of its breaks and at the ends. */
static void check_slice(const trial *t, const cipc_polylines *p, int level, int slice, double *used)
{
    mpq_t x[3], y[3];
    q_init(x, 3);
    q_init(y, 3);
    int width = p->slices >> level, i = slice * width, j = i + width;
    for (int node = 0; node < NODES; node++) {
        double bound = cipc_polylines_deviation(p, level, slice)[node], most = 0;
        for (long b = -2; b < t->paths.break_count; b++) {
            double time = b == -2 ? p->times[i] : b == -1 ? p->times[j] : t->breaks[b].time;
            if ((b >= 0 && t->breaks[b].node != node) || time < p->times[i] || time > p->times[j]) { continue; }
            exact_place_of(x, t, node, time);
            exact_place(y, time, p->times[i], p->times[j], place_at(p, i, node), place_at(p, j, node));
            expect_within(x, y, bound, &most);
        }
        if (bound > 4 * p->rounding[node]) { assert_true(most > 0.7); } /* and not much more */
        *used = fmax(*used, most);
    }
    q_clear(x, 3);
    q_clear(y, 3);
}

static void check_places(const trial *t, const cipc_polylines *p, double *used)
{
    mpq_t x[3], y[3];
    q_init(x, 3);
    q_init(y, 3);
    for (int j = 0; j <= p->slices; j++) {
        assert_true(j == 0 || p->times[j] >= p->times[j - 1]);
        for (int node = 0; node < NODES; node++) {
            exact_place_of(x, t, node, p->times[j]);
            q_set(y, place_at(p, j, node), 3);
            expect_within(x, y, j == 0 || j == p->slices ? 0 : p->rounding[node], used);
        }
    }
    q_clear(x, 3);
    q_clear(y, 3);
}

static void test_against_rationals(void **state)
{
    (void)state;
    fail_allocation(0);
    uint64_t seed = 11;
    double places_used = 0, slices_used = 0;
    for (int n = 0; n < 24; n++) {
        trial t;
        cipc_polylines p;
        cipc_error error;
        random_trial(&t, &seed, n % 4 == 0 ? 3 : 10 * n, n % 2 == 0 ? 0 : 1e3 / 3, n % 2 == 0 ? 1 : 1e3 / 3 + 0.01, n % 3 == 0 ? 0 : 1e3);
        assert_int_equal(cipc_polylines_init(&p, &t.paths, 1 + n % 2, &error), CIPC_OK);
        assert_true(p.slices * NODES <= t.paths.break_count || p.slices == 1);
        check_places(&t, &p, &places_used);
        for (int level = 0; 1 << level <= p.slices; level++) {
            for (int slice = 0; slice < 1 << level; slice++) { check_slice(&t, &p, level, slice, &slices_used); }
        }
        cipc_polylines_free(&p);
    }
    assert_true(places_used > 0.05 && places_used < 0.7); /* the bound is of the size of the rounding */
    assert_true(slices_used > 0.9);
}

/* A node without breaks, and one that has a break on its straight way, whose places are doubles. */
static void test_straight_paths_do_not_stray(void **state)
{
    (void)state;
    trial t = {.from = {0}, .to = {0}};
    t.paths = (cipc_paths){.begin = 0, .end = 2, .node_count = NODES, .from = t.from, .to = t.to, .break_count = 1, .breaks = t.breaks};
    for (int i = 0; i < 3 * NODES; i++) { t.to[i] = i; }
    t.breaks[0] = (cipc_path_break){1, 2, {3, 3.5, 4}};
    cipc_polylines p;
    cipc_error error;
    assert_int_equal(cipc_polylines_init(&p, &t.paths, 1, &error), CIPC_OK);
    assert_int_equal(p.slices, 1);
    const double *e = cipc_polylines_deviation(&p, 0, 0);
    assert_true(e[0] == 0 && e[1] == 0 && e[3] == 0 && e[2] > 0 && e[2] <= p.rounding[2]);
    cipc_polylines_free(&p);
}

/* Several breaks at one time are one corner, at the beginning and the end as well. */
static void test_corners(void **state)
{
    (void)state;
    trial t = {.from = {0}, .to = {0}};
    t.paths = (cipc_paths){.begin = -1, .end = 1, .node_count = NODES, .from = t.from, .to = t.to, .break_count = 7, .breaks = t.breaks};
    const cipc_path_break breaks[7] = {{-1, 1, {0, 0, 0}}, {-1, 1, {-0.0, 0, 0}}, {0, 1, {5, -6, 7}}, {0, 3, {1, 1, 1}}, {0, 1, {5, -6, 7}}, {0.5, 3, {1, 1, 1}}, {1, 1, {0, 0, 0}}};
    memcpy(t.breaks, breaks, sizeof breaks);
    cipc_polylines p;
    cipc_error error;
    assert_int_equal(cipc_polylines_init(&p, &t.paths, 1, &error), CIPC_OK);
    static const long want[NODES] = {2, 3, 2, 4, 2};
    for (int i = 0; i < NODES; i++) { assert_int_equal(p.first[i + 1] - p.first[i], want[i]); }
    const cipc_knot *corner = &p.knots[p.first[1] + 1];
    assert_true(corner->time == 0 && corner->x[0] == 5 && corner->x[1] == -6 && corner->x[2] == 7);
    double lo[3 * NODES], hi[3 * NODES];
    cipc_polylines_boxes(&p, lo, hi);
    assert_true(lo[3] == 0 && hi[3] == 5 && lo[4] == -6 && hi[4] == 0 && hi[5] == 7 && hi[9] == 1 && lo[9] == 0 && hi[0] == 0);
    cipc_polylines_free(&p);
}

static cipc_status status_of(trial *t)
{
    cipc_polylines p;
    cipc_error error;
    cipc_status status = cipc_polylines_init(&p, &t->paths, 1, &error);
    if (status == CIPC_E_OUT_OF_RANGE) { assert_non_null(strstr(error.what, "node 1 is at two places")); }
    cipc_polylines_free(&p);
    return status;
}

/* Nobody is at two places at one time: not at a break, not at the beginning, not at the end, not where these are one. */
static void test_jumps(void **state)
{
    (void)state;
    trial t = {.from = {0}, .to = {0}};
    t.paths = (cipc_paths){.begin = 0, .end = 1, .node_count = NODES, .from = t.from, .to = t.to, .break_count = 2, .breaks = t.breaks};
    for (int n = 0; n < 3; n++) {
        t.breaks[0] = t.breaks[1] = (cipc_path_break){0.5 * n, 1, {0, 0, n == 1 ? 3 : 0}};
        assert_int_equal(status_of(&t), CIPC_OK);
        t.breaks[1].x[2] = 1;
        assert_int_equal(status_of(&t), CIPC_E_OUT_OF_RANGE);
    }
    t.paths.end = 0;
    t.paths.break_count = 0;
    assert_int_equal(status_of(&t), CIPC_OK);
    t.to[5] = 1;
    assert_int_equal(status_of(&t), CIPC_E_OUT_OF_RANGE);
}

/* Where differences could overflow nothing is known of places. */
static void test_huge_coordinates(void **state)
{
    (void)state;
    trial t = {.from = {-1.5e308, 0, 0}, .to = {1.5e308, 0, 0}};
    t.paths = (cipc_paths){.begin = 0, .end = 1, .node_count = NODES, .from = t.from, .to = t.to, .break_count = 1, .breaks = t.breaks};
    t.breaks[0] = (cipc_path_break){0.5, 0, {0, 1, 0}};
    cipc_polylines p;
    cipc_error error;
    assert_int_equal(cipc_polylines_init(&p, &t.paths, 1, &error), CIPC_OK);
    assert_true(p.rounding[0] == INFINITY && cipc_polylines_deviation(&p, 0, 0)[0] == INFINITY && p.rounding[1] < 1e-100);
    cipc_polylines_free(&p);
}

static void test_lack_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 12;
    trial t;
    random_trial(&t, &seed, 50, 0, 1, 0);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = status_of(&t);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (!failed) { break; }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_rationals), cmocka_unit_test(test_straight_paths_do_not_stray), cmocka_unit_test(test_corners),
        cmocka_unit_test(test_jumps),             cmocka_unit_test(test_huge_coordinates),            cmocka_unit_test(test_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
