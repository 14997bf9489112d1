/* Closest feature of a point and a triangle. SPEC D.1, V.4; docs/theory/distance.md sections 6.2, 6.3. */
#include <math.h>

#include "cipc/geometry.h"
#include "geometry/nearest.h"
#include "geometry/plane_frame.h"

static const cipc_feature face = {CIPC_POINT_TRIANGLE, 4, {0, 1, 2, 3}};

/* The edges as node pairs, each opposite the node whose barycentric coordinate has the same place. */
static const int opposite_edge[3][2] = {{2, 3}, {3, 1}, {1, 2}};

/* Well-shaped triangle: barycentric coordinates times |n|^2. None negative: the face. Otherwise the closest point lies on an edge whose
 * coordinate is negative (section 6.2). */
static cipc_feature by_barycentrics(const double x[12], const double u[3], const double a[3], const double b[3], const double n[3],
                                    double n2)
{
    double m[3], weight[3];
    v3_cross(m, u, b);
    weight[1] = v3_dot(m, n);
    v3_cross(m, a, u);
    weight[2] = v3_dot(m, n);
    weight[0] = n2 - weight[1] - weight[2];
    if (weight[0] >= 0.0 && weight[1] >= 0.0 && weight[2] >= 0.0) return face;
    nearest_feature best = {INFINITY, feature_point_point(0, 1)};
    for (int i = 0; i < 3; i++)
        if (weight[i] < 0.0) nearest_offer_segment(&best, x, 0, opposite_edge[i][0], opposite_edge[i][1]);
    return best.feature;
}

/* Squared distance to the foot of the perpendicular on the plane, INFINITY if that foot is not inside the triangle. It is measured to
 * the foot itself, so it is the distance of a true point of the triangle however bad the foot. */
static double inside_distance2(const double u[3], const double a[3], const double b[3])
{
    plane_frame f;
    plane_frame_directions(&f, a, b);
    plane_frame_coordinates(&f, u);
    double distance2 = plane_frame_settle(&f, u, a, b);
    return f.n2 >= DBL_MIN && f.beta > 0.0 && f.gamma > 0.0 && f.beta + f.gamma < 1.0 ? distance2 : INFINITY;
}

/* Sliver or zero area: the nearest of the three edges, unless the face is truly nearer. */
static cipc_feature by_exhaustion(const double x[12], const double u[3], const double a[3], const double b[3])
{
    nearest_feature best = {INFINITY, feature_point_point(0, 1)};
    for (int i = 0; i < 3; i++) nearest_offer_segment(&best, x, 0, opposite_edge[i][0], opposite_edge[i][1]);
    return inside_distance2(u, a, b) < best.distance2 ? face : best.feature;
}

cipc_feature cipc_point_triangle_feature(const double x[12])
{
    double u[3], a[3], b[3], n[3];
    v3_sub(u, x, x + 3);
    v3_sub(a, x + 6, x + 3);
    v3_sub(b, x + 9, x + 3);
    v3_cross(n, a, b);
    double n2 = v3_norm2(n), scale = v3_norm2(a) * v3_norm2(b);
    if (n2 >= DBL_MIN && n2 > NEAREST_WELL_SHAPED * scale) return by_barycentrics(x, u, a, b, n, n2);
    return by_exhaustion(x, u, a, b);
}
