/* What queries are made of, for the files of this room. */
#ifndef CIPC_VERIFY_QUERY_H
#define CIPC_VERIFY_QUERY_H

#include "cipc/verify.h"

/* An array of numbers, a new reference; NULL: out of memory. */
json_t *verify_numbers_json(const double *values, int count);
/* Is fn the prefix followed by the name of a pair kind? */
bool verify_query_kind(const char *fn, const char *prefix, cipc_pair_kind *kind);
/* How many numbers the field "x" of a function has that is neither a time of impact nor an energy. */
int verify_query_numbers(const char *fn);
/* The function table's own string of that name, NULL: no such function. */
const char *verify_function_name(const char *name);
enum { VERIFY_FUNCTION_LIMIT = 64 };
int verify_function_count(void);
const char *verify_function_at(int index);
/* 0 scalars, 1 stencils, 2 elements, 3 continuous collision detection, 4 assembled potential (docs/conformance.md). fn: the table's own string, here and below. */
enum { VERIFY_HIGHEST_LEVEL = 4 };
int verify_function_level(const char *fn);

/* Numbers of an array field; the inverse of cipc_query_json. fn: the table's own string. place: for messages. CIPC_E_BAD_QUERY with the field and what is wrong. */
cipc_status verify_read_numbers(const json_t *value, const char *place, const char *field, int count, double *numbers, cipc_error *error);
cipc_status verify_query_parse(const json_t *object, const char *fn, const char *place, cipc_query *query, cipc_error *error);

#endif
