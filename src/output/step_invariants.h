/* The monitors' fields of a line of stats.jsonl, the same for every method. */
#ifndef OUTPUT_STEP_INVARIANTS_H
#define OUTPUT_STEP_INVARIANTS_H

#include <jansson.h>
#include "cipc/output.h"

/* invariants NULL (monitors off): the fields are null. */
void cipc_step_invariants_put(json_t *line, const cipc_step_invariants *invariants, bool *good);
/* The way back. False: the step was not monitored. */
bool cipc_step_invariants_get(const json_t *line, cipc_step_invariants *invariants);

#endif
