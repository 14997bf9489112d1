/* A pair in contact to JSON, and back. */
#include "output/contact_place.h"

#include <string.h>

#include "base/json_number.h"

json_t *cipc_contact_place_object(const cipc_contact_place *place, bool *good)
{
    if (place->layers == 0) {
        return json_null();
    }
    json_t *object = json_object(), *nodes = json_array();
    for (int i = 0; i < 4 && place->nodes[i] >= 0; i++) {
        json_array_append_new(nodes, json_integer(place->nodes[i]));
    }
    cipc_json_put(object, "kind", json_string(cipc_pair_name(place->kind)), good);
    cipc_json_put(object, "nodes", nodes, good);
    cipc_json_put(object, "gap", cipc_json_number(place->gap), good);
    cipc_json_put(object, "layers", json_integer(place->layers), good);
    cipc_json_put(object, "step", cipc_json_number(place->step), good);
    return object;
}

static cipc_pair_kind kind_of(const char *name)
{
    for (int k = 0; name != NULL && k < CIPC_PAIR_KIND_COUNT; k++) {
        if (strcmp(cipc_pair_name((cipc_pair_kind)k), name) == 0) {
            return (cipc_pair_kind)k;
        }
    }
    return CIPC_POINT_POINT;
}

cipc_contact_place cipc_contact_place_of(const json_t *object)
{
    cipc_contact_place place = {.nodes = {-1, -1, -1, -1}};
    const json_t *nodes = json_object_get(object, "nodes");
    place.layers = (int)json_integer_value(json_object_get(object, "layers"));
    if (place.layers == 0) {
        return place;
    }
    for (size_t i = 0; i < 4 && i < json_array_size(nodes); i++) {
        place.nodes[i] = (int)json_integer_value(json_array_get(nodes, i));
    }
    place.kind = kind_of(json_string_value(json_object_get(object, "kind")));
    place.gap = cipc_json_double(json_object_get(object, "gap"));
    place.step = cipc_json_double(json_object_get(object, "step"));
    return place;
}
