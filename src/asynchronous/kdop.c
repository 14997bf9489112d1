/* The hierarchy of k-DOPs over all elements that meet others (SPEC A.10): the slab intervals along thirteen directions that hold the balls of an element's nodes. */
#include "asynchronous/integrator.h"

#include <stdlib.h>

/* The three axes, the four diagonals of space and the six of planes, of unit length. */
#define D 0.57735026918962576451 /* 1/sqrt(3) */
#define P 0.70710678118654752440 /* 1/sqrt(2) */
static const double directions[ASYNCHRONOUS_AXES][3] = {
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {D, D, D}, {D, D, -D}, {D, -D, D}, {D, -D, -D}, {P, P, 0}, {P, -P, 0}, {P, 0, P}, {P, 0, -P}, {0, P, P}, {0, P, -P},
};
#undef D
#undef P

/* Contact is looked for a little further out than eta(1), because distances are rounded. */
static const double reach_spare = 1e-6;

void asynchronous_shadow(cipc_asynchronous *a, int node)
{
    double *shadow = a->broad.shadow + (size_t)node * ASYNCHRONOUS_AXES;
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++) shadow[k] = v3_dot(directions[k], a->balls[node].center);
}

/* Disjoint k-DOPs of two leaves mean a distance above eta(1) and the pair's thickness: each is larger by half of that. */
void asynchronous_leaf_dop(const cipc_asynchronous *a, int number, asynchronous_kdop *dop)
{
    const asynchronous_leaf *leaf = &a->broad.leaves[number];
    const double half = 0.5 * (a->options.thickness * (1 + reach_spare) + a->model->bodies[leaf->body].offset);
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++) {
        dop->along[k].lo = INFINITY;
        dop->along[k].hi = -INFINITY;
        for (int i = 0; i < leaf->node_count; i++) {
            const double at = a->broad.shadow[(size_t)leaf->nodes[i] * ASYNCHRONOUS_AXES + (size_t)k], around = a->balls[leaf->nodes[i]].radius + half;
            dop->along[k].lo = min2(at - around, dop->along[k].lo);
            dop->along[k].hi = max2(at + around, dop->along[k].hi);
        }
    }
}

int asynchronous_kdop_axis(const asynchronous_kdop *p, const asynchronous_kdop *q)
{
    for (int k = 0; k < ASYNCHRONOUS_AXES; k++)
        if (p->along[k].hi < q->along[k].lo || q->along[k].hi < p->along[k].lo) return k;
    return -1;
}

/* ---- Building --------------------------------------------------------------------------------------------------------------------------- */

typedef struct sorted_leaf { double key; int leaf; } sorted_leaf;

static int compare_keys(const void *p, const void *q)
{
    const sorted_leaf *s = p, *t = q;
    if (s->key != t->key) return s->key < t->key ? -1 : 1;
    return (s->leaf > t->leaf) - (s->leaf < t->leaf);
}

static double middle_of(const cipc_asynchronous *a, int leaf, int axis)
{
    double sum = 0;
    const asynchronous_leaf *l = &a->broad.leaves[leaf];
    for (int i = 0; i < l->node_count; i++) sum += a->broad.shadow[(size_t)l->nodes[i] * ASYNCHRONOUS_AXES + (size_t)axis];
    return sum / l->node_count;
}

/* The coordinate in which the middles of these leaves are spread most. */
static int widest_axis(const cipc_asynchronous *a, const sorted_leaf *leaves, int count)
{
    int widest = 0;
    double width = -1;
    for (int axis = 0; axis < 3; axis++) {
        double lo = INFINITY, hi = -INFINITY;
        for (int i = 0; i < count; i++) {
            const double at = middle_of(a, leaves[i].leaf, axis);
            lo = min2(at, lo);
            hi = max2(at, hi);
        }
        if (hi - lo > width) {
            width = hi - lo;
            widest = axis;
        }
    }
    return widest;
}

/* Halves at the median; parents come before their children. Returns the node's number. */
static int build(cipc_asynchronous *a, sorted_leaf *leaves, int count, int parent)
{
    asynchronous_broad *b = &a->broad;
    const int number = b->tree_count++;
    b->tree[number] = (asynchronous_tree_node){.child = {-1, -1}, .parent = parent, .leaf = -1, .first = -1};
    if (count == 1) {
        b->tree[number].leaf = leaves[0].leaf;
        b->leaf_place[leaves[0].leaf] = number;
        return number;
    }
    const int axis = widest_axis(a, leaves, count);
    for (int i = 0; i < count; i++) leaves[i].key = middle_of(a, leaves[i].leaf, axis);
    qsort(leaves, (size_t)count, sizeof *leaves, compare_keys);
    const int half = count / 2, first = build(a, leaves, half, number), second = build(a, leaves + half, count - half, number);
    b->tree[number].child[0] = first;
    b->tree[number].child[1] = second;
    return number;
}

cipc_status asynchronous_tree_create(cipc_asynchronous *a, cipc_error *error)
{
    asynchronous_broad *b = &a->broad;
    const size_t leaves = (size_t)b->leaf_count;
    sorted_leaf *sorted = cipc_alloc(leaves, sizeof *sorted);
    if (!b->tree) b->tree = cipc_alloc(2 * leaves, sizeof *b->tree);
    if (!b->leaf_place) b->leaf_place = cipc_alloc(leaves, sizeof *b->leaf_place);
    if (!b->travel) b->travel = cipc_alloc(2 * leaves, sizeof *b->travel);
    const bool good = sorted && b->tree && b->leaf_place && b->travel;
    b->tree_count = 0;
    for (int i = 0; good && i < b->leaf_count; i++) sorted[i] = (sorted_leaf){0, i};
    if (good && leaves > 0) build(a, sorted, b->leaf_count, -1);
    cipc_free(sorted);
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for the hierarchy of %zu elements", leaves);
}

void asynchronous_tree_fit(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    for (int i = b->tree_count - 1; i >= 0; i--) {
        asynchronous_tree_node *node = &b->tree[i];
        if (node->leaf >= 0) {
            asynchronous_leaf_dop(a, node->leaf, &node->dop);
            continue;
        }
        const asynchronous_kdop *p = &b->tree[node->child[0]].dop, *q = &b->tree[node->child[1]].dop;
        for (int k = 0; k < ASYNCHRONOUS_AXES; k++) {
            node->dop.along[k].lo = min2(p->along[k].lo, q->along[k].lo);
            node->dop.along[k].hi = max2(p->along[k].hi, q->along[k].hi);
        }
    }
}
