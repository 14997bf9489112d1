/* Gores: the panels of a skirt or a bodice, each a piece of a cone (or a cylinder) around y; flat, a piece of a ring (or a rectangle). */
#include <math.h>

#include "scene/mesh.h"
#include "scene/mesh_panels.h"

static const char place[] = "gores";
static const double two_pi = 6.28318530717958647693;

static cipc_status check(const cipc_panel_ring *ring, int across, cipc_error *error)
{
    cipc_status status = scene_check_panel_ring(ring, place, error);
    if (status != CIPC_OK) return status;
    long long around = scene_mesh_product(ring->panels, across);
    if (across < 1 || around < 3 || around > SCENE_NODES_MAX)
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place,
                         "%d panels of %d cells across; around the body 3 are needed, at most %d allowed", ring->panels, across,
                         SCENE_NODES_MAX);
    return CIPC_OK;
}

cipc_status cipc_mesh_gores(cipc_mesh *mesh, const cipc_panel_ring *ring, int across, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(ring, across, error);
    if (status != CIPC_OK) return status;
    int around = ring->panels * across;
    double(*curve)[2] = cipc_alloc((size_t)around + 1, sizeof *curve);
    if (curve == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d columns", around);
    for (int i = 0; i <= around; i++) {
        double angle = two_pi * ((double)(i % around) / around); /* the last seam closes to the bit */
        curve[i][0] = ring->top * cos(angle);
        curve[i][1] = -ring->top * sin(angle);
    }
    status = scene_mesh_panels(mesh, ring, across, (const double(*)[2])curve, place, error);
    cipc_free(curve);
    return status;
}
