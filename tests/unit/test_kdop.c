/* The hierarchy of k-DOPs: intervals that hold all balls of their elements; disjoint means out of contact's reach, by the exact distance; every element in the tree once, everything
 * inside its parent, parents first. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "cipc/oracle.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"

/* A crowd whose nodes are strewn about a little, in place and velocity, so that balls are of all sizes. */
static void start(asynchronous_scene *s, uint64_t seed, int cells)
{
    crowd_shape shape = crowd_shape_default();
    shape.cells = cells;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    crowd_build(s, &shape);
    cipc_asynchronous *a = s->integrator;
    for (int i = 0; i < s->sheet.model->node_count; i++) {
        asynchronous_node *n = &a->nodes[i];
        v3_copy(n->q, s->sheet.state->position + 3 * i);
        for (int k = 0; k < 3; k++) n->q[k] += random_uniform(&seed, -0.02, 0.02);
        random_fill(&seed, n->v, 3, exp(random_uniform(&seed, -5, 2)));
        n->inverse_mass = 1 / s->sheet.model->mass[i];
        asynchronous_ball_start(a, i);
    }
}

static const double *shadow_of(const cipc_asynchronous *a, int node) { return a->broad.shadow + (size_t)node * ASYNCHRONOUS_AXES; }

/* Thirteen directions of unit length, no two alike. */
static void test_shadows(void **state)
{
    (void)state;
    asynchronous_scene s;
    double direction[ASYNCHRONOUS_AXES][3];
    start(&s, 1, 1);
    cipc_asynchronous *a = s.integrator;
    for (int k = 0; k < 3; k++) {
        memset(a->balls[0].center, 0, sizeof a->balls[0].center);
        a->balls[0].center[k] = 1;
        asynchronous_shadow(a, 0);
        for (int axis = 0; axis < ASYNCHRONOUS_AXES; axis++) direction[axis][k] = shadow_of(a, 0)[axis];
    }
    for (int axis = 0; axis < ASYNCHRONOUS_AXES; axis++) {
        assert_true(fabs(v3_norm(direction[axis]) - 1) < 1e-15);
        for (int other = 0; other < axis; other++) assert_true(fabs(v3_dot(direction[axis], direction[other])) < 0.9);
    }
    asynchronous_scene_free(&s);
}

static void test_leaves_hold_their_balls(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 2, 3);
    const cipc_asynchronous *a = s.integrator;
    for (int l = 0; l < a->broad.leaf_count; l++) {
        const asynchronous_leaf *leaf = &a->broad.leaves[l];
        asynchronous_kdop dop;
        asynchronous_leaf_dop(a, l, &dop);
        for (int axis = 0; axis < ASYNCHRONOUS_AXES; axis++) {
            double lo = INFINITY, hi = -INFINITY;
            const double half = 0.5 * (s.options.thickness + s.sheet.model->bodies[leaf->body].offset);
            for (int i = 0; i < leaf->node_count; i++) {
                lo = fmin(lo, shadow_of(a, leaf->nodes[i])[axis] - a->balls[leaf->nodes[i]].radius - half);
                hi = fmax(hi, shadow_of(a, leaf->nodes[i])[axis] + a->balls[leaf->nodes[i]].radius + half);
            }
            assert_true(dop.along[axis].lo <= lo && dop.along[axis].lo >= lo - 1e-8 && dop.along[axis].hi >= hi && dop.along[axis].hi <= hi + 1e-8);
        }
    }
    asynchronous_scene_free(&s);
}

/* Wherever in their balls the nodes are. */
static void test_disjoint_is_out_of_reach(void **state)
{
    (void)state;
    uint64_t seed = 3;
    int apart = 0, close = 0;
    for (int round = 0; round < 24; round++) {
        asynchronous_scene s;
        start(&s, 10 + (uint64_t)round, 1);
        const cipc_asynchronous *a = s.integrator;
        for (int p = 0; p < a->broad.leaf_count; p++)
            for (int q = p + 1; q < a->broad.leaf_count; q++) {
                asynchronous_kdop dops[2];
                asynchronous_leaf_dop(a, p, &dops[0]);
                asynchronous_leaf_dop(a, q, &dops[1]);
                const int axis = asynchronous_kdop_axis(&dops[0], &dops[1]);
                if (axis < 0) continue;
                assert_true(dops[0].along[axis].hi < dops[1].along[axis].lo || dops[1].along[axis].hi < dops[0].along[axis].lo);
                apart++;
                for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS; i++) {
                    asynchronous_combination c;
                    double x[12] = {0};
                    if (!asynchronous_combination_of(a, &a->broad.leaves[p], &a->broad.leaves[q], i, &c)) continue;
                    for (int n = 0; n < cipc_pair_nodes(c.kind); n++) {
                        const asynchronous_ball *ball = &a->balls[c.nodes[n]];
                        double off[3];
                        random_fill(&seed, off, 3, 1);
                        v3_copy(x + 3 * n, ball->center);
                        v3_axpy(x + 3 * n, ball->radius / v3_norm(off), off);
                    }
                    const double reach = s.options.thickness + cipc_model_pair_offset(s.sheet.model, c.nodes[0], c.nodes[cipc_pair_first_nodes(c.kind)]);
                    const double gap = cipc_exact_distance_gap(c.kind, x, reach);
                    assert_true(gap > 0);
                    close += gap < 0.01;
                }
            }
        asynchronous_scene_free(&s);
    }
    assert_true(apart > 500 && close > 30);
}

/* ---- The tree ---- */

static void assert_inside(const asynchronous_kdop *inner, const asynchronous_kdop *outer)
{
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++) assert_true(inner->along[k].lo >= outer->along[k].lo && inner->along[k].hi <= outer->along[k].hi);
}

static int depth_below(const asynchronous_broad *b, int node)
{
    if (b->tree[node].leaf >= 0) return 0;
    const int first = depth_below(b, b->tree[node].child[0]), second = depth_below(b, b->tree[node].child[1]);
    return 1 + (first > second ? first : second);
}

static void test_tree(void **state)
{
    (void)state;
    for (int cells = 1; cells <= 4; cells++) {
        asynchronous_scene s;
        start(&s, 20, cells);
        cipc_asynchronous *a = s.integrator;
        const asynchronous_broad *b = &a->broad;
        assert_int_equal(asynchronous_tree_create(a, &s.error), CIPC_OK);
        asynchronous_tree_fit(a);
        assert_int_equal(b->tree_count, 2 * b->leaf_count - 1);
        int seen = 0;
        for (int i = 0; i < b->tree_count; i++) {
            const asynchronous_tree_node *node = &b->tree[i];
            if (node->leaf >= 0) {
                asynchronous_kdop dop;
                asynchronous_leaf_dop(a, node->leaf, &dop);
                assert_int_equal(b->leaf_place[node->leaf], i);
                assert_memory_equal(&dop, &node->dop, sizeof dop);
                seen++;
                continue;
            }
            for (int c = 0; c < 2; c++) {
                assert_true(node->child[c] > i);
                assert_int_equal(b->tree[node->child[c]].parent, i);
                assert_inside(&b->tree[node->child[c]].dop, &node->dop);
            }
        }
        assert_int_equal(seen, b->leaf_count);
        assert_true(depth_below(b, 0) <= 1 + (int)ceil(log2(b->leaf_count))); /* halves at the median */
        asynchronous_scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shadows), cmocka_unit_test(test_leaves_hold_their_balls), cmocka_unit_test(test_disjoint_is_out_of_reach), cmocka_unit_test(test_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
