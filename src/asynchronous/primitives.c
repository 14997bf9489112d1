/* The elements that meet others, and which of two such elements owns which pairs of primitives: every node and every edge belongs to one element, so that every pair is found once. */
#include "asynchronous/integrator.h"

#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *p, const void *q)
{
    const int *a = p, *b = q;
    const int low_a = a[0] < a[1] ? a[0] : a[1], low_b = b[0] < b[1] ? b[0] : b[1];
    if (low_a != low_b) return low_a < low_b ? -1 : 1;
    const int high_a = a[0] + a[1] - low_a, high_b = b[0] + b[1] - low_b;
    return (high_a > high_b) - (high_a < high_b);
}

int asynchronous_edge_of(const cipc_model *m, int node_a, int node_b)
{
    const int wanted[2] = {node_a, node_b};
    const int(*found)[2] = bsearch(wanted, m->edges, (size_t)m->first_segment, sizeof *m->edges, compare_edges);
    return found ? (int)(found - (const int(*)[2])m->edges) : -1;
}

/* ---- Leaves --------------------------------------------------------------------------------------------------------------------------- */

static void own_nodes(asynchronous_leaf *leaf, bool *taken)
{
    for (int i = 0; i < leaf->node_count; i++) {
        if (!taken[leaf->nodes[i]]) leaf->owned_nodes[leaf->owned_node_count++] = leaf->nodes[i];
        taken[leaf->nodes[i]] = true;
    }
}

static void own_edge(asynchronous_leaf *leaf, int edge, bool *taken)
{
    if (!taken[edge]) leaf->owned_edges[leaf->owned_edge_count++] = edge;
    taken[edge] = true;
}

static asynchronous_leaf *next_leaf(cipc_asynchronous *a, const int *nodes, int count)
{
    asynchronous_leaf *leaf = &a->broad.leaves[a->broad.leaf_count++];
    *leaf = (asynchronous_leaf){.node_count = count, .body = a->model->node_body[nodes[0]], .triangle = -1, .segment = -1};
    memcpy(leaf->nodes, nodes, (size_t)count * sizeof *nodes);
    return leaf;
}

static void add_leaves(cipc_asynchronous *a, bool *node_taken, bool *edge_taken)
{
    const cipc_model *m = a->model;
    for (int t = 0; t < m->triangle_count; t++) {
        asynchronous_leaf *leaf = next_leaf(a, m->triangles[t], 3);
        leaf->triangle = t;
        own_nodes(leaf, node_taken);
        for (int k = 0; k < 3; k++) own_edge(leaf, asynchronous_edge_of(m, m->triangles[t][k], m->triangles[t][(k + 1) % 3]), edge_taken);
    }
    for (int i = 0; i < m->segment_count; i++) {
        asynchronous_leaf *leaf = next_leaf(a, m->edges[m->first_segment + i], 2);
        leaf->segment = m->first_segment + i;
        own_nodes(leaf, node_taken);
        own_edge(leaf, leaf->segment, edge_taken);
    }
    for (int i = 0; i < m->node_count; i++)
        if (m->bodies[m->node_body[i]].kind == CIPC_BODY_PARTICLES) own_nodes(next_leaf(a, &i, 1), node_taken);
}

/* Leaves by node, one list after the other. */
static bool list_incident(cipc_asynchronous *a)
{
    asynchronous_broad *b = &a->broad;
    b->incident_first = cipc_alloc((size_t)a->model->node_count + 2, sizeof *b->incident_first);
    b->incident = cipc_alloc(3 * (size_t)b->leaf_count, sizeof *b->incident);
    if (!b->incident_first || !b->incident) return false;
    for (int l = 0; l < b->leaf_count; l++)
        for (int i = 0; i < b->leaves[l].node_count; i++) b->incident_first[b->leaves[l].nodes[i] + 2]++;
    for (int i = 0; i < a->model->node_count; i++) b->incident_first[i + 2] += b->incident_first[i + 1];
    for (int l = 0; l < b->leaf_count; l++)
        for (int i = 0; i < b->leaves[l].node_count; i++) b->incident[b->incident_first[b->leaves[l].nodes[i] + 1]++] = l;
    return true;
}

cipc_status asynchronous_primitives_create(cipc_asynchronous *a, cipc_error *error)
{
    const cipc_model *m = a->model;
    const size_t most = (size_t)m->triangle_count + (size_t)m->segment_count + (size_t)m->node_count;
    bool *node_taken = cipc_alloc((size_t)m->node_count, sizeof *node_taken), *edge_taken = cipc_alloc((size_t)m->edge_count, sizeof *edge_taken);
    a->broad.leaves = cipc_alloc(most, sizeof *a->broad.leaves);
    bool good = node_taken && edge_taken && a->broad.leaves;
    if (good) add_leaves(a, node_taken, edge_taken);
    good = good && list_incident(a);
    cipc_free(node_taken);
    cipc_free(edge_taken);
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for %zu elements in contact", most);
}

/* ---- Pairs of primitives of two leaves -------------------------------------------------------------------------------------------------- */

static bool is_particle(const asynchronous_leaf *leaf) { return leaf->node_count == 1; }

static void set(asynchronous_combination *c, cipc_pair_kind kind, const int *first, int first_count, int first_number, const int *second, int second_count, int second_number)
{
    c->kind = kind;
    memcpy(c->nodes, first, (size_t)first_count * sizeof *first);
    memcpy(c->nodes + first_count, second, (size_t)second_count * sizeof *second);
    c->order = asynchronous_pair_order(kind, first_number, second_number);
}

/* Does a segment at the node meet the segment q? Then the two segments keep the node away as well. Beside a joint none does. */
static bool is_spoken_for(const cipc_asynchronous *a, int node, const asynchronous_leaf *q)
{
    const asynchronous_broad *b = &a->broad;
    for (int i = b->incident_first[node]; i < b->incident_first[node + 1]; i++) {
        const asynchronous_leaf *own = &b->leaves[b->incident[i]];
        if (own->segment >= 0 && cipc_model_meet(a->model, own->nodes, 2, q->nodes, 2)) return true;
    }
    return false;
}

/* A node that p owns against the element q. Of nodes against segments those of particles are asked, and those of rods that no pair of segments speaks for. */
static bool node_and_element(const cipc_asynchronous *a, const asynchronous_leaf *p, int i, const asynchronous_leaf *q, bool first, asynchronous_combination *c)
{
    if (i >= p->owned_node_count) return false;
    const int node = p->owned_nodes[i];
    if (q->triangle >= 0) {
        set(c, CIPC_POINT_TRIANGLE, &node, 1, node, q->nodes, 3, q->triangle);
        return true;
    }
    if (q->segment >= 0) {
        if (!is_particle(p) && (p->segment < 0 || is_spoken_for(a, node, q))) return false;
        set(c, CIPC_POINT_EDGE, &node, 1, node, q->nodes, 2, q->segment);
        return true;
    }
    const int other = q->nodes[0], lower = node < other ? node : other, higher = node < other ? other : node;
    if (!is_particle(p) || !first) return false;
    set(c, CIPC_POINT_POINT, &lower, 1, lower, &higher, 1, higher);
    return true;
}

static bool edge_and_edge(const cipc_model *m, const asynchronous_leaf *p, int i, const asynchronous_leaf *q, int j, asynchronous_combination *c)
{
    if (i >= p->owned_edge_count || j >= q->owned_edge_count) return false;
    const int a = p->owned_edges[i], b = q->owned_edges[j], lower = a < b ? a : b, higher = a < b ? b : a;
    set(c, CIPC_EDGE_EDGE, m->edges[lower], 2, lower, m->edges[higher], 2, higher);
    return true;
}

/* Obstacles may meet each other as they like. */
static bool is_all_fixed(const cipc_model *m, const int *nodes, int count)
{
    for (int i = 0; i < count; i++)
        if (!m->bodies[m->node_body[nodes[i]]].fixed) return false;
    return true;
}

bool asynchronous_combination_of(const cipc_asynchronous *a, const asynchronous_leaf *p, const asynchronous_leaf *q, int number, asynchronous_combination *c)
{
    bool found = false;
    if (number < 3) found = node_and_element(a, p, number, q, true, c);
    else if (number < 6) found = node_and_element(a, q, number - 3, p, false, c);
    else found = edge_and_edge(a->model, p, (number - 6) / 3, q, (number - 6) % 3, c);
    if (!found) return false;
    const int count = cipc_pair_nodes(c->kind), first = cipc_pair_first_nodes(c->kind);
    return !is_all_fixed(a->model, c->nodes, count) && cipc_model_meet(a->model, c->nodes, first, c->nodes + first, count - first);
}
