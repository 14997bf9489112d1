/* Candidate pairs of the monitors M1, M2 and M5: every pair of primitives that may be within xi + reach, every edge-triangle pair that may
 * meet, found without any code of the solver. The lists reach `margin` further than asked and serve until a node has moved more than half
 * of it. */
#ifndef CIPC_INVARIANT_CANDIDATES_H
#define CIPC_INVARIANT_CANDIDATES_H

#include <stdbool.h>

#include "cipc/model.h"
#include "invariant/exemptions.h"
#include "invariant/primitives.h"

/* The kinds of pairs whose distance counts, numbered as cipc_pair_kind, and that of M1. */
typedef enum invariant_candidate_kind {
    CIPC_CANDIDATE_POINT_POINT = CIPC_POINT_POINT,
    CIPC_CANDIDATE_POINT_EDGE = CIPC_POINT_EDGE,
    CIPC_CANDIDATE_POINT_TRIANGLE = CIPC_POINT_TRIANGLE,
    CIPC_CANDIDATE_EDGE_EDGE = CIPC_EDGE_EDGE,
    CIPC_CANDIDATE_EDGE_TRIANGLE = CIPC_PAIR_KIND_COUNT,
    CIPC_CANDIDATE_KINDS
} invariant_candidate_kind;

/* A part of the search: the patches [first, last) of the first side of a kind against the second side, and what was found. Parts are
 * fixed at creation, so neither the lists nor their order depend on the number of threads. */
typedef struct invariant_candidate_part {
    invariant_candidate_kind kind;
    int first, last;
    int (*pairs)[2]; /* the model's numbers of the nodes, edges or triangles; of two nodes or two edges the lower first */
    int count, capacity;
    cipc_place_list patches; /* scratch: patches of the second side near a patch of the first */
    bool failed;
} invariant_candidate_part;

typedef struct invariant_candidates {
    const cipc_model *model;
    double reach, margin;
    int threads;
    bool *fixed;            /* of a node: in a fixed body, and fixed pairs do not count */
    invariant_exemptions exemptions;
    cipc_primitives primitives[CIPC_PRIMITIVE_KINDS];
    invariant_candidate_part *parts;
    int part_count;
    double *made_at; /* positions the lists were made at */
    const double *sweep_to; /* while paths are searched: where they end */
    bool made;
} invariant_candidates;

/* False: out of memory (free is safe then). */
bool invariant_candidates_init(invariant_candidates *c, const cipc_model *model, double reach, double margin, int threads, bool skip_fixed);
void invariant_candidates_free(invariant_candidates *c);

/* Make the lists valid for finite positions x; *made_now tells whether that took making them anew. False: out of memory (the lists are
 * void then). */
bool invariant_candidates_update(invariant_candidates *c, const double *x, bool *made_now);

/* Do the lists serve for x as they are? */
bool invariant_candidates_valid(const invariant_candidates *c, const double *x);
/* Do they serve where a node is at a place? If they do for the place of every node, they do for all together. */
bool invariant_candidates_near(const invariant_candidates *c, int node, const double place[3]);
/* Make lists of all pairs, but edge-triangle ones, that may come within xi + reach of one another while every node stays in the box that its places in `from`
 * and `to` (both finite) are corners of, as one that moves straight from the one to the other does. They serve for this once. False: out of memory. */
bool invariant_candidates_sweep(invariant_candidates *c, const double *from, const double *to);

/* Contact thickness of the pair of these nodes' bodies (SPEC C.4, eq. 11), m. */
double invariant_candidates_offset(const cipc_model *model, int node_a, int node_b);
/* The nodes of a pair that is not edge-triangle, first primitive first, -1 where it has fewer than four. Returns its thickness, m. */
double invariant_candidates_nodes(const cipc_model *model, cipc_pair_kind kind, const int pair[2], int nodes[4]);
/* Copy the positions of n nodes. */
void cipc_gather(double *stencil, const double *x, const int *nodes, int n);

#endif
