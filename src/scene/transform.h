/* Placing a body: scale, then rotate, then translate. */
#ifndef SCENE_TRANSFORM_H
#define SCENE_TRANSFORM_H

#include "scene/reader.h"

enum { SCENE_ROTATIONS_MAX = 8 };

typedef struct scene_transform {
    double scale[3];
    double rest_scale[3]; /* of the rest shape: scale, unless the scene says otherwise */
    int rotation_count;
    struct {
        double axis[3], angle;
    } rotations[SCENE_ROTATIONS_MAX]; /* applied in order; axes of unit length; radians */
    double translate[3];              /* m */
} scene_transform;

/* Read "scale", "rotate" and "translate" of an object. */
void scene_read_placement(scene_reader *reader, const scene_cursor *object, scene_transform *transform);
/* Read "transform" of a body, and the scale of its "rest". */
void scene_read_transform(scene_reader *reader, const scene_cursor *body, scene_transform *transform);
/* A direction that must not vanish, made a unit vector. */
void scene_read_axis(scene_reader *reader, const scene_cursor *object, const char *key, const double fallback[3], double axis[3]);

/* count nodes of a mesh -> start positions (3 * count). */
void scene_place_nodes(const scene_transform *transform, const double *nodes, int count, double *position);
/* count nodes of a mesh -> rest shape (3 * count). Rigid parts do not enter it. */
void scene_rest_nodes(const scene_transform *transform, const double *nodes, int count, double *rest);

#endif
