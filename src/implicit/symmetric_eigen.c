/* Small symmetric eigenproblems: Householder tridiagonalisation and implicit QL with Wilkinson's shift (Golub and Van Loan, chapter 8). */
#include "implicit/symmetric_eigen.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* QL needs two or three sweeps an eigenvalue; 50 mean that the input was not finite or that its squares underflow. */
enum { MAX_SWEEPS = 50 };

/* Matrices are stored with rows of CIPC_EIGEN_MAX. The functions are inlined into one body for each size that assembly needs, so that their loops have
 * constant bounds. */
typedef double matrix[CIPC_EIGEN_MAX][CIPC_EIGEN_MAX];
#define INLINE static inline __attribute__((always_inline))

/* Reflect T := P T P and R := P R (R holds V transposed) with P = 1 - beta v v^T that maps column k below the subdiagonal to a multiple of e_{k+1}. */
INLINE void eliminate_column(int n, int k, matrix T, matrix R)
{
    double v[CIPC_EIGEN_MAX], q[CIPC_EIGEN_MAX], below = 0;
    for (int i = k + 2; i < n; i++) below += T[i][k] * T[i][k];
    if (below == 0) return;
    double head = T[k + 1][k], norm = sqrt(head * head + below), alpha = head > 0 ? -norm : norm;
    v[k + 1] = head - alpha;
    for (int i = k + 2; i < n; i++) v[i] = T[i][k];
    double beta = 2 / (v[k + 1] * v[k + 1] + below), along = 0;
    for (int i = k + 1; i < n; i++) q[i] = 0;
    for (int j = k + 1; j < n; j++)
        for (int i = k + 1; i < n; i++) q[i] += T[j][i] * v[j]; /* T is symmetric: by rows, along memory */
    for (int i = k + 1; i < n; i++) {
        q[i] *= beta;
        along += q[i] * v[i];
    }
    for (int i = k + 1; i < n; i++) q[i] -= 0.5 * beta * along * v[i];
    for (int i = k + 1; i < n; i++)
        for (int j = k + 1; j < n; j++) T[i][j] -= v[i] * q[j] + q[i] * v[j];
    T[k + 1][k] = alpha;
    double sum[CIPC_EIGEN_MAX] = {0};
    for (int j = k + 1; j < n; j++)
        for (int i = 0; i < n; i++) sum[i] += v[j] * R[j][i];
    for (int j = k + 1; j < n; j++)
        for (int i = 0; i < n; i++) R[j][i] -= beta * v[j] * sum[i];
}

/* One implicit QL sweep on the unreduced block l..m of the tridiagonal (d, e), e[i] between d[i] and d[i+1]; rotations are applied to the rows of R. */
INLINE void ql_sweep(int n, int l, int m, double *d, double *e, matrix R)
{
    double delta = (d[l + 1] - d[l]) / (2 * e[l]);
    /* an overflow of delta^2 gives the right limit: e / infinity */
    double g = d[m] - d[l] + e[l] / (delta + copysign(sqrt(delta * delta + 1), delta));
    double sine = 1, cosine = 1, carry = 0;
    for (int i = m - 1; i >= l; i--) {
        double f = sine * e[i], b = cosine * e[i], r = sqrt(f * f + g * g);
        e[i + 1] = r;
        if (r == 0) {
            d[i + 1] -= carry;
            e[m] = 0;
            return;
        }
        sine = f / r;
        cosine = g / r;
        g = d[i + 1] - carry;
        double t = (d[i] - g) * sine + 2 * cosine * b;
        carry = sine * t;
        d[i + 1] = g + carry;
        g = cosine * t - b;
        for (int k = 0; k < n; k++) {
            double x = R[i + 1][k], y = R[i][k];
            R[i + 1][k] = sine * y + cosine * x;
            R[i][k] = cosine * y - sine * x;
        }
    }
    d[l] -= carry;
    e[l] = g;
    e[m] = 0;
}

INLINE int ql(int n, double *d, double *e, matrix R)
{
    for (int l = 0; l < n; l++)
        for (int sweep = 0;; sweep++) {
            int m = l;
            while (m < n - 1 && !(fabs(e[m]) <= DBL_EPSILON * (fabs(d[m]) + fabs(d[m + 1])))) m++; /* true of NaN */
            if (m == l) break;
            if (sweep == MAX_SWEEPS) return -1;
            ql_sweep(n, l, m, d, e, R);
        }
    return 0;
}

INLINE int decompose(int n, const double *A, double *w, double *V)
{
    matrix T, R;
    double e[CIPC_EIGEN_MAX] = {0};
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            T[i][j] = i >= j ? A[i * n + j] : A[j * n + i];
            R[i][j] = i == j;
        }
    for (int k = 0; k < n - 2; k++) eliminate_column(n, k, T, R);
    for (int i = 0; i < n; i++) {
        w[i] = T[i][i];
        if (i + 1 < n) e[i] = T[i + 1][i];
    }
    int failed = ql(n, w, e, R);
    for (int k = 0; k < n; k++) {
        if (!isfinite(w[k])) failed = -1;
        for (int i = 0; i < n; i++) V[k * n + i] = R[k][i];
    }
    return failed;
}

int cipc_symmetric_eigen(int n, const double *A, double *w, double *V)
{
    switch (n) {
    case 3: return decompose(3, A, w, V);
    case 5: return decompose(5, A, w, V);
    case 6: return decompose(6, A, w, V);
    case 9: return decompose(9, A, w, V);
    default: return decompose(n, A, w, V);
    }
}
