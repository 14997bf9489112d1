/* Squared distance of a point to the plane of a triangle. SPEC D.1; docs/theory/distance.md eqs. 2, 4-6. */
#include "cipc/geometry.h"
#include "geometry/plane_frame.h"

double cipc_point_plane_distance2_value(const double x[12])
{
    double u[3], a[3], b[3];
    v3_sub(u, x, x + 3);
    v3_sub(a, x + 6, x + 3);
    v3_sub(b, x + 9, x + 3);
    return plane_distance2(u, a, b);
}

void cipc_point_plane_distance2_gradient(const double x[12], double g[12])
{
    plane_frame f;
    double w[4];
    plane_frame_of_point_plane(x, &f, w);
    plane_frame_gradient(&f, w, g);
}

void cipc_point_plane_distance2_hessian(const double x[12], double H[144])
{
    plane_frame f;
    double w[4], q[4][3]; /* q: gradients of the barycentric coordinates; the point has none (eq. 7) */
    plane_frame_of_point_plane(x, &f, w);
    q[0][0] = q[0][1] = q[0][2] = 0.0;
    v3_add(q[1], f.g1, f.g2);
    v3_scale(q[1], -1.0, q[1]);
    v3_copy(q[2], f.g1);
    v3_copy(q[3], f.g2);
    plane_frame_hessian(&f, w, q, H);
}
