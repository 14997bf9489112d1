/* stats.jsonl in columns. */
#include "output/plot_table.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/json_number.h"

void cipc_plot_table_free(cipc_plot_table *t)
{
    for (int c = 0; c < t->columns; c++) {
        cipc_free(t->values[c]);
    }
}

static bool reserve(cipc_plot_table *t)
{
    if (t->count < t->capacity) {
        return true;
    }
    const int capacity = t->capacity > 0 ? 2 * t->capacity : 256;
    for (int c = 0; c < t->columns; c++) {
        double *larger = cipc_realloc(t->values[c], (size_t)capacity, sizeof(double));
        if (larger == NULL) {
            return false;
        }
        t->values[c] = larger;
    }
    t->capacity = capacity;
    return true;
}

/* "energy.total": a member of a member. */
static double number_at(const json_t *line, const char *key)
{
    char first[32];
    const char *dot = strchr(key, '.');
    if (dot == NULL) {
        return cipc_json_double(json_object_get(line, key));
    }
    snprintf(first, sizeof first, "%.*s", (int)(dot - key), key);
    return cipc_json_double(json_object_get(json_object_get(line, first), dot + 1));
}

cipc_status cipc_plot_table_read(cipc_plot_table *t, const char *path, const char *const *keys, int columns, cipc_error *error)
{
    *t = (cipc_plot_table){.columns = columns};
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        return cipc_fail(error, errno == ENOENT ? CIPC_E_MISSING_FILE : CIPC_E_IO, path, "cannot read the statistics: %s", strerror(errno));
    }
    cipc_status status = CIPC_OK;
    json_t *line;
    while (status == CIPC_OK && (line = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL)) != NULL) {
        if (reserve(t)) {
            for (int c = 0; c < columns; c++) {
                t->values[c][t->count] = number_at(line, keys[c]);
            }
            t->count++;
        } else {
            status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for the statistics");
        }
        json_decref(line);
    }
    fclose(in);
    return status;
}

bool cipc_plot_table_any(const cipc_plot_table *t, int column)
{
    for (int i = 0; i < t->count; i++) {
        if (isfinite(t->values[column][i])) {
            return true;
        }
    }
    return false;
}
