/* cipc/oracle.h - the truth, in exact rational arithmetic (GMP). Shares no arithmetic with the code it judges.
 * Floor 3; included only by invariant/, verify/, cli/ and tests. All functions are pure and thread-safe. */
#ifndef CIPC_ORACLE_H
#define CIPC_ORACLE_H

#include <stdbool.h>
#include "cipc/base.h"

/* Exact sign of d^2 - xi^2 for the true distance d of point-triangle (edge_edge false; x = p, t0, t1, t2) or edge-edge (x = a0, a1, b0,
 * b1), m, and the squared distance rounded to nearest (ties to even) in *distance2 (may be NULL), m^2. xi >= 0. Any finite doubles;
 * degenerate primitives are the sets they are. Non-finite input proves nothing: -1, and NaN in *distance2. (SPEC V.2) */
int cipc_exact_compare_distance(bool edge_edge, const double x[12], double xi, double *distance2);

/* The gap d - xi rounded to nearest (ties to even), m; same arguments. Its sign is that of d - xi, unless it underflows to 0.
 * NaN for non-finite input. (SPEC V.2) */
double cipc_exact_gap(bool edge_edge, const double x[12], double xi);

/* Exact sign of s - sigma_1 for the largest principal stretch of a triangle with rest positions X[9] and positions x[9]:
 * s^2 Ibar - I positive definite <=> +1, semi-definite <=> 0, else -1 (Ibar, I: first fundamental forms; all rational). s > 0.
 * Non-finite input proves nothing: -1. (SPEC V.5 M3) */
int cipc_exact_compare_stretch(const double rest[9], const double x[9], double limit);

#endif
