/* The separation list: at all times it covers every pair of elements that can meet exactly once, what it holds apart is apart, and every pair of primitives that can come into contact while
 * the balls stay where they are owns a certificate; after random motion of single nodes, after lists made afresh; out of memory at every allocation. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { MOST_LEAVES = 160 };

static void start(asynchronous_scene *s, unsigned kinds, int cells, uint64_t seed)
{
    crowd_shape shape = crowd_shape_default();
    shape.kinds = kinds;
    shape.cells = cells;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    crowd_build(s, &shape);
    asynchronous_steps(s, 1);
    assert_true(s->integrator->broad.leaf_count <= MOST_LEAVES);
    s->integrator->options.always_layers = 1; /* pairs make no slabs: nodes may be put where no contact would let them */
}

/* ---- What the list covers ---- */

typedef struct cover { int times[MOST_LEAVES][MOST_LEAVES]; } cover;

static void cover_below(const asynchronous_broad *b, int p, int q, cover *c)
{
    const asynchronous_tree_node *node_p = &b->tree[p], *node_q = &b->tree[q];
    if (node_p->leaf >= 0 && node_q->leaf >= 0) {
        c->times[node_p->leaf][node_q->leaf]++;
        c->times[node_q->leaf][node_p->leaf]++;
    } else if (node_p->leaf < 0) {
        for (int i = 0; i < 2; i++) cover_below(b, node_p->child[i], q, c);
    } else {
        for (int i = 0; i < 2; i++) cover_below(b, p, node_q->child[i], c);
    }
}

/* All entries by way of the lists of the tree's nodes: each is in those of both its nodes. */
static int walk(const cipc_asynchronous *a, cover *c)
{
    const asynchronous_broad *b = &a->broad;
    int entries = 0;
    memset(c, 0, sizeof *c);
    for (int node = 0; node < b->tree_count; node++) {
        int previous = -1;
        for (int link = b->tree[node].first; link >= 0; previous = link, link = b->entry[link / 2].next[link % 2]) {
            const asynchronous_separation *e = &b->entry[link / 2];
            assert_int_equal(e->node[link % 2], node);
            assert_int_equal(e->previous[link % 2], previous);
            if (link % 2) continue;
            entries++;
            cover_below(b, e->node[0], e->node[1], c);
            const asynchronous_kdop *p = &b->tree[e->node[0]].dop, *q = &b->tree[e->node[1]].dop;
            if (e->axis >= 0) assert_true(p->along[e->axis].hi < q->along[e->axis].lo || q->along[e->axis].hi < p->along[e->axis].lo);
            else assert_true(b->tree[e->node[0]].leaf >= 0 && b->tree[e->node[1]].leaf >= 0 && e->overlap >= 0);
        }
    }
    return entries;
}

static bool can_meet(const cipc_asynchronous *a, int p, int q)
{
    asynchronous_combination c;
    for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++)
        if (asynchronous_combination_of(a, &a->broad.leaves[p], &a->broad.leaves[q], i, &c)) return true;
    return false;
}

static void assert_covers_once(const cipc_asynchronous *a)
{
    static cover c;
    assert_int_equal(walk(a, &c), a->broad.live_entries);
    for (int p = 0; p < a->broad.leaf_count; p++)
        for (int q = 0; q < p; q++) {
            assert_true(c.times[p][q] <= 1);
            if (can_meet(a, p, q)) assert_int_equal(c.times[p][q], 1);
        }
}

/* k-DOPs hold what is below them as the balls are now. */
static void assert_tree_holds(const cipc_asynchronous *a)
{
    const asynchronous_broad *b = &a->broad;
    for (int i = 0; i < b->tree_count; i++) {
        asynchronous_kdop dop = b->tree[i].dop;
        if (b->tree[i].leaf >= 0) asynchronous_leaf_dop(a, b->tree[i].leaf, &dop);
        assert_memory_equal(&dop, &b->tree[i].dop, sizeof dop);
        const int parent = b->tree[i].parent;
        for (int k = 0; k < ASYNCHRONOUS_AXES && parent >= 0; k++) assert_true(dop.along[k].lo >= b->tree[parent].dop.along[k].lo && dop.along[k].hi <= b->tree[parent].dop.along[k].hi);
    }
}

/* ---- Which pairs own certificates ---- */

typedef struct owners { const cipc_asynchronous *a; int wanted, owned; } owners;

static bool owns_certificate(const cipc_asynchronous *a, cipc_pair_kind kind, const int *nodes)
{
    const struct asynchronous_incidences *of = &a->pairs.of_node[nodes[0]];
    int times = 0;
    for (int i = 0; i < of->count; i++) {
        const asynchronous_pair *pair = &a->pairs.pair[asynchronous_incidence_pair(of->list[i])];
        times += pair->kind == kind && memcmp(pair->nodes, nodes, (size_t)cipc_pair_nodes(kind) * sizeof *nodes) == 0;
    }
    assert_true(times <= 1);
    return times == 1;
}

/* So near the two can come for certain: as at the balls' centres, less the smallest radius of either. */
static void look_at_pair(void *context, cipc_pair_kind kind, const int nodes[4], int first, int second)
{
    owners *o = context;
    const cipc_asynchronous *a = o->a;
    const int count = cipc_pair_nodes(kind), own = cipc_pair_first_nodes(kind);
    double x[12] = {0}, radius[2] = {INFINITY, INFINITY};
    (void)first, (void)second;
    for (int i = 0; i < count; i++) {
        const asynchronous_ball *ball = &a->balls[nodes[i]];
        v3_copy(x + 3 * i, ball->center);
        radius[i >= own] = fmin(radius[i >= own], ball->radius);
    }
    const double gap = asynchronous_closest_points(kind, x).distance - cipc_model_pair_offset(a->model, nodes[0], nodes[own]) - a->options.thickness;
    if (gap > radius[0] + radius[1] - 1e-12) return;
    assert_true(owns_certificate(a, kind, nodes));
    o->wanted++;
}

static int assert_certificates(const cipc_asynchronous *a)
{
    owners o = {.a = a};
    crowd_visit_pairs(a->model, look_at_pair, &o);
    assert_true(a->pairs.live_count >= o.wanted);
    return o.wanted;
}

/* ---- Motion ---- */

/* A node jumps to where its element's size lets it, with any velocity, and its ball follows. */
static void move_someone(uint64_t *seed, cipc_asynchronous *a, double by)
{
    const int node = random_below(seed, a->model->node_count);
    asynchronous_node *n = &a->nodes[node];
    double jump[3];
    if (!(n->inverse_mass > 0)) return;
    asynchronous_position(n, a->now, n->q);
    n->t = a->now;
    random_fill(seed, jump, 3, by);
    v3_axpy(n->q, 1, jump);
    random_fill(seed, n->v, 3, exp(random_uniform(seed, -5, 1)));
    asynchronous_ball_event(a, node);
    if (a->broad.stale) asynchronous_separation_start(a); /* as the loop does before time goes on */
    assert_int_equal(a->status, CIPC_OK);
}

static void test_motion(void **state)
{
    (void)state;
    static const unsigned kinds[] = {CROWD_ALL, CROWD_ALL, CROWD_PARTICLES, CROWD_RODS | CROWD_VOLUME, CROWD_SHEETS};
    uint64_t seed = 1;
    int wanted = 0;
    for (int round = 0; round < 5; round++) {
        asynchronous_scene s;
        start(&s, kinds[round], 1 + round % 3, 30 + (uint64_t)round);
        cipc_asynchronous *a = s.integrator;
        const double by[] = {1e-4, 3e-3, 3e-2, 0.2};
        for (int step = 0; step < 400; step++) {
            move_someone(&seed, a, by[random_below(&seed, 4)]);
            if (step % 100 == 50) a->broad.fresh_entries = -1000; /* the next one makes the list afresh */
            if (step % 20 != 19) continue;
            assert_covers_once(a);
            assert_tree_holds(a);
            wanted += assert_certificates(a);
        }
        asynchronous_scene_free(&s);
    }
    assert_true(wanted > 500);
}

/* Elements that come near and part again: certificates come and go. */
static void test_certificates_come_and_go(void **state)
{
    (void)state;
    asynchronous_scene s;
    const double x[6] = {0, 0.5, 0, 1, 0.5, 0}, at_rest[3] = {0, 0, 0};
    asynchronous_scene_init(&s);
    s.options.thickness = 0.01;
    asynchronous_add_particles(&s, "two", 2, x, at_rest, 1);
    asynchronous_scene_build(&s);
    asynchronous_steps(&s, 1);
    cipc_asynchronous *a = s.integrator;
    static const double places[] = {0.02, 0.5, 0.011, 1, 0.015, 0.9};
    int seen[2] = {0, 0};
    for (int i = 0; i < 6; i++) {
        a->nodes[1].q[0] = places[i];
        asynchronous_ball_event(a, 1);
        assert_int_equal(a->pairs.live_count, places[i] < 0.1);
        seen[a->pairs.live_count]++;
        assert_covers_once(a);
    }
    assert_int_equal(seen[0], 3);
    assert_int_equal(a->broad.live_entries, 1);
    asynchronous_scene_free(&s);
}

/* Descending makes the list longer, never shorter, until it is made afresh: then it is as long as one for that state. */
static void test_lists_made_afresh(void **state)
{
    (void)state;
    uint64_t seed = 2;
    asynchronous_scene s;
    int afresh = 0;
    start(&s, CROWD_SHEETS | CROWD_PARTICLES, 6, 3);
    cipc_asynchronous *a = s.integrator;
    for (int step = 0; step < 3000; step++) {
        const int before = a->broad.live_entries;
        move_someone(&seed, a, 0.3);
        if (a->broad.live_entries < before) {
            assert_int_equal(a->broad.live_entries, a->broad.fresh_entries);
            afresh++;
        } else {
            assert_true(a->broad.live_entries <= 2 * a->broad.fresh_entries + 256);
        }
    }
    assert_true(afresh > 0);
    assert_covers_once(a);
    asynchronous_scene_free(&s);
}

/* ---- Out of memory ---- */

/* Wherever memory ends while the list is made, the status says so, and with memory again the list can be made. */
static void test_out_of_memory(void **state)
{
    (void)state;
    long n = 1;
    for (;; n++) {
        asynchronous_scene s;
        crowd_shape shape = crowd_shape_default();
        asynchronous_scene_init(&s);
        crowd_add(&s, &shape, 5);
        crowd_build(&s, &shape);
        cipc_asynchronous *a = s.integrator;
        asynchronous_elements_start(a);
        for (int i = 0; i < a->model->node_count; i++) {
            v3_copy(a->nodes[i].q, s.sheet.state->position + 3 * i);
            a->nodes[i].q[1] *= 0.2; /* near enough for pairs and overlaps in number */
            a->nodes[i].inverse_mass = 1 / a->model->mass[i];
            asynchronous_ball_start(a, i);
        }
        fail_allocation(n);
        cipc_status status = asynchronous_tree_create(a, &s.error);
        if (!status) asynchronous_separation_start(a);
        if (!status) status = a->status;
        const bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        a->status = CIPC_OK;
        assert_int_equal(asynchronous_tree_create(a, &s.error), CIPC_OK);
        asynchronous_separation_start(a);
        assert_int_equal(a->status, CIPC_OK);
        assert_covers_once(a);
        assert_certificates(a);
        asynchronous_scene_free(&s);
        if (!failed) break;
    }
    assert_true(n > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_motion),
        cmocka_unit_test(test_certificates_come_and_go),
        cmocka_unit_test(test_lists_made_afresh),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
