/* Sparse symmetric matrix of 3x3 blocks, lower triangle, in the scalar compressed-column form that CHOLMOD reads. */
#ifndef CIPC_IMPLICIT_BLOCK_MATRIX_H
#define CIPC_IMPLICIT_BLOCK_MATRIX_H

#include <stdbool.h>
#include "cipc/base.h"

typedef struct cipc_block_matrix {
    int n;           /* block rows and columns */
    int *start;      /* n + 1: blocks of column j are start[j] .. start[j+1]-1 */
    int *row;        /* block rows, ascending; the first of a column is the diagonal */
    int *p, *i;      /* scalar form: 3n + 1 column starts, row indices */
    double *x;       /* values; the diagonal blocks are stored whole, CHOLMOD ignores their upper part */
} cipc_block_matrix;

/* Pattern from pairs of block indices (either order, repeats allowed; diagonals are always there). Values are zero. */
cipc_status cipc_block_matrix_create(cipc_block_matrix *matrix, int n, const int (*pairs)[2], long pair_count, cipc_error *error);
void cipc_block_matrix_free(cipc_block_matrix *matrix);
/* Index of the block (row >= column), or -1 if the pattern lacks it. */
int cipc_block_matrix_find(const cipc_block_matrix *matrix, int row, int column);
/* Scalar entry (r, c) of block `index` in block column `column` is x[cipc_block_matrix_entry(...) + 3 * blocks_in_column * c + r]. */
static inline int cipc_block_matrix_entry(const cipc_block_matrix *m, int column, int index)
{
    return 9 * m->start[column] + 3 * (index - m->start[column]);
}
/* Distance between two scalar columns of a block column. */
static inline int cipc_block_matrix_stride(const cipc_block_matrix *m, int column) { return 3 * (m->start[column + 1] - m->start[column]); }

#endif
