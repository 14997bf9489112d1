/* The same body again, each time turned and moved a little further. */
#include "scene/copies.h"

#include "scene/transform.h"

void scene_read_copies(scene_reader *r, const scene_cursor *body, scene_copies *copies)
{
    static const char *const keys[] = {"count", "translate", "rotate", NULL}, *const rotate_keys[] = {"axis", "angle", NULL};
    static const double zero[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    *copies = (scene_copies){.axis = {0, 1, 0}};
    scene_cursor cursor = scene_member(body, "copies");
    if (cursor.value == NULL || !scene_is_object(r, &cursor, keys)) return;
    copies->count = scene_integer(r, &cursor, "count", SCENE_REQUIRED, 1, SCENE_COPIES_MAX);
    scene_vector(r, &cursor, "translate", zero, copies->translate);
    scene_cursor rotate = scene_object_member(r, &cursor, "rotate");
    if (!scene_is_object(r, &rotate, rotate_keys)) return;
    scene_read_axis(r, &rotate, "axis", up, copies->axis);
    copies->angle = scene_number(r, &rotate, "angle", 0, scene_any);
}

void scene_place_copy(const scene_copies *copies, int i, const double *position, int node_count, double *copy)
{
    scene_transform t = {.scale = {1, 1, 1}, .rotation_count = i > 0 && copies->angle != 0};
    t.rotations[0].angle = i * copies->angle;
    for (int k = 0; k < 3; k++) {
        t.rotations[0].axis[k] = copies->axis[k];
        t.translate[k] = i * copies->translate[k];
    }
    scene_place_nodes(&t, position, node_count, copy);
}
