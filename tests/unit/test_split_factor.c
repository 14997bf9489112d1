/* Factorisation in two halves: residuals on grids, separate pieces and growing separators; the answers "not worthwhile" and "not definite";
 * threads; memory. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <SuiteSparse_config.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "implicit/split_factor.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { WIDTH = 20, HEIGHT = 40, BLOCKS = WIDTH * HEIGHT, MOST_PAIRS = 3 * BLOCKS };

typedef struct system_of_equations {
    cipc_block_matrix A;
    int pairs[MOST_PAIRS][2];
    long pair_count;
    double b[3 * BLOCKS], x[3 * BLOCKS];
} system_of_equations;

/* A grid of WIDTH x rows nodes and more of the same beside it, unconnected, up to `blocks` nodes. */
static void make_grid(system_of_equations *s, int rows, int blocks)
{
    s->pair_count = 0;
    for (int k = 0; k < blocks; k++) {
        if (k % WIDTH) s->pairs[s->pair_count][0] = k, s->pairs[s->pair_count++][1] = k - 1;
        if (k / WIDTH % rows) s->pairs[s->pair_count][0] = k, s->pairs[s->pair_count++][1] = k - WIDTH;
    }
    assert_int_equal(cipc_block_matrix_create(&s->A, blocks, (const int(*)[2])s->pairs, s->pair_count, NULL), CIPC_OK);
}

static void add_pairs(system_of_equations *s, int count, int from, int to)
{
    int blocks = s->A.n;
    cipc_block_matrix_free(&s->A);
    for (int k = 0; k < count; k++) {
        s->pairs[s->pair_count][0] = from + k;
        s->pairs[s->pair_count++][1] = to + k;
    }
    assert_true(s->pair_count <= MOST_PAIRS);
    assert_int_equal(cipc_block_matrix_create(&s->A, blocks, (const int(*)[2])s->pairs, s->pair_count, NULL), CIPC_OK);
}

/* Entries in (-1, 1), `diagonal` on the diagonal: positive definite if that exceeds the rows' sums, 3 x the blocks of a row. */
static void fill(system_of_equations *s, uint64_t *seed, double diagonal)
{
    for (int j = 0; j < 3 * s->A.n; j++)
        for (int k = s->A.p[j]; k < s->A.p[j + 1]; k++) s->A.x[k] = s->A.i[k] == j ? diagonal : random_uniform(seed, -1, 1);
    random_fill(seed, s->b, 3 * s->A.n, 1);
}

/* |b - A x| <= 8 n u |A| |x| (test_linear_solver.c), twice for the sum of the halves. */
static bool solves(const system_of_equations *s)
{
    static double y[3 * BLOCKS], row_sum[3 * BLOCKS];
    int n = 3 * s->A.n;
    double norm = 0, size = 0;
    memset(y, 0, sizeof y);
    memset(row_sum, 0, sizeof row_sum);
    for (int j = 0; j < n; j++)
        for (int k = s->A.p[j]; k < s->A.p[j + 1]; k++) {
            int i = s->A.i[k];
            if (i < j) continue;
            y[i] += s->A.x[k] * s->x[j];
            row_sum[i] += fabs(s->A.x[k]);
            if (i > j) y[j] += s->A.x[k] * s->x[i], row_sum[j] += fabs(s->A.x[k]);
        }
    for (int i = 0; i < n; i++) norm = fmax(norm, row_sum[i]), size = fmax(size, fabs(s->x[i]));
    for (int i = 0; i < n; i++)
        if (!(fabs(y[i] - s->b[i]) <= 16.0 * n * UNIT_ROUNDOFF * norm * size)) return false;
    return true;
}

static bool analyze(cipc_split_factor *split, system_of_equations *s)
{
    bool worthwhile = false;
    assert_int_equal(cipc_split_factor_analyze(split, &s->A, &worthwhile, NULL), CIPC_OK);
    return worthwhile;
}

static void assert_solves(cipc_split_factor *split, system_of_equations *s, uint64_t *seed)
{
    for (int values = 0; values < 2; values++) {
        bool definite = false;
        fill(s, seed, 60);
        assert_int_equal(cipc_split_factor_factorize(split, &s->A, 1, &definite, NULL), CIPC_OK);
        assert_true(definite);
        assert_int_equal(cipc_split_factor_solve(split, s->b, s->x, 1, NULL), CIPC_OK);
        assert_true(solves(s));
    }
    s->x[4] += 1e-6;
    assert_false(solves(s)); /* the check can fail */
}

static system_of_equations *new_system(void)
{
    system_of_equations *s = calloc(1, sizeof *s);
    assert_non_null(s);
    return s;
}

static void free_system(system_of_equations *s)
{
    cipc_block_matrix_free(&s->A);
    free(s);
}

static void test_grid(void **state)
{
    (void)state;
    uint64_t seed = 121;
    cipc_split_factor *split;
    system_of_equations *s = new_system();
    make_grid(s, HEIGHT, BLOCKS);
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    assert_true(cipc_split_factor_entries(split) == 0);
    assert_true(analyze(split, s));
    assert_solves(split, s, &seed);
    assert_true(cipc_split_factor_entries(split) > 6.0 * BLOCKS);
    free_system(s);
    cipc_split_factor_destroy(split);
    cipc_split_factor_destroy(NULL);
}

/* Contacts between the halves join the separator, few of them without a new partition, many with one; another size starts afresh. */
static void test_patterns_follow(void **state)
{
    (void)state;
    uint64_t seed = 122;
    cipc_split_factor *split;
    system_of_equations *s = new_system();
    make_grid(s, HEIGHT, BLOCKS);
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    assert_true(analyze(split, s));
    assert_solves(split, s, &seed);
    for (int more = 1; more <= 16; more *= 2) {
        add_pairs(s, more, 5 * more, BLOCKS - 7 * more); /* from end to end */
        if (analyze(split, s)) assert_solves(split, s, &seed);
    }
    cipc_block_matrix_free(&s->A);
    make_grid(s, 20, 400);
    assert_true(analyze(split, s));
    assert_solves(split, s, &seed);
    free_system(s);
    cipc_split_factor_destroy(split);
}

/* Pieces that do not touch: the separator is empty, or nearly; and nobody complains (BLAS would, on stderr, about matrices of no rows). */
static void test_separate_pieces(void **state)
{
    (void)state;
    uint64_t seed = 123;
    char complaint[16];
    FILE *log = tmpfile();
    assert_non_null(log);
    int kept = dup(STDERR_FILENO);
    assert_true(kept >= 0 && dup2(fileno(log), STDERR_FILENO) >= 0);
    for (int rows = 2; rows <= 20; rows *= 10) { /* pieces of 2 rows, of 20 rows: two halves */
        cipc_split_factor *split;
        system_of_equations *s = new_system();
        make_grid(s, rows, BLOCKS);
        assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
        if (analyze(split, s)) assert_solves(split, s, &seed);
        free_system(s);
        cipc_split_factor_destroy(split);
    }
    assert_true(dup2(kept, STDERR_FILENO) >= 0);
    close(kept);
    rewind(log);
    assert_null(fgets(complaint, sizeof complaint, log));
    fclose(log);
}

/* Too small, or without a small separator. */
static void test_not_worthwhile(void **state)
{
    (void)state;
    cipc_split_factor *split;
    system_of_equations *s = new_system();
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    make_grid(s, 10, 200);
    assert_false(analyze(split, s));
    cipc_block_matrix_free(&s->A);
    s->pair_count = 0;
    for (int k = 0; k < MOST_PAIRS; k++) { /* a random graph has no small separator */
        uint64_t seed = 1000 + (uint64_t)k;
        s->pairs[k][0] = random_below(&seed, 300);
        s->pairs[k][1] = random_below(&seed, 300);
        s->pair_count++;
    }
    assert_int_equal(cipc_block_matrix_create(&s->A, 300, (const int(*)[2])s->pairs, s->pair_count, NULL), CIPC_OK);
    assert_false(analyze(split, s));
    free_system(s);
    cipc_split_factor_destroy(split);
}

/* One diagonal entry after the other is made negative: wherever it is, in a half or in the separator, the answer is "not definite", and the
 * factor recovers. */
static void test_not_definite(void **state)
{
    (void)state;
    uint64_t seed = 124;
    cipc_split_factor *split;
    system_of_equations *s = new_system();
    make_grid(s, HEIGHT, BLOCKS);
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
    assert_true(analyze(split, s));
    fill(s, &seed, 60);
    for (int block = 0; block < BLOCKS; block += 13) {
        bool found = true;
        double *entry = &s->A.x[s->A.p[3 * block + 1] + 1], kept = *entry;
        *entry = -1;
        assert_int_equal(cipc_split_factor_factorize(split, &s->A, 1, &found, NULL), CIPC_OK);
        assert_false(found);
        *entry = kept;
    }
    bool definite = true; /* indefinite only as a whole: the diagonal shrinks until some combination of many nodes is not positive */
    double diagonal = 60;
    for (; definite && diagonal > 0; diagonal *= 0.95) {
        uint64_t same = 127;
        fill(s, &same, diagonal);
        assert_int_equal(cipc_split_factor_factorize(split, &s->A, 1, &definite, NULL), CIPC_OK);
    }
    assert_false(definite);
    assert_true(diagonal > 1 && diagonal < 15); /* every entry of the diagonal is still larger than any other entry */
    assert_solves(split, s, &seed);
    free_system(s);
    cipc_split_factor_destroy(split);
}

static void test_threads(void **state)
{
    (void)state;
    static double x[3][3 * BLOCKS];
    for (int threads = 1; threads <= 3; threads++) {
        omp_set_max_active_levels(threads > 1);
        uint64_t seed = 125;
        bool definite;
        cipc_split_factor *split;
        system_of_equations *s = new_system();
        make_grid(s, HEIGHT, BLOCKS);
        fill(s, &seed, 60);
        assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
        assert_true(analyze(split, s));
        assert_int_equal(cipc_split_factor_factorize(split, &s->A, threads, &definite, NULL), CIPC_OK);
        assert_int_equal(cipc_split_factor_solve(split, s->b, x[threads - 1], threads, NULL), CIPC_OK);
        assert_memory_equal(x[0], x[threads - 1], sizeof x[0]);
        free_system(s);
        cipc_split_factor_destroy(split);
    }
    omp_set_max_active_levels(0);
}

/* --- lack of memory: whatever fails, it is reported, and the same factor is as good as new afterwards ----------------------------------
 */

/* CHOLMOD's allocations, through the hooks that SuiteSparse has: the countdown'th fails while armed. */
static long countdown;
static bool armed;

/* Two patterns (the second grows the separator of the first), factorisation and solution. */
static cipc_status whole_use(cipc_split_factor *split, system_of_equations *first, system_of_equations *second, bool *definite,
                             cipc_error *error)
{
    bool worthwhile = false;
    *definite = false;
    cipc_status status = cipc_split_factor_analyze(split, &first->A, &worthwhile, error);
    if (!status) status = cipc_split_factor_analyze(split, &second->A, &worthwhile, error);
    if (status) return status;
    assert_true(worthwhile);
    status = cipc_split_factor_factorize(split, &second->A, 1, definite, error);
    armed = false; /* CHOLMOD 3.0.14 itself does not survive lack of memory in a triangular solution */
    return status ? status : cipc_split_factor_solve(split, second->b, second->x, 1, error);
}

static bool refuse(void)
{
    return armed && --countdown == 0;
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

static void out_of_memory(bool cholmod)
{
    uint64_t seed = 126;
    system_of_equations *first = new_system(), *second = new_system();
    make_grid(first, 20, 400);
    make_grid(second, 20, 400);
    add_pairs(second, 1, 3, 390);
    fill(second, &seed, 60);
    struct SuiteSparse_config_struct hooks = SuiteSparse_config;
    long failures = 0;
    for (long n = 1, failed = 1; failed; n += cholmod ? 1 + n / 5 : 1) { /* CHOLMOD has hundreds */
        cipc_split_factor *split;
        cipc_error error = {.status = CIPC_OK};
        bool definite;
        assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_OK);
        countdown = n;
        armed = true;
        if (cholmod) {
            SuiteSparse_config.malloc_func = failing_malloc;
            SuiteSparse_config.calloc_func = failing_calloc;
            SuiteSparse_config.realloc_func = failing_realloc;
        } else {
            fail_allocation(n);
        }
        cipc_status status = whole_use(split, first, second, &definite, &error);
        failed = cholmod ? countdown <= 0 : allocation_failed();
        fail_allocation(0);
        SuiteSparse_config = hooks;
        assert_true(status == CIPC_OK || status == CIPC_E_OUT_OF_MEMORY);
        assert_true(status == CIPC_OK ? (cholmod || !failed) && definite && solves(second) : failed != 0);
        failures += status != CIPC_OK;
        memset(second->x, 0, sizeof second->x);
        assert_int_equal(whole_use(split, first, second, &definite, NULL), CIPC_OK);
        assert_true(definite && solves(second));
        cipc_split_factor_destroy(split);
    }
    assert_true(failures > 10);
    free_system(first);
    free_system(second);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_split_factor *split;
    fail_allocation(1);
    assert_int_equal(cipc_split_factor_create(&split, NULL), CIPC_E_OUT_OF_MEMORY);
    fail_allocation(0);
    assert_null(split);
    out_of_memory(false);
}

static void test_cholmod_out_of_memory(void **state)
{
    (void)state;
    out_of_memory(true);
}

int main(void)
{
    omp_set_max_active_levels(0); /* CHOLMOD's own threads would only wait for one another on a busy machine; test_threads lets them */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid),           cmocka_unit_test(test_patterns_follow),       cmocka_unit_test(test_separate_pieces),
        cmocka_unit_test(test_not_worthwhile), cmocka_unit_test(test_not_definite),          cmocka_unit_test(test_threads),
        cmocka_unit_test(test_out_of_memory),  cmocka_unit_test(test_cholmod_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
