/* A ball of tetrahedra. The diagonals of the cells run away from the middle of the cube, so that every tetrahedron begins at the innermost corner of its cell, below the
 * surface: one with all four nodes on the sphere would be nearly flat. */
#include <math.h>

#include "scene/cell_cuts.h"
#include "scene/cube_to_ball.h"

static const char place[] = "ball";

cipc_status cipc_mesh_ball(cipc_mesh *mesh, double radius, int cells, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (!(radius > 0 && isfinite(radius))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a radius of %g m", radius);
    const int lattice[3] = {cells, cells, cells};
    const bool mirrored[3] = {true, true, true};
    cipc_status status = scene_cut_cells(mesh, lattice, mirrored, place, error);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i;
        scene_cube_to_ball(3, x);
        for (int a = 0; a < 3; a++) x[a] *= radius;
    }
    return status;
}
