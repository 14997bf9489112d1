/* Which pairs of primitives two elements own: over all pairs of elements every pair that meets, each once, and no other; mixed bodies, stitches, bodies apart and fixed ones; rods folded
 * shut at a joint. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "asynchronous/integrator.h"
#include "cipc/oracle.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"

/* ---- Sets of pairs ---- */

typedef struct known_pair { uint64_t order; int nodes[4]; } known_pair;
typedef struct known_pairs { int count; known_pair pair[40000]; } known_pairs;

static void note(known_pairs *set, cipc_pair_kind kind, const int *nodes, uint64_t order)
{
    assert_true(set->count < 40000);
    known_pair *p = &set->pair[set->count++];
    *p = (known_pair){order, {-1, -1, -1, -1}};
    memcpy(p->nodes, nodes, (size_t)cipc_pair_nodes(kind) * sizeof *nodes);
}

static void note_wanted(void *context, cipc_pair_kind kind, const int nodes[4], int first, int second) { note(context, kind, nodes, asynchronous_pair_order(kind, first, second)); }

static int by_order(const void *p, const void *q)
{
    const uint64_t a = ((const known_pair *)p)->order, b = ((const known_pair *)q)->order;
    return (a > b) - (a < b);
}

static void assert_owned_once(const asynchronous_scene *s, long kinds[CIPC_PAIR_KIND_COUNT])
{
    static known_pairs owned, wanted;
    const cipc_asynchronous *a = s->integrator;
    owned.count = wanted.count = 0;
    for (int p = 0; p < a->broad.leaf_count; p++)
        for (int q = p + 1; q < a->broad.leaf_count; q++)
            for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++) {
                asynchronous_combination c, back;
                /* which of the two comes first is nothing to the pair, only to its number */
                const bool there = asynchronous_combination_of(a, &a->broad.leaves[p], &a->broad.leaves[q], i, &c);
                if (there) note(&owned, c.kind, c.nodes, c.order);
                if (there && c.kind == CIPC_EDGE_EDGE && asynchronous_combination_of(a, &a->broad.leaves[q], &a->broad.leaves[p], 6 + (i - 6) % 3 * 3 + (i - 6) / 3, &back))
                    assert_memory_equal(back.nodes, c.nodes, sizeof c.nodes);
            }
    crowd_visit_pairs(s->sheet.model, note_wanted, &wanted);
    qsort(owned.pair, (size_t)owned.count, sizeof *owned.pair, by_order);
    qsort(wanted.pair, (size_t)wanted.count, sizeof *wanted.pair, by_order);
    assert_int_equal(owned.count, wanted.count);
    for (int i = 0; i < wanted.count; i++) {
        assert_true(owned.pair[i].order == wanted.pair[i].order);
        assert_memory_equal(owned.pair[i].nodes, wanted.pair[i].nodes, sizeof wanted.pair[i].nodes);
        if (i > 0) assert_true(owned.pair[i].order > owned.pair[i - 1].order);
        kinds[owned.pair[i].order >> 62]++;
    }
}

static void test_every_pair_is_owned_once(void **state)
{
    (void)state;
    for (int variant = 0; variant < 8; variant++) {
        asynchronous_scene s;
        crowd_shape shape = crowd_shape_default();
        long kinds[CIPC_PAIR_KIND_COUNT] = {0};
        shape.kinds = variant & 1 ? CROWD_ALL : CROWD_ALL & ~(unsigned)CROWD_STITCHES;
        shape.cells = 1 + variant / 2;
        asynchronous_scene_init(&s);
        crowd_add(&s, &shape, (uint64_t)variant);
        s.sheet.bodies[1].fixed = variant & 2; /* then it and the floor meet as they like */
        asynchronous_scene_model(&s);
        if (variant & 4) {
            cipc_model_set_apart(s.sheet.model, 1, 6);
            cipc_model_set_apart(s.sheet.model, 3, 3);
            cipc_model_set_apart(s.sheet.model, 5, 5);
        }
        asynchronous_scene_start(&s);
        assert_owned_once(&s, kinds);
        for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) assert_true(kinds[k] > 0);
        asynchronous_scene_free(&s);
    }
}

/* Rods in a ring of three and a star: nodes whose own segments all touch the segment that they meet are asked themselves. */
static void test_rods_that_close(void **state)
{
    (void)state;
    static const double rest[21] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0, 4, 1, 0};
    static const int segments[6][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {5, 4}, {4, 6}};
    asynchronous_scene s;
    long kinds[CIPC_PAIR_KIND_COUNT] = {0};
    cipc_body_description body = {.name = "ring and star", .kind = CIPC_BODY_RODS, .node_count = 7, .rest = rest, .position = rest, .segment_count = 6, .segments = segments};
    body.material = (cipc_material){.density = 1000, .thickness = 1e-2};
    asynchronous_scene_init(&s);
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    assert_owned_once(&s, kinds);
    assert_int_equal(kinds[CIPC_EDGE_EDGE], 9);
    assert_int_equal(kinds[CIPC_POINT_EDGE], 3 + 6); /* ring: each node and the segment across; star: each tip and the two other arms */
    asynchronous_scene_free(&s);
}

/* Two segments without bending stiffness, thrown shut: the ends never come within the rod's own thickness. */
static void test_a_joint_folds_no_further_than_the_thickness(void **state)
{
    (void)state;
    static const double rest[9] = {0.1, 0, 0, 0, 0, 0, -0.09, 0.02, 0}, velocity[9] = {0, 1, 0.02, 0, 0, 0, 0, 1, 0};
    static const int segments[2][2] = {{0, 1}, {1, 2}};
    asynchronous_scene s;
    int touched = 0;
    cipc_body_description body = {.name = "joint", .kind = CIPC_BODY_RODS, .node_count = 3, .rest = rest, .position = rest, .velocity = velocity, .segment_count = 2, .segments = segments, .offset = 1e-2};
    body.material = (cipc_material){.density = 1000, .thickness = 1e-2, .young = 1e5};
    asynchronous_scene_init(&s);
    s.options.frame = 1e-3;
    s.options.restitution = 1;
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    for (int i = 0; i < 300; i++) {
        asynchronous_steps(&s, 1);
        const double *x = s.sheet.state->position;
        for (int end = 0; end < 2; end++) {
            double y[12] = {0};
            v3_copy(y, x + (end ? 6 : 0));
            v3_copy(y + 3, x + 3);
            v3_copy(y + 6, x + (end ? 0 : 6));
            assert_true(cipc_exact_distance_gap(CIPC_POINT_EDGE, y, 1e-2) > 0);
        }
        touched += s.report.contacts > 0;
    }
    assert_true(touched > 0);
    asynchronous_scene_free(&s);
}

/* The number of an edge, in either direction; edges that are not there. */
static void test_edge_of(void **state)
{
    (void)state;
    asynchronous_scene s;
    crowd_shape shape = crowd_shape_default();
    asynchronous_scene_init(&s);
    crowd_add(&s, &shape, 1);
    crowd_build(&s, &shape);
    const cipc_model *m = s.sheet.model;
    for (int e = 0; e < m->first_segment; e++) {
        assert_int_equal(asynchronous_edge_of(m, m->edges[e][0], m->edges[e][1]), e);
        assert_int_equal(asynchronous_edge_of(m, m->edges[e][1], m->edges[e][0]), e);
    }
    assert_int_equal(asynchronous_edge_of(m, 0, m->node_count - 1), -1);
    asynchronous_scene_free(&s);
}

/* Leaves of a node: those that it is a node of, each once. */
static void test_incident_leaves(void **state)
{
    (void)state;
    asynchronous_scene s;
    crowd_shape shape = crowd_shape_default();
    asynchronous_scene_init(&s);
    crowd_add(&s, &shape, 2);
    crowd_build(&s, &shape);
    const asynchronous_broad *b = &s.integrator->broad;
    int total = 0;
    for (int node = 0; node < s.sheet.model->node_count; node++)
        for (int i = b->incident_first[node]; i < b->incident_first[node + 1]; i++, total++) {
            const asynchronous_leaf *leaf = &b->leaves[b->incident[i]];
            int times = 0;
            for (int k = 0; k < leaf->node_count; k++) times += leaf->nodes[k] == node;
            assert_int_equal(times, 1);
            if (i > b->incident_first[node]) assert_true(b->incident[i] > b->incident[i - 1]);
        }
    for (int l = 0; l < b->leaf_count; l++) total -= b->leaves[l].node_count;
    assert_int_equal(total, 0);
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_pair_is_owned_once),
        cmocka_unit_test(test_rods_that_close),
        cmocka_unit_test(test_a_joint_folds_no_further_than_the_thickness),
        cmocka_unit_test(test_edge_of),
        cmocka_unit_test(test_incident_leaves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
