/* Closest feature of two edges. SPEC D.1, V.4; docs/theory/distance.md sections 6.2, 6.3. */
#include <math.h>

#include "cipc/geometry.h"
#include "geometry/nearest.h"
#include "geometry/plane_frame.h"

static const cipc_feature interior = {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}};

/* The scalar products that the 2 x 2 system of the closest points is made of; u = a0 - b0. */
typedef struct products {
    double aa, bb, ab, au, bu, n2; /* n2 = |a x b|^2, the determinant */
} products;

/* The end of edge b nearest to edge a is b_end: where on a does it look? `along` is the numerator of that parameter of a. */
static cipc_feature end_of_b(int end, double along, double aa)
{
    if (along <= 0.0) return feature_point_point(0, end);
    if (along >= aa) return feature_point_point(1, end);
    return feature_point_edge(end, 0, 1);
}

/* Edges at a clear angle: minimum of a convex quadratic over the unit square. Clamp the free minimum in s, minimise over t, clamp, and
 * minimise over s once more (section 6.2). Numerators are compared with denominators, so nothing is divided. */
static cipc_feature by_clamping(const products *m)
{
    double s = m->ab * m->bu - m->bb * m->au; /* times n2 */
    int end_a = s <= 0.0 ? 0 : s >= m->n2 ? 1 : -1;
    double t, t_full; /* t = t / t_full */
    if (end_a < 0) {
        t = m->aa * m->bu - m->ab * m->au;
        t_full = m->n2;
    } else {
        t = m->bu + (end_a == 1 ? m->ab : 0.0);
        t_full = m->bb;
    }
    if (t <= 0.0) return end_of_b(2, -m->au, m->aa);
    if (t >= t_full) return end_of_b(3, m->ab - m->au, m->aa);
    return end_a < 0 ? interior : feature_point_edge(end_a, 2, 3);
}

/* Squared distance between the closest points of the two lines, INFINITY if they are not inside the edges. It is measured between those
 * points, so it is the distance of two true points of the edges however bad the parameters. */
static double inside_distance2(const double u[3], const double a[3], const double b[3])
{
    plane_frame f;
    plane_frame_directions(&f, a, b);
    plane_frame_coordinates(&f, u);
    double distance2 = plane_frame_settle(&f, u, a, b), s = -f.beta, t = f.gamma;
    return f.n2 >= DBL_MIN && s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 ? distance2 : INFINITY;
}

/* Out of line, so that its variables take no registers from the usual case. Near-parallel or zero-length edges: the nearest of the four ends against the other edge, unless the interior is truly nearer. */
__attribute__((noinline, cold)) static cipc_feature by_exhaustion(const double x[12], const double u[3], const double a[3], const double b[3])
{
    nearest_feature best = {INFINITY, feature_point_point(0, 2)};
    nearest_offer_segment(&best, x, 0, 2, 3);
    nearest_offer_segment(&best, x, 1, 2, 3);
    nearest_offer_segment(&best, x, 2, 0, 1);
    nearest_offer_segment(&best, x, 3, 0, 1);
    return inside_distance2(u, a, b) < best.distance2 ? interior : best.feature;
}

cipc_feature cipc_edge_edge_feature(const double x[12])
{
    double u[3], a[3], b[3], n[3];
    v3_sub(u, x, x + 6);
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 9, x + 6);
    v3_cross(n, a, b);
    const products m = {v3_norm2(a), v3_norm2(b), v3_dot(a, b), v3_dot(a, u), v3_dot(b, u), v3_norm2(n)};
    double scale = m.aa * m.bb;
    if (m.n2 >= DBL_MIN && m.n2 > NEAREST_WELL_SHAPED * scale) return by_clamping(&m);
    return by_exhaustion(x, u, a, b);
}
