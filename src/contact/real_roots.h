/* Real roots of a polynomial in floating point. */
#ifndef CIPC_CONTACT_REAL_ROOTS_H
#define CIPC_CONTACT_REAL_ROOTS_H

enum { CONTACT_POLYNOMIAL_DEGREE = 6 };

/* The roots in (0, end] of c[0] + c[1] t + ... + c[degree] t^degree at which it changes its sign, ascending, each to the rounding of the polynomial's values; their
 * number. 0 <= degree <= 6. A double root, where the sign stays, counts only if rounding makes it two roots or a value of exactly 0. */
int contact_real_roots(const double *c, int degree, double end, double roots[CONTACT_POLYNOMIAL_DEGREE]);

#endif
