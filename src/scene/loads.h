/* Forces on nodes. */
#ifndef SCENE_LOADS_H
#define SCENE_LOADS_H

#include "scene/bodies.h"

/* Read "loads" and append them to the model's. */
void scene_read_loads(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);

#endif
