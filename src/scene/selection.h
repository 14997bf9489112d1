/* Which nodes of a body a Dirichlet set takes. */
#ifndef SCENE_SELECTION_H
#define SCENE_SELECTION_H

#include "scene/reader.h"

/* Bounding box; INFINITY and -INFINITY of no nodes. */
typedef struct scene_box {
    double low[3], high[3]; /* m */
} scene_box;
scene_box scene_box_of(const double *position, int count);
scene_box scene_box_around(const scene_box *a, const scene_box *b);

/* The nodes of a body at the start, and the boxes that a selection may be relative to besides the body's own. */
typedef struct scene_selectable {
    const double *position; /* 3 * count */
    int count;
    scene_box so_far; /* of all bodies up to and including this one */
    scene_box scene;  /* of all bodies */
} scene_selectable;

/* Read a "select" object and write the body-local indices of the nodes selected, ascending and unique, to `nodes` (room for count). Returns
 * how many; rejects a selection of none. */
int scene_select_nodes(scene_reader *reader, const scene_cursor *select, const scene_selectable *body, int *nodes);

#endif
