/* A rod along a part of a circle, or all of it. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "arc";
static const double two_pi = 6.28318530717958647693;
static const double closing = 1e-9; /* rad: 2 pi written with ten digits is meant as the whole circle, not as an arc whose ends nearly touch */

cipc_status cipc_mesh_arc(cipc_mesh *mesh, double radius, double angle, int segments, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (!(radius > 0 && isfinite(radius))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a radius of %g m", radius);
    if (!(angle > 0 && angle <= two_pi + closing)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "an angle of %g; above 0 and up to 2 pi is allowed", angle);
    }
    bool ring = angle >= two_pi - closing;
    if (segments < (ring ? 3 : 1)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d segments; %d are needed", segments, ring ? 3 : 1);
    scene_mesh_sizes sizes = {.nodes = segments + (ring ? 0LL : 1LL), .segments = segments};
    cipc_status status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0; i < mesh->node_count; i++) {
        double at = (ring ? two_pi : angle) * ((double)i / segments);
        mesh->nodes[3 * i] = radius * cos(at);
        mesh->nodes[3 * i + 1] = radius * sin(at);
    }
    for (int s = 0; s < segments; s++) {
        mesh->segments[s][0] = s;
        mesh->segments[s][1] = (s + 1) % mesh->node_count;
    }
    return CIPC_OK;
}
