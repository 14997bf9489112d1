/* Isotropic cloth and paper of the C-IPC release (SPEC C.8, tag [C]): fabrics measured by Penava et al. 2014, strain limits from the
 * authors' scripts. */
#include "scene/materials.h"

#include <stddef.h>

#define PENAVA "C-IPC release [C], after Penava, Simic Penava and Knezic 2014"

static const scene_material materials[] = {
    {"cotton", 472.641509, 0.318e-3, 0.821e6, 0.243, 1.0608, PENAVA},
    {"wool", 413.380282, 0.568e-3, 0.170e6, 0.277, 1.085, PENAVA},
    {"lycra", 543.292683, 0.328e-3, 0.076e6, 0.071, 1.134, PENAVA " (95 % wool, 5 % lycra)"},
    {"polyester", 653.174603, 0.252e-3, 0.478e6, 0.381, 1.0646, PENAVA},
    {"paper", 800, 0.3e-3, 3e9, 0.3, 1.005, "C-IPC release [C]"},
};
static const char *const names[] = {"cotton", "wool", "lycra", "polyester", "paper", NULL};

const scene_material *scene_materials(int *count)
{
    *count = (int)(sizeof materials / sizeof materials[0]);
    return materials;
}

const char *const *scene_material_names(void)
{
    return names;
}
