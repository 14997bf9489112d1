/* Nodes and positions of a candidate pair's stencil. */
#ifndef CIPC_CONTACT_STENCIL_H
#define CIPC_CONTACT_STENCIL_H

#include "base/vector.h"
#include "cipc/model.h"

/* (node, triangle) or (edge, edge): the four global nodes, point or first edge first. */
static inline void cipc_stencil_nodes(const cipc_model *model, bool edge_edge, const int pair[2], int nodes[4])
{
    if (edge_edge) {
        nodes[0] = model->edges[pair[0]][0];
        nodes[1] = model->edges[pair[0]][1];
        nodes[2] = model->edges[pair[1]][0];
        nodes[3] = model->edges[pair[1]][1];
    } else {
        nodes[0] = pair[0];
        for (int k = 0; k < 3; k++) nodes[1 + k] = model->triangles[pair[1]][k];
    }
}

static inline void cipc_stencil_positions(const double *x, const int nodes[4], double y[12])
{
    for (int i = 0; i < 4; i++) v3_copy(y + 3 * i, x + 3 * nodes[i]);
}

#endif
