/* The conditions of the nearest positive semi-definite matrix P to H: P >= 0, P - H >= 0, <P, P - H> = 0. They are necessary and sufficient, because the
 * positive semi-definite matrices are a self-dual convex cone; so no second projection is needed to judge one. If H >= 0 they say P = H. */
#include "verify/projection_check.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "verify/condition.h"

enum { MOST = 12 };
/* (7): n u |H| each for the solver's eigenvectors, for LAPACK's eigenvalues, for the sum of n products that P is, and for |H| itself; twice that. */
static const double PROJECTION_ROUNDINGS = 8;

/* Least eigenvalue by LAPACK, which the solver does not use for this; NAN if it finds none. */
static double least_eigenvalue(int n, const double *A)
{
    double copy[MOST * MOST], w[MOST];
    memcpy(copy, A, (size_t)(n * n) * sizeof *A);
    return LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', n, copy, n, w) == 0 ? w[0] : NAN;
}

static double frobenius(int n, const double *A)
{
    double most = verify_largest(A, n * n), sum = 0;
    if (most == 0) return 0;
    for (int i = 0; i < n * n; i++) sum += A[i] / most * (A[i] / most);
    return most * sqrt(sum);
}

double verify_projection_error(int n, const double *H, const double *P)
{
    double size = frobenius(n, H), p[MOST * MOST], difference[MOST * MOST], inner = 0;
    if (!isfinite(size) || !isfinite(verify_largest_error(P, H, n * n))) return INFINITY;
    if (size == 0) return verify_largest(P, n * n) == 0 ? 0 : INFINITY;
    for (int i = 0; i < n * n; i++) {
        p[i] = P[i] / size;
        difference[i] = p[i] - H[i] / size;
        inner += p[i] * difference[i];
    }
    double asymmetry = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) asymmetry = fmax(asymmetry, fabs(p[i * n + j] - p[j * n + i]));
    double least = fmin(least_eigenvalue(n, p), least_eigenvalue(n, difference));
    if (isnan(least)) return INFINITY;
    return fmax(fmax(-least, fabs(inner)), asymmetry) / (PROJECTION_ROUNDINGS * n * VERIFY_UNIT);
}
