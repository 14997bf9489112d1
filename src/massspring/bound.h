/* The bound on deformation as the integrator keeps it: the sweeps of cipc_deformation_project, bit for bit, but of the springs alone whose ends have moved; and between sweeps somebody else may
 * move nodes as well (bodies do), so that both get what they ask for (docs/theory/massspring_springs.md, "Deformation"). */
#ifndef MASSSPRING_BOUND_H
#define MASSSPRING_BOUND_H

#include "cipc/massspring.h"

typedef struct massspring_bound massspring_bound;

/* What is swept. Everything belongs to the caller. */
typedef struct massspring_sheet {
    const cipc_spring *springs;
    const int (*ends)[2];
    int count, node_count;
    const double *inverse_mass;    /* 0: held, not touched */
    double dt;                     /* s: velocities change by displacement / dt */
    double *x, *v;
} massspring_sheet;

/* Moves a node that sweeps have moved, if it has to. Returns whether it did. */
typedef bool massspring_after_sweep(void *context, int node, double x[3], double v[3]);

/* Lists the springs of every node. NULL: no memory. */
massspring_bound *massspring_bound_create(const int (*ends)[2], int count, int node_count);
void massspring_bound_destroy(massspring_bound *bound);
/* Sweeps until all springs are within greatest (1 + tolerance) after `after` (may be NULL) has moved what it wanted, at most `sweeps`. Returns how many sweeps; 0: there was nothing to do,
 * and `after` was not called. When sweeps are used up, `after` has had the last word. *kept: whether all springs are within it now. */
int massspring_bound_sweep(massspring_bound *bound, const massspring_sheet *sheet, double greatest, double tolerance, int sweeps, massspring_after_sweep *after, void *context, bool *kept);

#endif
