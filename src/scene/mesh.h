/* Making a mesh's arrays. */
#ifndef SCENE_MESH_H
#define SCENE_MESH_H

#include "cipc/scene.h"

enum { SCENE_NODES_MAX = 10000000, SCENE_TRIANGLES_MAX = 2 * SCENE_NODES_MAX };

/* Arrays of the given sizes, zeroed; the mesh is empty if it fails. OUT_OF_RANGE beyond SCENE_NODES_MAX or SCENE_TRIANGLES_MAX. */
cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error);

#endif
