/* The numbers of mass-spring cloth, and the bodies given by formulas that it collides with. */
#ifndef SCENE_MASSSPRING_H
#define SCENE_MASSSPRING_H

#include "cipc/scene.h"
#include "scene/reader.h"

/* Read the block "mass_spring", whatever the method, so that one file serves all. time_step: s, from frame to frame. */
void scene_read_massspring(scene_reader *reader, const scene_cursor *root, double time_step, cipc_massspring_options *options);
/* Read "colliders" into *scene. */
void scene_read_colliders(scene_reader *reader, const scene_cursor *root, cipc_scene *scene);
/* Reject a node of a moving body that starts inside a collider: the method takes up nodes from outside only. */
void scene_check_colliders(scene_reader *reader, const scene_cursor *root, const cipc_scene *scene);

#endif
