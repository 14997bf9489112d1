/* A pair of primitives whose nodes move, as the monitors of paths see it: the filter of straight motion, and which of the pairs not cleared is told of. */
#ifndef CIPC_INVARIANT_MOVING_PAIR_H
#define CIPC_INVARIANT_MOVING_PAIR_H

#include <stdbool.h>

#include "cipc/base.h"

typedef struct cipc_moving_pair {
    cipc_pair_kind kind;
    int nodes[4];  /* unused: -1 */
    double offset; /* xi */
    bool violated; /* else undecided */
    double time;   /* of the violation, a lower bound */
} cipc_moving_pair;

/* What one part of the lists gave; of the pairs not cleared the one with the least nodes, so that the answer does not depend on the order of the lists, and
 * not on what else a list holds. */
typedef struct cipc_moving_result {
    long checked, exact;
    bool any;
    cipc_moving_pair first;
} cipc_moving_result;

/* Is there a direction along which the pair is certified to be further apart than `enough` all the way from `here` to `there`, every node moving straight? Tried
 * are n and, found at either end, the first direction that clears that end and the best one. One that clears is left in n. (0 in n: nothing to try yet.) */
bool cipc_moving_pair_clear(cipc_pair_kind kind, const double here[12], const double there[12], double enough, double n[3]);

/* Add a pair that was not cleared. */
void cipc_moving_result_keep(cipc_moving_result *result, const cipc_moving_pair *pair);
cipc_moving_result cipc_moving_result_merge(const cipc_moving_result *results, int count);

#endif
