/* Making a mesh's arrays. */
#ifndef SCENE_MESH_H
#define SCENE_MESH_H

#include "cipc/scene.h"

enum { SCENE_NODES_MAX = 10000000, SCENE_TRIANGLES_MAX = 2 * SCENE_NODES_MAX };

/* Arrays of the given sizes, zeroed; the mesh is empty if it fails. OUT_OF_RANGE beyond SCENE_NODES_MAX or SCENE_TRIANGLES_MAX. */
cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error);

/* Arrays for `nodes` nodes and `elements` elements of a kind, zeroed. */
cipc_status scene_mesh_allocate_kind(cipc_mesh *mesh, cipc_mesh_kind kind, long long nodes, long long elements, const char *place, cipc_error *error);

/* The readers by format: all nodes of the file, used or not. */
cipc_status scene_mesh_read_obj(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error);
cipc_status scene_mesh_read_gmsh(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error);
cipc_status scene_mesh_read_vtk(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error);

/* Write the three tetrahedra of each of `count` prisms into the mesh from tetrahedron `first` on: prism i stands on triangle i of `triangles` with nodes of layer `below` under those of layer `above`, a
 * layer being the number to add to the triangle's nodes. Neighbours fit: each side face is cut from its lowest node number. Orientation is made positive from the nodes' positions. */
void scene_mesh_add_prisms(cipc_mesh *mesh, int first, const int (*triangles)[3], int count, int below, int above);
/* Exchange two nodes of tetrahedra of negative volume. */
void scene_mesh_orient(cipc_mesh *mesh);

#endif
