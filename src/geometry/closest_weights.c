/* Weights of the closest vector of a feature pair. SPEC D.6; docs/theory/distance.md eqs. 1, 5, 11. */
#include "cipc/geometry.h"
#include "base/vector.h"
#include "geometry/plane_frame.h"

static void point_point(double w[4])
{
    w[0] = 1.0;
    w[1] = -1.0;
    w[2] = w[3] = 0.0;
}

static void point_line(const double x[9], double w[4])
{
    double u[3], e[3];
    v3_sub(u, x, x + 3);
    v3_sub(e, x + 6, x + 3);
    double t = v3_dot(u, e) / v3_norm2(e);
    w[0] = 1.0;
    w[1] = t - 1.0;
    w[2] = -t;
    w[3] = 0.0;
}

void cipc_closest_weights(cipc_pair_kind kind, const double *x, double w[4])
{
    plane_frame f;
    switch (kind) {
    case CIPC_POINT_POINT: point_point(w); break;
    case CIPC_POINT_EDGE: point_line(x, w); break;
    case CIPC_POINT_TRIANGLE: plane_frame_of_point_plane(x, &f, w); break;
    default: plane_frame_of_line_line(x, &f, w); break;
    }
}
