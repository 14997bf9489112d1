/* What answers and truths are made of. */
#ifndef CIPC_VERIFY_TRUTH_H
#define CIPC_VERIFY_TRUTH_H

#include "cipc/oracle.h"
#include "cipc/verify.h"

/* The derivatives of a feature, in the places of its nodes among the n numbers of the stencil. */
void verify_scatter(const cipc_feature *feature, int n, const double *g, const double *H, double *whole_g, double *whole_H);
/* {"numbers": ..., "tolerance": ...} under key: numbers with the absolute error that the condition of the case allows (class cond:16 of binary64). */
void verify_put_numbers(json_t *want, const char *key, const double *values, int count, double tolerance, bool *good);
/* How near the stencil lies to where another feature takes over, in units of the tolerance of d: how far the distance of another feature's flats is from the least
 * one; 0 if several attain it. features: those that do. */
double verify_nearest_border(cipc_pair_kind kind, const double *x, unsigned features);
/* The path that a query asks about. */
void verify_query_path(const cipc_query *query, cipc_pair_kind kind, cipc_stencil_path *path);
/* Eq. (16) of SPEC C.5 with the slackness s: (1 - s)(d - xi) / l_p, at most 1. */
double verify_least_time(const cipc_stencil_path *path, double gap, double slackness);

#endif
