/* Reading arrays, element by element, so that an error names the element. */
#include "scene/lists.h"

/* The array under a key. False if it is missing, or not an array of so many elements. */
static bool find_array(scene_reader *r, const scene_cursor *member, const char *of, size_t minimum, size_t maximum)
{
    if (member->value == NULL && minimum == maximum)
        scene_reject(r, member, CIPC_E_MISSING_KEY, "required, but missing: an array of %zu %s", minimum, of);
    else if (member->value == NULL)
        scene_reject(r, member, CIPC_E_MISSING_KEY, "required, but missing: an array of %s", of);
    return scene_is_array(r, member, minimum, maximum);
}

void scene_numbers(scene_reader *r, const scene_cursor *object, const char *key, size_t count, scene_range range, double *values)
{
    scene_cursor member = scene_member(object, key);
    for (size_t i = 0; i < count; i++) values[i] = 0;
    if (!find_array(r, &member, "numbers", count, count)) return;
    for (size_t i = 0; i < count; i++) {
        scene_cursor element = scene_element(&member, i);
        values[i] = scene_number_at(r, &element, range);
    }
}

void scene_integers(scene_reader *r, const scene_cursor *object, const char *key, size_t count, int lower, int upper, int *values)
{
    scene_cursor member = scene_member(object, key);
    for (size_t i = 0; i < count; i++) values[i] = 0;
    if (!find_array(r, &member, "integers", count, count)) return;
    for (size_t i = 0; i < count; i++) {
        scene_cursor element = scene_element(&member, i);
        values[i] = scene_integer_at(r, &element, lower, upper);
    }
}

static void read_point(scene_reader *r, const scene_cursor *point, size_t dimension, double *values)
{
    if (!scene_is_array(r, point, dimension, dimension)) return;
    for (size_t k = 0; k < dimension; k++) {
        scene_cursor coordinate = scene_element(point, k);
        values[k] = scene_number_at(r, &coordinate, scene_any);
    }
}

double *scene_points_at(scene_reader *r, const scene_cursor *list, size_t dimension, size_t minimum, size_t maximum, int *count)
{
    *count = 0;
    if (!find_array(r, list, "points", minimum, maximum)) return NULL;
    size_t points = json_array_size(list->value);
    double *values = cipc_alloc(dimension * points, sizeof *values);
    if (values == NULL) scene_reject_memory(r, list);
    for (size_t i = 0; i < points && r->status == CIPC_OK; i++) {
        scene_cursor point = scene_element(list, i);
        read_point(r, &point, dimension, values + dimension * i);
    }
    if (r->status == CIPC_OK) {
        *count = (int)points;
        return values;
    }
    cipc_free(values);
    return NULL;
}

double *scene_points(scene_reader *r, const scene_cursor *object, const char *key, size_t dimension, size_t minimum, size_t maximum,
                     int *count)
{
    scene_cursor member = scene_member(object, key);
    return scene_points_at(r, &member, dimension, minimum, maximum, count);
}

int *scene_integer_list(scene_reader *r, const scene_cursor *object, const char *key, int lower, int upper, size_t minimum, size_t maximum,
                        int *count)
{
    scene_cursor member = scene_member(object, key);
    *count = 0;
    if (!find_array(r, &member, "integers", minimum, maximum)) return NULL;
    size_t size = json_array_size(member.value);
    int *values = cipc_alloc(size, sizeof *values);
    if (values == NULL) scene_reject_memory(r, &member);
    for (size_t i = 0; i < size && r->status == CIPC_OK; i++) {
        scene_cursor element = scene_element(&member, i);
        values[i] = scene_integer_at(r, &element, lower, upper);
    }
    if (r->status == CIPC_OK) {
        *count = (int)size;
        return values;
    }
    cipc_free(values);
    return NULL;
}
