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

/* Do the primitives share a node, are their bodies apart or their nodes sewn together, or are all their nodes in fixed bodies (and skip_fixed)? */
bool plain_is_exempt(const cipc_model *model, const int *a, int na, const int *b, int nb, bool skip_fixed);

/* Primitives of a side of a kind of pairs: all nodes, edges or triangles of the model. */
int plain_side_count(const cipc_model *model, cipc_pair_kind kind, int side);
/* Is the pair one that must not touch? Of two nodes or two edges the lower comes first. */
bool plain_is_pair(const cipc_model *model, cipc_pair_kind kind, int a, int b, bool skip_fixed);
/* Its nodes; returns its thickness. */
double plain_pair_nodes(const cipc_model *model, cipc_pair_kind kind, int a, int b, int nodes[4]);
/* Its stencil at x. */
void plain_stencil(cipc_pair_kind kind, const double *x, const int nodes[4], double stencil[12]);

/* M5: is every pair above its thickness all along the straight path? */
bool plain_path_clear(const cipc_model *model, const double *from, const double *to, bool skip_fixed);

#endif
