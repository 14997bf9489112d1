/* Density, thickness, stiffness and limits of a body. */
#ifndef SCENE_SHELL_MATERIAL_H
#define SCENE_SHELL_MATERIAL_H

#include "cipc/model.h"
#include "scene/reader.h"

/* What a body without numbers of its own gets. */
typedef struct scene_material_defaults {
    bool optional;             /* density, thickness, membrane and bending may be left out (fixed bodies) */
    double density, thickness; /* then used */
    bool released;             /* the hinge constant of the released code */
} scene_material_defaults;

/* Read a body's material; in the tree the name and the factors are replaced by the numbers they stand for. */
void scene_read_material(scene_reader *reader, const scene_cursor *body, const scene_material_defaults *defaults,
                         cipc_material *material);

#endif
