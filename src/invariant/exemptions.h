/* Pairs that the scene lets pass, and that the monitors therefore leave out: bodies set apart, and nodes sewn to each other. Made from what the model was given - its table of bodies and its
 * stitches - not from what it derived of them for the solver. */
#ifndef CIPC_INVARIANT_EXEMPTIONS_H
#define CIPC_INVARIANT_EXEMPTIONS_H

#include <stdbool.h>

#include "cipc/model.h"

typedef struct invariant_exemptions {
    const cipc_model *model;
    bool any;
    long long *sewn; /* pairs of nodes as lower * node_count + higher, ascending */
    int sewn_count;
} invariant_exemptions;

/* False: out of memory (free is safe then). Models made by hand may leave the table of bodies out. */
bool invariant_exemptions_init(invariant_exemptions *e, const cipc_model *model);
void invariant_exemptions_free(invariant_exemptions *e);

/* May the primitives of these nodes pass through each other? */
bool invariant_exempt(const invariant_exemptions *e, const int *a, int count_a, const int *b, int count_b);

#endif
