/* Listing the primitives of a model. */
#include "invariant/primitives.h"

#include <string.h>

#include "invariant/rest_order.h"

static bool all_fixed(const bool *fixed, const int *nodes, int n)
{
    for (int i = 0; i < n; i++) {
        if (!fixed[nodes[i]]) { return false; }
    }
    return true;
}

static bool init_kind(cipc_primitives *p, int kind, const cipc_model *m, const bool *fixed)
{
    if (kind < CIPC_EDGES) {
        p->nodes = p->listed;
        p->size = 1; /* the number is counted already */
    } else if (kind == CIPC_TRIANGLES) {
        p->nodes = (const int *)m->triangles;
        p->size = 3;
        p->count = m->triangle_count;
    } else {
        p->first = kind == CIPC_SEGMENTS ? m->first_segment : 0;
        p->nodes = m->edge_count > 0 ? m->edges[p->first] : NULL;
        p->size = 2;
        p->count = kind == CIPC_SEGMENTS ? m->segment_count : m->edge_count;
    }
    p->order = cipc_alloc((size_t)p->count, sizeof *p->order);
    if (!cipc_patch_tree_init(&p->tree, p->count) || p->order == NULL ||
        !cipc_rest_order(p->order, m, p->nodes, p->size, p->count, fixed)) {
        return false;
    }
    while (p->moving < p->count && !all_fixed(fixed, &p->nodes[p->size * p->order[p->moving]], p->size)) { p->moving++; }
    return true;
}

/* Is the node one of the primitives of this kind? That a node is inside a volume is believed only of one that no triangle has. Models made by hand may leave `interior` out. */
static bool is_of_kind(const cipc_model *m, const bool *in_triangle, int node, int kind)
{
    cipc_body_kind body = m->bodies[m->node_body[node]].kind;
    if (kind == CIPC_POINTS) { return m->interior == NULL || !m->interior[node] || in_triangle[node]; }
    return body == CIPC_BODY_PARTICLES || (kind == CIPC_ENDS && body == CIPC_BODY_RODS);
}

static bool list_nodes_of(cipc_primitives *primitives, const cipc_model *m, const bool *in_triangle)
{
    for (int kind = 0; kind < CIPC_EDGES; kind++) {
        cipc_primitives *p = &primitives[kind];
        for (int i = 0; i < m->node_count; i++) { p->count += is_of_kind(m, in_triangle, i, kind) ? 1 : 0; }
        p->listed = cipc_alloc((size_t)p->count, sizeof *p->listed);
        if (p->listed == NULL) { return false; }
        for (int i = 0, n = 0; i < m->node_count; i++) {
            if (is_of_kind(m, in_triangle, i, kind)) { p->listed[n++] = i; }
        }
    }
    return true;
}

static bool list_nodes(cipc_primitives *primitives, const cipc_model *m)
{
    bool *in_triangle = cipc_alloc((size_t)m->node_count, sizeof *in_triangle);
    if (in_triangle == NULL) { return false; }
    for (int i = 0; i < 3 * m->triangle_count; i++) { in_triangle[m->triangles[i / 3][i % 3]] = true; }
    bool good = list_nodes_of(primitives, m, in_triangle);
    cipc_free(in_triangle);
    return good;
}

bool invariant_primitives_init(cipc_primitives primitives[CIPC_PRIMITIVE_KINDS], const cipc_model *model, const bool *fixed)
{
    memset(primitives, 0, CIPC_PRIMITIVE_KINDS * sizeof *primitives);
    if (!list_nodes(primitives, model)) { return false; }
    for (int kind = 0; kind < CIPC_PRIMITIVE_KINDS; kind++) {
        if (!init_kind(&primitives[kind], kind, model, fixed)) { return false; }
    }
    return true;
}

void invariant_primitives_free(cipc_primitives primitives[CIPC_PRIMITIVE_KINDS])
{
    for (int kind = 0; kind < CIPC_PRIMITIVE_KINDS; kind++) {
        cipc_free(primitives[kind].order);
        cipc_free(primitives[kind].listed);
        cipc_patch_tree_free(&primitives[kind].tree);
    }
}
