/* Making a mesh's arrays. */
#ifndef SCENE_MESH_H
#define SCENE_MESH_H

#include "cipc/scene.h"

enum {
    SCENE_NODES_MAX = 10000000,
    SCENE_TRIANGLES_MAX = 2 * SCENE_NODES_MAX,
    SCENE_SEGMENTS_MAX = 2 * SCENE_NODES_MAX,
    SCENE_TETRAHEDRA_MAX = 6 * SCENE_NODES_MAX
};

typedef struct scene_mesh_sizes {
    long long nodes, triangles, segments, tetrahedra;
} scene_mesh_sizes;

/* a * b of two numbers of 0 or more, or a number beyond every limit above if the product is beyond them: sizes multiplied with it do not overflow. */
long long scene_mesh_product(long long a, long long b);

/* Arrays of the given sizes, zeroed, NULL for elements that the mesh has none of; the mesh is empty if it fails. OUT_OF_RANGE beyond the limits above. */
cipc_status scene_mesh_allocate_sizes(cipc_mesh *mesh, const scene_mesh_sizes *sizes, const char *place, cipc_error *error);
/* The same for a surface. */
cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error);

#endif
