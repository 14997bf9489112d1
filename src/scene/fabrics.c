/* Orthotropic fabrics of the C-IPC release (SPEC C.3, tag [C]), fitted by Clyde, Teran and Tamstorf 2017. The densities are the release's,
 * but look like areal densities in g/m^2 that are used as kg/m^3 (SPEC F7): cotton would weigh 19 g/m^2. They are kept, so that its scenes
 * can be repeated; a scene that is after real cloth gives a density of its own. */
#include "scene/fabrics.h"

#include <stddef.h>

static const scene_fabric fabrics[] = {
    {"cotton", 103.6, 0.18e-3, {15.557e6, 7.779e6, 25.004e6, 1.076e6}, {0.14, 0.14, 0.063}},
    {"wool", 480.6, 1.28e-3, {2.290e6, 1.145e6, 2.219e6, 0.371e6}, {0.5, 0.62, 0.12}},
    {"canvas", 294, 0.53e-3, {5.366e6, 2.683e6, 19.804e6, 2.009e6}, {0.11, 0.067, 0.059}},
    {"silk", 83, 0.18e-3, {4.300e6, 4.971e6, 9.942e6, 0.570e6}, {0.41, 0.34, 0.11}},
    {"denim", 400, 0.66e-3, {4.793e6, 4.515e6, 9.029e6, 2.448e6}, {0.28, 0.28, 0.05}},
};
static const char *const names[] = {"cotton", "wool", "canvas", "silk", "denim", NULL};

const scene_fabric *scene_fabrics(int *count)
{
    *count = (int)(sizeof fabrics / sizeof fabrics[0]);
    return fabrics;
}

const char *const *scene_fabric_names(void)
{
    return names;
}
