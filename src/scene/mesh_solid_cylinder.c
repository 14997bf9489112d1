/* A cylinder of tetrahedra about y. Across, the cells are those of a square carried onto the disc, their diagonals away from the axis, as those of the ball; along y they
 * all run upwards. */
#include <math.h>

#include "scene/cell_cuts.h"
#include "scene/cube_to_ball.h"

static const char place[] = "solid_cylinder";

cipc_status cipc_mesh_solid_cylinder(cipc_mesh *mesh, double radius, double length, int cells_across, int cells_along, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (!(radius > 0 && length > 0 && isfinite(radius) && isfinite(length))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a cylinder of radius %g and length %g m", radius, length);
    }
    const int lattice[3] = {cells_across, cells_along, cells_across};
    const bool mirrored[3] = {true, false, true};
    cipc_status status = scene_cut_cells(mesh, lattice, mirrored, place, error);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i, across[2] = {x[0], x[2]};
        scene_cube_to_ball(2, across);
        x[0] = radius * across[0];
        x[1] *= 0.5 * length;
        x[2] = radius * across[1];
    }
    return status;
}
