/* Rods: one modulus for stretching, and the same, a multiple of it or another one for bending. */
#include "scene/rod_material.h"

static void read_bending(scene_reader *r, const scene_cursor *body, cipc_material *m)
{
    static const char *const keys[] = {"young", NULL};
    double factor = scene_read_factor(r, body, "bending_factor", "bending", "young");
    scene_cursor bending = scene_object_member(r, body, "bending");
    if (!scene_is_object(r, &bending, keys)) return;
    m->bending_young = scene_number(r, &bending, "young", factor * m->young, scene_not_negative);
    json_object_del(body->value, "bending_factor"); /* it is in the number now: the resolved scene must not multiply it again */
}

void scene_read_rod_material(scene_reader *r, const scene_cursor *body, const scene_material_defaults *defaults, cipc_material *m)
{
    static const char *const curvatures[] = {"straight", "rest", NULL};
    double density = defaults->optional ? defaults->density : SCENE_REQUIRED_NUMBER;
    double diameter = defaults->optional ? defaults->thickness : SCENE_REQUIRED_NUMBER;
    scene_read_density(r, body, "diameter", density, diameter, m);
    m->young = scene_number(r, body, "young", defaults->optional ? 0 : SCENE_REQUIRED_NUMBER, scene_not_negative);
    read_bending(r, body, m);
    m->curved = scene_choice(r, body, "rest_curvature", "rest curvature", curvatures, 0) == 1;
}
