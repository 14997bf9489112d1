/* Windows of motion. */
#include "scene/motions.h"

#include <math.h>

#include "scene/transform.h"

enum { MOTIONS_MAX = 1000 };

/* Seconds from turn to turn; "never" is 0 in the model. */
static double read_turn(scene_reader *r, const scene_cursor *motion)
{
    double turn = scene_time_or_never(r, motion, "turn");
    scene_cursor member = scene_member(motion, "turn");
    if (!(turn > 0)) scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "is %g, but must be greater than 0 or \"never\"", turn);
    return isfinite(turn) ? turn : 0;
}

static void read_motion(scene_reader *r, const scene_cursor *cursor, cipc_motion *motion)
{
    static const char *const keys[] = {"begin", "end", "velocity", "angular_velocity", "axis", "center", "turn", NULL};
    static const double zero[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    if (!scene_is_object(r, cursor, keys)) return;
    motion->begin = scene_number(r, cursor, "begin", 0, scene_any);
    motion->end = scene_time_or_never(r, cursor, "end");
    scene_vector(r, cursor, "velocity", zero, motion->velocity);
    motion->angular_velocity = scene_number(r, cursor, "angular_velocity", 0, scene_any);
    scene_read_axis(r, cursor, "axis", up, motion->axis);
    scene_vector(r, cursor, "center", zero, motion->center);
    motion->turn = read_turn(r, cursor);
    scene_cursor end = scene_member(cursor, "end");
    if (!(motion->end > motion->begin))
        scene_reject(r, &end, CIPC_E_OUT_OF_RANGE, "is %g, but must be after the begin at %g", motion->end, motion->begin);
}

void scene_read_motions(scene_reader *r, const scene_cursor *set, int *count, cipc_motion **motions)
{
    *count = 0;
    *motions = NULL;
    scene_cursor list = scene_array_member(r, set, "motion");
    if (!scene_is_array(r, &list, 0, MOTIONS_MAX)) return;
    size_t size = json_array_size(list.value);
    *motions = cipc_alloc(size, sizeof **motions);
    if (*motions == NULL) {
        scene_reject_memory(r, &list);
        return;
    }
    *count = (int)size;
    for (size_t i = 0; i < size; i++) {
        scene_cursor motion = scene_element(&list, i);
        read_motion(r, &motion, &(*motions)[i]);
    }
}
