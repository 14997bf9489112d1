/* The largest free step over all candidates: the least of the pairs' own steps, whatever the order of the pairs and the number of threads;
 * and no pair touches on the way. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "support/cloth_soup.h"
#include "support/exact_geometry.h"

/* All pairs of a soup that are apart at the start. */
static void keep_apart(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi)
{
    soup *s = ((void **)context)[0];
    cipc_candidates *c = ((void **)context)[1];
    double y[12];
    soup_stencil(s->x, nodes, y);
    if (soup_box_distance(edge_edge, y) <= xi && cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), y, xi) <= 0) return;
    int(**pairs)[2] = edge_edge ? &c->lists[CIPC_EDGE_EDGE].pairs : &c->lists[CIPC_POINT_TRIANGLE].pairs, *count = edge_edge ? &c->lists[CIPC_EDGE_EDGE].count : &c->lists[CIPC_POINT_TRIANGLE].count;
    memcpy((*pairs)[(*count)++], pair, 2 * sizeof(int));
}

static cipc_candidates all_candidates(const soup *s)
{
    size_t nodes = (size_t)s->model->node_count, triangles = (size_t)s->model->triangle_count, edges = (size_t)s->model->edge_count;
    cipc_candidates c = {.lists[CIPC_POINT_TRIANGLE].pairs = cipc_alloc(nodes * triangles, 2 * sizeof(int)),
                         .lists[CIPC_EDGE_EDGE].pairs = cipc_alloc(edges * edges / 2, 2 * sizeof(int))};
    assert_true(c.lists[CIPC_POINT_TRIANGLE].pairs && c.lists[CIPC_EDGE_EDGE].pairs);
    const void *context[2] = {s, &c};
    visit_all_pairs(s->model, s->is_dirichlet, keep_apart, context);
    return c;
}

/* How a path is to be tried. */
typedef struct trial {
    const soup *s;
    const cipc_candidates *candidates;
    double t_max;
    cipc_ccd_options options;
} trial;

typedef struct answer {
    double t;
    int nodes[4];
    cipc_pair_kind kind;
} answer;

static answer solve(const trial *t, int threads)
{
    answer a = {.kind = CIPC_PAIR_KIND_COUNT};
    a.t = cipc_candidates_ccd(t->s->model, t->candidates, t->s->x, t->s->p, t->t_max, &t->options, threads, a.nodes, &a.kind);
    return a;
}

static void assert_same(const answer *a, const answer *b)
{
    if (a->t != b->t) fail_msg("steps %.17g and %.17g", a->t, b->t);
    assert_memory_equal(a->nodes, b->nodes, sizeof a->nodes);
    assert_int_equal(a->kind, b->kind);
}

/* Do the boxes of the two primitives' paths over [0, t_max] stay apart by more than xi? Such a pair cannot touch. */
static bool paths_apart(const trial *t, bool edge_edge, const int nodes[4], double xi, double t_max)
{
    double y[12], z[12];
    int first = edge_edge ? 2 : 1;
    soup_stencil(t->s->x, nodes, y);
    soup_moved_stencil(t->s->x, t->s->p, t_max, nodes, z);
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 4; i++) {
            lo[i >= first] = fmin(lo[i >= first], fmin(y[3 * i + k], z[3 * i + k]));
            hi[i >= first] = fmax(hi[i >= first], fmax(y[3 * i + k], z[3 * i + k]));
        }
        if (lo[0] - hi[1] > xi || lo[1] - hi[0] > xi) return true;
    }
    return false;
}

/* The plain form: every pair by itself, the first of the earliest. */
static answer plain(const trial *t)
{
    const cipc_model *m = t->s->model;
    const cipc_candidates *c = t->candidates;
    answer best = {.t = t->t_max, .nodes = {-1, -1, -1, -1}, .kind = CIPC_PAIR_KIND_COUNT};
    bool any = false;
    for (int i = 0; i < c->lists[CIPC_POINT_TRIANGLE].count + c->lists[CIPC_EDGE_EDGE].count; i++) {
        bool edge_edge = i >= c->lists[CIPC_POINT_TRIANGLE].count;
        const int *pair = edge_edge ? c->lists[CIPC_EDGE_EDGE].pairs[i - c->lists[CIPC_POINT_TRIANGLE].count] : c->lists[CIPC_POINT_TRIANGLE].pairs[i],
                  *v = edge_edge ? NULL : m->triangles[pair[1]];
        const int nodes[4] = {edge_edge ? m->edges[pair[0]][0] : pair[0], edge_edge ? m->edges[pair[0]][1] : v[0],
                              edge_edge ? m->edges[pair[1]][0] : v[1], edge_edge ? m->edges[pair[1]][1] : v[2]};
        cipc_stencil_path path = {.kind = cipc_mesh_pair(edge_edge)};
        double xi = cipc_model_pair_offset(m, nodes[0], nodes[2]);
        if (paths_apart(t, edge_edge, nodes, xi, t->options.gap_first ? 1 : t->t_max)) continue;
        soup_stencil(t->s->x, nodes, path.x);
        soup_stencil(t->s->p, nodes, path.p);
        cipc_ccd_result r = cipc_ccd(&path, xi, t->t_max, &t->options);
        if (!r.hit || (any && r.toi >= best.t)) continue;
        any = true;
        best = (answer){.t = r.toi, .nodes = {nodes[0], nodes[1], nodes[2], nodes[3]}, .kind = cipc_mesh_pair(edge_edge)};
    }
    return best;
}

static void reverse(int (*pairs)[2], int count)
{
    for (int i = 0; i < count / 2; i++)
        for (int k = 0; k < 2; k++) {
            int swap = pairs[i][k];
            pairs[i][k] = pairs[count - 1 - i][k];
            pairs[count - 1 - i][k] = swap;
        }
}

/* Many soups, of which some are limited early, some late, some not at all. */
static void test_is_the_least_of_all_pairs(void **state)
{
    (void)state;
    int limited = 0, by_edges = 0, free_ways = 0;
    for (int seed = 1; seed <= 40; seed++) {
        soup_shape shape = soup_shape_default();
        shape.cells = 3;
        shape.motion = seed % 4 ? 0.02 * seed : 1e-3;
        shape.offset = seed % 2 ? 0.02 : 1e-4;
        soup s = soup_create(&shape, (uint64_t)(300 + seed));
        cipc_candidates c = all_candidates(&s);
        trial t = {.s = &s, .candidates = &c, .t_max = seed % 3 ? 1 : 0.4, .options = cipc_ccd_options_default()};
        for (int way = 0; way < 3; way++) { /* certified; additive in both orders */
            t.options.method = way == 0 ? CIPC_CCD_CERTIFIED : CIPC_CCD_ADDITIVE;
            t.options.gap_first = way == 2;
            answer want = plain(&t);
            for (int threads = 1; threads <= 3; threads++) {
                answer got = solve(&t, threads);
                assert_same(&got, &want);
            }
            reverse(c.lists[CIPC_POINT_TRIANGLE].pairs, c.lists[CIPC_POINT_TRIANGLE].count);
            reverse(c.lists[CIPC_EDGE_EDGE].pairs, c.lists[CIPC_EDGE_EDGE].count);
            assert_true(solve(&t, 1).t == want.t && solve(&t, 2).t == want.t);
            limited += want.nodes[0] >= 0;
            by_edges += want.kind == CIPC_EDGE_EDGE;
            free_ways += want.nodes[0] < 0;
        }
        cipc_candidates_free(&c);
        soup_destroy(&s);
    }
    assert_true(limited >= 20 && by_edges >= 5 && free_ways >= 5);
}

/* Nothing touches on the way, by exact distances. */
static void assert_apart_on_the_way(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi)
{
    enum { PLACES = 5 };
    soup *s = ((void **)context)[0];
    double step = *(const double *)((void **)context)[1], y[12];
    (void)pair;
    for (int i = 0; i < PLACES; i++) {
        soup_moved_stencil(s->x, s->p, step * i / (PLACES - 1), nodes, y);
        if (soup_box_distance(edge_edge, y) > xi) continue;
        bool apart = cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), y, xi) > 0;
        if (i == 0 && !apart) return; /* not one of the candidates */
        assert_true(apart);
    }
}

static void test_way_is_free(void **state)
{
    (void)state;
    for (uint64_t seed = 351; seed <= 356; seed++) {
        soup_shape shape = soup_shape_default();
        shape.offset = 1e-3;
        soup s = soup_create(&shape, seed);
        cipc_candidates c = all_candidates(&s);
        trial t = {.s = &s, .candidates = &c, .t_max = 1, .options = cipc_ccd_options_default()};
        double step = solve(&t, 2).t;
        assert_true(step > 0 && step < 1);
        void *context[2] = {&s, &step};
        visit_all_pairs(s.model, s.is_dirichlet, assert_apart_on_the_way, context);
        cipc_candidates_free(&c);
        soup_destroy(&s);
    }
}

/* A triangle of height 1 above another one falls at speed 2; its second node is lower by `tilt`. */
static soup facing(double tilt, double offset, double x[18], double p[18])
{
    static const double gravity[3] = {0};
    const double nodes[2][9] = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 1, 1, 0, 1 - tilt, 0, 1, 1}};
    const int triangle[1][3] = {{0, 1, 2}};
    cipc_body_description d[2];
    for (int b = 0; b < 2; b++) {
        d[b] = (cipc_body_description){.name = "t", .material = {.density = 1, .thickness = 1}, .node_count = 3, .triangle_count = 1};
        d[b].offset = (1 + b) * offset;
        d[b].rest = d[b].position = nodes[b];
        d[b].triangles = triangle;
    }
    soup s = {.x = x, .p = p};
    assert_int_equal(cipc_model_create(&s.model, d, 2, gravity, NULL), CIPC_OK);
    memcpy(x, nodes, sizeof nodes);
    for (int i = 0; i < 18; i++) p[i] = i > 9 && i % 3 == 2 ? -2 : 0;
    return s;
}

/* All pairs that face each other hit at (1 - s)(d - xi)/P, unless the path ends before. */
static void test_known_answer(void **state)
{
    (void)state;
    static const double ROUNDINGS = 128 * UNIT_ROUNDOFF; /* the certified bound gives up 16 u |n|_1 S of a gap of 0.625: 77 u for S = 3 */
    double x[18], p[18], want = 0.9 * (1 - 0.375) / 2;
    soup s = facing(0, 0.25, x, p);
    cipc_candidates c = all_candidates(&s), empty = {0};
    trial t = {.s = &s, .candidates = &c, .t_max = 1, .options = cipc_ccd_options_default()};
    assert_true(fabs(solve(&t, 2).t - want) <= ROUNDINGS * want);
    t.t_max = 0.4; /* closer than xi, but not yet at d = 0 */
    assert_true(fabs(solve(&t, 2).t - want) <= ROUNDINGS * want);
    /* the limiting pair need not be asked for */
    assert_true(cipc_candidates_ccd(s.model, &c, x, p, 1, &t.options, 1, NULL, NULL) == solve(&t, 1).t);
    t.t_max = 0.25;
    answer none = solve(&t, 2);
    assert_true(none.t == 0.25 && none.nodes[0] == -1 && none.nodes[3] == -1 && none.kind == CIPC_PAIR_KIND_COUNT);
    t.candidates = &empty;
    assert_true(solve(&t, 2).t == 0.25);
    cipc_candidates_free(&c);
    cipc_model_destroy(s.model);
}

/* The second pair's gap, and that of its box, is as large as the first pair's step, its own step is smaller: it must not be passed over. */
static void test_a_later_pair_may_be_earlier(void **state)
{
    (void)state;
    double x[18], p[18];
    soup s = facing(0.05, 0, x, p);
    cipc_candidates c = all_candidates(&s);
    trial t = {.s = &s, .candidates = &c, .t_max = 1, .options = cipc_ccd_options_default()};
    for (int method = CIPC_CCD_CERTIFIED; method <= CIPC_CCD_ADDITIVE; method++) {
        t.options.method = (cipc_ccd_method)method;
        answer want = plain(&t), got = solve(&t, 1);
        assert_same(&got, &want);
        /* the certified steps along a fixed direction make it a tie, but for rounding */
        assert_true(want.nodes[0] == 1 || (method == CIPC_CCD_CERTIFIED && fabs(want.t - 0.9 * 0.95 / 2) <= 0x1p-9));
    }
    cipc_candidates_free(&c);
    cipc_model_destroy(s.model);
}

/* Two flat sheets with some hundred pairs that all hit at the same time: the first of the list is named, by any thread. */
static void test_ties_go_to_the_first(void **state)
{
    (void)state;
    soup_shape shape = {.sheets = 2, .cells = 8, .size = 1};
    soup s = soup_create(&shape, 361);
    int n = s.model->node_count / 2;
    for (int i = 0; i < n; i++)
        for (int b = 0; b < 2; b++) {
            double *x = s.x + 3 * (b * n + i);
            x[0] = 0.125 * (i % 9), x[1] = 0.125 * (i / 9), x[2] = b;
            s.p[3 * (b * n + i) + 2] = b ? -2 : 0;
        }
    cipc_candidates c = all_candidates(&s);
    trial t = {.s = &s, .candidates = &c, .t_max = 1, .options = cipc_ccd_options_default()};
    answer want = plain(&t);
    assert_true(fabs(want.t - 0.45) <= 64 * UNIT_ROUNDOFF && want.kind == CIPC_POINT_TRIANGLE);
    assert_int_equal(want.nodes[0], 0);
    for (int repeat = 0; repeat < 20; repeat++)
        for (int threads = 1; threads <= 3; threads++) {
            answer got = solve(&t, threads);
            assert_same(&got, &want);
        }
    cipc_candidates_free(&c);
    soup_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_is_the_least_of_all_pairs),
        cmocka_unit_test(test_way_is_free),
        cmocka_unit_test(test_known_answer),
        cmocka_unit_test(test_a_later_pair_may_be_earlier),
        cmocka_unit_test(test_ties_go_to_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
