/* Isosurface stuffing: tetrahedra that fill a solid given by a function, with good angles at its surface too. After Labelle and Shewchuk, "Isosurface stuffing: fast tetrahedral
 * meshes with good dihedral angles", 2007. */
#ifndef SCENE_STUFFING_H
#define SCENE_STUFFING_H

#include "scene/cut_lattice.h"

/* Fill what lies between low and high; nothing of the solid lies beyond. `cell`: the edge of the cubes of the body-centred lattice, m. Nodes of the surface lie where `depth` is
 * zero to rounding. Parts thinner than about a cell are lost, and so are the links between parts. OUT_OF_RANGE: no node of the lattice inside, or too many of them. */
cipc_status scene_stuff(cipc_mesh *mesh, scene_depth depth, const void *shape, const double low[3], const double high[3], double cell, const char *place, cipc_error *error);

#endif
