/* An open cylinder about x: that of revolution about y, turned. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "cylinder";

static cipc_status check(double radius, double length, int around, int along, cipc_error *error)
{
    if (!(radius > 0 && length > 0 && isfinite(radius) && isfinite(length))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a cylinder of radius %g and length %g m", radius, length);
    }
    if (around < 3 || along < 1 || along > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d nodes around and %d strips along; 3 and 1 are needed, at most %d nodes allowed", around, along,
                         SCENE_NODES_MAX);
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_cylinder(cipc_mesh *mesh, double radius, double length, int around, int along, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(radius, length, around, along, error);
    if (status != CIPC_OK) return status;
    double (*profile)[2] = cipc_alloc((size_t)along + 1, sizeof *profile);
    if (profile == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d rings", along + 1);
    for (int k = 0; k <= along; k++) {
        profile[k][0] = radius;
        profile[k][1] = -0.5 * length + length * ((double)k / along);
    }
    status = cipc_mesh_revolution(mesh, along + 1, (const double(*)[2])profile, around, error);
    cipc_free(profile);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i, first = x[0];
        x[0] = x[1];
        x[1] = x[2];
        x[2] = first;
    }
    return status;
}
