/* Unique edges and hinges of a triangle mesh, found by sorting half-edges. */
#include "model/mesh_topology.h"

#include <stdlib.h>

#include "model/measures.h"

/* One side of one triangle: from < to after ordering; `forward` tells whether the triangle runs from -> to. */
typedef struct half_edge {
    int from, to, triangle, opposite;
    bool forward;
} half_edge;

static int compare_half_edges(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->from != q->from) return p->from < q->from ? -1 : 1;
    if (p->to != q->to) return p->to < q->to ? -1 : 1;
    return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

static void fill_half_edges(const cipc_model *m, half_edge *sides)
{
    for (int t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            int a = m->triangles[t][k], b = m->triangles[t][(k + 1) % 3];
            half_edge side = {.from = a < b ? a : b, .to = a < b ? b : a, .triangle = t, .opposite = m->triangles[t][(k + 2) % 3], .forward = a < b};
            sides[3 * t + k] = side;
        }
    qsort(sides, 3 * (size_t)m->triangle_count, sizeof *sides, compare_half_edges);
}

/* Sides i..j-1 are one edge. Two sides make a hinge (v0, v1, v2, v3) with the first triangle running v0 -> v1; the second is read as
 * (v1, v0, v3), whatever its own orientation, so that a flat sheet has theta = 0 even where its triangles are not oriented alike. */
static void add_edge(cipc_model *m, const half_edge *sides, int i, int j)
{
    const half_edge *a = &sides[i];
    double area = 0;
    for (int k = i; k < j; k++) {
        const int *v = m->triangles[sides[k].triangle];
        area += cipc_triangle_area(m->rest + 3 * v[0], m->rest + 3 * v[1], m->rest + 3 * v[2]) / 3;
    }
    m->edges[m->edge_count][0] = a->forward ? a->from : a->to;
    m->edges[m->edge_count][1] = a->forward ? a->to : a->from;
    m->edge_area[m->edge_count++] = area;
    /* Two triangles on the same three nodes have no angle between them. */
    if (j - i != 2 || a->opposite == sides[i + 1].opposite || m->bodies[m->triangle_body[a->triangle]].kind != CIPC_BODY_SHELL) return;
    int *hinge = m->hinges[m->hinge_count++];
    hinge[0] = a->forward ? a->from : a->to;
    hinge[1] = a->forward ? a->to : a->from;
    hinge[2] = a->opposite;
    hinge[3] = sides[i + 1].opposite;
}

cipc_status cipc_mesh_topology(cipc_model *m, cipc_error *error)
{
    size_t side_count = 3 * (size_t)m->triangle_count;
    half_edge *sides = cipc_alloc(side_count, sizeof *sides);
    size_t edge_room = side_count + (size_t)m->segment_count;
    m->edges = cipc_alloc(edge_room, sizeof *m->edges);
    m->edge_area = cipc_alloc(edge_room, sizeof *m->edge_area);
    m->hinges = cipc_alloc(side_count, sizeof *m->hinges);
    cipc_status status = CIPC_OK;
    if (!sides || !m->edges || !m->edge_area || !m->hinges) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for the edges of %d triangles", m->triangle_count);
    } else {
        fill_half_edges(m, sides);
        for (int i = 0, j; i < (int)side_count; i = j) {
            for (j = i + 1; j < (int)side_count && sides[j].from == sides[i].from && sides[j].to == sides[i].to; j++) continue;
            add_edge(m, sides, i, j);
        }
    }
    cipc_free(sides);
    return status;
}
