/* Certified lower bounds of distances by separating directions (SPEC V.4, duality; docs/monitors.md, "The separation bound").
 *
 * For ANY direction n and convex A, B:  d(A, B) >= ( min_i n.a_i - max_j n.b_j ) / |n|.  So whatever finds n need not be trusted:
 * approximate closest points and features do. Only the evaluation of the right-hand side needs an error bound. Coordinates are taken
 * relative to a node of the stencil, so that the error scales with the stencil, not with the world. */
#include "invariant/separation.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"

/* Unit roundoff of double. */
#define UNIT (0.5 * DBL_EPSILON)
/* Error of min - max in units of u |n|_1 S, S = largest coordinate of the stencil: 2 * 4 + 2 = 10 in first order; 12 covers the rest and
 * the rounding of the bound itself (docs/monitors.md). */
#define SEPARATION_ERROR (12 * UNIT)
/* The quotient sep / |n| is off by less than 6 u relatively: 3/2 + 1 in the length, 1 each in the difference, the quotient and the
 * product. */
#define ROUND_DOWN (1 - 8 * UNIT)
/* Outside of these, underflow or overflow could spoil the bounds: nothing is proven then. */
#define SMALLEST_NORM  0x1p-400
#define LARGEST_NORM   0x1p400
#define SMALLEST_SCALE 0x1p-900
#define LARGEST_SCALE  0x1p900
/* Upper and lower bound this near (relative to the distance, and to the stencil's size) count as one number. Far above the rounding of a
 * good direction (12 sqrt(3) u S, u = 2^-53), far below anything a report shows. */
#define TIGHT_RELATIVE 0x1p-30
#define TIGHT_SIZE     0x1p-46
/* Edges (or sides of a triangle) at an angle below about this (its sine) have a poor cross product: their ends are tried as well. */
#define NEAR_PARALLEL 1e-3

static const cipc_separation nothing = {-INFINITY, INFINITY, false, {0, 0, 0}};

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double least3(double a, double b, double c)
{
    return smaller(smaller(a, b), c);
}

static inline double largest(double size, const double v[3])
{
    return larger(larger(size, fabs(v[0])), larger(fabs(v[1]), fabs(v[2])));
}

/* (low - high) / |n| minus the rounding bound, for projections low and high on n that were evaluated from coordinates up to `size`. */
static inline double certified(double low, double high, const double n[3], double size)
{
    double norm1 = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), scale = norm1 * size;
    if (!(norm1 > SMALLEST_NORM && norm1 < LARGEST_NORM && scale > SMALLEST_SCALE && scale < LARGEST_SCALE)) { return -INFINITY; }
    return ((low - high) - SEPARATION_ERROR * scale) / v3_norm(n) * ROUND_DOWN;
}

/* The point of the segment p + t d, 0 <= t <= 1, nearest to the origin (approximately). Returns its squared distance; inside: 0 < t < 1. */
static inline double nearest_on_segment(const double p[3], const double d[3], double nearest[3], bool *inside)
{
    double length2 = v3_norm2(d), t = -v3_dot(p, d);
    *inside = t > 0 && t < length2;
    t = *inside ? t / length2 : (t > 0 ? 1.0 : 0.0);
    for (int k = 0; k < 3; k++) { nearest[k] = p[k] + t * d[k]; }
    return v3_norm2(nearest);
}

/* Make n perpendicular to d once more: the first time it was perpendicular only up to the rounding of coordinates. */
static inline void orthogonalise(double n[3], const double d[3])
{
    double length2 = v3_norm2(d);
    if (length2 > 0) { v3_axpy(n, -v3_dot(n, d) / length2, d); }
}

/* A point-edge candidate for the nearest feature: from a point to the line through two others. */
typedef struct nearest_candidate {
    double distance2;
    double n[3];     /* from the nearest point of the edge to the point */
    double along[3]; /* the edge's direction */
    bool inside;
} nearest_candidate;

/* Keep the nearer of *best and the pair (origin, segment p + t d); n points from the segment to the origin, times sign. */
static inline void offer_segment(nearest_candidate *best, const double p[3], const double d[3], double sign)
{
    double q[3];
    bool inside;
    double distance2 = nearest_on_segment(p, d, q, &inside);
    if (distance2 < best->distance2) {
        best->distance2 = distance2;
        v3_scale(best->n, -sign, q);
        v3_copy(best->along, d);
        best->inside = inside;
    }
}

static bool is_tight(double lower, double upper, double size)
{
    return upper - lower <= TIGHT_RELATIVE * upper + TIGHT_SIZE * size;
}

static void keep_better(cipc_separation *best, double lower, double upper, double size, const double n[3])
{
    if (lower >= best->lower) { v3_copy(best->n, n); }
    best->lower = larger(best->lower, lower);
    best->upper = smaller(best->upper, upper);
    best->tight = is_tight(best->lower, best->upper, size);
}

/* The nodes of a stencil relative to its first one. Returns the largest coordinate. */
static inline double relative_to_first(double y[][3], const double *x, int others)
{
    double size = 0;
    for (int i = 0; i < others; i++) {
        v3_sub(y[i], &x[3 * i + 3], x);
        size = largest(size, y[i]);
    }
    return size;
}

/* --- point-point: y = q - p. --- */

static inline double point_point_along(const double y[3], const double n[3], double size)
{
    return certified(0, v3_dot(n, y), n, size);
}

cipc_separation cipc_separate_point_point(const double x[6], double enough)
{
    (void)enough; /* the first direction is the best */
    double y[1][3], n[3], size = relative_to_first(y, x, 1);
    cipc_separation best = nothing;
    v3_scale(n, -1, y[0]);
    keep_better(&best, point_point_along(y[0], n, size), v3_norm(n), size, n);
    return best;
}

/* --- point-edge: y_i = e_i - p, the point is the origin. --- */

/* Lower bound along n, which points from the edge to the point. */
static inline double point_edge_along(double y[2][3], const double n[3], double size)
{
    return certified(0, larger(v3_dot(n, y[0]), v3_dot(n, y[1])), n, size);
}

cipc_separation cipc_separate_point_edge(const double x[9], double enough)
{
    double y[2][3], d[3], n[3], size = relative_to_first(y, x, 2);
    cipc_separation best = nothing;
    for (int k = 0; k < 3; k++) { n[k] = -(y[0][k] + y[1][k]); }
    best.lower = point_edge_along(y, n, size); /* towards the middle: settles most far pairs */
    v3_copy(best.n, n);
    if (best.lower > enough) { return best; }
    nearest_candidate nearest = {INFINITY, {0, 0, 0}, {0, 0, 0}, false};
    v3_sub(d, &x[6], &x[3]);
    offer_segment(&nearest, y[0], d, 1);
    if (nearest.inside) { orthogonalise(nearest.n, nearest.along); }
    keep_better(&best, point_edge_along(y, nearest.n, size), sqrt(nearest.distance2), size, nearest.n);
    return best;
}

/* --- point-triangle: y_i = t_i - p, the point is the origin. --- */

/* Lower bound along n, which points from the triangle to the point. */
static inline double point_triangle_along(double y[3][3], const double n[3], double size)
{
    double high = -least3(-v3_dot(n, y[0]), -v3_dot(n, y[1]), -v3_dot(n, y[2]));
    return certified(0, high, n, size);
}

/* The triangle's normal, if the foot of the point lies inside. Returns false when the triangle is such a sliver that its sides must be
 * tried too. */
static bool separate_by_normal(cipc_separation *best, const double x[12], double y[3][3], double size)
{
    double e1[3], e2[3], n[3], s[3];
    v3_sub(e1, &x[6], &x[3]);
    v3_sub(e2, &x[9], &x[3]);
    v3_cross(n, e1, e2);
    /* w = p - t0 = -y0; barycentric coordinates times |n|^2: (w x e2).n and (e1 x w).n. */
    double n2 = v3_norm2(n);
    v3_cross(s, e2, y[0]);
    double beta1 = v3_dot(s, n);
    v3_cross(s, y[0], e1);
    double beta2 = v3_dot(s, n);
    if (!(n2 > 0 && beta1 >= 0 && beta2 >= 0 && beta1 + beta2 <= n2)) { return false; }
    double height = -v3_dot(y[0], n);
    v3_scale(n, height < 0 ? -1.0 : 1.0, n);
    keep_better(best, point_triangle_along(y, n, size), fabs(height) / sqrt(n2), size, n);
    return n2 > NEAR_PARALLEL * NEAR_PARALLEL * v3_norm2(e1) * v3_norm2(e2);
}

static void separate_by_sides(cipc_separation *best, double y[3][3], double size)
{
    nearest_candidate nearest = {INFINITY, {0, 0, 0}, {0, 0, 0}, false};
    for (int i = 0; i < 3; i++) {
        double d[3];
        v3_sub(d, y[(i + 1) % 3], y[i]);
        offer_segment(&nearest, y[i], d, 1);
    }
    if (nearest.inside) { orthogonalise(nearest.n, nearest.along); }
    keep_better(best, point_triangle_along(y, nearest.n, size), sqrt(nearest.distance2), size, nearest.n);
}

cipc_separation cipc_separate_point_triangle(const double x[12], double enough)
{
    double y[3][3], n[3], size = relative_to_first(y, x, 3);
    cipc_separation best = nothing;
    for (int k = 0; k < 3; k++) { n[k] = -(y[0][k] + y[1][k] + y[2][k]); }
    best.lower = point_triangle_along(y, n, size); /* towards the centroid: settles most far pairs */
    v3_copy(best.n, n);
    if (best.lower > enough) { return best; }
    bool settled = separate_by_normal(&best, x, y, size);
    if (!(settled && best.tight) && !(best.lower > enough)) { separate_by_sides(&best, y, size); }
    return best;
}

/* --- edge-edge: y = a1, b0, b1 relative to a0. --- */

/* Lower bound along n, which points from edge b to edge a. */
static inline double edge_edge_along(double y[3][3], const double n[3], double size)
{
    double a = v3_dot(n, y[0]), b0 = v3_dot(n, y[1]), b1 = v3_dot(n, y[2]);
    return certified(a < 0 ? a : 0.0, b0 > b1 ? b0 : b1, n, size);
}

/* The common normal of the two lines, if they come nearest inside both edges. Returns false when they are so parallel that the end points
 * must be tried too. */
static bool separate_by_common_normal(cipc_separation *best, double y[3][3], const double da[3], const double db[3], double size)
{
    double n[3], s[3];
    v3_cross(n, da, db);
    double n2 = v3_norm2(n);
    /* w = b0 - a0 = y1; parameters of the closest points times |n|^2: (w x db).n and (w x da).n. */
    v3_cross(s, y[1], db);
    double ta = v3_dot(s, n);
    v3_cross(s, y[1], da);
    double tb = v3_dot(s, n);
    if (!(n2 > 0 && ta >= 0 && ta <= n2 && tb >= 0 && tb <= n2)) { return false; }
    double height = -v3_dot(y[1], n);
    v3_scale(n, height < 0 ? -1.0 : 1.0, n);
    keep_better(best, edge_edge_along(y, n, size), fabs(height) / sqrt(n2), size, n);
    return n2 > NEAR_PARALLEL * NEAR_PARALLEL * v3_norm2(da) * v3_norm2(db);
}

static void separate_by_ends(cipc_separation *best, const double x[12], double y[3][3], const double da[3], const double db[3], double size)
{
    nearest_candidate nearest = {INFINITY, {0, 0, 0}, {0, 0, 0}, false};
    double r[3];
    offer_segment(&nearest, y[1], db, 1); /* a0 to edge b */
    v3_sub(r, &x[6], &x[3]);
    offer_segment(&nearest, r, db, 1); /* a1 to edge b */
    v3_scale(r, -1, y[1]);
    offer_segment(&nearest, r, da, -1); /* b0 to edge a */
    v3_sub(r, x, &x[9]);
    offer_segment(&nearest, r, da, -1); /* b1 to edge a */
    if (nearest.inside) { orthogonalise(nearest.n, nearest.along); }
    keep_better(best, edge_edge_along(y, nearest.n, size), sqrt(nearest.distance2), size, nearest.n);
}

cipc_separation cipc_separate_edge_edge(const double x[12], double enough)
{
    double y[3][3], da[3], db[3], n[3], size = relative_to_first(y, x, 3);
    cipc_separation best = nothing;
    for (int k = 0; k < 3; k++) { n[k] = y[0][k] - y[1][k] - y[2][k]; }
    best.lower = edge_edge_along(y, n, size); /* between the mid-points: settles most far pairs */
    v3_copy(best.n, n);
    if (best.lower > enough) { return best; }
    v3_sub(da, &x[3], x);
    v3_sub(db, &x[9], &x[6]);
    bool settled = separate_by_common_normal(&best, y, da, db, size);
    if (!(settled && best.tight) && !(best.lower > enough)) { separate_by_ends(&best, x, y, da, db, size); }
    return best;
}

/* --- by kind --- */

cipc_separation cipc_separate(cipc_pair_kind kind, const double *x, double enough)
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_separate_point_point(x, enough);
    case CIPC_POINT_EDGE: return cipc_separate_point_edge(x, enough);
    case CIPC_POINT_TRIANGLE: return cipc_separate_point_triangle(x, enough);
    default: return cipc_separate_edge_edge(x, enough);
    }
}

double cipc_separation_along(cipc_pair_kind kind, const double *x, const double n[3])
{
    double y[3][3], size = relative_to_first(y, x, cipc_pair_nodes(kind) - 1);
    switch (kind) {
    case CIPC_POINT_POINT: return point_point_along(y[0], n, size);
    case CIPC_POINT_EDGE: return point_edge_along(y, n, size);
    case CIPC_POINT_TRIANGLE: return point_triangle_along(y, n, size);
    default: return edge_edge_along(y, n, size);
    }
}

/* --- edge-triangle: y = t0, t1, t2, e1 relative to e0. --- */

/* The larger of the lower bounds along n and -n. */
static inline double edge_triangle_along(const double y[4][3], const double n[3], double size)
{
    double t0 = v3_dot(n, y[0]), t1 = v3_dot(n, y[1]), t2 = v3_dot(n, y[2]), e = v3_dot(n, y[3]);
    double edge_low = e < 0 ? e : 0.0, edge_high = e < 0 ? 0.0 : e;
    double triangle_low = least3(t0, t1, t2), triangle_high = -least3(-t0, -t1, -t2);
    bool triangle_above = triangle_low - edge_high > edge_low - triangle_high;
    return triangle_above ? certified(triangle_low, edge_high, n, size) : certified(edge_low, triangle_high, n, size);
}

/* The nodes of both relative to e0, the sides and the normal of the triangle. */
typedef struct edge_triangle {
    double y[4][3]; /* t0, t1, t2, e1 */
    double side[3][3], normal[3];
    double size;
} edge_triangle;

static inline void set_nodes(edge_triangle *p, const double edge[6], const double triangle[9])
{
    for (int i = 0; i < 3; i++) { v3_sub(p->y[i], &triangle[3 * i], edge); }
    v3_sub(p->y[3], &edge[3], edge);
    p->size = largest(largest(0, p->y[0]), p->y[1]);
    p->size = largest(largest(p->size, p->y[2]), p->y[3]);
}

static inline void set_sides(edge_triangle *p, const double triangle[9])
{
    for (int i = 0; i < 3; i++) { v3_sub(p->side[i], &triangle[3 * ((i + 1) % 3)], &triangle[3 * i]); }
    v3_cross(p->normal, p->side[0], p->side[1]);
}

static bool is_apart_along(const edge_triangle *p, const double n[3], double distance)
{
    return edge_triangle_along(p->y, n, p->size) > distance;
}

/* Along the triangle's normal, or in its plane perpendicular to a side. */
static bool is_apart_by_triangle(const edge_triangle *p, double distance)
{
    double n[3];
    bool apart = is_apart_along(p, p->normal, distance);
    for (int i = 0; i < 3 && !apart; i++) {
        v3_cross(n, p->normal, p->side[i]);
        apart = is_apart_along(p, n, distance);
    }
    return apart;
}

/* The other faces of the Minkowski difference triangle - edge: spanned by the edge and a side; and, in place of these when all lie
 * (nearly) in one plane, perpendicular to the edge in that plane. */
static bool is_apart_by_edge(const edge_triangle *p, double distance)
{
    double n[3];
    v3_cross(n, p->normal, p->y[3]);
    bool apart = is_apart_along(p, n, distance);
    for (int i = 0; i < 3 && !apart; i++) {
        v3_cross(n, p->y[3], p->side[i]);
        apart = is_apart_along(p, n, distance);
    }
    return apart;
}

bool cipc_edge_triangle_apart(const double edge[6], const double triangle[9])
{
    edge_triangle p;
    set_nodes(&p, edge, triangle);
    set_sides(&p, triangle);
    return is_apart_by_triangle(&p, 0) || is_apart_by_edge(&p, 0);
}

bool cipc_edge_triangle_far(const double edge[6], const double triangle[9], double distance)
{
    edge_triangle p;
    double n[3];
    set_nodes(&p, edge, triangle);
    for (int k = 0; k < 3; k++) {
        /* Six times the vector from the middle of the edge to the centroid of the triangle. */
        n[k] = 2 * (p.y[0][k] + p.y[1][k] + p.y[2][k]) - 3 * p.y[3][k];
    }
    if (is_apart_along(&p, n, distance)) { return true; }
    set_sides(&p, triangle);
    return is_apart_by_triangle(&p, distance);
}
