/* Density, diameter and stiffness of rods. */
#ifndef SCENE_ROD_MATERIAL_H
#define SCENE_ROD_MATERIAL_H

#include "scene/material.h"

/* In the tree the factor of bending is replaced by the modulus. */
void scene_read_rod_material(scene_reader *reader, const scene_cursor *body, const scene_material_defaults *defaults,
                             cipc_material *material);

#endif
