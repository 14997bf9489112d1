/* Small symmetric eigenproblems: residual, orthogonality, eigenvalues against LAPACK's. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "implicit/symmetric_eigen.h"
#include "support/exact_geometry.h"

enum { N = CIPC_EIGEN_MAX };

/* Householder's reduction commits a backward error below 10 n^1.5 u |A|_F (each of n - 2 reflections a few n u), QL with some 2n sweeps of
 * at most n rotations, each 6 u, less than 12 n^1.5 u |A|_F in practice and 24 n^2 in the worst case (Wilkinson). 40 n^2 u covers both; for
 * n = 12: 2^-40. */
static double tolerance(int n, double size)
{
    return 40.0 * n * n * UNIT_ROUNDOFF * size;
}

static double frobenius(int n, const double *A)
{
    double scale = 0, sum = 0;
    for (int i = 0; i < n * n; i++) scale = fmax(scale, fabs(A[i]));
    if (scale == 0) return 0;
    for (int i = 0; i < n * n; i++) sum += A[i] / scale * (A[i] / scale);
    return scale * sqrt(sum);
}

static int ascending(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Is (w, V) the decomposition of A: rows of V orthonormal, A V_k = w_k V_k, and the w those of LAPACK? */
static bool is_decomposition(int n, const double *A, const double *w, const double *V)
{
    double limit = tolerance(n, frobenius(n, A)), copy[N * N], reference[N], sorted[N];
    for (int k = 0; k < n; k++)
        for (int i = 0; i < n; i++) {
            double residual = -w[k] * V[k * n + i], product = i < n && k <= i ? (k == i ? -1 : 0) : 0;
            for (int j = 0; j < n; j++) residual += A[i * n + j] * V[k * n + j];
            for (int j = 0; k <= i && j < n; j++) product += V[k * n + j] * V[i * n + j];
            if (!(fabs(residual) <= limit) || !(fabs(product) <= tolerance(n, 1))) return false;
        }
    memcpy(copy, A, (size_t)(n * n) * sizeof *A);
    memcpy(sorted, w, (size_t)n * sizeof *w);
    assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', n, copy, n, reference), 0);
    qsort(sorted, (size_t)n, sizeof *sorted, ascending);
    for (int k = 0; k < n; k++)
        if (!(fabs(sorted[k] - reference[k]) <= limit)) return false;
    return true;
}

static void assert_decomposes(int n, const double *A)
{
    double w[N], V[N * N];
    assert_int_equal(cipc_symmetric_eigen(n, A, w, V), 0);
    if (!is_decomposition(n, A, w, V)) fail_msg("n = %d, |A| = %g: wrong decomposition", n, frobenius(n, A));
}

static void draw_symmetric(uint64_t *seed, int n, double *A)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) A[i * n + j] = A[j * n + i] = random_uniform(seed, -1, 1);
}

static void test_random(void **state)
{
    (void)state;
    uint64_t seed = 11;
    double A[N * N];
    for (int n = 1; n <= N; n++)
        for (int trial = 0; trial < 500; trial++) {
            draw_symmetric(&seed, n, A);
            assert_decomposes(n, A);
        }
}

/* Low rank, repeated, zero and clustered eigenvalues; matrices that are diagonal, tridiagonal or graded already. */
static void test_special(void **state)
{
    (void)state;
    uint64_t seed = 12;
    double A[N * N], v[N];
    for (int n = 1; n <= N; n++) {
        memset(A, 0, sizeof A);
        assert_decomposes(n, A); /* zero */
        for (int i = 0; i < n; i++) A[i * n + i] = i % 3 - 1;
        assert_decomposes(n, A); /* diagonal, repeated */
        for (int i = 0; i + 1 < n; i++) A[i * n + i + 1] = A[(i + 1) * n + i] = 1;
        assert_decomposes(n, A); /* tridiagonal */
        for (int trial = 0; trial < 100; trial++) {
            random_fill(&seed, v, n, 1);
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) A[i * n + j] = v[i] * v[j] + (i == j ? 1e-9 * trial : 0);
            assert_decomposes(n, A); /* rank one, and a cluster */
            draw_symmetric(&seed, n, A);
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) A[i * n + j] *= pow(10, -(double)(i + j)); /* graded either way */
            assert_decomposes(n, A);
            for (int i = 0; i < n * n / 2; i++) {
                double swap = A[i];
                A[i] = A[n * n - 1 - i];
                A[n * n - 1 - i] = swap;
            }
            assert_decomposes(n, A);
        }
    }
}

/* Any scale whose squares neither overflow nor underflow; and where they underflow, a failure, or an error as small as the matrix. */
static void test_scales(void **state)
{
    (void)state;
    uint64_t seed = 13;
    double A[N * N], w[N], V[N * N];
    static const double scales[] = {1e-140, 1e-30, 1e30, 1e140};
    for (size_t k = 0; k < sizeof scales / sizeof *scales; k++)
        for (int n = 1; n <= N; n++) {
            draw_symmetric(&seed, n, A);
            for (int i = 0; i < n * n; i++) A[i] *= scales[k];
            assert_decomposes(n, A);
        }
    for (int n = 2; n <= N; n++) {
        memset(A, 0, sizeof A);
        for (int i = 0; i + 1 < n; i++) A[i * n + i + 1] = A[(i + 1) * n + i] = 1e-165;
        int failed = cipc_symmetric_eigen(n, A, w, V);
        assert_true(failed == 0 || failed == -1);
        for (int i = 0; i < n; i++) assert_true(failed || fabs(w[i]) <= 1e-160);
    }
}

/* Only the lower triangle counts. */
static void test_upper_triangle_is_not_read(void **state)
{
    (void)state;
    uint64_t seed = 14;
    for (int n = 2; n <= N; n++) {
        double A[N * N], B[N * N], w[2][N], V[2][N * N];
        draw_symmetric(&seed, n, A);
        memcpy(B, A, sizeof A);
        for (int i = 0; i < n; i++)
            for (int j = i + 1; j < n; j++) B[i * n + j] = NAN;
        assert_int_equal(cipc_symmetric_eigen(n, A, w[0], V[0]), 0);
        assert_int_equal(cipc_symmetric_eigen(n, B, w[1], V[1]), 0);
        assert_memory_equal(w[0], w[1], (size_t)n * sizeof(double));
        assert_memory_equal(V[0], V[1], (size_t)(n * n) * sizeof(double));
    }
}

/* Not finite: -1, wherever the entry is. */
static void test_not_finite(void **state)
{
    (void)state;
    uint64_t seed = 15;
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int n = 1; n <= N; n++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j <= i; j++)
                for (int b = 0; b < 3; b++) {
                    double A[N * N], w[N], V[N * N];
                    draw_symmetric(&seed, n, A);
                    A[i * n + j] = A[j * n + i] = bad[b];
                    assert_int_equal(cipc_symmetric_eigen(n, A, w, V), -1);
                }
}

/* The check itself must notice a wrong value, a wrong vector and a lost orthogonality. */
static void test_check_rejects(void **state)
{
    (void)state;
    uint64_t seed = 16;
    for (int n = 2; n <= N; n++) {
        double A[N * N], w[N], V[N * N], bad[N * N];
        draw_symmetric(&seed, n, A);
        assert_int_equal(cipc_symmetric_eigen(n, A, w, V), 0);
        assert_true(is_decomposition(n, A, w, V));
        w[n - 1] += 1e-9;
        assert_false(is_decomposition(n, A, w, V));
        w[n - 1] -= 1e-9;
        memcpy(bad, V, sizeof V);
        bad[1] += 1e-9;
        assert_false(is_decomposition(n, A, w, bad));
        memcpy(bad, V, sizeof V);
        memcpy(bad, bad + n, (size_t)n * sizeof *bad);
        assert_false(is_decomposition(n, A, w, bad));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random),     cmocka_unit_test(test_special),
        cmocka_unit_test(test_scales),     cmocka_unit_test(test_upper_triangle_is_not_read),
        cmocka_unit_test(test_not_finite), cmocka_unit_test(test_check_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
