/* A query from a JSON object: every field there, of the right length and kind, or one clear sentence why not. */
#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "base/vector.h"
#include "verify/query.h"
#include "verify/two_triangles.h"

static cipc_status refuse(const char *place, cipc_error *error, const char *field, const char *what)
{
    return cipc_fail(error, CIPC_E_BAD_QUERY, place, "field \"%s\" %s", field, what);
}

cipc_status verify_read_numbers(const json_t *value, const char *place, const char *field, int count, double *numbers, cipc_error *error)
{
    char what[96];
    snprintf(what, sizeof what, "must be an array of %d numbers", count);
    if (value == NULL) return refuse(place, error, field, "is missing");
    if (!json_is_array(value) || json_array_size(value) != (size_t)count) return refuse(place, error, field, what);
    for (int i = 0; i < count; i++) {
        const json_t *item = json_array_get(value, (size_t)i);
        numbers[i] = cipc_json_double(item);
        if (!isfinite(numbers[i])) return refuse(place, error, field, "holds something that is not a finite number");
    }
    return CIPC_OK;
}

static cipc_status read_number(const json_t *value, const char *place, const char *field, double *number, cipc_error *error)
{
    if (value == NULL) return refuse(place, error, field, "is missing");
    *number = cipc_json_double(value);
    return isfinite(*number) ? CIPC_OK : refuse(place, error, field, "is not a finite number");
}

/* xi and s have defaults: no thickness, a tenth. */
static cipc_status read_toi(const json_t *object, cipc_pair_kind kind, const char *place, cipc_query *q, cipc_error *error)
{
    int n = 3 * cipc_pair_nodes(kind);
    const json_t *thickness = json_object_get(object, "thickness"), *scale = json_object_get(object, "scale"), *p = json_object_get(object, "p");
    q->displacement = p != NULL;
    q->thickness = 0;
    q->scale = 0.1;
    cipc_status status = verify_read_numbers(json_object_get(object, "x0"), place, "x0", n, q->x, error);
    if (status == CIPC_OK) status = verify_read_numbers(p != NULL ? p : json_object_get(object, "x1"), place, p != NULL ? "p" : "x1", n, q->x1, error);
    if (status == CIPC_OK && thickness != NULL) status = read_number(thickness, place, "thickness", &q->thickness, error);
    if (status == CIPC_OK && scale != NULL) status = read_number(scale, place, "scale", &q->scale, error);
    if (status == CIPC_OK && q->thickness < 0) status = refuse(place, error, "thickness", "is negative");
    if (status == CIPC_OK && !(q->scale > 0 && q->scale < 1)) status = refuse(place, error, "scale", "is not between 0 and 1");
    return status;
}

static bool has_area(const double rest[9])
{
    double a[3], b[3], n[3];
    v3_sub(a, rest + 3, rest);
    v3_sub(b, rest + 6, rest);
    v3_cross(n, a, b);
    return v3_norm2(n) > 0;
}

/* The thickness has a default: none. */
static cipc_status read_potential(const json_t *object, const char *place, cipc_query *q, cipc_error *error)
{
    const json_t *thickness = json_object_get(object, "thickness");
    cipc_status status = verify_read_numbers(json_object_get(object, "x"), place, "x", VERIFY_TWO_TRIANGLES_NUMBERS, q->x, error);
    if (status == CIPC_OK) status = verify_read_numbers(json_object_get(object, "rest"), place, "rest", VERIFY_TWO_TRIANGLES_NUMBERS, q->rest, error);
    if (status == CIPC_OK) status = read_number(json_object_get(object, "dhat"), place, "dhat", &q->params[VERIFY_DHAT], error);
    if (status == CIPC_OK) status = read_number(json_object_get(object, "stiffness"), place, "stiffness", &q->params[VERIFY_STIFFNESS], error);
    if (status == CIPC_OK && thickness != NULL) status = read_number(thickness, place, "thickness", &q->thickness, error);
    if (status == CIPC_OK && q->thickness < 0) status = refuse(place, error, "thickness", "is negative");
    if (status == CIPC_OK && !(q->params[VERIFY_DHAT] > 0)) status = refuse(place, error, "dhat", "is not positive");
    if (status == CIPC_OK && !(q->params[VERIFY_STIFFNESS] > 0)) status = refuse(place, error, "stiffness", "is not positive");
    if (status == CIPC_OK && !(has_area(q->rest) && has_area(q->rest + 9))) status = refuse(place, error, "rest", "holds a triangle without area");
    return status;
}

static int feature_named(const char *name)
{
    for (int i = 0; name != NULL && i < cipc_feature_count(CIPC_EDGE_EDGE); i++)
        if (strcmp(name, cipc_feature_name(CIPC_EDGE_EDGE, i)) == 0) return i;
    return -1;
}

static cipc_status read_energy(const json_t *object, const cipc_energy *energy, const char *place, cipc_query *q, cipc_error *error)
{
    const json_t *params = json_object_get(object, "params");
    double *numbers = q->params;
    cipc_status status = verify_read_numbers(json_object_get(object, "x"), place, "x", 3 * energy->nodes, q->x, error);
    if (status == CIPC_OK && !json_is_object(params)) status = refuse(place, error, "params", "is missing or no object");
    for (int i = 0; i < energy->field_count && status == CIPC_OK; i++) {
        const cipc_energy_field *field = &energy->fields[i];
        const json_t *value = json_object_get(params, field->name);
        char name[64];
        snprintf(name, sizeof name, "params.%s", field->name);
        if (field->feature) {
            int feature = feature_named(json_string_value(value));
            *numbers = feature;
            if (feature < 0) status = refuse(place, error, name, "is no feature of two edges");
        } else {
            status = field->count == 1 ? read_number(value, place, name, numbers, error) : verify_read_numbers(value, place, name, field->count, numbers, error);
        }
        numbers += field->count;
    }
    return status;
}

cipc_status verify_query_parse(const json_t *object, const char *fn, const char *place, cipc_query *q, cipc_error *error)
{
    cipc_pair_kind kind;
    memset(q, 0, sizeof *q);
    q->fn = fn;
    if (verify_query_kind(fn, "toi_", &kind)) return read_toi(object, kind, place, q, error);
    if (verify_function_level(fn) == 4) return read_potential(object, place, q, error);
    if (strncmp(fn, "energy/", 7) == 0) return read_energy(object, cipc_energy_find(fn + 7), place, q, error);
    return verify_read_numbers(json_object_get(object, "x"), place, "x", verify_query_numbers(fn), q->x, error);
}
