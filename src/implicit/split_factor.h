/* Cholesky factorisation in two halves that can be computed at the same time, joined by a separator (docs/theory/assembly.md, section on the two halves). */
#ifndef CIPC_IMPLICIT_SPLIT_FACTOR_H
#define CIPC_IMPLICIT_SPLIT_FACTOR_H

#include <stdbool.h>
#include "implicit/block_matrix.h"

typedef struct cipc_split_factor cipc_split_factor;

cipc_status cipc_split_factor_create(cipc_split_factor **split, cipc_error *error);
void cipc_split_factor_destroy(cipc_split_factor *split);

/* Partition and analyse the pattern of A. *worthwhile false: A is too small, or has no small separator; the other functions must then not be called. */
cipc_status cipc_split_factor_analyze(cipc_split_factor *split, const cipc_block_matrix *A, bool *worthwhile, cipc_error *error);
/* As in linear_solver.h. The result does not depend on `threads`. */
cipc_status cipc_split_factor_factorize(cipc_split_factor *split, const cipc_block_matrix *A, int threads, bool *definite, cipc_error *error);
cipc_status cipc_split_factor_solve(cipc_split_factor *split, const double *b, double *x, int threads, cipc_error *error);
/* Entries of the factor. */
double cipc_split_factor_entries(const cipc_split_factor *split);

#endif
