/* Members of a struct to JSON, and back. */
#include "output/fields.h"

#include "base/json_number.h"

static json_t *value_at(const void *at, cipc_field_type type)
{
    if (at == NULL) {
        return json_null();
    }
    if (type == CIPC_FIELD_REAL) {
        return cipc_json_number(*(const double *)at);
    }
    return json_integer(type == CIPC_FIELD_INTEGER ? *(const int *)at : *(const long *)at);
}

void cipc_fields_put(json_t *object, const cipc_field *fields, size_t count, const void *values, bool *good)
{
    for (size_t i = 0; i < count; i++) {
        const void *at = values != NULL ? (const char *)values + fields[i].offset : NULL;
        cipc_json_put(object, fields[i].key, value_at(at, fields[i].type), good);
    }
}

void cipc_fields_get(const json_t *object, const cipc_field *fields, size_t count, void *values)
{
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_object_get(object, fields[i].key);
        void *at = (char *)values + fields[i].offset;
        if (value == NULL || json_is_null(value)) {
            continue;
        }
        if (fields[i].type == CIPC_FIELD_REAL) {
            *(double *)at = cipc_json_double(value);
        } else if (fields[i].type == CIPC_FIELD_INTEGER) {
            *(int *)at = (int)json_integer_value(value);
        } else {
            *(long *)at = (long)json_integer_value(value);
        }
    }
}
