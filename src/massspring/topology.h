/* The springs of a shell. */
#ifndef MASSSPRING_TOPOLOGY_H
#define MASSSPRING_TOPOLOGY_H

#include "cipc/model.h"

/* First the structural springs, one along every edge of the shell's mesh; then the bending springs, one between the two vertices opposite to every edge with two triangles (SPEC B.1). */
typedef struct massspring_topology {
    int count, structural_count;
    int (*ends)[2];  /* global node indices; structural: as the model's edge, bending: v2 and v3 of the hinge */
    double *lengths; /* m, in the rest shape */
} massspring_topology;

/* Of the body `body`, in the model's order of edges and of hinges. On a sheet of equilateral triangles with edge d the bending springs are sqrt(3) d long. Of a curved rest shape
 * they are as long as the straight way, so that it is at rest. On a mesh so coarse that two opposite vertices are joined by an edge too, both springs are listed; where two
 * triangles of the same three nodes lie back to back there is nothing between the vertices, and no spring. The list is empty if it fails: CIPC_E_OUT_OF_MEMORY. */
cipc_status massspring_topology_create(massspring_topology *topology, const cipc_model *model, int body, cipc_error *error);
void massspring_topology_free(massspring_topology *topology);

#endif
