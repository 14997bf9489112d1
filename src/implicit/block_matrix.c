/* Pattern of a sparse symmetric block matrix, by two bucket sorts: O(n + pairs). */
#include "implicit/block_matrix.h"

#include <string.h>

/* Column starts by counting, then rows in ascending order: pairs are first bucketed by row, so that each column receives its rows ascending. */
static void bucket(cipc_block_matrix *m, const int (*pairs)[2], long pair_count, int *row_start, int *by_row, int *fill)
{
    for (long k = 0; k < pair_count; k++) row_start[(pairs[k][0] > pairs[k][1] ? pairs[k][0] : pairs[k][1]) + 1]++;
    for (int r = 0; r < m->n; r++) row_start[r + 1] += row_start[r];
    memcpy(fill, row_start, (size_t)m->n * sizeof *fill);
    for (long k = 0; k < pair_count; k++) {
        int high = pairs[k][0] > pairs[k][1] ? pairs[k][0] : pairs[k][1], low = pairs[k][0] > pairs[k][1] ? pairs[k][1] : pairs[k][0];
        by_row[fill[high]++] = low;
    }
}

/* last[c] is the last row that column c got; a repeat is skipped. Counts when rows is NULL, else stores. */
static void scatter(const cipc_block_matrix *m, const int *row_start, const int *by_row, int *last, int *next, int *rows)
{
    for (int c = 0; c < m->n; c++) {
        last[c] = c;
        if (rows) rows[next[c]] = c;
        next[c]++;
    }
    for (int r = 0; r < m->n; r++)
        for (int k = row_start[r]; k < row_start[r + 1]; k++) {
            int c = by_row[k];
            if (last[c] == r) continue;
            last[c] = r;
            if (rows) rows[next[c]] = r;
            next[c]++;
        }
}

static void scalar_pattern(cipc_block_matrix *m)
{
    for (int j = 0; j < m->n; j++) {
        int blocks = m->start[j + 1] - m->start[j];
        for (int c = 0; c < 3; c++) {
            int first = 9 * m->start[j] + 3 * blocks * c;
            m->p[3 * j + c] = first;
            for (int k = 0; k < blocks; k++)
                for (int r = 0; r < 3; r++) m->i[first + 3 * k + r] = 3 * m->row[m->start[j] + k] + r;
        }
    }
    m->p[3 * m->n] = 9 * m->start[m->n];
}

cipc_status cipc_block_matrix_create(cipc_block_matrix *m, int n, const int (*pairs)[2], long pair_count, cipc_error *error)
{
    memset(m, 0, sizeof *m);
    m->n = n;
    size_t size = (size_t)n;
    int *row_start = cipc_alloc(size + 1, sizeof(int)), *by_row = cipc_alloc((size_t)pair_count, sizeof(int));
    int *last = cipc_alloc(size, sizeof(int)), *next = cipc_alloc(size + 1, sizeof(int));
    m->start = cipc_alloc(size + 1, sizeof(int));
    m->p = cipc_alloc(3 * size + 1, sizeof(int));
    cipc_status status = CIPC_OK;
    if (row_start && by_row && last && next && m->start && m->p) {
        bucket(m, pairs, pair_count, row_start, by_row, next);
        memset(next, 0, (size + 1) * sizeof(int));
        scatter(m, row_start, by_row, last, next, NULL);
        for (int c = 0; c < n; c++) m->start[c + 1] = m->start[c] + next[c];
        size_t blocks = (size_t)m->start[n];
        m->row = cipc_alloc(blocks, sizeof(int));
        m->i = cipc_alloc(9 * blocks, sizeof(int));
        m->x = cipc_alloc(9 * blocks, sizeof(double));
        memcpy(next, m->start, size * sizeof(int));
    }
    if (!m->row || !m->i || !m->x) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "matrix", "no memory for a matrix of %d block rows", n);
        cipc_block_matrix_free(m);
    } else {
        scatter(m, row_start, by_row, last, next, m->row);
        scalar_pattern(m);
    }
    cipc_free(row_start);
    cipc_free(by_row);
    cipc_free(last);
    cipc_free(next);
    return status;
}

void cipc_block_matrix_free(cipc_block_matrix *m)
{
    cipc_free(m->start);
    cipc_free(m->row);
    cipc_free(m->p);
    cipc_free(m->i);
    cipc_free(m->x);
    memset(m, 0, sizeof *m);
}

int cipc_block_matrix_find(const cipc_block_matrix *m, int row, int column)
{
    int low = m->start[column], high = m->start[column + 1];
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (m->row[middle] < row) low = middle + 1;
        else high = middle;
    }
    return low < m->start[column + 1] && m->row[low] == row ? low : -1;
}
