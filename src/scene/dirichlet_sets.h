/* What binds bodies: friction of pairs, Dirichlet sets and their scripted motion. */
#ifndef SCENE_CONSTRAINTS_H
#define SCENE_CONSTRAINTS_H

#include "scene/bodies.h"

/* Read "friction" into the model's table of pairs. */
void scene_read_friction(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);
/* Read "dirichlet" and append its sets to the model's. */
void scene_read_dirichlet(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);

#endif
