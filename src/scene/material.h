/* Density, size, stiffness, limits and damping of a body of any kind. */
#ifndef SCENE_MATERIAL_H
#define SCENE_MATERIAL_H

#include "cipc/model.h"
#include "scene/reader.h"

/* What a body without numbers of its own gets. */
typedef struct scene_material_defaults {
    bool optional;             /* nothing need be given (fixed bodies) */
    double density, thickness; /* then used; the thickness as diameter of rods and particles too */
    bool released;             /* the hinge constant and the volume model of the released code */
} scene_material_defaults;

/* Read a body's material; in the tree names and factors are replaced by the numbers they stand for. */
void scene_read_material(scene_reader *reader, const scene_cursor *body, cipc_body_kind kind, const scene_material_defaults *defaults,
                         cipc_material *material);

/* ---- for the readers of the kinds ---- */

extern const scene_range scene_factor_range; /* of what multiplies a modulus */

/* Density, and the thickness or diameter under `size_key`, where the body does not say them: NAN stands for "must be given". */
void scene_read_density(scene_reader *reader, const scene_cursor *body, const char *size_key, double density, double size,
                        cipc_material *material);
/* A factor multiplies a modulus that comes from elsewhere: without that (base NULL) or beside `part`.young, it would be ignored. 1 if absent. */
double scene_read_factor(scene_reader *reader, const scene_cursor *body, const char *key, const char *part, const char *base);

#endif
