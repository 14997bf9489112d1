/* The pattern of the sparse block matrix: against a dense table of the same pairs. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "implicit/block_matrix.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

enum { MOST = 24 };

/* Does the matrix hold exactly the blocks of the table (lower triangle), in order, and is the scalar form the same pattern? */
static bool has_pattern(const cipc_block_matrix *m, int n, bool table[MOST][MOST])
{
    int blocks = 0;
    if (m->n != n || m->start[0] != 0 || m->p[0] != 0) return false;
    for (int c = 0; c < n; c++) {
        for (int r = c; r < n; r++) {
            int index = cipc_block_matrix_find(m, r, c);
            if ((index >= 0) != (table[r][c] || r == c)) return false;
            if (index < 0) continue;
            if (index != blocks++ || m->row[index] != r) return false;
            for (int k = 0; k < 9; k++) {
                int entry = cipc_block_matrix_entry(m, c, index) + k / 3 * cipc_block_matrix_stride(m, c) + k % 3;
                if (m->i[entry] != 3 * r + k % 3) return false;
                if (entry < m->p[3 * c + k / 3] || entry >= m->p[3 * c + k / 3 + 1] || m->x[entry] != 0) return false;
            }
        }
        if (m->start[c + 1] != blocks) return false;
    }
    return m->p[3 * n] == 9 * blocks;
}

static void draw_pairs(uint64_t *seed, int n, int count, int (*pairs)[2], bool table[MOST][MOST])
{
    memset(table, 0, MOST * sizeof *table);
    for (int k = 0; k < count; k++) {
        int a = random_below(seed, n), b = random_below(seed, n);
        pairs[k][0] = a;
        pairs[k][1] = b;
        table[a > b ? a : b][a > b ? b : a] = true;
    }
}

static void test_random_patterns(void **state)
{
    (void)state;
    uint64_t seed = 41;
    for (int n = 1; n <= MOST; n++)
        for (int trial = 0; trial < 60; trial++) {
            int count = random_below(&seed, 4 * n), pairs[4 * MOST][2]; /* repeats, either order, pairs of a block with itself */
            bool table[MOST][MOST];
            draw_pairs(&seed, n, count, pairs, table);
            cipc_block_matrix m;
            assert_int_equal(cipc_block_matrix_create(&m, n, (const int(*)[2])pairs, count, NULL), CIPC_OK);
            assert_true(has_pattern(&m, n, table));
            if (n > 1) { /* the check notices a block too few and one too many */
                table[n - 1][0] = !table[n - 1][0];
                assert_false(has_pattern(&m, n, table));
            }
            cipc_block_matrix_free(&m);
        }
}

/* No rows, no pairs. */
static void test_empty(void **state)
{
    (void)state;
    cipc_block_matrix m;
    bool table[MOST][MOST] = {{false}};
    assert_int_equal(cipc_block_matrix_create(&m, 0, NULL, 0, NULL), CIPC_OK);
    assert_true(has_pattern(&m, 0, table));
    cipc_block_matrix_free(&m);
    assert_int_equal(cipc_block_matrix_create(&m, 5, NULL, 0, NULL), CIPC_OK);
    assert_true(has_pattern(&m, 5, table));
    assert_int_equal(cipc_block_matrix_find(&m, 3, 2), -1);
    assert_int_equal(cipc_block_matrix_find(&m, 1, 2), -1); /* the upper triangle is not stored */
    cipc_block_matrix_free(&m);
    cipc_block_matrix_free(&m); /* a freed one is empty */
}

static void test_out_of_memory(void **state)
{
    (void)state;
    uint64_t seed = 42;
    int pairs[4 * MOST][2];
    bool table[MOST][MOST];
    draw_pairs(&seed, MOST, 4 * MOST, pairs, table);
    for (long n = 1;; n++) {
        cipc_block_matrix m;
        cipc_error error = {.status = CIPC_OK};
        fail_allocation(n);
        cipc_status status = cipc_block_matrix_create(&m, MOST, (const int(*)[2])pairs, 4 * MOST, &error);
        bool failed = allocation_failed();
        fail_allocation(0);
        if (!failed) {
            assert_int_equal(status, CIPC_OK);
            assert_true(has_pattern(&m, MOST, table));
            cipc_block_matrix_free(&m);
            assert_true(n > 5);
            return;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_null(m.start); /* empty again */
        assert_int_equal(m.n, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_patterns),
        cmocka_unit_test(test_empty),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
