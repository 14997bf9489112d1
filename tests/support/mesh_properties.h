/* What a surface mesh is like: for tests of generators. */
#ifndef SUPPORT_MESH_PROPERTIES_H
#define SUPPORT_MESH_PROPERTIES_H

#include "cipc/scene.h"

typedef struct mesh_properties {
    int edges, boundary_edges;
    int euler;     /* nodes - edges + triangles: 1 for a disc, 2 for a sphere */
    int bad_edges; /* with more than two triangles, or passed twice in the same direction (inconsistent orientation) */
    int unused_nodes;
    double area, volume;   /* volume: of the signed tetrahedra from the origin */
    double smallest_angle; /* rad */
    double smallest_up;    /* least y of the unit normals */
} mesh_properties;

/* Brute force over sorted half-edges; O(n log n). */
mesh_properties measure_mesh(const cipc_mesh *mesh);

#endif
