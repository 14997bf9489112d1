/* The bodies of a scene. */
#ifndef SCENE_BODIES_H
#define SCENE_BODIES_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* One body; `description` borrows the other members' arrays. */
typedef struct scene_body {
    cipc_body_description description;
    cipc_mesh mesh;
    double *rest, *position, *velocity;
    const char *group; /* whose bodies do not meet; NULL: none. Lives as long as the tree */
} scene_body;

typedef struct scene_bodies {
    int count;
    scene_body *bodies;
    cipc_body_description *descriptions; /* of all, in order: what cipc_model_create takes */
} scene_bodies;

void scene_bodies_free(scene_bodies *bodies);

/* Read "bodies". What is wrong with a body is rejected; free in any case. */
void scene_read_bodies(scene_reader *reader, const scene_cursor *root, unsigned long seed, bool released, scene_bodies *bodies);
/* The index of the body that the string under the cursor names; rejects unknown names with the nearest known one (and returns 0). */
int scene_find_body(scene_reader *reader, const scene_cursor *name, const scene_bodies *bodies);

#endif
