/* Signed distance and outward normal of bodies given by formulas (SPEC B.6; docs/theory/massspring_collision.md, section 1). All of them are convex. */
#include <float.h>

#include "base/vector.h"
#include "cipc/massspring.h"

/* The square of a shorter vector loses digits to underflow: it has no direction that could be told, m. */
static const double least_length = 1e-150;
/* A vector that is less aside of an axis than this part of its length is on the axis: more is not known of it. */
static const double least_slope = 4 * DBL_EPSILON;

/* unit = v / |v|, or `otherwise` if v is too short. Returns |v|. */
static double direction(double unit[3], const double v[3], const double otherwise[3])
{
    const double length = v3_norm(v);
    if (length > least_length) v3_scale(unit, 1 / length, v);
    else v3_copy(unit, otherwise);
    return length;
}

/* r = a component of v across the unit axis. Done twice: of a short r, what the first pass leaves along the axis by rounding may be a large part. */
static void reject(double r[3], const double v[3], const double axis[3])
{
    v3_copy(r, v);
    for (int pass = 0; pass < 2; pass++) v3_axpy(r, -v3_dot(r, axis), axis);
}

/* Some unit vector across the axis: made of the coordinate axis that is least parallel to it. */
static void some_normal(double unit[3], const double axis[3])
{
    double e[3] = {0, 0, 0}, across[3];
    const int xy = fabs(axis[1]) < fabs(axis[0]);
    e[fabs(axis[2]) < fabs(axis[xy]) ? 2 : xy] = 1;
    reject(across, e, axis);
    v3_scale(unit, 1 / v3_norm(across), across);
}

/* Coordinates about an axis: d = along axis + across radial, radial a unit vector across the axis; on the axis any such. */
typedef struct cylindrical {
    double along, across, radial[3];
} cylindrical;

static cylindrical cylindrical_of(const double d[3], const double axis[3])
{
    cylindrical c = {.along = v3_dot(d, axis)};
    double r[3];
    reject(r, d, axis);
    c.across = v3_norm(r);
    if (c.across > max2(least_length, least_slope * v3_norm(d))) v3_scale(c.radial, 1 / c.across, r);
    else some_normal(c.radial, axis);
    return c;
}

static double plane_distance(const cipc_collider *plane, const double x[3], double normal[3])
{
    double d[3];
    v3_sub(d, x, plane->center);
    v3_copy(normal, plane->axis);
    return v3_dot(d, normal);
}

/* (1). At the centre `otherwise` is the normal. */
static double ball_distance(const double center[3], double radius, const double otherwise[3], const double x[3], double normal[3])
{
    double d[3];
    v3_sub(d, x, center);
    return direction(normal, d, otherwise) - radius;
}

/* (2): q[k] tells how far beyond the k-th pair of faces a point is; n: its normal in terms of theirs. Outside, only what is beyond counts, so that nothing cancels near an edge. */
static double corner_distance(const double q[3], double n[3])
{
    const int first = q[1] > q[0], greatest = q[2] > q[first] ? 2 : first;
    double beyond[3], face[3] = {0, 0, 0};
    face[greatest] = 1;
    for (int k = 0; k < 3; k++) beyond[k] = max2(q[k], 0);
    const double outside = direction(n, beyond, face);
    return q[greatest] > 0 ? outside : q[greatest];
}

static double box_distance(const cipc_collider *box, const double x[3], double normal[3])
{
    double d[3], q[3];
    v3_sub(d, x, box->center);
    for (int k = 0; k < 3; k++) q[k] = fabs(d[k]) - box->half[k];
    const double distance = corner_distance(q, normal);
    for (int k = 0; k < 3; k++) normal[k] = copysign(normal[k], d[k]);
    return distance;
}

/* (2) in the half plane of the axis and the point. */
static double disc_distance(const cipc_collider *disc, const double x[3], double normal[3])
{
    double d[3], n[3];
    v3_sub(d, x, disc->center);
    const cylindrical c = cylindrical_of(d, disc->axis);
    const double distance = corner_distance((double[3]){c.across - disc->half[0], fabs(c.along) - disc->half[1], -INFINITY}, n);
    v3_scale(normal, n[0], c.radial);
    v3_axpy(normal, copysign(n[1], c.along), disc->axis);
    return distance;
}

/* (3), (4). Where the two balls meet the cone their distances agree, so it does not matter which side rounding takes a point for. */
static double capsule_distance(const cipc_collider *capsule, const double x[3], double normal[3])
{
    const double *p = capsule->center, *q = capsule->axis, a = capsule->half[0], b = capsule->half[1], anywhere[3] = {1, 0, 0};
    double e[3], axis[3], d[3], cone[3];
    v3_sub(e, q, p);
    const double length = direction(axis, e, anywhere);
    if (!(length > max2(fabs(a - b), least_length))) return ball_distance(a < b ? q : p, max2(a, b), anywhere, x, normal); /* one ball is in the other */
    v3_sub(d, x, p);
    const cylindrical c = cylindrical_of(d, axis);
    const double sine = (a - b) / length, cosine = sqrt((length - (a - b)) * (length + (a - b))) / length, foot = c.along * cosine - c.across * sine;
    v3_scale(cone, cosine, c.radial);
    v3_axpy(cone, sine, axis);
    if (foot < 0) return ball_distance(p, a, cone, x, normal);
    if (foot > length * cosine) return ball_distance(q, b, cone, x, normal);
    v3_copy(normal, cone);
    return sine * c.along + cosine * c.across - a;
}

double cipc_collider_distance(const cipc_collider *collider, const double x[3], double normal[3])
{
    double unused[3];
    double *n = normal ? normal : unused;
    switch (collider->kind) {
    case CIPC_COLLIDER_PLANE: return plane_distance(collider, x, n);
    case CIPC_COLLIDER_SPHERE: return ball_distance(collider->center, collider->half[0], (double[3]){1, 0, 0}, x, n);
    case CIPC_COLLIDER_BOX: return box_distance(collider, x, n);
    case CIPC_COLLIDER_DISC: return disc_distance(collider, x, n);
    case CIPC_COLLIDER_CAPSULE: return capsule_distance(collider, x, n);
    }
    return NAN; /* not reached: all kinds are above */
}
