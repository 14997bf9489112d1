/* Reader of recorded CCD queries. */
#include "verify/ccd_queries.h"

#include "verify/json_lines.h"
#include "verify/truth.h"

void verify_ccd_queries_free(verify_ccd_queries *q)
{
    cipc_free(q->query);
    *q = (verify_ccd_queries){0};
}

static bool grow(verify_ccd_queries *q)
{
    if (q->count < q->capacity) return true;
    long capacity = q->capacity > 0 ? 2 * q->capacity : 1024;
    verify_ccd_query *query = cipc_realloc(q->query, (size_t)capacity, sizeof *query);
    if (query == NULL) return false;
    q->query = query;
    q->capacity = capacity;
    return true;
}

static cipc_status append(verify_ccd_queries *q, const verify_lines *lines, const json_t *object, cipc_error *error)
{
    long id;
    const char *fn;
    cipc_query query;
    cipc_pair_kind kind;
    cipc_status status = verify_line_head(lines, object, &id, &fn, error);
    if (status != CIPC_OK) return status;
    if (!verify_query_kind(fn, "toi_", &kind)) {
        cipc_fail(error, CIPC_E_BAD_QUERY, lines->place, "id %ld asks %s, not a time of impact", id, fn);
        return cipc_fail_remedy(error, "name a file of cipc run --record-ccd");
    }
    status = verify_query_parse(object, fn, lines->place, &query, error);
    if (status != CIPC_OK) return status;
    if (!grow(q)) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, lines->place, "no memory for %ld queries", q->count);
    verify_ccd_query *next = &q->query[q->count++];
    verify_query_path(&query, kind, &next->path);
    next->thickness = query.thickness;
    next->scale = query.scale;
    return CIPC_OK;
}

cipc_status verify_ccd_queries_read(verify_ccd_queries *q, FILE *stream, const char *name, cipc_error *error)
{
    verify_lines lines;
    json_t *object = NULL;
    verify_lines_init(&lines, stream, name);
    cipc_status status = verify_lines_next(&lines, &object, error);
    while (status == CIPC_OK && object != NULL) {
        status = append(q, &lines, object, error);
        json_decref(object);
        object = NULL;
        if (status == CIPC_OK) status = verify_lines_next(&lines, &object, error);
    }
    if (status == CIPC_OK && lines.number == 0) status = cipc_fail(error, CIPC_E_BAD_QUERY, name, "is empty: there is no query");
    verify_lines_free(&lines);
    return status;
}
