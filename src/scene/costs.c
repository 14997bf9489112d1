/* What the scenes of the catalogue cost. ci/scene-costs writes the rows from the summaries of runs; a test holds nodes and steps against the scenes themselves. */
#include "cipc/scene.h"

#include <string.h>

static const cipc_scene_cost costs[] = {
#include "scene/costs.inc"
};

const cipc_scene_cost *cipc_scene_cost_of(const char *scene, const char *size)
{
    for (size_t i = 0; i < sizeof costs / sizeof costs[0]; i++) {
        if (strcmp(costs[i].scene, scene) == 0 && strcmp(costs[i].size, size) == 0) return &costs[i];
    }
    return NULL;
}
