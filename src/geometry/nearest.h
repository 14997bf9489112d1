/* What the classifications of closest features share: the nearest point of a segment, and when a 2 x 2 system can be trusted.
 * docs/theory/distance.md, section 6. */
#ifndef CIPC_GEOMETRY_NEAREST_H
#define CIPC_GEOMETRY_NEAREST_H

#include <float.h>

#include "cipc/geometry.h"
#include "base/vector.h"

/* sin^2 of the angle between two edges above which the 2 x 2 system is solved once and believed: with sin > 1/10 its solution is off
 * by at most about 4 u/sin = 40 u of the stencil's size, and that is also all that the distance can be off by (section 6.2). */
#define NEAREST_WELL_SHAPED 1e-2

/* Squared distance across the line of a segment, |u x e|^2 / |e|^2. */
static inline double line_distance2(const double u[3], const double e[3])
{
    double m[3];
    v3_cross(m, u, e);
    return v3_norm2(m) / v3_norm2(e);
}

/* Where the nearest point of a segment lies. */
typedef enum nearest_place { NEAREST_FIRST_END, NEAREST_SECOND_END, NEAREST_INSIDE } nearest_place;

/* Nearest point of the segment e0 e1 to p, from u = p - e0 and e = e1 - e0. A zero-length segment is its first end. */
static inline nearest_place nearest_on_segment(const double u[3], const double e[3])
{
    double along = v3_dot(u, e), length2 = v3_norm2(e);
    if (along <= 0.0 || length2 < DBL_MIN) return NEAREST_FIRST_END;
    return along < length2 ? NEAREST_INSIDE : NEAREST_SECOND_END;
}

/* The same, with the squared distance to that point. */
static inline nearest_place nearest_on_segment_distance2(const double u[3], const double e[3], double *distance2)
{
    double rest[3];
    nearest_place place = nearest_on_segment(u, e);
    if (place == NEAREST_FIRST_END) {
        *distance2 = v3_norm2(u);
    } else if (place == NEAREST_SECOND_END) {
        v3_sub(rest, u, e);
        *distance2 = v3_norm2(rest);
    } else {
        *distance2 = line_distance2(u, e);
    }
    return place;
}

/* The lower node first, that is, that of the first primitive. */
static inline cipc_feature feature_point_point(int p, int q)
{
    return (cipc_feature){CIPC_POINT_POINT, 2, {p < q ? p : q, p < q ? q : p, 0, 0}};
}

static inline cipc_feature feature_point_edge(int p, int e0, int e1)
{
    return (cipc_feature){CIPC_POINT_EDGE, 3, {p, e0, e1, 0}};
}

/* The feature of node p and the segment of nodes e0, e1. */
static inline cipc_feature feature_of_place(nearest_place place, int p, int e0, int e1)
{
    if (place == NEAREST_INSIDE) return feature_point_edge(p, e0, e1);
    return feature_point_point(p, place == NEAREST_FIRST_END ? e0 : e1);
}

/* Of several candidates the nearest so far. */
typedef struct nearest_feature {
    double distance2;
    cipc_feature feature;
} nearest_feature;

/* Offer the segment of nodes e0, e1 as seen from node p. */
static inline void nearest_offer_segment(nearest_feature *best, const double *x, int p, int e0, int e1)
{
    double u[3], e[3], distance2;
    v3_sub(u, x + 3 * p, x + 3 * e0);
    v3_sub(e, x + 3 * e1, x + 3 * e0);
    nearest_place place = nearest_on_segment_distance2(u, e, &distance2);
    if (distance2 < best->distance2) {
        best->distance2 = distance2;
        best->feature = feature_of_place(place, p, e0, e1);
    }
}

#endif
