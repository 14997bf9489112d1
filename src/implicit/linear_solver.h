/* Direct solution of the Newton system by CHOLMOD, with the symbolic factorisation kept while the pattern holds; larger systems in two halves at a time
 * (split_factor.h). */
#ifndef CIPC_IMPLICIT_LINEAR_SOLVER_H
#define CIPC_IMPLICIT_LINEAR_SOLVER_H

#include <stdbool.h>
#include "implicit/block_matrix.h"

typedef struct cipc_linear_solver cipc_linear_solver;

cipc_status cipc_linear_solver_create(cipc_linear_solver **solver, cipc_error *error);
void cipc_linear_solver_destroy(cipc_linear_solver *solver);

/* Order and analyse the pattern of A. The fill-reducing order is computed on the block graph, three times smaller each way. */
cipc_status cipc_linear_solver_analyze(cipc_linear_solver *solver, const cipc_block_matrix *A, cipc_error *error);
/* A = L L^T with the values of A; its pattern must be the analysed one. *definite false: A is not positive definite. `threads` does not change
 * the result. */
cipc_status cipc_linear_solver_factorize(cipc_linear_solver *solver, const cipc_block_matrix *A, int threads, bool *definite, cipc_error *error);
/* A x = b, 3n numbers each. */
cipc_status cipc_linear_solver_solve(cipc_linear_solver *solver, const double *b, double *x, int threads, cipc_error *error);
/* Entries of the factor, for the statistics. */
double cipc_linear_solver_factor_entries(const cipc_linear_solver *solver);

#endif
