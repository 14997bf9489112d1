/* Numbers of stats.jsonl in columns, for plots. */
#ifndef OUTPUT_PLOT_TABLE_H
#define OUTPUT_PLOT_TABLE_H

#include "cipc/base.h"

enum { CIPC_PLOT_COLUMNS_MAX = 24 };

typedef struct cipc_plot_table {
    int columns, count, capacity;             /* count: rows, one per step */
    double *values[CIPC_PLOT_COLUMNS_MAX];    /* NAN where a line has no such number */
} cipc_plot_table;

/* A column per key; "energy.total" is `total` of the object `energy`. The lines up to the first that is broken: a run that was killed may have left half a line.
 * Free in any case. CIPC_E_MISSING_FILE, CIPC_E_IO, CIPC_E_OUT_OF_MEMORY. */
cipc_status cipc_plot_table_read(cipc_plot_table *table, const char *path, const char *const *keys, int columns, cipc_error *error);
void cipc_plot_table_free(cipc_plot_table *table);
/* Has the column a finite number? */
bool cipc_plot_table_any(const cipc_plot_table *table, int column);

#endif
