/* Nearest positive semi-definite matrix: V max(w, 0) V^T (docs/theory/assembly.md, eq. 1). */
#include "implicit/psd_projection.h"

#include <math.h>
#include <string.h>

#include "implicit/symmetric_eigen.h"

#define INLINE static inline __attribute__((always_inline))
#define R2 0.70710678118654752440
#define R6 0.40824829046386301637

/* Is A (m x m) + 0 positive definite? In-place Cholesky on a copy; a pivot that is not clearly positive says no. */
INLINE bool cholesky_succeeds(int m, const double *A)
{
    double L[CIPC_EIGEN_MAX][CIPC_EIGEN_MAX];
    for (int i = 0; i < m; i++)
        for (int j = 0; j <= i; j++) {
            double sum = A[i * m + j];
            for (int k = 0; k < j; k++) sum -= L[i][k] * L[j][k];
            if (i > j) L[i][j] = sum * L[j][j];
            else if (sum > 0) L[i][i] = 1 / sqrt(sum); /* the reciprocal: one division a row */
            else return false;
        }
    return true;
}

/* S := sum over positive eigenvalues of w v v^T, or over the negative ones of -w v v^T added to S: whichever are fewer. */
INLINE bool clamp(int m, double *S)
{
    double w[CIPC_EIGEN_MAX], V[CIPC_EIGEN_MAX * CIPC_EIGEN_MAX];
    if (cipc_symmetric_eigen(m, S, w, V)) return false;
    int positive = 0;
    for (int k = 0; k < m; k++) positive += w[k] > 0;
    bool rebuild = 2 * positive <= m;
    if (rebuild) memset(S, 0, (size_t)(m * m) * sizeof *S);
    for (int k = 0; k < m; k++) {
        if ((w[k] > 0) != rebuild) continue;
        for (int i = 0; i < m; i++) {
            double s = fabs(w[k]) * V[k * m + i];
            for (int j = 0; j < m; j++) S[i * m + j] += s * V[k * m + j];
        }
    }
    return true;
}

/* Differences of nodes that span the complement of (1, .., 1) orthonormally: z (nodes - 1 of them, `stride` apart) from y (nodes of them). The columns are
 * (1,-1)/sqrt 2;  (1,-1,0)/sqrt 2, (1,1,-2)/sqrt 6;  and for four nodes the other three rows of Hadamard's matrix by 1/2. */
INLINE void to_differences(int nodes, int stride, const double *y, double *z)
{
    double a = y[0], b = y[stride];
    if (nodes == 2) {
        z[0] = R2 * (a - b);
    } else if (nodes == 3) {
        z[0] = R2 * (a - b);
        z[stride] = R6 * (a + b - 2 * y[2 * stride]);
    } else {
        double c = y[2 * stride], d = y[3 * stride];
        z[0] = 0.5 * ((a + b) - (c + d));
        z[stride] = 0.5 * ((a - b) + (c - d));
        z[2 * stride] = 0.5 * ((a - b) - (c - d));
    }
}

INLINE void from_differences(int nodes, int stride, const double *z, double *y)
{
    double p = z[0];
    if (nodes == 2) {
        y[0] = R2 * p;
        y[stride] = -R2 * p;
    } else if (nodes == 3) {
        double q = R6 * z[stride];
        y[0] = R2 * p + q;
        y[stride] = q - R2 * p;
        y[2 * stride] = -2 * q;
    } else {
        double q = z[stride], r = z[2 * stride];
        y[0] = 0.5 * (p + (q + r));
        y[stride] = 0.5 * (p - (q + r));
        y[2 * stride] = 0.5 * ((q - r) - p);
        y[3 * stride] = 0.5 * ((r - q) - p);
    }
}

/* H[n*n] on nodes -> S[m*m] on differences, m = n - 3, and back: rows first, then columns; node i's coordinate r is entry 3i + r. */
INLINE void reduce(int nodes, const double *H, double *S)
{
    int n = 3 * nodes, m = n - 3;
    double half[CIPC_EIGEN_MAX * CIPC_EIGEN_MAX];
    for (int r = 0; r < 3; r++)
        for (int j = 0; j < n; j++) to_differences(nodes, 3 * n, H + r * n + j, half + r * n + j);
    for (int i = 0; i < m; i++)
        for (int r = 0; r < 3; r++) to_differences(nodes, 3, half + i * n + r, S + i * m + r);
}

INLINE void expand(int nodes, const double *S, double *H)
{
    int n = 3 * nodes, m = n - 3;
    double half[CIPC_EIGEN_MAX * CIPC_EIGEN_MAX];
    for (int i = 0; i < m; i++)
        for (int r = 0; r < 3; r++) from_differences(nodes, 3, S + i * m + r, half + i * n + r);
    for (int r = 0; r < 3; r++)
        for (int j = 0; j < n; j++) from_differences(nodes, 3 * n, half + r * n + j, H + r * n + j);
}

INLINE bool project_invariant(int nodes, double *H)
{
    double S[CIPC_EIGEN_MAX * CIPC_EIGEN_MAX];
    reduce(nodes, H, S);
    if (cholesky_succeeds(3 * nodes - 3, S)) return true;
    if (!clamp(3 * nodes - 3, S)) return false;
    expand(nodes, S, H);
    return true;
}

bool cipc_psd_project_plain(int n, double *H) { return clamp(n, H); }

bool cipc_psd_project(int nodes, double *H, bool translation_invariant)
{
    int n = 3 * nodes;
    if (!translation_invariant || nodes == 1) return cholesky_succeeds(n, H) || clamp(n, H);
    if (nodes == 2) return project_invariant(2, H);
    return nodes == 3 ? project_invariant(3, H) : project_invariant(4, H);
}
