/* Volumes: the paper's fixed-corotational energy, or the neo-Hookean one of the released code (SPEC F5). */
#include "scene/volume_material.h"

static const scene_range poisson_range = {-1, 0.5, true, true}; /* lambda is infinite at 1/2 */

void scene_read_volume_material(scene_reader *r, const scene_cursor *body, const scene_material_defaults *defaults, cipc_material *m)
{
    static const char *const models[] = {"fixed-corotational", "neo-hookean", NULL}; /* in the order of cipc_volume_model */
    double none = defaults->optional ? 0 : SCENE_REQUIRED_NUMBER;
    m->density = scene_number(r, body, "density", defaults->optional ? defaults->density : SCENE_REQUIRED_NUMBER, scene_positive);
    m->young = scene_number(r, body, "young", none, defaults->optional ? scene_not_negative : scene_positive);
    m->poisson = scene_number(r, body, "poisson", none, poisson_range);
    m->volume = (cipc_volume_model)scene_choice(r, body, "model", "volume model", models,
                                                defaults->released ? CIPC_VOLUME_NEO_HOOKEAN : CIPC_VOLUME_COROTATIONAL);
}
