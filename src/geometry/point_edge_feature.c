/* Closest feature of a point and an edge. SPEC D.1; docs/theory/distance.md section 6.1. */
#include "cipc/geometry.h"
#include "geometry/nearest.h"

cipc_feature cipc_point_edge_feature(const double x[9])
{
    double u[3], e[3];
    v3_sub(u, x, x + 3);
    v3_sub(e, x + 6, x + 3);
    return feature_of_place(nearest_on_segment(u, e), 0, 1, 2);
}
