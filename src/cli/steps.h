/* What a method does in a run. The rest (cli/steps.c) is the same for all. */
#ifndef CLI_STEPS_H
#define CLI_STEPS_H

#include "cli/simulation.h"

typedef struct cipc_steps {
    cipc_status (*create)(cipc_simulation *s, cipc_error *error); /* the integrator, before any file is touched */
    void (*begin)(cipc_simulation *s);                            /* before the first step: who is told of what */
    cipc_status (*take)(cipc_simulation *s);                      /* a step, what the monitors say of it, and its share of the totals; fills s->error */
    cipc_status (*write_line)(cipc_simulation *s, cipc_error *error); /* of stats.jsonl, of the step just taken */
    void (*show_line)(const cipc_simulation *s, double seconds_left); /* of progress, on stderr */
    cipc_status (*plot)(const cipc_simulation *s, const char *plots, const char *stats, cipc_error *error);
} cipc_steps;
extern const cipc_steps cipc_implicit_steps, cipc_asynchronous_steps, cipc_massspring_steps;
const cipc_steps *cipc_steps_of(cipc_method method);

/* Put where it was found before the place of an error of the monitors. */
void cipc_steps_found_at(cipc_error *error, const char *where);
/* Has a signal come? Then the step is to stop: an error, and the simulation remembers it. */
cipc_status cipc_steps_interrupted(cipc_simulation *s, cipc_error *error);

#endif
