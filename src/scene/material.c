/* The material of a body by its kind. */
#include "scene/material.h"

#include "scene/rod_material.h"
#include "scene/shell_material.h"
#include "scene/volume_material.h"

const scene_range scene_factor_range = {0, 1e12, false, false}; /* keeps the product finite */

void scene_read_density(scene_reader *r, const scene_cursor *body, const char *size_key, double density, double size, cipc_material *m)
{
    m->density = scene_number(r, body, "density", density, scene_positive);
    m->thickness = scene_number(r, body, size_key, size, scene_positive);
}

double scene_read_factor(scene_reader *r, const scene_cursor *body, const char *key, const char *part, const char *base)
{
    scene_cursor factor = scene_member(body, key);
    if (factor.value == NULL) return 1;
    if (base == NULL) scene_reject(r, &factor, CIPC_E_MISSING_KEY, "multiplies the modulus of a named material, but there is no 'material'");
    if (json_object_get(json_object_get(body->value, part), "young") != NULL) {
        scene_reject(r, &factor, CIPC_E_OUT_OF_RANGE, "cannot stand beside %s.young, which says the modulus itself", part);
    }
    return scene_number_at(r, &factor, scene_factor_range);
}

static void read_damping(scene_reader *r, const scene_cursor *body, cipc_material *m)
{
    static const char *const keys[] = {"stiffness", "mass", NULL};
    scene_cursor damping = scene_object_member(r, body, "damping");
    if (!scene_is_object(r, &damping, keys)) return;
    m->damping_stiffness = scene_number(r, &damping, "stiffness", 0, scene_not_negative);
    m->damping_mass = scene_number(r, &damping, "mass", 0, scene_not_negative);
}

void scene_read_material(scene_reader *r, const scene_cursor *body, cipc_body_kind kind, const scene_material_defaults *defaults,
                         cipc_material *m)
{
    double density = defaults->optional ? defaults->density : SCENE_REQUIRED_NUMBER;
    double diameter = defaults->optional ? defaults->thickness : SCENE_REQUIRED_NUMBER;
    *m = (cipc_material){0};
    if (kind == CIPC_BODY_SHELL)
        scene_read_shell_material(r, body, defaults, m);
    else if (kind == CIPC_BODY_RODS)
        scene_read_rod_material(r, body, defaults, m);
    else if (kind == CIPC_BODY_VOLUME)
        scene_read_volume_material(r, body, defaults, m);
    else
        scene_read_density(r, body, "diameter", density, diameter, m);
    read_damping(r, body, m);
}
