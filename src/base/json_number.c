/* Doubles in JSON. */
#include "base/json_number.h"

#include <math.h>
#include <string.h>

json_t *cipc_json_number(double value)
{
    if (isnan(value)) {
        return json_string("nan");
    }
    if (isinf(value)) {
        return json_string(value > 0 ? "inf" : "-inf");
    }
    return json_real(value);
}

double cipc_json_double(const json_t *value)
{
    if (json_is_number(value)) {
        return json_number_value(value);
    }
    const char *text = json_string_value(value);
    if (text != NULL && strcmp(text, "inf") == 0) {
        return INFINITY;
    }
    if (text != NULL && strcmp(text, "-inf") == 0) {
        return -INFINITY;
    }
    return NAN;
}

void cipc_json_put(json_t *object, const char *key, json_t *value, bool *good)
{
    if (json_object_set_new(object, key, value) != 0) {
        *good = false;
    }
}
