/* What pairs of bodies do to each other: friction, and whether they meet at all. */
#ifndef SCENE_PAIRS_H
#define SCENE_PAIRS_H

#include "scene/bodies.h"

/* Read "friction" into the model's table of pairs. */
void scene_read_friction(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);
/* Read "collisions", and let the bodies of each group pass through one another unless "collisions" says of a pair that it meets. */
void scene_read_collisions(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);

#endif
