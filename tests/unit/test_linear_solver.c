/* The direct solver: residuals, reuse of the symbolic factorisation, indefinite matrices, the number of threads, lack of memory (ours and
 * CHOLMOD's). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <SuiteSparse_config.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "implicit/linear_solver.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { SIDE = 12, BLOCKS = SIDE * SIDE };

/* A grid of SIDE x SIDE nodes with its edges and `extra` random pairs. */
static void make_matrix(uint64_t *seed, int extra, cipc_block_matrix *A)
{
    int pairs[3 * BLOCKS][2];
    long count = 0;
    for (int k = 0; k < BLOCKS; k++) {
        if (k % SIDE) pairs[count][0] = k, pairs[count++][1] = k - 1;
        if (k >= SIDE) pairs[count][0] = k, pairs[count++][1] = k - SIDE;
    }
    assert_true(extra <= BLOCKS);
    for (int k = 0; k < extra; k++) pairs[count][0] = random_below(seed, BLOCKS), pairs[count++][1] = random_below(seed, BLOCKS);
    assert_int_equal(cipc_block_matrix_create(A, BLOCKS, (const int(*)[2])pairs, count, NULL), CIPC_OK);
}

/* Random entries in (-1, 1) and `diagonal` on the diagonal: with 3 x the blocks of a row it dominates, so the matrix is positive definite.
 */
static void fill(uint64_t *seed, cipc_block_matrix *A, double diagonal)
{
    for (int j = 0; j < 3 * A->n; j++)
        for (int k = A->p[j]; k < A->p[j + 1]; k++) A->x[k] = A->i[k] == j ? diagonal : random_uniform(seed, -1, 1);
}

/* y = A x from the lower triangle; the norm bound |A| <= largest row sum. */
static double multiply(const cipc_block_matrix *A, const double *x, double *y)
{
    double row_sum[3 * BLOCKS] = {0}, norm = 0;
    memset(y, 0, 3 * (size_t)A->n * sizeof *y);
    for (int j = 0; j < 3 * A->n; j++)
        for (int k = A->p[j]; k < A->p[j + 1]; k++) {
            int i = A->i[k];
            if (i < j) continue; /* the stored upper halves of diagonal blocks do not count */
            y[i] += A->x[k] * x[j];
            row_sum[i] += fabs(A->x[k]);
            if (i != j) {
                y[j] += A->x[k] * x[i];
                row_sum[j] += fabs(A->x[k]);
            }
        }
    for (int i = 0; i < 3 * A->n; i++) norm = fmax(norm, row_sum[i]);
    return norm;
}

/* Cholesky's solution satisfies |b - A x| <= 4 n (3 n + 1) u |A| |x| in the worst case (Higham, theorem 10.4); 8 n u, as for the random
 * rounding of so many operations. */
static bool solves(const cipc_block_matrix *A, const double *x, const double *b)
{
    double y[3 * BLOCKS], norm = multiply(A, x, y), size = 0;
    int n = 3 * A->n;
    for (int i = 0; i < n; i++) size = fmax(size, fabs(x[i]));
    for (int i = 0; i < n; i++)
        if (!(fabs(y[i] - b[i]) <= 8.0 * n * UNIT_ROUNDOFF * norm * size)) return false;
    return true;
}

static void assert_solves(cipc_linear_solver *solver, const cipc_block_matrix *A, uint64_t *seed)
{
    double b[3 * BLOCKS], x[3 * BLOCKS];
    bool definite = false;
    random_fill(seed, b, 3 * A->n, 1);
    assert_int_equal(cipc_linear_solver_factorize(solver, A, 1, &definite, NULL), CIPC_OK);
    assert_true(definite);
    assert_int_equal(cipc_linear_solver_solve(solver, b, x, 1, NULL), CIPC_OK);
    assert_true(solves(A, x, b));
    x[1] += 1e-6;
    assert_false(solves(A, x, b));
}

/* One analysis, several sets of values; then other patterns of the same and of another size. */
static void test_solves(void **state)
{
    (void)state;
    uint64_t seed = 51;
    cipc_linear_solver *solver;
    assert_int_equal(cipc_linear_solver_create(&solver, NULL), CIPC_OK);
    assert_true(cipc_linear_solver_factor_entries(solver) == 0);
    for (int extra = 0; extra <= BLOCKS; extra += 36) {
        cipc_block_matrix A;
        make_matrix(&seed, extra, &A);
        assert_int_equal(cipc_linear_solver_analyze(solver, &A, NULL), CIPC_OK);
        for (int values = 0; values < 3; values++) {
            fill(&seed, &A, 60);
            assert_solves(solver, &A, &seed);
        }
        assert_true(cipc_linear_solver_factor_entries(solver) >= 3.0 * BLOCKS);
        cipc_block_matrix_free(&A);
    }
    cipc_block_matrix small;
    const int pair[1][2] = {{1, 0}};
    assert_int_equal(cipc_block_matrix_create(&small, 2, pair, 1, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_analyze(solver, &small, NULL), CIPC_OK);
    fill(&seed, &small, 60);
    assert_solves(solver, &small, &seed);
    cipc_block_matrix_free(&small);
    cipc_linear_solver_destroy(solver);
    cipc_linear_solver_destroy(NULL);
}

/* All nodes prescribed: a system without rows. */
static void test_empty(void **state)
{
    (void)state;
    cipc_linear_solver *solver;
    cipc_block_matrix A;
    bool definite = false;
    double nothing = 0;
    assert_int_equal(cipc_linear_solver_create(&solver, NULL), CIPC_OK);
    assert_int_equal(cipc_block_matrix_create(&A, 0, NULL, 0, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_analyze(solver, &A, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_factorize(solver, &A, 1, &definite, NULL), CIPC_OK);
    assert_true(definite);
    assert_int_equal(cipc_linear_solver_solve(solver, &nothing, &nothing, 1, NULL), CIPC_OK);
    cipc_block_matrix_free(&A);
    cipc_linear_solver_destroy(solver);
}

/* A pivot that is not positive is an answer, not an error, and the next factorisation is not the worse for it. */
static void test_not_definite(void **state)
{
    (void)state;
    uint64_t seed = 52;
    cipc_linear_solver *solver;
    cipc_block_matrix A;
    make_matrix(&seed, 40, &A);
    assert_int_equal(cipc_linear_solver_create(&solver, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_analyze(solver, &A, NULL), CIPC_OK);
    static const double diagonals[] = {-60, 0, 0.1, 60};
    for (int k = 0; k < 4; k++) {
        bool definite = k < 3;
        fill(&seed, &A, diagonals[k]);
        assert_int_equal(cipc_linear_solver_factorize(solver, &A, 1, &definite, NULL), CIPC_OK);
        assert_int_equal(definite, k == 3);
    }
    assert_solves(solver, &A, &seed);
    cipc_block_matrix_free(&A);
    cipc_linear_solver_destroy(solver);
}

/* Same bits for any number of threads. */
static void test_threads(void **state)
{
    (void)state;
    double x[4][3 * BLOCKS], b[3 * BLOCKS];
    for (int threads = 1; threads <= 4; threads++) {
        uint64_t seed = 53;
        cipc_linear_solver *solver;
        cipc_block_matrix A;
        bool definite;
        make_matrix(&seed, 100, &A);
        fill(&seed, &A, 60);
        random_fill(&seed, b, 3 * BLOCKS, 1);
        assert_int_equal(cipc_linear_solver_create(&solver, NULL), CIPC_OK);
        assert_int_equal(cipc_linear_solver_analyze(solver, &A, NULL), CIPC_OK);
        assert_int_equal(cipc_linear_solver_factorize(solver, &A, threads, &definite, NULL), CIPC_OK);
        assert_int_equal(cipc_linear_solver_solve(solver, b, x[threads - 1], 1, NULL), CIPC_OK);
        assert_memory_equal(x[0], x[threads - 1], sizeof b);
        cipc_block_matrix_free(&A);
        cipc_linear_solver_destroy(solver);
    }
}

/* A matrix that is not the analysed one is refused by CHOLMOD: an error that says so. */
static void test_wrong_pattern(void **state)
{
    (void)state;
    uint64_t seed = 54;
    cipc_linear_solver *solver;
    cipc_block_matrix A, other;
    cipc_error error = {.status = CIPC_OK};
    bool definite = true;
    make_matrix(&seed, 0, &A);
    fill(&seed, &A, 60);
    assert_int_equal(cipc_block_matrix_create(&other, 2, NULL, 0, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_create(&solver, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_analyze(solver, &A, NULL), CIPC_OK);
    assert_int_equal(cipc_linear_solver_factorize(solver, &other, 1, &definite, &error), CIPC_E_FACTORIZATION);
    assert_non_null(strstr(error.what, "factorise"));
    cipc_block_matrix_free(&A);
    cipc_block_matrix_free(&other);
    cipc_linear_solver_destroy(solver);
}

/* --- lack of memory ------------------------------------------------------------------------------------------------------------ */

typedef enum phase { CREATE, ANALYZE, FACTORIZE, SOLVE } phase;

/* All four phases; the status and where it stopped. */
static cipc_status whole_use(const cipc_block_matrix *A, const double *b, double *x, phase *reached, cipc_error *error)
{
    cipc_linear_solver *solver;
    bool definite;
    *reached = CREATE;
    cipc_status status = cipc_linear_solver_create(&solver, error);
    if (!status) *reached = ANALYZE, status = cipc_linear_solver_analyze(solver, A, error);
    if (!status) *reached = FACTORIZE, status = cipc_linear_solver_factorize(solver, A, 1, &definite, error);
    if (!status) *reached = SOLVE, status = cipc_linear_solver_solve(solver, b, x, 1, error);
    cipc_linear_solver_destroy(solver);
    return status;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 55;
    cipc_block_matrix A;
    double b[3 * BLOCKS], x[3 * BLOCKS];
    make_matrix(&seed, 20, &A);
    fill(&seed, &A, 60);
    random_fill(&seed, b, 3 * BLOCKS, 1);
    for (long n = 1;; n++) {
        phase reached;
        cipc_error error = {.status = CIPC_OK};
        fail_allocation(n);
        cipc_status status = whole_use(&A, b, x, &reached, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_int_equal(error.status, status);
        if (!failed) break;
    }
    assert_true(solves(&A, x, b));
    cipc_block_matrix_free(&A);
}

/* CHOLMOD's own allocations, through the hooks that SuiteSparse has for that. */
static long countdown;
static bool refuse(void)
{
    return --countdown == 0;
}
static void *failing_malloc(size_t size)
{
    return refuse() ? NULL : malloc(size);
}
static void *failing_calloc(size_t count, size_t size)
{
    return refuse() ? NULL : calloc(count, size);
}
static void *failing_realloc(void *block, size_t size)
{
    return refuse() ? NULL : realloc(block, size);
}

static void test_cholmod_out_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 56;
    cipc_block_matrix A;
    double b[3 * BLOCKS], x[3 * BLOCKS];
    long failures[4] = {0, 0, 0, 0};
    bool done = false;
    make_matrix(&seed, 20, &A);
    fill(&seed, &A, 60);
    random_fill(&seed, b, 3 * BLOCKS, 1);
    struct SuiteSparse_config_struct hooks = SuiteSparse_config;
    SuiteSparse_config.malloc_func = failing_malloc;
    SuiteSparse_config.calloc_func = failing_calloc;
    SuiteSparse_config.realloc_func = failing_realloc;
    for (long n = 1; !done; n++) {
        phase reached;
        cipc_error error = {.status = CIPC_OK};
        countdown = n;
        cipc_status status = whole_use(&A, b, x, &reached, &error);
        done = countdown > 0;
        /* CHOLMOD gets by without some of its memory, e.g. with one ordering of two; then the answer is right. */
        if (!status)
            assert_true(solves(&A, x, b));
        else {
            assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
            failures[reached]++;
        }
    }
    SuiteSparse_config = hooks;
    assert_true(failures[ANALYZE] > 0 && failures[FACTORIZE] > 0 && failures[SOLVE] > 0);
    cipc_block_matrix_free(&A);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solves),
        cmocka_unit_test(test_empty),
        cmocka_unit_test(test_not_definite),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_wrong_pattern),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_cholmod_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
