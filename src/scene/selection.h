/* Which nodes of a body a Dirichlet set takes. */
#ifndef SCENE_SELECTION_H
#define SCENE_SELECTION_H

#include "scene/reader.h"

/* Read a "select" object for a body of `count` nodes at `position` (3 * count) and write the body-local indices, ascending and unique, to
 * `nodes` (room for count). Returns how many; rejects a selection of none. */
int scene_select_nodes(scene_reader *reader, const scene_cursor *select, const double *position, int count, int *nodes);

#endif
