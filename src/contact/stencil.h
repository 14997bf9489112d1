/* Nodes and positions of a candidate pair's stencil. */
#ifndef CIPC_CONTACT_STENCIL_H
#define CIPC_CONTACT_STENCIL_H

#include "base/vector.h"
#include "cipc/geometry.h"
#include "cipc/model.h"

/* The global nodes of a pair's stencil, in the order of its kind; unused ones -1. */
static inline void cipc_stencil_nodes(const cipc_model *model, cipc_pair_kind kind, const int pair[2], int nodes[4])
{
    nodes[2] = nodes[3] = -1;
    if (kind == CIPC_EDGE_EDGE) {
        nodes[0] = model->edges[pair[0]][0];
        nodes[1] = model->edges[pair[0]][1];
        nodes[2] = model->edges[pair[1]][0];
        nodes[3] = model->edges[pair[1]][1];
        return;
    }
    nodes[0] = pair[0];
    if (kind == CIPC_POINT_POINT) nodes[1] = pair[1];
    for (int k = 0; kind == CIPC_POINT_EDGE && k < 2; k++) nodes[1 + k] = model->edges[pair[1]][k];
    for (int k = 0; kind == CIPC_POINT_TRIANGLE && k < 3; k++) nodes[1 + k] = model->triangles[pair[1]][k];
}

/* Positions of a stencil of `count` nodes; the rest of y is 0. */
static inline void cipc_stencil_positions(const double *x, const int *nodes, int count, double y[12])
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) y[3 * i + k] = i < count ? x[3 * nodes[i] + k] : 0;
    }
}

/* True squared distance of the two primitives. */
static inline double cipc_stencil_distance2(cipc_pair_kind kind, const double *x)
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_point_point_distance2_value(x);
    case CIPC_POINT_EDGE: return cipc_point_edge_distance2(x);
    case CIPC_POINT_TRIANGLE: return cipc_point_triangle_distance2(x);
    default: return cipc_edge_edge_distance2(x);
    }
}

/* Contact thickness of a stencil: of one node of each side. */
static inline double cipc_stencil_offset(const cipc_model *model, cipc_pair_kind kind, const int nodes[4])
{
    return cipc_model_pair_offset(model, nodes[0], nodes[cipc_pair_nodes(kind) - 1]);
}

#endif
