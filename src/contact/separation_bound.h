/* Certified lower bounds of the gap of a moving stencil at one time: in doubles, and in MPFR where doubles do not suffice (docs/theory/certified_ccd.md). */
#ifndef CIPC_CONTACT_SEPARATION_BOUND_H
#define CIPC_CONTACT_SEPARATION_BOUND_H

#include "cipc/contact.h"

/* A path in local coordinates: y_i = x_i - x_0 and q_i = p_i - common, each rounded once (the displacements of a to_end path twice). */
typedef struct contact_local_path {
    cipc_pair_kind kind;
    int nodes, first; /* of the stencil; of its first primitive */
    double y[12], q[12];
    double size;  /* S of eq. (2): largest coordinates of y, q and, to_end, of the displacements, added up */
    double speed;     /* (7) speed * 2^speed_unit >= l_p, the relative speed of the two primitives at most, rounded up; 0: none */
    int speed_unit;   /* 0 unless l_p is far out in the range of doubles */
} contact_local_path;

/* False if a number of the path is not finite. */
bool contact_local_path_init(contact_local_path *local, const cipc_stencil_path *path);

/* What is known of the gap at a time: lower <= d - xi, certified (-INFINITY: nothing); estimate: d - xi as computed, not certified. */
typedef struct contact_gap_bound {
    double lower, estimate;
    double n[3]; /* the direction that gave the bound, from the second primitive to the first */
} contact_gap_bound;

/* Bound along the normal of the closest feature at time t, in doubles. */
contact_gap_bound contact_gap_at(const contact_local_path *local, double xi, double t);
/* Bound along a given direction at time t. */
double contact_gap_along(const contact_local_path *local, const double n[3], double xi, double t);

/* About the last time after t at which the gap along n is still `wanted`: not certified. INFINITY: it never falls below. */
double contact_time_along(const contact_local_path *local, const double n[3], double xi, double t, double wanted);

/* Is it certain that d <= xi at t = 0? False may mean either. */
bool contact_surely_close(const contact_local_path *local, double xi);

/* The same as contact_gap_at in MPFR, at a precision that makes the bound tight. CLEAR: 0 < *lower <= d - xi, and *lower is at least half of it. CLOSE: d <= xi. UNKNOWN: not
 * decided: the gap is out of the range of doubles. */
typedef enum contact_decision { CONTACT_CLEAR, CONTACT_CLOSE, CONTACT_UNKNOWN } contact_decision;
contact_decision contact_gap_mpfr(const cipc_stencil_path *path, double xi, double t, double *lower, int *precision);

#endif
