/* What can meet: the nodes, edges and triangles of the model, kind by kind, each with a patch tree of its own. */
#ifndef CIPC_INVARIANT_PRIMITIVES_H
#define CIPC_INVARIANT_PRIMITIVES_H

#include <stdbool.h>

#include "cipc/model.h"
#include "invariant/patch_tree.h"

/* The primitives of one kind, all bodies together. */
typedef struct cipc_primitives {
    int count, size;  /* size: nodes of one, 1..3 */
    const int *nodes; /* count * size */
    int first;        /* of edges and triangles: the model's number of the first one */
    int *order;       /* item at each place of the tree: those that are not fixed first, then by body, then along the rest shape */
    int moving;       /* the first `moving` places are those that are not fixed (all, if fixed pairs count) */
    cipc_patch_tree tree;
    int *listed;      /* of points, ends and particles: the nodes that they are, ascending */
} cipc_primitives;

/* Points: all nodes but those inside volumes. Ends: nodes of rods, and particles. */
enum { CIPC_POINTS = 0, CIPC_ENDS, CIPC_PARTICLES, CIPC_EDGES, CIPC_SEGMENTS, CIPC_TRIANGLES, CIPC_PRIMITIVE_KINDS };

/* All kinds of a model; fixed[node]: pairs of nodes that are all so do not count. False: out of memory (free is safe then). */
bool invariant_primitives_init(cipc_primitives primitives[CIPC_PRIMITIVE_KINDS], const cipc_model *model, const bool *fixed);
void invariant_primitives_free(cipc_primitives primitives[CIPC_PRIMITIVE_KINDS]);

#endif
