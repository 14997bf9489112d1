/* Edges and hinges of a model's triangles. */
#ifndef CIPC_MODEL_MESH_TOPOLOGY_H
#define CIPC_MODEL_MESH_TOPOLOGY_H

#include "cipc/model.h"

/* Fill edges, edge_area and hinges from triangles and rest positions. */
cipc_status cipc_mesh_topology(cipc_model *model, cipc_error *error);

/* Area of a triangle, m^2. */
double cipc_triangle_area(const double a[3], const double b[3], const double c[3]);

#endif
