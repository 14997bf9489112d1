/* Doubles in JSON: 17 significant digits, and the three values that JSON has no number for as strings. */
#ifndef BASE_JSON_NUMBER_H
#define BASE_JSON_NUMBER_H

#include <jansson.h>
#include <stdbool.h>

/* A number; "inf", "-inf" or "nan". NULL: out of memory. */
json_t *cipc_json_number(double value);
/* The double that such a value stands for (integers too); NAN for anything else. */
double cipc_json_double(const json_t *value);

/* object[key] = value, of which the object becomes the owner; *good becomes false if that fails (or value is NULL), else stays. */
void cipc_json_put(json_t *object, const char *key, json_t *value, bool *good);

/* How all files of cipc are written: reals so that they read back to the same bits. */
#define CIPC_JSON_FORMAT (JSON_REAL_PRECISION(17))

#endif
