/* What is sewn together. */
#ifndef SCENE_SEAMS_H
#define SCENE_SEAMS_H

#include "scene/bodies.h"

/* Read "stitches" and add them to the model. */
void scene_read_stitches(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, cipc_model *model);

#endif
