/* The active set against all pairs one by one: which are active, what they weigh, what merging keeps, when edges are mollified; the
 * smallest gap; and equality for any number of threads. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "support/cloth_soup.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

#define STIFFNESS 7.0

/* SPEC D.3: eps_x = 1e-3 |A|^2 |B|^2. */
#define MOLLIFIED_SINE2 1e-3

/* A sum of up to some thousand weights of size one. */
static const double WEIGHT_ROUNDING = 1e4 * UNIT_ROUNDOFF;

/* Distances in these scenes are good to 32 u of lengths below 4, and all gaps of the energy test are above 1e-4. b(D) varies by at most
 * about 1/D per unit of D, D >= 2 xi 1e-4 with xi near 1e-2: 32 u 4 / 2e-6 is 7e-9 for the worst pair. */
static const double ENERGY_ROUNDING = 1e-8;

/* ---- The plain form: one pair after the other. ---- */

typedef struct plain_pair {
    cipc_energy_id energy;
    int nodes[4];
    double gap, weight, value;
    bool mollified;
} plain_pair;

typedef struct plain_set {
    const soup *s;
    const double *x;
    cipc_contact_options options;
    double mean_node_area, mean_edge_area;
    double least_gap; /* pairs closer than that are left out of candidates and set */
    cipc_candidates candidates;
    int count, capacity;
    plain_pair *pairs;
} plain_set;

static double length2(const double *x, int a, int b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (x[3 * a + k] - x[3 * b + k]) * (x[3 * a + k] - x[3 * b + k]);
    return sum;
}

static double cross2(const double y[12])
{
    double a[3] = {y[3] - y[0], y[4] - y[1], y[5] - y[2]}, b[3] = {y[9] - y[6], y[10] - y[7], y[11] - y[8]};
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
}

/* Energy and nodes of the closest features; point-point and point-edge: the exchangeable nodes in ascending order, unless directed. */
static void classify(plain_pair *p, bool edge_edge, const double y[12], const int nodes[4], bool directed)
{
    cipc_feature f = edge_edge ? cipc_edge_edge_feature(y) : cipc_point_triangle_feature(y);
    p->energy = (cipc_energy_id)(CIPC_ENERGY_BARRIER_POINT_POINT + f.kind);
    for (int i = 0; i < 4; i++) p->nodes[i] = i < f.count ? nodes[f.local[i]] : -1;
    int low = f.kind == CIPC_POINT_POINT ? 0 : 1;
    if (f.kind <= CIPC_POINT_EDGE && !directed && p->nodes[low] > p->nodes[low + 1]) {
        int swap = p->nodes[low];
        p->nodes[low] = p->nodes[low + 1];
        p->nodes[low + 1] = swap;
    }
}

static void add_pair(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi)
{
    plain_set *set = context;
    const cipc_model *m = set->s->model;
    double y[12], distance2, dhat = set->options.dhat, b[3];
    soup_stencil(set->x, nodes, y);
    bool far = soup_box_distance(edge_edge, y) > xi + dhat;
    plain_pair p = {.gap = far ? INFINITY : cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), y, xi), .weight = 1};
    if (p.gap < set->least_gap) return;
    cipc_candidates *c = &set->candidates;
    memcpy(edge_edge ? c->lists[CIPC_EDGE_EDGE].pairs[c->lists[CIPC_EDGE_EDGE].count++] : c->lists[CIPC_POINT_TRIANGLE].pairs[c->lists[CIPC_POINT_TRIANGLE].count++], pair, 2 * sizeof(int));
    if (p.gap >= dhat) return;
    if (set->options.area_weights)
        p.weight = edge_edge ? 0.5 * (m->edge_area[pair[0]] + m->edge_area[pair[1]]) / set->mean_edge_area
                             : m->node_area[nodes[0]] / set->mean_node_area;
    classify(&p, edge_edge, y, nodes, set->options.merge_directed);
    distance2 = cipc_exact_distance2(cipc_mesh_pair(edge_edge), y, NULL);
    cipc_barrier(distance2 - xi * xi, dhat * dhat + 2 * xi * dhat, b);
    p.value = STIFFNESS * p.weight * b[0];
    if (edge_edge) {
        double sine2 = cross2(y) / (length2(m->rest, nodes[0], nodes[1]) * length2(m->rest, nodes[2], nodes[3])),
               ratio = sine2 / MOLLIFIED_SINE2;
        p.mollified = ratio < 1;
        if (p.mollified) p.value *= ratio * (2 - ratio);
        if (p.mollified) p.energy = CIPC_ENERGY_BARRIER_EDGE_EDGE;
        if (p.mollified) memcpy(p.nodes, nodes, sizeof p.nodes);
    }
    assert_true(set->count < set->capacity);
    set->pairs[set->count++] = p;
}

static plain_set plain(const soup *s, const cipc_contact_options *options, double least_gap)
{
    enum { MOST_ACTIVE = 100000 };
    const cipc_model *m = s->model;
    size_t edges = (size_t)m->edge_count;
    plain_set set = {.s = s, .x = s->x, .options = *options, .least_gap = least_gap, .capacity = MOST_ACTIVE};
    set.candidates.lists[CIPC_POINT_TRIANGLE].pairs = cipc_alloc((size_t)m->node_count * (size_t)m->triangle_count, 2 * sizeof(int));
    set.candidates.lists[CIPC_EDGE_EDGE].pairs = cipc_alloc(edges * edges / 2, 2 * sizeof(int));
    set.pairs = cipc_alloc(MOST_ACTIVE, sizeof *set.pairs);
    assert_true(set.candidates.lists[CIPC_POINT_TRIANGLE].pairs && set.candidates.lists[CIPC_EDGE_EDGE].pairs && set.pairs);
    for (int i = 0; i < m->node_count; i++) set.mean_node_area += m->node_area[i] / m->node_count;
    for (int e = 0; e < m->edge_count; e++) set.mean_edge_area += m->edge_area[e] / m->edge_count;
    visit_all_pairs(m, s->is_dirichlet, add_pair, &set);
    return set;
}

static void free_plain(plain_set *set)
{
    cipc_candidates_free(&set->candidates);
    cipc_free(set->pairs);
}

/* ---- Comparison. ---- */

static cipc_contact_set build(const plain_set *p, int threads)
{
    cipc_contact_set set = {0};
    assert_int_equal(cipc_contact_set_build(&set, p->s->model, &p->candidates, p->x, STIFFNESS, &p->options, threads, NULL), CIPC_OK);
    return set;
}

static double value_of(const cipc_contact *c, const double *x)
{
    double y[12];
    for (int i = 0; i < 3 * c->count; i++) y[i] = x[3 * c->nodes[i / 3] + i % 3];
    return cipc_energy_entry(c->energy)->value(y, &c->barrier);
}

static bool stands_for(const cipc_contact *c, const plain_pair *p)
{
    return c->energy == p->energy && memcmp(c->nodes, p->nodes, sizeof p->nodes) == 0 && (c->barrier.mollifier_eps > 0) == p->mollified;
}

static double relative(double got, double want)
{
    return fabs(got - want) / fabs(want);
}

/* Every contact is the sum of exactly the plain pairs on its nodes, and every plain pair is in one. Returns how many were merged away. */
static int assert_equals_plain(const cipc_contact_set *set, const plain_set *want)
{
    int total = 0;
    double energy = 0, all = 0, least = INFINITY;
    for (int i = 0; i < set->count; i++) {
        const cipc_contact *c = &set->contacts[i];
        double weight = 0, value = 0;
        int multiplicity = 0;
        for (int k = 0; k < want->count; k++) {
            const plain_pair *p = &want->pairs[k];
            if (!stands_for(c, p)) continue;
            multiplicity++;
            weight += p->weight;
            value += p->value;
            assert_true(fabs(cipc_contact_gap(c, want->x) - p->gap) <= ENERGY_ROUNDING);
        }
        assert_true(multiplicity > 0);
        assert_int_equal(c->multiplicity, multiplicity);
        assert_true(relative(c->barrier.weight, weight) <= WEIGHT_ROUNDING);
        assert_true(relative(value_of(c, want->x), value) <= ENERGY_ROUNDING || fabs(value) < DBL_MIN);
        assert_true(c->barrier.stiffness == STIFFNESS && c->barrier.dhat == want->options.dhat);
        total += multiplicity;
        energy += value_of(c, want->x);
    }
    for (int k = 0; k < want->count; k++) all += want->pairs[k].value, least = fmin(least, want->pairs[k].gap);
    assert_int_equal(total, want->count);
    assert_int_equal(set->total_multiplicity, want->count);
    assert_true(relative(energy, all) <= ENERGY_ROUNDING);
    assert_true(relative(set->min_gap, least) <= ENERGY_ROUNDING);
    assert_true(cipc_contact_gap(&set->contacts[set->min_gap_contact], want->x) == set->min_gap);
    return total - set->count;
}

static cipc_contact_options options_of(bool area_weights, bool merge_directed)
{
    cipc_contact_options options = cipc_contact_options_default();
    options.dhat = 0.05;
    options.area_weights = area_weights;
    options.merge_directed = merge_directed;
    return options;
}

/* Soups whose rest shape is the crumpled one (edges and areas of all sizes), with both kinds of weights and of merging. */
static void test_equals_all_pairs(void **state)
{
    (void)state;
    int merged[2] = {0, 0}, mollified = 0, kinds[4] = {0};
    for (uint64_t seed = 401; seed <= 406; seed++) {
        soup_shape shape = soup_shape_default();
        shape.crease_allowed = seed % 3 > 0;
        if (seed % 3 == 0) shape.size = 0.15, shape.jitter = 0.0005, shape.world = 0.05; /* nearly parallel edges within dhat */
        soup s = soup_create(&shape, seed);
        for (int way = 0; way < 4; way++) {
            cipc_contact_options options = options_of(way & 1, way & 2);
            plain_set want = plain(&s, &options, 1e-4);
            cipc_contact_set set = build(&want, 2);
            assert_true(want.count >= 50);
            merged[way / 2] += assert_equals_plain(&set, &want);
            for (int i = 0; i < set.count; i++) {
                kinds[set.contacts[i].energy - CIPC_ENERGY_BARRIER_POINT_POINT]++;
                mollified += set.contacts[i].barrier.mollifier_eps > 0;
            }
            cipc_contact_set_free(&set);
            free_plain(&want);
        }
        soup_destroy(&s);
    }
    for (int k = 0; k < 4; k++) assert_true(kinds[k] >= 20);
    assert_true(mollified >= 20);
    /* directed merging keeps more stencils apart, but it merges some */
    assert_true(merged[0] > merged[1] && merged[1] > 0);
}

/* Pairs in contact and beyond are in the set too, and min_gap says so. */
static void test_pairs_in_contact_are_active(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 411);
    cipc_contact_options options = options_of(true, false);
    plain_set want = plain(&s, &options, -INFINITY);
    cipc_contact_set set = build(&want, 1);
    double least = INFINITY;
    for (int k = 0; k < want.count; k++) least = fmin(least, want.pairs[k].gap);
    assert_true(least < 0 && set.min_gap < 0);
    assert_true(fabs(set.min_gap - least) <= ENERGY_ROUNDING);
    assert_int_equal(set.total_multiplicity, want.count);
    cipc_contact_set_free(&set);
    free_plain(&want);
    soup_destroy(&s);
}

static bool same_contact(const cipc_contact *a, const cipc_contact *b)
{
    const cipc_contact_barrier *p = &a->barrier, *q = &b->barrier;
    return a->energy == b->energy && a->count == b->count && memcmp(a->nodes, b->nodes, sizeof a->nodes) == 0 &&
           a->multiplicity == b->multiplicity && memcmp(&p->stiffness, &q->stiffness, offsetof(cipc_contact_barrier, feature)) == 0 &&
           memcmp(&p->feature, &q->feature, sizeof p->feature) == 0;
}

static void assert_same_set(const cipc_contact_set *a, const cipc_contact_set *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->min_gap_contact, b->min_gap_contact);
    assert_int_equal(a->total_multiplicity, b->total_multiplicity);
    assert_memory_equal(&a->min_gap, &b->min_gap, sizeof a->min_gap);
    for (int i = 0; i < a->count; i++) assert_true(same_contact(&a->contacts[i], &b->contacts[i]));
}

static void test_same_for_any_number_of_threads(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 421);
    cipc_contact_options options = options_of(true, false);
    plain_set p = plain(&s, &options, 0);
    cipc_contact_set one = build(&p, 1);
    assert_true(one.count >= 100);
    for (int threads = 2; threads <= 3; threads++) {
        cipc_contact_set more = build(&p, threads);
        assert_same_set(&one, &more);
        /* once more into a set that has been used */
        assert_int_equal(cipc_contact_set_build(&more, s.model, &p.candidates, s.x, STIFFNESS, &options, threads, NULL), CIPC_OK);
        assert_same_set(&one, &more);
        cipc_contact_set_free(&more);
    }
    cipc_contact_set_free(&one);
    free_plain(&p);
    soup_destroy(&s);
}

/* ---- Two triangles by hand. ---- */

typedef struct two_triangles {
    cipc_model *model;
    double x[18];
    cipc_candidates candidates;
    int (*pair)[2];
} two_triangles;

/* Rest shapes a and b; the only candidate is a pair of edges of the two, or node 3 (the first of b) with triangle 0. */
static two_triangles two(const double a[9], const double b[9], bool edge_edge)
{
    static const double gravity[3] = {0};
    const int triangle[1][3] = {{0, 1, 2}};
    cipc_body_description d[2];
    for (int i = 0; i < 2; i++)
        d[i] = (cipc_body_description){.name = "t",
                                       .material = {.density = 1, .thickness = 1},
                                       .node_count = 3,
                                       .rest = i ? b : a,
                                       .position = i ? b : a,
                                       .triangle_count = 1,
                                       .triangles = triangle};
    two_triangles t = {.pair = cipc_alloc(1, 2 * sizeof(int))};
    assert_int_equal(cipc_model_create(&t.model, d, 2, gravity, NULL), CIPC_OK);
    memcpy(t.x, a, 9 * sizeof *a);
    memcpy(t.x + 9, b, 9 * sizeof *b);
    t.pair[0][0] = edge_edge ? 0 : 3; /* edges in ascending order: 0 1, 0 2, 1 2, 3 4, ... */
    t.pair[0][1] = edge_edge ? 3 : 0;
    *(edge_edge ? &t.candidates.lists[CIPC_EDGE_EDGE].pairs : &t.candidates.lists[CIPC_POINT_TRIANGLE].pairs) = t.pair;
    *(edge_edge ? &t.candidates.lists[CIPC_EDGE_EDGE].count : &t.candidates.lists[CIPC_POINT_TRIANGLE].count) = 1;
    return t;
}

static cipc_contact_set build_two(const two_triangles *t, double dhat)
{
    cipc_contact_options options = {.dhat = dhat};
    cipc_contact_set set = {0};
    assert_int_equal(cipc_contact_set_build(&set, t->model, &t->candidates, t->x, 1, &options, 1, NULL), CIPC_OK);
    return set;
}

static void free_two(two_triangles *t)
{
    cipc_model_destroy(t->model);
    cipc_candidates_free(&t->candidates);
}

/* Active if d < xi + dhat, not at equality. */
static void test_limit_of_activation(void **state)
{
    (void)state;
    const double low[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0}, high[9] = {1, 1, 0.125, 5, 1, 9, 1, 5, 9};
    two_triangles t = two(low, high, false);
    cipc_contact_set at = build_two(&t, 0.125), inside = build_two(&t, 0.125 * (1 + DBL_EPSILON));
    assert_int_equal(at.count, 0);
    assert_int_equal(at.total_multiplicity, 0);
    assert_int_equal(at.min_gap_contact, -1);
    assert_true(at.min_gap == INFINITY);
    assert_int_equal(inside.count, 1);
    assert_int_equal(inside.contacts[0].energy, CIPC_ENERGY_BARRIER_POINT_TRIANGLE);
    const int nodes[4] = {3, 0, 1, 2};
    assert_memory_equal(inside.contacts[0].nodes, nodes, sizeof nodes);
    assert_true(inside.min_gap == 0.125);
    cipc_contact_set_free(&at);
    cipc_contact_set_free(&inside);
    free_two(&t);
}

/* Crossing edges at an angle of this sine, 0.25 apart, the first `stretch` times its rest length. */
static cipc_contact_set crossing(double sine, double stretch)
{
    double a[9] = {-1, 0, 0, 1, 0, 0, 0, 9, -9}, c = sqrt(1 - sine * sine), b[9] = {-c, -sine, 0.25, c, sine, 0.25, 0, 9, 9};
    two_triangles t = two(a, b, true);
    t.x[0] *= stretch;
    t.x[3] *= stretch;
    cipc_contact_set set = build_two(&t, 0.5);
    assert_int_equal(set.count, 1);
    free_two(&t);
    return set;
}

/* On below sin^2 = 1e-3, where sin is of the cross product over the rest lengths. */
static void test_mollifier_threshold(void **state)
{
    (void)state;
    const double threshold = sqrt(MOLLIFIED_SINE2);
    const struct {
        double sine, stretch;
        bool mollified;
    } cases[] = {
        {1, 1, false},   {0.5, 1, false}, {1.001 * threshold, 1, false}, {0.999 * threshold, 1, true},
        {1e-3, 1, true}, {0, 1, true},    {0.6 * threshold, 2, false},   {1.5 * threshold, 0.5, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_contact_set set = crossing(cases[i].sine, cases[i].stretch);
        const cipc_contact *c = &set.contacts[0];
        assert_int_equal(c->barrier.mollifier_eps > 0, cases[i].mollified);
        if (cases[i].mollified) assert_true(relative(c->barrier.mollifier_eps, MOLLIFIED_SINE2 * 4 * 4) <= WEIGHT_ROUNDING);
        assert_int_equal(c->energy, CIPC_ENERGY_BARRIER_EDGE_EDGE);
        assert_int_equal(c->count, 4);
        assert_true(fabs(set.min_gap - 0.25) <= WEIGHT_ROUNDING);
        cipc_contact_set_free(&set);
    }
}

/* Parallel edges of which end and end are closest: still one stencil of four nodes, on the feature of two. */
static void test_mollified_stencils_keep_four_nodes(void **state)
{
    (void)state;
    const double a[9] = {0, 0, 0, 1, 0, 0, 0, 9, -9}, b[9] = {1.5, 0, 0, 2.5, 0, 0, 1, 9, 9};
    two_triangles t = two(a, b, true);
    cipc_contact_set set = build_two(&t, 1);
    const int nodes[4] = {0, 1, 3, 4};
    assert_int_equal(set.count, 1);
    assert_int_equal(set.contacts[0].energy, CIPC_ENERGY_BARRIER_EDGE_EDGE);
    assert_memory_equal(set.contacts[0].nodes, nodes, sizeof nodes);
    assert_int_equal(set.contacts[0].barrier.feature.kind, CIPC_POINT_POINT);
    assert_true(set.min_gap == 0.5);
    cipc_contact_set_free(&set);
    free_two(&t);
}

/* At other positions the gap is that of the contact's own line or plane. */
static void test_gap_elsewhere(void **state)
{
    (void)state;
    const double low[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0}, high[9] = {1, 1, 0.125, 5, 1, 9, 1, 5, 9};
    two_triangles t = two(low, high, false);
    cipc_contact_set set = build_two(&t, 1);
    t.x[9] = 100, t.x[11] = 0.75; /* far beside the triangle, still 0.75 above its plane */
    assert_true(cipc_contact_gap(&set.contacts[0], t.x) == 0.75);
    cipc_contact_set_free(&set);
    free_two(&t);
}

/* Area weights are the primitives' areas over the mean: their mean over all nodes, or all edges, is 1. */
static void test_area_weights(void **state)
{
    (void)state;
    const double low[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0}, high[9] = {1, 1, 0.125, 5, 1, 9, 1, 5, 9};
    const double small_area = 8, large_area = 0.5 * sqrt(35.5 * 35.5 + 35.5 * 35.5 + 16 * 16);
    for (int edge_edge = 0; edge_edge < 2; edge_edge++) {
        two_triangles t = two(low, high, edge_edge);
        cipc_contact_options options = cipc_contact_options_default();
        options.dhat = 9;
        assert_true(options.area_weights && !options.merge_directed);
        cipc_contact_set set = {0};
        assert_int_equal(cipc_contact_set_build(&set, t.model, &t.candidates, t.x, 1, &options, 1, NULL), CIPC_OK);
        double mean = 0.5 * (small_area + large_area), own = edge_edge ? mean : large_area;
        assert_true(relative(set.contacts[0].barrier.weight, own / mean) <= WEIGHT_ROUNDING);
        cipc_contact_set_free(&set);
        free_two(&t);
    }
}

static void test_out_of_memory(void **state)
{
    (void)state;
    soup_shape shape = soup_shape_default();
    soup s = soup_create(&shape, 431);
    cipc_contact_options options = options_of(true, false);
    options.dhat = 0.3; /* thousands of contacts: the set grows more than once */
    plain_set p = plain(&s, &options, 0);
    cipc_contact_set want = build(&p, 1);
    assert_true(want.total_multiplicity > 2048);
    cipc_error error;
    long n = 1;
    for (;; n++) {
        cipc_contact_set set = {0};
        fail_allocation(n);
        cipc_status status = cipc_contact_set_build(&set, s.model, &p.candidates, s.x, STIFFNESS, &options, n % 2 ? 1 : 2, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        if (failed) assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        if (failed) assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        /* the set can be used again */
        assert_int_equal(cipc_contact_set_build(&set, s.model, &p.candidates, s.x, STIFFNESS, &options, 1, NULL), CIPC_OK);
        assert_same_set(&set, &want);
        cipc_contact_set_free(&set);
        if (!failed) break;
    }
    assert_true(n > 10);
    cipc_contact_set_free(&want);
    cipc_contact_set_free(&want); /* an empty one may be freed too */
    free_plain(&p);
    soup_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equals_all_pairs),
        cmocka_unit_test(test_pairs_in_contact_are_active),
        cmocka_unit_test(test_same_for_any_number_of_threads),
        cmocka_unit_test(test_limit_of_activation),
        cmocka_unit_test(test_mollifier_threshold),
        cmocka_unit_test(test_mollified_stencils_keep_four_nodes),
        cmocka_unit_test(test_gap_elsewhere),
        cmocka_unit_test(test_area_weights),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
