/* Squared distance of the lines through two edges. SPEC D.1; docs/theory/distance.md eqs. 2, 4-6, 8. */
#include "cipc/geometry.h"
#include "geometry/plane_frame.h"

double cipc_line_line_distance2_value(const double x[12])
{
    double u[3], a[3], b[3];
    v3_sub(u, x, x + 6);
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 9, x + 6);
    return plane_distance2(u, a, b);
}

void cipc_line_line_distance2_gradient(const double x[12], double g[12])
{
    plane_frame f;
    double w[4];
    plane_frame_of_line_line(x, &f, w);
    plane_frame_gradient(&f, w, g);
}

void cipc_line_line_distance2_hessian(const double x[12], double H[144])
{
    plane_frame f;
    double w[4], q[4][3]; /* eq. 8 */
    plane_frame_of_line_line(x, &f, w);
    v3_scale(q[0], -1.0, f.g1);
    v3_copy(q[1], f.g1);
    v3_scale(q[2], -1.0, f.g2);
    v3_copy(q[3], f.g2);
    plane_frame_hessian(&f, w, q, H);
}
