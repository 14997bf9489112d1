/* A query as a JSON object, as the conformance protocol writes it (docs/conformance.md). */
#include <string.h>

#include "base/json_number.h"
#include "cipc/verify.h"
#include "verify/query.h"
#include "verify/two_triangles.h"

json_t *verify_numbers_json(const double *values, int count)
{
    json_t *array = json_array();
    for (int i = 0; array != NULL && i < count; i++) {
        if (json_array_append_new(array, cipc_json_number(values[i])) != 0) {
            json_decref(array);
            array = NULL;
        }
    }
    return array;
}

/* "basis" of six numbers is an array, "eps" of one a number, "feature" a name. */
static json_t *params_json(const cipc_energy *energy, const double *numbers)
{
    json_t *params = json_object();
    bool good = params != NULL;
    for (int i = 0; good && i < energy->field_count; i++) {
        const cipc_energy_field *field = &energy->fields[i];
        json_t *value = field->feature       ? json_string(cipc_feature_name(CIPC_EDGE_EDGE, (int)numbers[0]))
                        : field->count == 1 ? cipc_json_number(numbers[0])
                                            : verify_numbers_json(numbers, field->count);
        cipc_json_put(params, field->name, value, &good);
        numbers += field->feature ? 1 : field->count;
    }
    if (!good) json_decref(params);
    return good ? params : NULL;
}

static void put_toi(json_t *object, const cipc_query *q, cipc_pair_kind kind, bool *good)
{
    int n = 3 * cipc_pair_nodes(kind);
    cipc_json_put(object, "x0", verify_numbers_json(q->x, n), good);
    cipc_json_put(object, q->displacement ? "p" : "x1", verify_numbers_json(q->x1, n), good);
    cipc_json_put(object, "thickness", cipc_json_number(q->thickness), good);
    cipc_json_put(object, "scale", cipc_json_number(q->scale), good);
}

static void put_potential(json_t *object, const cipc_query *q, bool *good)
{
    cipc_json_put(object, "rest", verify_numbers_json(q->rest, VERIFY_TWO_TRIANGLES_NUMBERS), good);
    cipc_json_put(object, "thickness", cipc_json_number(q->thickness), good);
    cipc_json_put(object, "dhat", cipc_json_number(q->params[VERIFY_DHAT]), good);
    cipc_json_put(object, "stiffness", cipc_json_number(q->params[VERIFY_STIFFNESS]), good);
}

bool verify_query_kind(const char *fn, const char *prefix, cipc_pair_kind *kind)
{
    size_t length = strlen(prefix);
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) {
        *kind = (cipc_pair_kind)k;
        if (strncmp(fn, prefix, length) == 0 && strcmp(fn + length, cipc_pair_name(*kind)) == 0) return true;
    }
    return false;
}

json_t *cipc_query_json(const cipc_query *q, long id)
{
    json_t *object = json_object();
    bool good = object != NULL;
    cipc_pair_kind kind;
    cipc_json_put(object, "id", json_integer(id), &good);
    cipc_json_put(object, "fn", json_string(q->fn), &good);
    if (verify_query_kind(q->fn, "toi_", &kind)) {
        put_toi(object, q, kind, &good);
    } else if (strncmp(q->fn, "energy/", 7) == 0) {
        const cipc_energy *energy = cipc_energy_find(q->fn + 7);
        cipc_json_put(object, "x", verify_numbers_json(q->x, 3 * energy->nodes), &good);
        cipc_json_put(object, "params", params_json(energy, q->params), &good);
    } else {
        cipc_json_put(object, "x", verify_numbers_json(q->x, verify_query_numbers(q->fn)), &good);
        if (verify_function_level(q->fn) == 4) put_potential(object, q, &good);
    }
    if (!good) json_decref(object);
    return good ? object : NULL;
}
