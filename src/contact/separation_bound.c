/* Certified lower bound of a gap in doubles (SPEC V.4 item 2; docs/theory/certified_ccd.md, section 2). */
#include "contact/separation_bound.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"

#define UNIT (0.5 * DBL_EPSILON)
/* (5) error of the separation min - max along n, in units of u |n|_1 S: 14 in first order, 16 with everything else. */
#define SEPARATION_ERROR (16 * UNIT)
/* (6) the quotient by |n| and what is multiplied and subtracted after it: below 7 u relatively. */
#define ROUND_DOWN (1 - 8 * UNIT)
/* (7) a length is off by less than 3 u, a sum by u; with two roundings of q before. */
#define ROUND_UP (1 + 16 * UNIT)
/* cot^2 of the angle from which a common normal is used as computed: it only has to be nearly the best direction. */
#define CLEAR_COT2 15.0
/* Outside of these ranges underflow or overflow could spoil the bounds: nothing is certified there. */
#define SMALLEST 0x1p-300
#define LARGEST  0x1p300

static double largest_coordinate(const double *v, int nodes)
{
    double most[3] = {0, 0, 0};
    for (int i = 0; i < nodes; i++)
        for (int k = 0; k < 3; k++) most[k] = max2(most[k], fabs(v[3 * i + k]));
    return max2(max2(most[0], most[1]), most[2]);
}

/* (7) l_p: the largest displacement on each side, added; `unit` scales the displacements to where their squares neither vanish nor overflow. */
static double speed_in_unit(const contact_local_path *local, double raw, int unit)
{
    double side[2];
    for (int j = 0; j < 2; j++) {
        side[j] = 0;
        for (int i = j ? local->first : 0; i < (j ? local->nodes : local->first); i++) {
            double q[3];
            for (int k = 0; k < 3; k++) q[k] = unit ? ldexp(local->q[3 * i + k], -unit) : local->q[3 * i + k];
            side[j] = max2(side[j], v3_norm2(q));
        }
    }
    return (sqrt(side[0]) + sqrt(side[1])) * ROUND_UP + 4 * UNIT * (unit ? ldexp(raw, -unit) : raw);
}

static void set_speed(contact_local_path *local, double raw)
{
    local->speed_unit = 0;
    local->speed = speed_in_unit(local, raw, 0);
    if (local->speed > SMALLEST && local->speed < LARGEST) return;
    double most = max2(largest_coordinate(local->q, local->nodes), raw);
    if (most == 0) return;
    if (!isfinite(most)) { /* a difference has overflowed: no displacement exceeds four times the largest double */
        local->speed = 1;
        local->speed_unit = 1028;
        return;
    }
    int unit, more;
    frexp(most, &unit);
    local->speed = frexp(speed_in_unit(local, raw, unit), &more); /* in [1/2, 1), as the quotients by it ask */
    local->speed_unit = unit + more;
}

/* NaN or infinity anywhere makes the sum one. */
static bool all_finite(const cipc_stencil_path *path, int nodes)
{
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < nodes; i++)
        for (int k = 0; k < 3; k++) sum[k] += 0 * path->x[3 * i + k] + 0 * path->p[3 * i + k];
    return sum[0] + sum[1] + sum[2] == 0;
}

bool contact_local_path_init(contact_local_path *local, const cipc_stencil_path *path)
{
    double common[3] = {0, 0, 0}, moved[12], raw = 0;
    local->kind = path->kind;
    local->nodes = cipc_pair_nodes(path->kind);
    local->first = cipc_pair_first_nodes(path->kind);
    double share = 1.0 / local->nodes; /* any common vector serves: what matters is that all nodes lose the same */
    for (int i = 0; i < local->nodes; i++) {
        for (int k = 3 * i; k < 3 * i + 3; k++) moved[k] = path->to_end ? path->p[k] - path->x[k] : path->p[k];
        for (int k = 0; k < 3; k++) common[k] += moved[3 * i + k] * share;
    }
    for (int i = 0; i < local->nodes; i++) {
        v3_sub(local->y + 3 * i, path->x + 3 * i, path->x);
        v3_sub(local->q + 3 * i, moved + 3 * i, common);
    }
    if (path->to_end) raw = largest_coordinate(moved, local->nodes);
    local->size = largest_coordinate(local->y, local->nodes) + largest_coordinate(local->q, local->nodes) + raw;
    set_speed(local, raw);
    return all_finite(path, local->nodes);
}

/* (1) positions at time t. */
static void positions_at(const contact_local_path *local, double t, double z[12])
{
    for (int i = 0; i < 3 * local->nodes; i++) z[i] = local->y[i] + t * local->q[i];
}

/* (4)-(6) lower bound of the distance along n at positions z. */
static double distance_along(const contact_local_path *local, const double z[12], const double n[3], double length)
{
    double near = INFINITY, far = -INFINITY;
    for (int i = 0; i < local->first; i++) near = min2(near, v3_dot(n, z + 3 * i));
    for (int i = local->first; i < local->nodes; i++) far = max2(far, v3_dot(n, z + 3 * i));
    double norm1 = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), scale = norm1 * local->size;
    if (!(norm1 > SMALLEST && norm1 < LARGEST && scale > SMALLEST && scale < LARGEST)) return -INFINITY;
    double distance = ((near - far) - SEPARATION_ERROR * scale) / length;
    return distance > 0 ? distance * ROUND_DOWN : -INFINITY;
}

/* (6) d - xi rounded down. */
static double gap_below(double distance, double xi)
{
    double gap = distance - xi;
    return gap > 0 ? gap * ROUND_DOWN : -INFINITY;
}

double contact_gap_along(const contact_local_path *local, const double n[3], double xi, double t)
{
    double z[12];
    positions_at(local, t, z);
    return gap_below(distance_along(local, z, n, v3_norm(n)), xi);
}

/* The separation along n is the least of n.(a_i - b_j) over pairs of nodes, each linear in time. */
double contact_time_along(const contact_local_path *local, const double n[3], double xi, double t, double wanted)
{
    double height[4], rate[4], level = v3_norm(n) * (xi + wanted), last = INFINITY;
    for (int i = 0; i < local->nodes; i++) {
        rate[i] = v3_dot(n, local->q + 3 * i);
        height[i] = v3_dot(n, local->y + 3 * i) + t * rate[i];
    }
    for (int i = 0; i < local->first; i++) {
        for (int j = local->first; j < local->nodes; j++) {
            double fall = rate[j] - rate[i];
            if (fall > 0) last = min2(last, t + (height[i] - height[j] - level) / fall);
        }
    }
    return last;
}

/* n := e x (u x e), the part of u across e times |e|^2: perpendicular to e to a few ulp of itself, however small it is against u (SPEC V.4 item 2). */
static void perpendicular(double n[3], const double u[3], const double e[3])
{
    double m[3];
    v3_cross(m, u, e);
    v3_cross(n, e, m);
}

/* n := a x b, at small angles with its rounding error along a taken out (docs/theory/distance.md (9)). */
static void common_normal(double n[3], const double a[3], const double b[3])
{
    v3_cross(n, a, b);
    double ab = v3_dot(a, b);
    if (ab * ab > CLEAR_COT2 * v3_norm2(n)) v3_axpy(n, -v3_dot(n, a) / v3_norm2(a), a);
}

/* Normal of a feature, pointing from the second primitive to the first if the computed distance has a sign at all. */
static void feature_normal(const double z[12], const cipc_feature *feature, int first, double n[3])
{
    const double *x[4];
    double u[3], a[3], b[3];
    for (int i = 0; i < 4; i++) x[i] = z + 3 * feature->local[i];
    switch (feature->kind) {
    case CIPC_POINT_POINT: v3_sub(n, x[0], x[1]); return; /* features name the first primitive's node first */
    case CIPC_POINT_EDGE:
        v3_sub(u, x[0], x[1]);
        v3_sub(a, x[2], x[1]);
        perpendicular(n, u, a);
        if (feature->local[0] >= first) v3_scale(n, -1, n); /* a point of the second primitive against an edge of the first */
        return;
    case CIPC_POINT_TRIANGLE:
        v3_sub(u, x[0], x[1]);
        v3_sub(a, x[2], x[1]);
        v3_sub(b, x[3], x[1]);
        break;
    default:
        v3_sub(u, x[0], x[2]);
        v3_sub(a, x[1], x[0]);
        v3_sub(b, x[3], x[2]);
        break;
    }
    common_normal(n, a, b);
    if (v3_dot(u, n) < 0) v3_scale(n, -1, n);
}

static cipc_feature closest_feature(cipc_pair_kind kind, const double z[12])
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_feature_at(CIPC_POINT_POINT, 0);
    case CIPC_POINT_EDGE: return cipc_point_edge_feature(z);
    case CIPC_POINT_TRIANGLE: return cipc_point_triangle_feature(z);
    default: return cipc_edge_edge_feature(z);
    }
}

contact_gap_bound contact_gap_at(const contact_local_path *local, double xi, double t)
{
    contact_gap_bound bound;
    double z[12], u[3];
    positions_at(local, t, z);
    cipc_feature feature = closest_feature(local->kind, z);
    feature_normal(z, &feature, local->first, bound.n);
    double length = v3_norm(bound.n);
    bound.lower = gap_below(distance_along(local, z, bound.n, length), xi);
    int other = feature.kind == CIPC_EDGE_EDGE ? 2 : 1; /* a node of the feature's other side */
    v3_sub(u, z + 3 * feature.local[0], z + 3 * feature.local[other]);
    bound.estimate = fabs(v3_dot(u, bound.n)) / length - xi;
    return bound;
}

/* (8) The distance of two true points, found as the closest ones of the closest feature: any weights >= 0 that sum to 1 on each side give points of the
 * primitives. Weights are off by a few u from their sum, coordinates and the difference by a few u S: 32 u S in all. */
bool contact_surely_close(const contact_local_path *local, double xi)
{
    double stencil[12], w[4], between[3] = {0, 0, 0}, sum[2] = {0, 0};
    cipc_feature feature = closest_feature(local->kind, local->y);
    for (int i = 0; i < feature.count; i++) v3_copy(stencil + 3 * i, local->y + 3 * feature.local[i]);
    cipc_closest_weights(feature.kind, stencil, w);
    int first = cipc_pair_first_nodes(feature.kind);
    for (int i = 0; i < feature.count; i++) {
        w[i] = max2(0, i < first ? w[i] : -w[i]);
        sum[i >= first] += w[i];
    }
    for (int i = 0; i < feature.count; i++) v3_axpy(between, (i < first ? w[i] : -w[i]) / sum[i >= first], stencil + 3 * i);
    return local->size > SMALLEST && local->size < LARGEST && v3_norm(between) * ROUND_UP + 32 * UNIT * local->size < xi;
}
