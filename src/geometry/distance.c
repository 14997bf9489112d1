/* Squared distances by kind of feature, and the true squared distance of two primitives. SPEC D.1; docs/theory/distance.md. */
#include <string.h>

#include "cipc/geometry.h"
#include "geometry/nearest.h"

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

/* Features of less than four nodes: their nodes' positions. */
enum { PART_NODES = 3 };
static void gather(const cipc_feature *feature, const double *x, double y[3 * PART_NODES])
{
    for (int i = 0; i < PART_NODES; i++) memcpy(y + 3 * i, x + 3 * feature->local[i], 3 * sizeof y[0]); /* local is 0 beyond the count */
}

/* The smooth distance of such a feature of the stencil x, read where its nodes lie. */
static inline double part_distance2(const cipc_feature *feature, const double *x)
{
    const double *p = x + 3 * feature->local[0], *e0 = x + 3 * feature->local[1], *e1 = x + 3 * feature->local[2];
    double u[3], e[3];
    v3_sub(u, p, e0);
    v3_sub(e, e1, e0);
    return feature->kind == CIPC_POINT_POINT ? v3_norm2(u) : line_distance2(u, e);
}

double cipc_point_edge_distance2(const double x[9])
{
    cipc_feature feature = cipc_point_edge_feature(x);
    return part_distance2(&feature, x);
}

double cipc_point_triangle_distance2(const double x[12])
{
    cipc_feature feature = cipc_point_triangle_feature(x);
    return feature.count == 4 ? cipc_point_plane_distance2_value(x) : part_distance2(&feature, x);
}

double cipc_edge_edge_distance2(const double x[12])
{
    cipc_feature feature = cipc_edge_edge_feature(x);
    return feature.count == 4 ? cipc_line_line_distance2_value(x) : part_distance2(&feature, x);
}

/* g[n] of the feature's nodes among the n numbers of the stencil. */
static void part_gradient(const cipc_feature *feature, int n, const double *x, double *g)
{
    double y[3 * PART_NODES], part[3 * PART_NODES];
    gather(feature, x, y);
    if (feature->kind == CIPC_POINT_POINT) cipc_point_point_distance2_gradient(y, part);
    else cipc_point_line_distance2_gradient(y, part);
    memset(g, 0, (size_t)n * sizeof *g);
    for (int i = 0; i < PART_NODES && i < feature->count; i++) memcpy(g + 3 * feature->local[i], part + 3 * i, 3 * sizeof *g);
}

static void part_hessian(const cipc_feature *feature, int n, const double *x, double *H)
{
    double y[3 * PART_NODES], part[9 * PART_NODES * PART_NODES];
    gather(feature, x, y);
    if (feature->kind == CIPC_POINT_POINT) cipc_point_point_distance2_hessian(y, part);
    else cipc_point_line_distance2_hessian(y, part);
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    int m = 3 * feature->count;
    for (int r = 0; r < 3 * PART_NODES && r < m; r++) {
        double *row = H + n * (3 * feature->local[r / 3] + r % 3);
        for (int j = 0; j < PART_NODES && j < feature->count; j++) memcpy(row + 3 * feature->local[j], part + m * r + 3 * j, 3 * sizeof *row);
    }
}

void cipc_point_edge_distance2_gradient(const double x[9], double g[9])
{
    cipc_feature feature = cipc_point_edge_feature(x);
    part_gradient(&feature, 9, x, g);
}

void cipc_point_edge_distance2_hessian(const double x[9], double H[81])
{
    cipc_feature feature = cipc_point_edge_feature(x);
    part_hessian(&feature, 9, x, H);
}

void cipc_point_triangle_distance2_gradient(const double x[12], double g[12])
{
    cipc_feature feature = cipc_point_triangle_feature(x);
    if (feature.count == 4) cipc_point_plane_distance2_gradient(x, g);
    else part_gradient(&feature, 12, x, g);
}

void cipc_point_triangle_distance2_hessian(const double x[12], double H[144])
{
    cipc_feature feature = cipc_point_triangle_feature(x);
    if (feature.count == 4) cipc_point_plane_distance2_hessian(x, H);
    else part_hessian(&feature, 12, x, H);
}

void cipc_edge_edge_distance2_gradient(const double x[12], double g[12])
{
    cipc_feature feature = cipc_edge_edge_feature(x);
    if (feature.count == 4) cipc_line_line_distance2_gradient(x, g);
    else part_gradient(&feature, 12, x, g);
}

void cipc_edge_edge_distance2_hessian(const double x[12], double H[144])
{
    cipc_feature feature = cipc_edge_edge_feature(x);
    if (feature.count == 4) cipc_line_line_distance2_hessian(x, H);
    else part_hessian(&feature, 12, x, H);
}
