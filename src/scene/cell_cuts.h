/* A lattice of cells cut into tetrahedra: what the meshes of volumes start from. */
#ifndef SCENE_CELL_CUTS_H
#define SCENE_CELL_CUTS_H

#include <stdbool.h>

#include "scene/mesh.h"

/* cells[0] x cells[1] x cells[2] cells along x, y, z, six tetrahedra each around one diagonal of the cell; neighbours share whole faces. Node (i, j, k) has the lattice
 * coordinates -1 + 2 i / cells[0], ... in [-1, 1]; x runs fastest, then z, then y. The diagonals run from the lowest to the highest corner; along a mirrored axis (an even
 * number of cells), away from the middle. */
cipc_status scene_cut_cells(cipc_mesh *mesh, const int cells[3], const bool mirrored[3], const char *place, cipc_error *error);

#endif
