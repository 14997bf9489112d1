/* Selecting nodes by box, by number, by nearness, at an end, or all. */
#include "scene/selection.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "scene/alternatives.h"
#include "scene/transform.h"

/* Default slack of a box or ring, as a fraction of the extent: hides the rounding of the transform (some 1e-16 of the coordinates), and is
 * far below the size of any triangle. */
static const double default_tolerance = 1e-9;

scene_box scene_box_of(const double *position, int count)
{
    scene_box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < 3 * count; i++) {
        b.low[i % 3] = fmin(b.low[i % 3], position[i]);
        b.high[i % 3] = fmax(b.high[i % 3], position[i]);
    }
    return b;
}

scene_box scene_box_around(const scene_box *a, const scene_box *b)
{
    scene_box around;
    for (int k = 0; k < 3; k++) {
        around.low[k] = fmin(a->low[k], b->low[k]);
        around.high[k] = fmax(a->high[k], b->high[k]);
    }
    return around;
}

static scene_box read_bounds(scene_reader *r, const scene_cursor *box, const scene_selectable *body)
{
    static const char *const names[] = {"body", "so-far", "scene", NULL};
    const scene_box bounds[] = {scene_box_of(body->position, body->count), body->so_far, body->scene};
    return bounds[scene_choice(r, box, "relative_to", "bounding box", names, 0)];
}

/* The box in metres. A direction in which the bounds are flat is met by every interval that is not empty. */
static scene_box read_box(scene_reader *r, const scene_cursor *member, const scene_selectable *body)
{
    static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    double low[3], high[3];
    scene_box bounds = read_bounds(r, member, body), chosen = bounds;
    scene_vector(r, member, "min", zero, low);
    scene_vector(r, member, "max", one, high);
    double tolerance = scene_number(r, member, "tolerance", default_tolerance, scene_not_negative);
    for (int k = 0; k < 3; k++) {
        double extent = bounds.high[k] - bounds.low[k];
        if (low[k] > high[k])
            scene_reject(r, member, CIPC_E_OUT_OF_RANGE, "an empty box: min %g is above max %g along axis %d", low[k], high[k], k);
        chosen.low[k] = bounds.low[k] + (low[k] - tolerance) * extent;
        chosen.high[k] = bounds.low[k] + (high[k] + tolerance) * extent;
    }
    return chosen;
}

static bool is_in(const scene_box *b, const double x[3])
{
    return x[0] >= b->low[0] && x[0] <= b->high[0] && x[1] >= b->low[1] && x[1] <= b->high[1] && x[2] >= b->low[2] && x[2] <= b->high[2];
}

static void mark_box(scene_reader *r, const scene_cursor *box, const scene_selectable *body, bool *marked)
{
    static const char *const keys[] = {"min", "max", "tolerance", "relative_to", NULL};
    if (!scene_is_object(r, box, keys)) return;
    scene_box chosen = read_box(r, box, body);
    for (int i = 0; i < body->count; i++) marked[i] = is_in(&chosen, body->position + 3 * i);
}

/* The nodes at one end of the body along a direction: those of a cylinder's last ring, of a solid's last face. */
static void mark_ring(scene_reader *r, const scene_cursor *ring, const scene_selectable *body, bool *marked)
{
    static const char *const keys[] = {"axis", "end", "tolerance", NULL}, *const ends[] = {"min", "max", NULL};
    static const double along_x[3] = {1, 0, 0};
    double axis[3], end = -INFINITY, other = INFINITY;
    if (!scene_is_object(r, ring, keys)) return;
    scene_read_axis(r, ring, "axis", along_x, axis);
    if (scene_choice(r, ring, "end", "end", ends, SCENE_REQUIRED) == 0) v3_scale(axis, -1, axis);
    double tolerance = scene_number(r, ring, "tolerance", default_tolerance, scene_not_negative);
    for (int i = 0; i < body->count; i++) {
        double along = v3_dot(axis, body->position + 3 * i);
        end = fmax(end, along);
        other = fmin(other, along);
    }
    for (int i = 0; i < body->count; i++) marked[i] = v3_dot(axis, body->position + 3 * i) >= end - tolerance * (end - other);
}

static void mark_listed(scene_reader *r, const scene_cursor *list, int count, bool *marked)
{
    if (!scene_is_array(r, list, 0, (size_t)count)) return;
    for (size_t i = 0; i < json_array_size(list->value); i++) {
        scene_cursor element = scene_element(list, i);
        marked[scene_integer_at(r, &element, 0, count - 1)] = true;
    }
}

/* Of equally near nodes the first. */
static void mark_nearest(scene_reader *r, const scene_cursor *point, const double *position, int count, bool *marked)
{
    double x[3], smallest = INFINITY;
    int nearest = 0;
    scene_vector_at(r, point, scene_any, x);
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

static void mark_all(scene_reader *r, const scene_cursor *all, int count, bool *marked)
{
    if (!json_is_true(all->value)) scene_reject(r, all, CIPC_E_WRONG_TYPE, "must be true; leave the set out to select nothing");
    for (int i = 0; i < count; i++) marked[i] = true;
}

static void mark(scene_reader *r, const scene_cursor *select, const scene_selectable *body, bool *marked)
{
    enum { BOX, NODES, NEAREST, RING, ALL };
    static const char *const keys[] = {"box", "nodes", "nearest", "ring", "all", NULL};
    if (!scene_is_object(r, select, keys)) return;
    int way = scene_one_of(r, select, keys);
    if (way < 0) return;
    scene_cursor member = scene_member(select, keys[way]);
    if (way == BOX)
        mark_box(r, &member, body, marked);
    else if (way == NODES)
        mark_listed(r, &member, body->count, marked);
    else if (way == NEAREST)
        mark_nearest(r, &member, body->position, body->count, marked);
    else if (way == RING)
        mark_ring(r, &member, body, marked);
    else
        mark_all(r, &member, body->count, marked);
}

int scene_select_nodes(scene_reader *r, const scene_cursor *select, const scene_selectable *body, int *nodes)
{
    bool *marked = cipc_alloc((size_t)body->count, sizeof *marked);
    if (marked == NULL) {
        scene_reject_memory(r, select);
        return 0;
    }
    int chosen = 0;
    mark(r, select, body, marked);
    for (int i = 0; i < body->count; i++) {
        if (marked[i]) nodes[chosen++] = i;
    }
    cipc_free(marked);
    if (chosen == 0) scene_reject(r, select, CIPC_E_OUT_OF_RANGE, "selects none of the body's %d nodes", body->count);
    return chosen;
}
