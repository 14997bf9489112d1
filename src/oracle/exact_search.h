/* The least squared distance over a stencil's feature pairs, in integers (SPEC V.2; the candidates are explained in exact_search.c). */
#ifndef CIPC_ORACLE_EXACT_SEARCH_H
#define CIPC_ORACLE_EXACT_SEARCH_H

#include <gmp.h>
#include "cipc/base.h"
#include "oracle/integers.h"

/* The nodes of the stencil in some unit (the caller writes them), the least candidate least_numerator / least_denominator in its square, the features that
 * attain it, and scratch. */
typedef struct oracle_search {
    cipc_integer3 node[4];
    mpz_t least_numerator, least_denominator;
    unsigned features;
    cipc_integer3 u, v, w, n, s;
    mpz_t numerator, denominator, p, q;
} oracle_search;

void oracle_search_init(oracle_search *f);
void oracle_search_clear(oracle_search *f);
void oracle_search_run(oracle_search *f, cipc_pair_kind kind);
/* Sign of d^2 - xi^2 for a thickness xi in the nodes' unit. */
int oracle_search_compare(oracle_search *f, const mpz_t xi);

#endif
