/* What a mesh is like: for tests of generators. */
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

typedef struct volume_properties {
    double volume, smallest, largest; /* of all tetrahedra, the least and the largest one, signed */
    double smallest_dihedral;         /* rad */
    mesh_properties surface;          /* of the faces of one tetrahedron only; its unused nodes lie inside, its Euler number counts the others */
    int surface_triangles;
    int nodes_unused;                 /* by any tetrahedron */
} volume_properties;

volume_properties measure_volume(const cipc_mesh *mesh);

/* Nodes at the very place of another one. */
int count_duplicate_nodes(const cipc_mesh *mesh);
/* Sum over the segments. */
double total_length(const cipc_mesh *mesh);
/* Same counts, same bits. */
bool are_same_meshes(const cipc_mesh *a, const cipc_mesh *b);

#endif
