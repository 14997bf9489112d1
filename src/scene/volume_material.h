/* Density and stiffness of volumes. */
#ifndef SCENE_VOLUME_MATERIAL_H
#define SCENE_VOLUME_MATERIAL_H

#include "scene/material.h"

void scene_read_volume_material(scene_reader *reader, const scene_cursor *body, const scene_material_defaults *defaults,
                                cipc_material *material);

#endif
