/* The order in which a patch tree holds the primitives of a model. */
#ifndef CIPC_INVARIANT_REST_ORDER_H
#define CIPC_INVARIANT_REST_ORDER_H

#include <stdbool.h>

#include "cipc/model.h"

/* order[count]: the primitives of `size` nodes each, those with a node that is not fixed first, then body by body, within a body along a
 * space-filling curve through its rest shape; ties by index. False: out of memory. */
bool cipc_rest_order(int *order, const cipc_model *model, const int *nodes, int size, int count, const bool *fixed);

#endif
