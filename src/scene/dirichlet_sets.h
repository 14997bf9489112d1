/* Nodes that are held or moved. */
#ifndef SCENE_DIRICHLET_SETS_H
#define SCENE_DIRICHLET_SETS_H

#include "scene/bodies.h"

/* Read "dirichlet" and append its sets to the model's. */
void scene_read_dirichlet(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);

#endif
