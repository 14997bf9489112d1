/* Selecting nodes by box, by number, by nearness, or all. */
#include "scene/selection.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* Default slack of a box, as a fraction of the body's extent: hides the rounding of the transform (some 1e-16 of the coordinates), and is
 * far below the size of any triangle. */
static const double default_tolerance = 1e-9;

typedef struct box {
    double low[3], high[3];
} box;

static box bounds_of(const double *position, int count)
{
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < 3 * count; i++) {
        b.low[i % 3] = fmin(b.low[i % 3], position[i]);
        b.high[i % 3] = fmax(b.high[i % 3], position[i]);
    }
    return b;
}

/* The box in metres. A direction in which the body is flat is met by every interval that is not empty. */
static box read_box(scene_reader *r, const scene_cursor *select, const box *bounds)
{
    static const char *const keys[] = {"min", "max", "tolerance", NULL};
    static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    double low[3], high[3];
    box chosen = *bounds;
    scene_cursor member = scene_member(select, "box");
    if (!scene_is_object(r, &member, keys)) return chosen;
    scene_vector(r, &member, "min", zero, low);
    scene_vector(r, &member, "max", one, high);
    double tolerance = scene_number(r, &member, "tolerance", default_tolerance, scene_not_negative);
    for (int k = 0; k < 3; k++) {
        double extent = bounds->high[k] - bounds->low[k];
        if (low[k] > high[k])
            scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "an empty box: min %g is above max %g along axis %d", low[k], high[k], k);
        chosen.low[k] = bounds->low[k] + (low[k] - tolerance) * extent;
        chosen.high[k] = bounds->low[k] + (high[k] + tolerance) * extent;
    }
    return chosen;
}

static bool is_in(const box *b, const double x[3])
{
    return x[0] >= b->low[0] && x[0] <= b->high[0] && x[1] >= b->low[1] && x[1] <= b->high[1] && x[2] >= b->low[2] && x[2] <= b->high[2];
}

static void mark_box(scene_reader *r, const scene_cursor *select, const double *position, int count, bool *marked)
{
    box bounds = bounds_of(position, count), chosen = read_box(r, select, &bounds);
    for (int i = 0; i < count; i++) marked[i] = is_in(&chosen, position + 3 * i);
}

static void mark_listed(scene_reader *r, const scene_cursor *select, int count, bool *marked)
{
    scene_cursor list = scene_member(select, "nodes");
    if (!scene_is_array(r, &list, 0, (size_t)count)) return;
    for (size_t i = 0; i < json_array_size(list.value); i++) {
        scene_cursor element = scene_element(&list, i);
        marked[scene_integer_at(r, &element, 0, count - 1)] = true;
    }
}

/* Of equally near nodes the first. */
static void mark_nearest(scene_reader *r, const scene_cursor *select, const double *position, int count, bool *marked)
{
    scene_cursor point = scene_member(select, "nearest");
    double x[3], smallest = INFINITY;
    int nearest = 0;
    scene_vector_at(r, &point, scene_any, x);
    for (int i = 0; i < count; i++) {
        double apart[3];
        v3_sub(apart, position + 3 * i, x);
        if (v3_norm2(apart) < smallest) {
            smallest = v3_norm2(apart);
            nearest = i;
        }
    }
    marked[nearest] = true;
}

static void mark_all(scene_reader *r, const scene_cursor *select, int count, bool *marked)
{
    scene_cursor all = scene_member(select, "all");
    if (!json_is_true(all.value)) scene_reject(r, &all, CIPC_E_WRONG_TYPE, "must be true; leave the set out to select nothing");
    for (int i = 0; i < count; i++) marked[i] = true;
}

static void mark(scene_reader *r, const scene_cursor *select, const double *position, int count, bool *marked)
{
    static const char *const keys[] = {"box", "nodes", "nearest", "all", NULL};
    int ways = 0;
    if (!scene_is_object(r, select, keys)) return;
    for (int i = 0; keys[i] != NULL; i++) ways += json_object_get(select->value, keys[i]) != NULL;
    if (ways == 0)
        scene_reject(r, select, CIPC_E_MISSING_KEY, "needs one of box, nodes, nearest, all");
    else if (ways > 1)
        scene_reject(r, select, CIPC_E_OUT_OF_RANGE, "has %d of box, nodes, nearest, all, but must have one", ways);
    else if (json_object_get(select->value, "box") != NULL)
        mark_box(r, select, position, count, marked);
    else if (json_object_get(select->value, "nodes") != NULL)
        mark_listed(r, select, count, marked);
    else if (json_object_get(select->value, "nearest") != NULL)
        mark_nearest(r, select, position, count, marked);
    else
        mark_all(r, select, count, marked);
}

int scene_select_nodes(scene_reader *r, const scene_cursor *select, const double *position, int count, int *nodes)
{
    bool *marked = cipc_alloc((size_t)count, sizeof *marked);
    if (marked == NULL) {
        scene_reject_memory(r, select);
        return 0;
    }
    int chosen = 0;
    mark(r, select, position, count, marked);
    for (int i = 0; i < count; i++) {
        if (marked[i]) nodes[chosen++] = i;
    }
    cipc_free(marked);
    if (chosen == 0) scene_reject(r, select, CIPC_E_OUT_OF_RANGE, "selects none of the body's %d nodes", count);
    return chosen;
}
