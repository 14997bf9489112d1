/* Eigen-decomposition of small dense symmetric matrices. */
#ifndef CIPC_IMPLICIT_SYMMETRIC_EIGEN_H
#define CIPC_IMPLICIT_SYMMETRIC_EIGEN_H

enum { CIPC_EIGEN_MAX = 12 };

/* A = V^T diag(w) V for symmetric A[n*n] (row-major, only the lower triangle is read), 1 <= n <= CIPC_EIGEN_MAX. w in no particular order;
 * row k of V (V[k*n+i]) is the unit eigenvector of w[k]. Householder tridiagonalisation, then implicit QL: backward stable, |A - V w V^T| <= c(n) u |A|.
 * Entries other than 0 must be of a size whose squares neither overflow nor underflow, 1e-150 .. 1e150, or negligible against those that are.
 * Returns 0, or -1 for input that is not finite (and possibly for such tiny input). Why not LAPACK: see docs/theory/assembly.md. */
int cipc_symmetric_eigen(int n, const double *A, double *w, double *V);

#endif
