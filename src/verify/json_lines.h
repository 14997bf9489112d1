/* Reading JSON lines, one object a line. */
#ifndef CIPC_VERIFY_JSON_LINES_H
#define CIPC_VERIFY_JSON_LINES_H

#include <stdio.h>
#include "verify/query.h"

typedef struct verify_lines {
    FILE *stream;
    const char *name;
    char *text;
    size_t size;
    long number;      /* of the line read last */
    char place[512];  /* "file:line" */
} verify_lines;

void verify_lines_init(verify_lines *lines, FILE *stream, const char *name);
void verify_lines_free(verify_lines *lines);
/* The next object, a new reference, in *object; NULL at the end. CIPC_E_BAD_QUERY: the line is no JSON object, or the last one is cut off (no newline). Empty
 * lines are skipped. */
cipc_status verify_lines_next(verify_lines *lines, json_t **object, cipc_error *error);
/* "id" and "fn" of a line; fn becomes the table's own string. */
cipc_status verify_line_head(const verify_lines *lines, const json_t *object, long *id, const char **fn, cipc_error *error);

#endif
