/* How sensitive a function's derivatives are to the rounding of its nodes, measured on the oracle (docs/theory/tolerances.md). */
#ifndef CIPC_VERIFY_CONDITION_H
#define CIPC_VERIFY_CONDITION_H

#include "cipc/oracle.h"

/* Unit roundoff of double. */
#define VERIFY_UNIT 0x1p-53
/* Tolerances are these many roundings of a case's own condition, (1)-(3) of docs/theory/tolerances.md; and of the stencil's size, (4), in units of 2 u. */
#define VERIFY_ROUNDINGS 16
#define VERIFY_DISTANCE_ULPS 4

/* Largest absolute entry, and largest absolute difference (INFINITY if something computed is not finite). */
double verify_largest(const double *v, int n);
double verify_largest_error(const double *got, const double *want, int n);
/* error / tolerance; 0 if there is no error. */
double verify_over(double error, double tolerance);

/* |dH| S: how much the largest-changing entry of the Hessian H at x changes when all coordinates shift by a small fraction of the stencil's size, over that
 * fraction; the most of three patterns of shifts: along the gradient g, and two of random signs. The fraction is made smaller until the change is small
 * against H, that is, proportional to it; INFINITY: it never was, a rounding of the nodes changes everything. */
double verify_hessian_change(const cipc_oracle_function *function, const double *x, const double *fields, const double *g, const double *H, double size,
                             unsigned long random);

/* Absolute tolerances (1)-(3) of docs/theory/tolerances.md for value, gradient and Hessian of a function with these derivatives. change: |dH| S of above;
 * the Hessian's is INFINITY if that is. */
typedef struct verify_tolerances {
    double value, gradient, hessian;
} verify_tolerances;
verify_tolerances verify_tolerances_of(double value, const double *g, const double *H, int n, double size, double change);
/* Terms (8), (9) there, for "damping" alone: its Hessian H is a parameter, whose entries are rounded too. */
void verify_add_matrix_rounding(verify_tolerances *tolerances, const cipc_oracle_function *function, const double *x, const double *fields, const double *H);

#endif
