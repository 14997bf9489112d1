/* Density, thickness, stiffness and limits of a shell. */
#ifndef SCENE_SHELL_MATERIAL_H
#define SCENE_SHELL_MATERIAL_H

#include "scene/material.h"

/* In the tree the names of material and fabric and the factors are replaced by the numbers they stand for. */
void scene_read_shell_material(scene_reader *reader, const scene_cursor *body, const scene_material_defaults *defaults,
                               cipc_material *material);

#endif
