/* Recorded CCD queries: files of JSON lines as `cipc run --record-ccd` writes them (docs/formats.md). */
#ifndef CIPC_VERIFY_CCD_QUERIES_H
#define CIPC_VERIFY_CCD_QUERIES_H

#include <stdio.h>
#include "cipc/base.h"

typedef struct verify_ccd_query {
    cipc_stencil_path path;
    double thickness, scale;
} verify_ccd_query;

typedef struct verify_ccd_queries {
    verify_ccd_query *query;
    long count, capacity;
} verify_ccd_queries;

void verify_ccd_queries_free(verify_ccd_queries *queries);
/* Append the queries of a stream; `name` is for messages. CIPC_E_BAD_QUERY with the line: no query, or one of another function than toi_...; or no line at
 * all. CIPC_E_OUT_OF_MEMORY. */
cipc_status verify_ccd_queries_read(verify_ccd_queries *queries, FILE *stream, const char *name, cipc_error *error);

#endif
