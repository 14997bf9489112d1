/* A box of tetrahedra. */
#include <math.h>

#include "scene/cell_cuts.h"

static const char place[] = "box";

cipc_status cipc_mesh_box(cipc_mesh *mesh, const double size[3], const int cells[3], cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    for (int a = 0; a < 3; a++) {
        if (!(size[a] > 0 && isfinite(size[a]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a box of %g by %g by %g m", size[0], size[1], size[2]);
        }
    }
    const bool mirrored[3] = {false, false, false};
    cipc_status status = scene_cut_cells(mesh, cells, mirrored, place, error);
    for (int i = 0; i < 3 * mesh->node_count; i++) mesh->nodes[i] *= 0.5 * size[i % 3];
    return status;
}
