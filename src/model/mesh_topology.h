/* Edges and hinges of triangles, joints of segments, the surface of tetrahedra. */
#ifndef CIPC_MODEL_MESH_TOPOLOGY_H
#define CIPC_MODEL_MESH_TOPOLOGY_H

#include "cipc/model.h"

/* Fill edges, edge_area and hinges from triangles and rest positions. Hinges of shells only. Room is left behind the edges for `segment_count` segments. */
cipc_status cipc_mesh_topology(cipc_model *model, cipc_error *error);

/* Fill joints from the segments: all pairs at each node. */
cipc_status cipc_rod_topology(cipc_model *model, cipc_error *error);

/* The surface of tetrahedra: faces that belong to one only, seen from outside anticlockwise, in the order of tetrahedra. *faces is the caller's to free. CIPC_E_BAD_MESH if a
 * face belongs to more than two. */
cipc_status cipc_volume_surface(const int (*tetrahedra)[4], int count, const char *body, int (**faces)[3], int *face_count, cipc_error *error);

#endif
