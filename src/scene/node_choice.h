/* The nodes of a body that an entry of the scene chooses by its "select": a Dirichlet set, a load. */
#ifndef SCENE_NODE_CHOICE_H
#define SCENE_NODE_CHOICE_H

#include "scene/bodies.h"
#include "scene/selection.h"

typedef struct scene_node_choice {
    const scene_bodies *bodies;
    scene_box *so_far; /* of each body and those before it; owned */
} scene_node_choice;

/* False and a rejection at the cursor if there is no memory. */
bool scene_node_choice_init(scene_node_choice *choice, scene_reader *reader, const scene_cursor *cursor, const scene_bodies *bodies);
void scene_node_choice_free(scene_node_choice *choice);

/* The nodes that "select" of the entry takes of a body, in the body's own numbering, ascending; the caller frees them. NULL: rejected. */
int *scene_choose_nodes(const scene_node_choice *choice, scene_reader *reader, const scene_cursor *entry, int body, int *count);

#endif
