/* Squared distances by kind of feature, and the true squared distance of two primitives. SPEC D.1; docs/theory/distance.md. */
#include <string.h>

#include "cipc/geometry.h"

double cipc_distance2_value(cipc_pair_kind kind, const double *x)
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_point_point_distance2_value(x);
    case CIPC_POINT_EDGE: return cipc_point_line_distance2_value(x);
    case CIPC_POINT_TRIANGLE: return cipc_point_plane_distance2_value(x);
    default: return cipc_line_line_distance2_value(x);
    }
}

void cipc_distance2_gradient(cipc_pair_kind kind, const double *x, double *g)
{
    switch (kind) {
    case CIPC_POINT_POINT: cipc_point_point_distance2_gradient(x, g); break;
    case CIPC_POINT_EDGE: cipc_point_line_distance2_gradient(x, g); break;
    case CIPC_POINT_TRIANGLE: cipc_point_plane_distance2_gradient(x, g); break;
    default: cipc_line_line_distance2_gradient(x, g); break;
    }
}

void cipc_distance2_hessian(cipc_pair_kind kind, const double *x, double *H)
{
    switch (kind) {
    case CIPC_POINT_POINT: cipc_point_point_distance2_hessian(x, H); break;
    case CIPC_POINT_EDGE: cipc_point_line_distance2_hessian(x, H); break;
    case CIPC_POINT_TRIANGLE: cipc_point_plane_distance2_hessian(x, H); break;
    default: cipc_line_line_distance2_hessian(x, H); break;
    }
}

/* The smooth distance of a feature of the stencil x. */
static double feature_distance2(cipc_feature feature, const double *x)
{
    double y[12];
    for (int i = 0; i < feature.count; i++) memcpy(y + 3 * i, x + 3 * feature.local[i], 3 * sizeof y[0]);
    return cipc_distance2_value(feature.kind, y);
}

double cipc_point_edge_distance2(const double x[9])
{
    return feature_distance2(cipc_point_edge_feature(x), x);
}

double cipc_point_triangle_distance2(const double x[12])
{
    return feature_distance2(cipc_point_triangle_feature(x), x);
}

double cipc_edge_edge_distance2(const double x[12])
{
    return feature_distance2(cipc_edge_edge_feature(x), x);
}
