/* The bodies of a scene. */
#ifndef SCENE_BODIES_H
#define SCENE_BODIES_H

#include <stdbool.h>

#include "cipc/scene.h"
#include "scene/reader.h"

/* One body; `description` borrows the other members' arrays, and those of the first copy where a copy has none of its own. */
typedef struct scene_body {
    cipc_body_description description;
    cipc_mesh mesh;                        /* empty: a copy */
    double *rest, *position, *velocity;    /* rest is NULL for a copy */
    const char *group; /* whose bodies do not meet; NULL: none. Lives as long as the tree */
} scene_body;

/* An element of "bodies": itself, or its copies, which are called NAME-1, NAME-2, ... */
typedef struct scene_body_entry {
    char name[CIPC_NAME_SIZE];
    int first, count;
    bool copied; /* has "copies": the name is that of them all */
} scene_body_entry;

typedef struct scene_bodies {
    int entry_count;
    scene_body_entry *entries;
    int count;
    scene_body *bodies;
    cipc_body_description *descriptions; /* of all, in order: what cipc_model_create takes */
} scene_bodies;

void scene_bodies_free(scene_bodies *bodies);

/* Read "bodies". What is wrong with a body is rejected; free in any case. */
void scene_read_bodies(scene_reader *reader, const scene_cursor *root, unsigned long seed, bool released, scene_bodies *bodies);
/* The mesh of a body; that of the first for all copies. */
const cipc_mesh *scene_mesh_of(const scene_bodies *bodies, int body);
/* The element of the scene's list that a body comes from. */
int scene_entry_of(const scene_bodies *bodies, int body);
/* The index of the body that the string under the cursor names; rejects unknown names with the nearest known one (and returns 0). */
int scene_find_body(scene_reader *reader, const scene_cursor *name, const scene_bodies *bodies);
/* The same where all copies of a body may be meant: bodies first to first + count - 1 (count 0: rejected). */
int scene_find_bodies(scene_reader *reader, const scene_cursor *name, const scene_bodies *bodies, int *count);

#endif
