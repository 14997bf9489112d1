/* Which method takes the steps, and what it cannot do. */
#ifndef SCENE_METHOD_H
#define SCENE_METHOD_H

#include "scene/bodies.h"

/* Read "method". */
cipc_method scene_read_method(scene_reader *reader, const scene_cursor *root);
/* Reject what the scene asks for and its method does not know, there where the scene asks for it: nothing is left out silently. */
void scene_check_method(scene_reader *reader, const scene_cursor *root, const scene_bodies *bodies, const cipc_scene *scene);

#endif
