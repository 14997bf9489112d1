/* Certified lower bounds of distances: the filter of the monitors M1, M2 and M5 (docs/monitors.md, "The separation bound"). */
#ifndef CIPC_INVARIANT_SEPARATION_H
#define CIPC_INVARIANT_SEPARATION_H

#include <stdbool.h>

#include "cipc/base.h"

/* lower <= true distance, proven against rounding; may be negative or -INFINITY when nothing could be proven. upper is about the true
 * distance or above it, not proven; tight: upper - lower is small, so that lower may be reported as the distance. */
typedef struct cipc_separation {
    double lower, upper;
    bool tight;
    double n[3]; /* the direction that gave lower, from the second primitive to the first */
} cipc_separation;

/* Points p and q; point p against edge e0, e1 or triangle t0, t1, t2; edge a0, a1 against edge b0, b1. Any doubles, degenerate primitives
 * too. The search stops early once lower > enough (then upper and tight mean nothing); enough = INFINITY: look for the best. */
cipc_separation cipc_separate_point_point(const double x[6], double enough);
cipc_separation cipc_separate_point_edge(const double x[9], double enough);
cipc_separation cipc_separate_point_triangle(const double x[12], double enough);
cipc_separation cipc_separate_edge_edge(const double x[12], double enough);
/* The same by kind. */
cipc_separation cipc_separate(cipc_pair_kind kind, const double *x, double enough);

/* Certified lower bound of the distance along a given direction. */
double cipc_separation_along(cipc_pair_kind kind, const double *x, const double n[3]);

/* Is it proven that edge and triangle have no point in common? A disjoint pair is recognised unless rounding prevents it. */
bool cipc_edge_triangle_apart(const double edge[6], const double triangle[9]);
/* Is it proven that they are further apart than `distance` >= 0? A quick look along few directions; many pairs at larger distance are not
 * recognised. */
bool cipc_edge_triangle_far(const double edge[6], const double triangle[9], double distance);

#endif
