/* A line of stats.jsonl: how every method's is written, and how those of the others but c-ipc are read back. */
#ifndef OUTPUT_STATS_LINE_H
#define OUTPUT_STATS_LINE_H

#include <jansson.h>
#include "cipc/output.h"

/* Write the line, flushed. Takes over the reference; not good: there was no memory to make it. */
cipc_status cipc_stats_line_write(FILE *file, json_t *line, bool good, int step, cipc_error *error);
/* Add what a line of the method asynchronous says to the totals. */
void cipc_asynchronous_line_add(const json_t *line, cipc_run_summary *summary);
/* The same of the method mass-spring. */
void cipc_massspring_line_add(const json_t *line, cipc_run_summary *summary);

#endif
