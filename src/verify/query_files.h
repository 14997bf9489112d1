/* Reader of the field's public collision queries: 8 rows a query, a row "x_num,x_den,y_num,y_den,z_num,z_den,truth" of one node, first the four nodes at t = 0,
 * then at t = 1; edges a0 a1 b0 b1, or point and triangle. Every coordinate must be exactly a double. */
#ifndef CIPC_VERIFY_QUERY_FILES_H
#define CIPC_VERIFY_QUERY_FILES_H

#include "cipc/base.h"

typedef struct verify_public_query {
    cipc_stencil_path path; /* to_end */
    bool hit;               /* the truth column */
} verify_public_query;

typedef struct verify_public_queries {
    verify_public_query *query;
    int count, capacity;
} verify_public_queries;

void verify_public_queries_free(verify_public_queries *q);
/* Append the queries of one file; kind is point-triangle or edge-edge. CIPC_E_MISSING_FILE, CIPC_E_BAD_QUERY with file and line, CIPC_E_OUT_OF_MEMORY. */
cipc_status verify_public_queries_read(verify_public_queries *q, const char *path, cipc_pair_kind kind, cipc_error *error);
/* Append all files directory / * / {vertex-face,edge-edge} / *.csv, in the order of their names. An absent directory: CIPC_E_MISSING_FILE. */
cipc_status verify_public_queries_read_all(verify_public_queries *q, const char *directory, cipc_error *error);

#endif
