/* Scale, rotate, translate. */
#include "scene/transform.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* A number for all three axes, or one for each. */
static void read_scale(scene_reader *r, const scene_cursor *object, const double fallback[3], double scale[3])
{
    scene_cursor member = scene_member(object, "scale");
    if (json_is_number(member.value)) {
        scale[0] = scale[1] = scale[2] = scene_number_at(r, &member, scene_positive);
    } else if (member.value == NULL) {
        scene_vector(r, object, "scale", fallback, scale);
    } else {
        scene_vector_at(r, &member, scene_positive, scale);
    }
}

void scene_read_axis(scene_reader *r, const scene_cursor *object, const char *key, const double fallback[3], double axis[3])
{
    scene_vector(r, object, key, fallback, axis);
    double length = v3_norm(axis);
    scene_cursor member = scene_member(object, key);
    if (!(length > 0) || !isfinite(length))
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "is not a direction: its length is %g", length);
    else
        v3_scale(axis, 1 / length, axis);
}

static void read_rotation(scene_reader *r, const scene_cursor *rotation, scene_transform *t)
{
    static const char *const keys[] = {"axis", "angle", NULL};
    static const double up[3] = {0, 1, 0};
    if (!scene_is_object(r, rotation, keys)) return;
    scene_read_axis(r, rotation, "axis", up, t->rotations[t->rotation_count].axis);
    t->rotations[t->rotation_count++].angle = scene_number(r, rotation, "angle", SCENE_REQUIRED_NUMBER, scene_any);
}

static void read_rotations(scene_reader *r, const scene_cursor *transform, scene_transform *t)
{
    scene_cursor rotate = scene_member(transform, "rotate");
    if (json_is_object(rotate.value)) {
        read_rotation(r, &rotate, t);
        return;
    }
    rotate = scene_array_member(r, transform, "rotate");
    if (!scene_is_array(r, &rotate, 0, SCENE_ROTATIONS_MAX)) return;
    for (size_t i = 0; i < json_array_size(rotate.value); i++) {
        scene_cursor rotation = scene_element(&rotate, i);
        read_rotation(r, &rotation, t);
    }
}

/* A pattern fits its garment only if both are scaled alike. */
static void check_pattern_scale(scene_reader *r, const scene_cursor *body, const scene_transform *t)
{
    scene_cursor rest = scene_member(body, "rest");
    if (t->scale[0] != t->scale[1] || t->scale[0] != t->scale[2])
        scene_reject(r, &rest, CIPC_E_OUT_OF_RANGE, "is \"flat\", but a flat pattern has no directions x, y and z to scale by %g, %g and %g: one scale for all",
                     t->scale[0], t->scale[1], t->scale[2]);
}

/* "initial": the mesh after its scale; "flat": its flat pattern likewise; {"scale": ...}: the mesh after that scale, so that the body starts
 * stretched. A rest mesh is in the units of the mesh itself unless it has a scale of its own. */
static void read_rest(scene_reader *r, const scene_cursor *body, scene_transform *t)
{
    static const char *const keys[] = {"scale", "mesh", NULL};
    static const char *const kinds[] = {"initial", "flat", NULL};
    static const double one[3] = {1, 1, 1};
    scene_cursor rest = scene_member(body, "rest"), mesh = scene_member(&rest, "mesh");
    if (json_is_object(rest.value)) {
        if (scene_is_object(r, &rest, keys)) read_scale(r, &rest, mesh.value != NULL ? t->scale : one, t->rest_scale);
        return;
    }
    if (scene_choice(r, body, "rest", "rest shape", kinds, 0) == 1) check_pattern_scale(r, body, t);
    memcpy(t->rest_scale, t->scale, sizeof t->scale);
}

void scene_read_placement(scene_reader *r, const scene_cursor *object, scene_transform *t)
{
    static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    *t = (scene_transform){.scale = {1, 1, 1}, .rest_scale = {1, 1, 1}};
    read_scale(r, object, one, t->scale);
    read_rotations(r, object, t);
    scene_vector(r, object, "translate", zero, t->translate);
}

void scene_read_transform(scene_reader *r, const scene_cursor *body, scene_transform *t)
{
    static const char *const keys[] = {"scale", "rotate", "translate", NULL};
    *t = (scene_transform){.scale = {1, 1, 1}, .rest_scale = {1, 1, 1}};
    scene_cursor transform = scene_object_member(r, body, "transform");
    if (!scene_is_object(r, &transform, keys)) return;
    scene_read_placement(r, &transform, t);
    read_rest(r, body, t);
}

/* Rodrigues' formula: x cos + (axis x x) sin + axis (axis . x) (1 - cos). */
static void rotate_point(double x[3], const double axis[3], double angle)
{
    double cosine = cos(angle), sine = sin(angle), along = v3_dot(axis, x) * (1 - cosine), across[3];
    v3_cross(across, axis, x);
    for (int k = 0; k < 3; k++) x[k] = x[k] * cosine + across[k] * sine + axis[k] * along;
}

void scene_place_nodes(const scene_transform *t, const double *nodes, int count, double *position)
{
    for (int i = 0; i < count; i++) {
        double *y = position + 3 * i;
        for (int k = 0; k < 3; k++) y[k] = t->scale[k] * nodes[3 * i + k];
        for (int n = 0; n < t->rotation_count; n++) rotate_point(y, t->rotations[n].axis, t->rotations[n].angle);
        v3_add(y, y, t->translate);
    }
}

void scene_rest_nodes(const scene_transform *t, const double *nodes, int count, double *rest)
{
    for (int i = 0; i < 3 * count; i++) rest[i] = t->rest_scale[i % 3] * nodes[i];
}
