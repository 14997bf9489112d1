/* The factorisation in two halves: solves, recognises matrices that are not positive definite, keeps its partition while it may. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "implicit/split_factor.h"
#include "support/failing_memory.h"

enum { SIDE = 24, BLOCKS = SIDE * SIDE };

/* Residual of a backward stable solution: |A x - b| <= c u |A| |x|; c = 64 is far above what a few hundred eliminations with ordered fill give and
 * far below what a wrong block, sign or transposition gives (of order 1/u). */
static const double residual_factor = 64 * DBL_EPSILON;

typedef struct pairs {
    int (*list)[2];
    long count;
} pairs;

/* A square grid graph with diagonals, and `extra` couplings of far corners. `apart`: no coupling between the two halves of the columns. */
static pairs grid(int side, int extra, bool apart)
{
    pairs p = {calloc((size_t)(4 * side * side + extra), sizeof *p.list), 0};
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            int to[3][2] = {{i + 1, j}, {i, j + 1}, {i + 1, j + 1}};
            for (int k = 0; k < 3; k++) {
                if (to[k][0] >= side || to[k][1] >= side || (apart && j < side / 2 && to[k][1] >= side / 2)) continue;
                p.list[p.count][0] = i * side + j;
                p.list[p.count++][1] = to[k][0] * side + to[k][1];
            }
        }
    for (int k = 0; k < extra; k++) {
        p.list[p.count][0] = k;
        p.list[p.count++][1] = side * side - 1 - 2 * k;
    }
    return p;
}

/* Random symmetric blocks, diagonally dominant by `margin`: positive definite for a positive one. */
static void fill(cipc_block_matrix *A, unsigned seed, double margin)
{
    double *sums = calloc(3 * (size_t)A->n, sizeof *sums);
    srand(seed);
    for (int c = 0; c < A->n; c++)
        for (int k = A->start[c] + 1; k < A->start[c + 1]; k++)
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    double value = rand() / (double)RAND_MAX - 0.5;
                    A->x[cipc_block_matrix_entry(A, c, k) + j * cipc_block_matrix_stride(A, c) + i] = value;
                    sums[3 * c + j] += fabs(value);
                    sums[3 * A->row[k] + i] += fabs(value);
                }
    for (int c = 0; c < A->n; c++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                A->x[cipc_block_matrix_entry(A, c, A->start[c]) + j * cipc_block_matrix_stride(A, c) + i] = i == j ? sums[3 * c + i] + margin : 0;
    free(sums);
}

static void multiply(const cipc_block_matrix *A, const double *x, double *y)
{
    memset(y, 0, 3 * (size_t)A->n * sizeof *y);
    for (int c = 0; c < A->n; c++)
        for (int k = A->start[c]; k < A->start[c + 1]; k++)
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    double value = A->x[cipc_block_matrix_entry(A, c, k) + j * cipc_block_matrix_stride(A, c) + i];
                    y[3 * A->row[k] + i] += value * x[3 * c + j];
                    if (A->row[k] != c) y[3 * c + j] += value * x[3 * A->row[k] + i];
                }
}

static double largest(const double *values, long count)
{
    double most = 0;
    for (long k = 0; k < count; k++) most = fmax(most, fabs(values[k]));
    return most;
}

/* Does it solve A x = b? */
static bool solves(cipc_split_factor *split, const cipc_block_matrix *A, int threads, double *x)
{
    double b[3 * BLOCKS], Ax[3 * BLOCKS];
    bool definite;
    for (int k = 0; k < 3 * A->n; k++) b[k] = sin(k + 1.0);
    if (cipc_split_factor_factorize(split, A, threads, &definite, NULL) || !definite || cipc_split_factor_solve(split, b, x, threads, NULL)) return false;
    multiply(A, x, Ax);
    for (int k = 0; k < 3 * A->n; k++) Ax[k] -= b[k];
    return largest(Ax, 3 * A->n) <= residual_factor * largest(A->x, 9L * A->start[A->n]) * largest(x, 3 * A->n);
}

static void analyzed(cipc_split_factor *split, cipc_block_matrix *A, pairs p, bool expected)
{
    bool worthwhile;
    assert_int_equal(cipc_block_matrix_create(A, BLOCKS, (const int(*)[2])p.list, p.count, NULL), CIPC_OK);
    assert_int_equal(cipc_split_factor_analyze(split, A, &worthwhile, NULL), CIPC_OK);
    assert_int_equal(worthwhile, expected);
    free(p.list);
}

static void test_solves_and_does_not_depend_on_threads(void **state)
{
    (void)state;
    double x[3][3 * BLOCKS];
    cipc_split_factor *split;
    cipc_block_matrix A;
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    analyzed(split, &A, grid(SIDE, 0, false), true);
    assert_true(cipc_split_factor_entries(split) > 9.0 * A.start[A.n] / 2);
    for (int threads = 1; threads <= 3; threads++) {
        fill(&A, 7, 0.1);
        assert_true(solves(split, &A, threads, x[threads - 1]));
        assert_memory_equal(x[0], x[threads - 1], sizeof x[0]);
    }
    /* the check can fail: a solution of another matrix is not one */
    double b[3 * BLOCKS];
    bool definite;
    for (int k = 0; k < 3 * BLOCKS; k++) b[k] = 1;
    fill(&A, 8, 0.1);
    assert_int_equal(cipc_split_factor_factorize(split, &A, 1, &definite, NULL), CIPC_OK);
    fill(&A, 9, 0.1);
    assert_int_equal(cipc_split_factor_solve(split, b, x[0], 1, NULL), CIPC_OK);
    multiply(&A, x[0], x[1]);
    double error = 0;
    for (int k = 0; k < 3 * BLOCKS; k++) error = fmax(error, fabs(x[1][k] - 1));
    assert_true(error > residual_factor * largest(A.x, 9L * A.start[A.n]) * largest(x[0], 3 * BLOCKS));
    cipc_block_matrix_free(&A);
    cipc_split_factor_destroy(split);
}

/* A contact between the halves that comes later moves a block to the separator; too many make a new partition. */
static void test_later_couplings(void **state)
{
    (void)state;
    double x[3 * BLOCKS];
    cipc_split_factor *split;
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    static const int extras[] = {0, 1, 3, 6, 12, 0};
    for (size_t k = 0; k < sizeof extras / sizeof *extras; k++) {
        cipc_block_matrix A;
        analyzed(split, &A, grid(SIDE, extras[k], false), true);
        fill(&A, 11 + (unsigned)k, 0.1);
        assert_true(solves(split, &A, 2, x));
        cipc_block_matrix_free(&A);
    }
    cipc_split_factor_destroy(split);
}

static void test_two_parts_that_do_not_touch(void **state)
{
    (void)state;
    double x[3 * BLOCKS];
    cipc_split_factor *split;
    cipc_block_matrix A;
    bool worthwhile;
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    pairs p = grid(SIDE, 0, true);
    assert_int_equal(cipc_block_matrix_create(&A, BLOCKS, (const int(*)[2])p.list, p.count, NULL), CIPC_OK);
    assert_int_equal(cipc_split_factor_analyze(split, &A, &worthwhile, NULL), CIPC_OK);
    if (worthwhile) { /* it may decline, but what it accepts it must solve */
        fill(&A, 5, 0.1);
        assert_true(solves(split, &A, 2, x));
    }
    free(p.list);
    cipc_block_matrix_free(&A);
    cipc_split_factor_destroy(split);
}

/* A pivot that is not positive in either half or in the separator's Schur complement is noticed. */
static void test_recognises_indefinite(void **state)
{
    (void)state;
    cipc_split_factor *split;
    cipc_block_matrix A;
    int rejected = 0;
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    analyzed(split, &A, grid(SIDE, 0, false), true);
    for (int block = 0; block < BLOCKS; block += 7) {
        bool definite = true;
        fill(&A, 3, 0.1);
        A.x[cipc_block_matrix_entry(&A, block, A.start[block])] = -1e-3;
        assert_int_equal(cipc_split_factor_factorize(split, &A, 2, &definite, NULL), CIPC_OK);
        rejected += !definite;
        assert_false(definite);
    }
    assert_true(rejected > 50);
    /* indefinite only as a whole: every principal 2x2 and both halves may be definite, the Schur complement is not */
    fill(&A, 4, 0.1);
    double shift = 0;
    bool definite = true;
    for (; definite && shift < 100; shift += 0.05) {
        fill(&A, 4, 0.1 - shift);
        assert_int_equal(cipc_split_factor_factorize(split, &A, 1, &definite, NULL), CIPC_OK);
    }
    assert_false(definite);
    cipc_block_matrix_free(&A);
    cipc_split_factor_destroy(split);
}

static void test_declines_small_and_dense(void **state)
{
    (void)state;
    cipc_split_factor *split;
    cipc_block_matrix A;
    bool worthwhile = true;
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    pairs p = grid(4, 0, false);
    assert_int_equal(cipc_block_matrix_create(&A, 16, (const int(*)[2])p.list, p.count, NULL), CIPC_OK);
    assert_int_equal(cipc_split_factor_analyze(split, &A, &worthwhile, NULL), CIPC_OK);
    assert_false(worthwhile);
    free(p.list);
    cipc_block_matrix_free(&A);
    enum { DENSE = 300 };
    int(*all)[2] = calloc(DENSE * DENSE / 2, sizeof *all);
    long count = 0;
    for (int i = 0; i < DENSE; i++)
        for (int j = 0; j < i; j++) {
            all[count][0] = i;
            all[count++][1] = j;
        }
    assert_int_equal(cipc_block_matrix_create(&A, DENSE, (const int(*)[2])all, count, NULL), CIPC_OK);
    assert_int_equal(cipc_split_factor_analyze(split, &A, &worthwhile, NULL), CIPC_OK);
    assert_false(worthwhile);
    free(all);
    cipc_block_matrix_free(&A);
    cipc_split_factor_destroy(split);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_block_matrix A;
    pairs p = grid(SIDE, 2, false);
    assert_int_equal(cipc_block_matrix_create(&A, BLOCKS, (const int(*)[2])p.list, p.count, NULL), CIPC_OK);
    int failures = 0;
    for (long n = 1;; n++) {
        cipc_split_factor *split = NULL;
        cipc_error error = {0};
        bool worthwhile;
        fail_allocation(n);
        cipc_status status = cipc_split_factor_create(&split, &error);
        if (!status) status = cipc_split_factor_analyze(split, &A, &worthwhile, &error);
        fail_allocation(0);
        cipc_split_factor_destroy(split);
        if (!status) break;
        failures++;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
    }
    assert_true(failures > 10);
    free(p.list);
    cipc_block_matrix_free(&A);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solves_and_does_not_depend_on_threads), cmocka_unit_test(test_later_couplings),
        cmocka_unit_test(test_two_parts_that_do_not_touch),           cmocka_unit_test(test_recognises_indefinite),
        cmocka_unit_test(test_declines_small_and_dense),              cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
