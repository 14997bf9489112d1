/* The slow twin of the monitors: every pair of primitives, one after another, in exact arithmetic; no boxes, no filter, no lists kept. */
#ifndef SUPPORT_PLAIN_MONITOR_H
#define SUPPORT_PLAIN_MONITOR_H

#include <stdbool.h>

#include "cipc/model.h"

typedef struct plain_report {
    bool crossing, gap_violated, strain_violated; /* M1, M2, M3 */
    double min_gap;                               /* over all pairs, rounded to nearest; INFINITY: none */
    long within;                                  /* pairs with gap <= reach */
} plain_report;

/* skip_fixed: leave out pairs whose nodes are all in fixed bodies. */
plain_report plain_monitor(const cipc_model *model, const double *x, double reach, bool skip_fixed);

/* Do the primitives share a node, or are all their nodes in fixed bodies (and skip_fixed)? */
bool plain_is_exempt(const cipc_model *model, const int *a, int na, const int *b, int nb, bool skip_fixed);

#endif
