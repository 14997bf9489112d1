/* A table of the members of a struct and of the keys that they have in JSON: one table for both directions. */
#ifndef OUTPUT_FIELDS_H
#define OUTPUT_FIELDS_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

typedef enum cipc_field_type { CIPC_FIELD_INTEGER, CIPC_FIELD_LONG, CIPC_FIELD_REAL } cipc_field_type;
typedef struct cipc_field {
    const char *key;
    cipc_field_type type;
    size_t offset; /* of the member in its struct */
} cipc_field;

/* values NULL: every field becomes null. */
void cipc_fields_put(json_t *object, const cipc_field *fields, size_t count, const void *values, bool *good);
/* Fields that are missing or null leave the value as it is. */
void cipc_fields_get(const json_t *object, const cipc_field *fields, size_t count, void *values);

#endif
