/* Projection of an element Hessian to the nearest positive semi-definite matrix in the Frobenius norm. */
#ifndef CIPC_IMPLICIT_PSD_PROJECTION_H
#define CIPC_IMPLICIT_PSD_PROJECTION_H

#include <stdbool.h>

/* H[n*n] symmetric, n = 3 * nodes, nodes 1..4, in place: negative eigenvalues become zero; unchanged (to the bit) if a Cholesky test shows that it
 * is positive semi-definite. translation_invariant: H (1,1,..)^T = 0 for each coordinate, as the energy is; the problem is then solved on the
 * complement of the translations, which is smaller by 3 and gives the same matrix. Returns false if H is not finite. */
bool cipc_psd_project(int nodes, double *H, bool translation_invariant);

/* The plain form: no shortcut. The tests hold the other against it. */
bool cipc_psd_project_plain(int n, double *H);

#endif
