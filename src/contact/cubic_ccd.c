/* The baseline that the C-IPC paper (6.6) shows failing: times at which the four nodes are coplanar are roots of a cubic, found in floating point; at each the
 * primitives are tested for overlap with a tolerance. No thickness, no certificate: it misses contacts, and it is here to be compared with. */
#include "cipc/contact.h"

#include <gsl/gsl_poly.h>
#include <math.h>

#include "base/vector.h"

/* Slack of the time, and of the overlap test's distance relative to the stencil's size: what implementations of this kind use. */
static const double INSIDE = 1e-6, NEAR = 1e-6;

static void positions_at(const double x[12], const double p[12], double t, double z[12])
{
    for (int i = 0; i < 12; i++) z[i] = x[i] + t * p[i];
}

/* Coefficients of det(u, a, b)(t), u = u0 + t u1 and so on, from its values at 0, 1, -1, 2. */
static double determinant_at(const double x[12], const double p[12], const int nodes[4], double t)
{
    double z[12], u[3], a[3], b[3], n[3];
    positions_at(x, p, t, z);
    v3_sub(u, z + 3 * nodes[0], z + 3 * nodes[1]);
    v3_sub(a, z + 3 * nodes[2], z + 3 * nodes[1]);
    v3_sub(b, z + 3 * nodes[3], z + 3 * nodes[1]);
    v3_cross(n, a, b);
    return v3_dot(u, n);
}

static int coplanar_times(const double x[12], const double p[12], double times[3])
{
    static const int nodes[4] = {0, 1, 2, 3};
    double f0 = determinant_at(x, p, nodes, 0), f1 = determinant_at(x, p, nodes, 1), g1 = determinant_at(x, p, nodes, -1), f2 = determinant_at(x, p, nodes, 2);
    double c2 = 0.5 * (f1 + g1) - f0, odd = 0.5 * (f1 - g1), c3 = (f2 - f0 - 4 * c2 - 2 * odd) / 6, c1 = odd - c3;
    double scale = fabs(f0) + fabs(c1) + fabs(c2) + fabs(c3);
    if (scale == 0) return 0;
    if (fabs(c3) > 1e-12 * scale) return gsl_poly_solve_cubic(c2 / c3, c1 / c3, f0 / c3, &times[0], &times[1], &times[2]);
    return gsl_poly_solve_quadratic(c2, c1, f0, &times[0], &times[1]);
}

static bool overlaps_at(cipc_pair_kind kind, const double x[12], const double p[12], double t)
{
    double z[12], size = 0;
    positions_at(x, p, t, z);
    for (int i = 0; i < 12; i++) size = max2(size, fabs(z[i] - z[i % 3]));
    double d2 = kind == CIPC_POINT_TRIANGLE ? cipc_point_triangle_distance2(z) : cipc_edge_edge_distance2(z);
    return d2 <= (NEAR * size) * (NEAR * size);
}

cipc_ccd_result cipc_cubic_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options)
{
    (void)thickness;
    cipc_ccd_result result = {.toi = t_max, .outcome = CIPC_CCD_FREE, .precision = 53, .iterations = 1};
    if (path->kind != CIPC_POINT_TRIANGLE && path->kind != CIPC_EDGE_EDGE) return result; /* no four nodes, no cubic */
    double p[12], times[3];
    for (int i = 0; i < 12; i++) p[i] = path->to_end ? path->p[i] - path->x[i] : path->p[i];
    int count = coplanar_times(path->x, p, times);
    for (int i = 0; i < count; i++) { /* ascending */
        if (times[i] < -INSIDE || times[i] > t_max + INSIDE || !overlaps_at(path->kind, path->x, p, times[i])) continue;
        result.toi = max2(0, times[i]) * (1 - options->slackness);
        result.hit = true;
        result.outcome = CIPC_CCD_HIT;
        break;
    }
    return result;
}
