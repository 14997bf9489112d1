/* Broad phase: no pair that comes close is lost, few others are kept, the order is fixed, the cost grows like n log n, and no
 * allocation that fails does harm. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "support/cloth_soup.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

static int by_pair(const void *a, const void *b)
{
    const int *p = a, *q = b;
    return p[0] != q[0] ? p[0] - q[0] : p[1] - q[1];
}

static bool contains(int (*pairs)[2], int count, const int pair[2])
{
    return count > 0 && bsearch(pair, pairs, (size_t)count, sizeof *pairs, by_pair) != NULL;
}

/* What a search is asked, and its answer, sorted. */
typedef struct search {
    const soup *s;
    const double *p; /* NULL: no motion */
    double t_max, reach;
    const bool *is_dirichlet;
    cipc_candidates found;
    int close; /* pairs that had to be found */
} search;

static void find(search *q, int threads)
{
    cipc_broad_phase *b;
    assert_int_equal(cipc_broad_phase_create(&b, q->s->model, NULL), CIPC_OK);
    assert_int_equal(cipc_broad_phase_find(b, q->s->model, q->s->x, q->p, q->t_max, q->reach, q->is_dirichlet, threads, &q->found, NULL),
                     CIPC_OK);
    cipc_broad_phase_destroy(b);
}

static void sort(cipc_candidates *c)
{
    if (c->lists[CIPC_POINT_TRIANGLE].count > 0) qsort(c->lists[CIPC_POINT_TRIANGLE].pairs, (size_t)c->lists[CIPC_POINT_TRIANGLE].count, sizeof *c->lists[CIPC_POINT_TRIANGLE].pairs, by_pair);
    if (c->lists[CIPC_EDGE_EDGE].count > 0) qsort(c->lists[CIPC_EDGE_EDGE].pairs, (size_t)c->lists[CIPC_EDGE_EDGE].count, sizeof *c->lists[CIPC_EDGE_EDGE].pairs, by_pair);
}

static bool found(const search *q, bool edge_edge, const int pair[2])
{
    return edge_edge ? contains(q->found.lists[CIPC_EDGE_EDGE].pairs, q->found.lists[CIPC_EDGE_EDGE].count, pair)
                     : contains(q->found.lists[CIPC_POINT_TRIANGLE].pairs, q->found.lists[CIPC_POINT_TRIANGLE].count, pair);
}

/* Distances are compared with xi + reach exactly (GMP), on positions at the start or along the way. */
static void must_find_close_pair(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi)
{
    enum { PLACES = 9 };
    search *q = context;
    for (int i = 0; i < (q->p ? PLACES : 1); i++) {
        double y[12];
        if (q->p)
            soup_moved_stencil(q->s->x, q->p, q->t_max * i / (PLACES - 1), nodes, y);
        else
            soup_stencil(q->s->x, nodes, y);
        if (soup_box_distance(edge_edge, y) > 1.001 * (xi + q->reach)) continue;
        if (cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), y, xi) > q->reach) continue;
        if (!found(q, edge_edge, pair)) fail_msg("lost: %s %d %d", edge_edge ? "edges" : "node and triangle", pair[0], pair[1]);
        q->close++;
        return;
    }
}

/* Separation of the boxes that two primitives sweep. */
static double swept_box_distance(const search *q, bool edge_edge, const int nodes[4])
{
    double from[12], to[12], apart = 0;
    soup_stencil(q->s->x, nodes, from);
    memcpy(to, from, sizeof to);
    if (q->p) soup_moved_stencil(q->s->x, q->p, q->t_max, nodes, to);
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 4; i++) {
            int side = i >= (edge_edge ? 2 : 1);
            lo[side] = fmin(lo[side], fmin(from[3 * i + k], to[3 * i + k]));
            hi[side] = fmax(hi[side], fmax(from[3 * i + k], to[3 * i + k]));
        }
        apart = fmax(apart, fmax(lo[0] - hi[1], lo[1] - hi[0]));
    }
    return apart;
}

/* The answer is that of the boxes: nothing farther than xi + reach on every axis. The margin for rounding is 2^-40 of that and 8 ulp of the
 * coordinates. */
static void count_pair_by_box(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi)
{
    static const double ROUNDING_MARGIN = 0x1p-38;
    search *q = context;
    double apart = swept_box_distance(q, edge_edge, nodes), limit = xi + q->reach;
    if (apart > limit + ROUNDING_MARGIN)
        assert_false(found(q, edge_edge, pair));
    else
        q->close++;
}

static void assert_no_duplicates(int (*pairs)[2], int count)
{
    for (int i = 1; i < count; i++) assert_true(by_pair(pairs[i - 1], pairs[i]) < 0);
}

/* Exactly the pairs whose boxes come close; among them all that come close themselves. Returns the number of the latter. */
static int check(search *q)
{
    find(q, 2);
    sort(&q->found);
    assert_no_duplicates(q->found.lists[CIPC_POINT_TRIANGLE].pairs, q->found.lists[CIPC_POINT_TRIANGLE].count);
    assert_no_duplicates(q->found.lists[CIPC_EDGE_EDGE].pairs, q->found.lists[CIPC_EDGE_EDGE].count);
    q->close = 0;
    visit_all_pairs(q->s->model, q->is_dirichlet, count_pair_by_box, q);
    /* Pairs left out by visit_all_pairs (a common node, all Dirichlet) are not in the answer: the counts would differ. */
    assert_int_equal(q->close, q->found.lists[CIPC_POINT_TRIANGLE].count + q->found.lists[CIPC_EDGE_EDGE].count);
    q->close = 0;
    visit_all_pairs(q->s->model, q->is_dirichlet, must_find_close_pair, q);
    cipc_candidates_free(&q->found);
    return q->close;
}

static void test_finds_all_close_pairs(void **state)
{
    (void)state;
    static const double reaches[] = {0, 0.01, 0.1};
    int close = 0;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        soup_shape shape = soup_shape_default();
        shape.offset = seed % 2 ? 0.02 : 0;
        soup s = soup_create(&shape, seed);
        for (int r = 0; r < 3; r++) {
            search q = {.s = &s, .reach = reaches[r]};
            close += check(&q);
        }
        soup_destroy(&s);
    }
    assert_true(close >= 1000); /* the soup is thick enough to tell */
}

static void test_finds_all_pairs_that_come_close(void **state)
{
    (void)state;
    for (uint64_t seed = 11; seed <= 13; seed++) {
        soup_shape shape = soup_shape_default();
        soup s = soup_create(&shape, seed);
        search whole = {.s = &s, .p = s.p, .t_max = 1, .reach = 0.01}, part = {.s = &s, .p = s.p, .t_max = 0.3, .reach = 0.01};
        assert_true(check(&whole) > check(&part));
        soup_destroy(&s);
    }
}

/* A node that is Dirichlet or not is drawn for each node: every pair with one free node must be kept, and no other. */
static void test_dirichlet_filter(void **state)
{
    (void)state;
    uint64_t seed = 21;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, seed);
    for (int share = 0; share <= 4; share++) {
        for (int i = 0; i < s.model->node_count; i++) s.is_dirichlet[i] = random_below(&seed, 4) < share;
        search q = {.s = &s, .p = s.p, .t_max = 1, .reach = 0.02, .is_dirichlet = s.is_dirichlet};
        int close = check(&q);
        assert_int_equal(close > 0, share < 4);
    }
    soup_destroy(&s);
}

/* Far from the origin a coordinate's ulp is a large part of the reach; still nothing is lost. */
static void test_far_from_the_origin(void **state)
{
    (void)state;
    /* x from 1e7 on comes in steps of 2^-29, about 1.9e-9; the soup is 50 steps wide */
    soup_shape shape = {.sheets = 4, .cells = 4, .size = 1e-7, .jitter = 1e-8, .world = 7e-8, .offset = 1e-9, .motion = 3e-8};
    soup s = soup_create(&shape, 31);
    for (int i = 0; i < s.model->node_count; i++) s.x[3 * i] += 1e7;
    search q = {.s = &s, .p = s.p, .t_max = 1, .reach = 0x1p-29};
    find(&q, 1);
    sort(&q.found);
    visit_all_pairs(s.model, NULL, must_find_close_pair, &q);
    assert_true(q.close >= 500);
    cipc_candidates_free(&q.found);
    soup_destroy(&s);
}

/* A triangle at z = 0 below another one, of which only the first node comes near it, at height z. The first is 0.25 thick, the second
 * 0.75. */
static soup stack(double z)
{
    static const double gravity[3] = {0};
    const double low[] = {0, 0, 0, 4, 0, 0, 0, 4, 0}, high[] = {1, 1, z, 5, 1, z + 9, 1, 5, z + 9};
    const int triangle[1][3] = {{0, 1, 2}};
    cipc_body_description d[2];
    for (int b = 0; b < 2; b++) {
        d[b] = (cipc_body_description){.name = "t", .material = {.density = 1, .thickness = 1}, .node_count = 3, .triangle_count = 1};
        d[b].offset = b ? 0.75 : 0.25;
        d[b].rest = d[b].position = b ? high : low;
        d[b].triangles = triangle;
    }
    soup s = {.x = cipc_alloc(18, sizeof(double)), .p = cipc_alloc(18, sizeof(double))};
    assert_true(s.x && s.p);
    assert_int_equal(cipc_model_create(&s.model, d, 2, gravity, NULL), CIPC_OK);
    memcpy(s.x, low, sizeof low);
    memcpy(s.x + 9, high, sizeof high);
    return s;
}

static int pairs_of_stack(soup *s, const double *p, double reach)
{
    search q = {.s = s, .p = p, .t_max = 1, .reach = reach};
    find(&q, 1);
    int count = q.found.lists[CIPC_POINT_TRIANGLE].count;
    cipc_candidates_free(&q.found);
    cipc_model_destroy(s->model);
    cipc_free(s->x);
    cipc_free(s->p);
    return count;
}

/* A node straight above a triangle at exactly xi + reach is found, just beyond it is not. */
static void test_limit(void **state)
{
    (void)state;
    soup at = stack(0.75), beyond = stack(0.75 * (1 + 0x1p-30)); /* xi = (0.25 + 0.75) / 2 */
    assert_int_equal(pairs_of_stack(&at, NULL, 0.25), 1);
    assert_int_equal(pairs_of_stack(&beyond, NULL, 0.25), 0);
}

/* An ulp apart, and approaching by 0.98 of it, which neither end of the two paths shows in doubles. */
static void test_motion_below_an_ulp(void **state)
{
    (void)state;
    static const double HEIGHT = 0x1p23, ULP = 0x1p-29;
    soup s = stack(9);
    for (int b = 0; b < 2; b++) s.model->bodies[b].offset = 0;
    for (int i = 0; i < 6; i++) {
        s.x[3 * i + 2] = HEIGHT + (i < 3 ? 0 : i == 3 ? ULP : 9);
        s.p[3 * i + 2] = i < 3 ? 0.49 * ULP : -0.49 * ULP;
        assert_true(s.x[3 * i + 2] + s.p[3 * i + 2] == s.x[3 * i + 2]);
    }
    assert_int_equal(pairs_of_stack(&s, s.p, 0.9 * ULP), 1);
}

static void assert_same(const cipc_candidates *a, const cipc_candidates *b)
{
    assert_int_equal(a->lists[CIPC_POINT_TRIANGLE].count, b->lists[CIPC_POINT_TRIANGLE].count);
    assert_int_equal(a->lists[CIPC_EDGE_EDGE].count, b->lists[CIPC_EDGE_EDGE].count);
    assert_true(a->lists[CIPC_POINT_TRIANGLE].count > 0 && a->lists[CIPC_EDGE_EDGE].count > 0);
    assert_memory_equal(a->lists[CIPC_POINT_TRIANGLE].pairs, b->lists[CIPC_POINT_TRIANGLE].pairs, (size_t)a->lists[CIPC_POINT_TRIANGLE].count * sizeof *a->lists[CIPC_POINT_TRIANGLE].pairs);
    assert_memory_equal(a->lists[CIPC_EDGE_EDGE].pairs, b->lists[CIPC_EDGE_EDGE].pairs, (size_t)a->lists[CIPC_EDGE_EDGE].count * sizeof *a->lists[CIPC_EDGE_EDGE].pairs);
}

static void test_order_does_not_depend_on_threads(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 41);
    search one = {.s = &s, .p = s.p, .t_max = 1, .reach = 0.05, .is_dirichlet = s.is_dirichlet};
    find(&one, 1);
    assert_true(one.found.lists[CIPC_POINT_TRIANGLE].count > 100 && one.found.lists[CIPC_EDGE_EDGE].count > 100);
    for (int threads = 2; threads <= 3; threads++) {
        search more = one;
        memset(&more.found, 0, sizeof more.found);
        find(&more, threads);
        assert_same(&one.found, &more.found);
        cipc_candidates_free(&more.found);
    }
    cipc_candidates_free(&one.found);
    soup_destroy(&s);
}

static void deform(soup *s)
{
    for (int i = 0; i < 3 * s->model->node_count; i++) s->x[i] += 0.1 * s->p[i];
}

/* Trees that have been refitted, and rebuilt, over a long deformation answer like fresh ones. */
static void test_order_does_not_depend_on_the_past(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 42);
    cipc_broad_phase *b;
    cipc_candidates kept = {0};
    assert_int_equal(cipc_broad_phase_create(&b, s.model, NULL), CIPC_OK);
    for (int i = 0; i < 80; i++) {
        assert_int_equal(cipc_broad_phase_find(b, s.model, s.x, s.p, 0.5, 0.05, NULL, 2, &kept, NULL), CIPC_OK);
        if (i % 8 == 0) {
            search fresh = {.s = &s, .p = s.p, .t_max = 0.5, .reach = 0.05};
            find(&fresh, 1);
            assert_same(&kept, &fresh.found);
            cipc_candidates_free(&fresh.found);
        }
        deform(&s);
    }
    cipc_candidates_free(&kept);
    cipc_broad_phase_destroy(b);
    soup_destroy(&s);
}

static void ignore(void *context, int item)
{
    (void)context;
    (void)item;
}

/* Box tests of all nodes of a sheet against the boxes of its triangles, in units of n log2 n, n triangles. */
static double tree_cost(const soup *s)
{
    const cipc_model *m = s->model;
    cipc_box *boxes = cipc_alloc((size_t)m->triangle_count, sizeof *boxes);
    assert_non_null(boxes);
    for (int t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            double a = s->x[3 * m->triangles[t][0] + k], b = s->x[3 * m->triangles[t][1] + k], c = s->x[3 * m->triangles[t][2] + k];
            boxes[t].lo[k] = fmin(a, fmin(b, c));
            boxes[t].hi[k] = fmax(a, fmax(b, c));
        }
    cipc_box_tree *tree;
    size_t tests = 0;
    assert_int_equal(cipc_box_tree_create(&tree, boxes, m->triangle_count, NULL), CIPC_OK);
    for (int i = 0; i < m->node_count; i++) {
        cipc_box point;
        memcpy(point.lo, s->x + 3 * i, sizeof point.lo);
        memcpy(point.hi, s->x + 3 * i, sizeof point.hi);
        cipc_box_tree_query(tree, &point, ignore, NULL, &tests);
    }
    cipc_box_tree_destroy(tree);
    cipc_free(boxes);
    return (double)tests / (m->triangle_count * log2(m->triangle_count));
}

/* A crumpled sheet of ever more cells of one size. Every node has about as many neighbours, so the answers grow like n (a sheet's
 * border, with fewer, is a quarter of the nodes of the smallest), and the box tests like n log n. If either were quadratic, it would
 * grow 64-fold. */
#define MOST_GROWTH 1.5
static void test_cost_grows_like_n_log_n(void **state)
{
    (void)state;
    double least = INFINITY, most = 0, least_cost = INFINITY, most_cost = 0;
    for (int cells = 16; cells <= 128; cells *= 2) {
        soup_shape shape = {.sheets = 1, .cells = cells, .size = 0.1 * cells, .jitter = 0.03};
        soup s = soup_create(&shape, 51);
        search q = {.s = &s, .reach = 0.02};
        find(&q, 2);
        double answers = (double)(q.found.lists[CIPC_POINT_TRIANGLE].count + q.found.lists[CIPC_EDGE_EDGE].count) / s.model->triangle_count, cost = tree_cost(&s);
        least = fmin(least, answers), most = fmax(most, answers);
        least_cost = fmin(least_cost, cost), most_cost = fmax(most_cost, cost);
        cipc_candidates_free(&q.found);
        soup_destroy(&s);
    }
    assert_true(most <= MOST_GROWTH * least);
    assert_true(most_cost <= MOST_GROWTH * least_cost);
}

static void test_create_out_of_memory(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 61);
    cipc_broad_phase *b;
    cipc_error error;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_broad_phase_create(&b, s.model, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_null(b);
    }
    fail_allocation(0);
    assert_int_equal(n, 7); /* six allocations */
    cipc_broad_phase_destroy(b);
    cipc_broad_phase_destroy(NULL);
    soup_destroy(&s);
}

static cipc_status find_failing(cipc_broad_phase *b, const search *q, long n, cipc_candidates *c)
{
    cipc_error error;
    fail_allocation(n);
    cipc_status status = cipc_broad_phase_find(b, q->s->model, q->s->x, q->p, q->t_max, q->reach, NULL, 1, c, &error);
    if (allocation_failed()) assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
    if (allocation_failed())
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
    else
        assert_int_equal(status, CIPC_OK);
    fail_allocation(0);
    return status;
}

/* After any failure - of the trees, of the pieces, of the answer, in the first search or in the one that rebuilds - the next search is
 * right. */
static void test_find_out_of_memory(void **state)
{
    (void)state;
    enum { SEARCHES = 40, TREES = 10 }; /* within so many searches the trees are rebuilt; a rebuild makes 8 allocations */
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 62);
    search q = {.s = &s, .p = s.p, .t_max = 1, .reach = 0.05};
    find(&q, 1);
    int failures = 0, late_failures = 0;
    for (long n = 1;; n++) {
        cipc_broad_phase *b;
        cipc_candidates c = {0};
        assert_int_equal(cipc_broad_phase_create(&b, s.model, NULL), CIPC_OK);
        bool failed = find_failing(b, &q, n, &c) != CIPC_OK;
        for (int i = 0; n <= TREES && i < SEARCHES; i++) late_failures += find_failing(b, &q, n, &c) != CIPC_OK;
        assert_int_equal(find_failing(b, &q, 0, &c), CIPC_OK);
        assert_same(&c, &q.found);
        cipc_candidates_free(&c);
        cipc_broad_phase_destroy(b);
        failures += failed;
        if (!failed) break;
    }
    assert_true(failures > 50); /* 8 for the trees, some for the pieces, 2 for the answer */
    assert_true(late_failures > 0);
    cipc_candidates_free(&q.found);
    soup_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_finds_all_close_pairs),
        cmocka_unit_test(test_finds_all_pairs_that_come_close),
        cmocka_unit_test(test_dirichlet_filter),
        cmocka_unit_test(test_far_from_the_origin),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_motion_below_an_ulp),
        cmocka_unit_test(test_order_does_not_depend_on_threads),
        cmocka_unit_test(test_order_does_not_depend_on_the_past),
        cmocka_unit_test(test_cost_grows_like_n_log_n),
        cmocka_unit_test(test_create_out_of_memory),
        cmocka_unit_test(test_find_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
