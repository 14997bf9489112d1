/* Sizes at rest of elements, and what follows from them: masses, areas, contact weights. */
#ifndef CIPC_MODEL_MEASURES_H
#define CIPC_MODEL_MEASURES_H

#include "cipc/model.h"

/* Length, m. */
double cipc_segment_length(const double a[3], const double b[3]);
/* Area of a triangle, m^2. */
double cipc_triangle_area(const double a[3], const double b[3], const double c[3]);
/* Signed volume of a tetrahedron, m^3: positive if det[b-a, c-a, d-a] is. */
double cipc_tetrahedron_volume(const double a[3], const double b[3], const double c[3], const double d[3]);

/* Add the lumped masses of a body's elements to its nodes, once its elements are in the model (SPEC C.1, R.1), and mark the inner nodes of a volume. */
void cipc_body_masses(cipc_model *model, const cipc_body *body);
/* Areas of nodes, once the triangles are known; weights of nodes and edges, once the edges are. */
void cipc_model_areas(cipc_model *model);
cipc_status cipc_model_weights(cipc_model *model, cipc_error *error);

#endif
