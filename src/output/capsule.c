/* Where a line enters a capsule: through its side, if that is between the ends, or through the ball at the end that it passes. */
#include "output/capsule.h"

#include <math.h>
#include "base/vector.h"

/* A line whose squared sine with the axis is below this counts as parallel: it enters through an end. */
static const double parallel_sine2 = 1e-14;

/* The smaller root of |m + t d| = radius; *normal = (m + t d) / radius. */
static bool enter_circle(const double m[3], const double d[3], double radius, double *t, double normal[3])
{
    const double dd = v3_dot(d, d), md = v3_dot(m, d), inside = md * md - dd * (v3_dot(m, m) - radius * radius);
    if (!(inside >= 0) || !(dd > 0)) {
        return false;
    }
    *t = (-md - sqrt(inside)) / dd;
    v3_copy(normal, m);
    v3_axpy(normal, *t, d);
    v3_scale(normal, 1 / radius, normal);
    return true;
}

/* v without its part along the axis; `along` is that part in lengths of the axis. */
static double split(const double v[3], const double axis[3], double across[3])
{
    const double along = v3_dot(v, axis) / v3_dot(axis, axis);
    v3_copy(across, v);
    v3_axpy(across, -along, axis);
    return along;
}

bool cipc_capsule_enter(const cipc_capsule *capsule, const double origin[3], const double direction[3], double *t, double normal[3])
{
    double axis[3], from_a[3], from_b[3], m[3], d[3];
    v3_sub(axis, capsule->b, capsule->a);
    v3_sub(from_a, origin, capsule->a);
    v3_sub(from_b, origin, capsule->b);
    if (!(v3_dot(axis, axis) > 0)) {
        return enter_circle(from_a, direction, capsule->radius, t, normal);
    }
    const double start = split(from_a, axis, m), speed = split(direction, axis, d);
    double place = speed > 0 ? -INFINITY : INFINITY; /* where along the axis the line enters the endless cylinder */
    if (v3_dot(d, d) > parallel_sine2 * v3_dot(direction, direction)) {
        if (!enter_circle(m, d, capsule->radius, t, normal)) {
            return false;
        }
        place = start + *t * speed;
    }
    if (place >= 0 && place <= 1) {
        return true;
    }
    return enter_circle(place < 0 ? from_a : from_b, direction, capsule->radius, t, normal);
}
