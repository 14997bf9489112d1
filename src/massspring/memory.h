/* memory.c: what the integrator remembers from step to step, into a state that has room for it, and back. A state without is left alone. */
#ifndef MASSSPRING_MEMORY_H
#define MASSSPRING_MEMORY_H

#include "massspring/stepper.h"

void massspring_remember(const cipc_massspring *s, cipc_state *state);
void massspring_recall(cipc_massspring *s, const cipc_state *state);

#endif
