/* Is a matrix the nearest positive semi-definite one to another? */
#ifndef CIPC_VERIFY_PROJECTION_CHECK_H
#define CIPC_VERIFY_PROJECTION_CHECK_H

/* How far P[n*n] is from being the projection of the symmetric H[n*n], n <= 12, to the nearest positive semi-definite matrix in the Frobenius norm, over the
 * tolerance (7) of docs/theory/tolerances.md. INFINITY: not finite, not symmetric, or no eigenvalues found. */
double verify_projection_error(int n, const double *H, const double *P);

#endif
