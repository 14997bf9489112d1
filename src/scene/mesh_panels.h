/* Panels of a garment, cut flat and bent along straight lines around the body. */
#ifndef SCENE_MESH_PANELS_H
#define SCENE_MESH_PANELS_H

#include "cipc/scene.h"

/* A ring of panels over a closed curve in plan, of ring->panels * columns + 1 points (x, z), in m, the last the same as the first. Each panel
 * stands over `columns` steps of the curve and has its own nodes: (columns + 1) * (down + 1), row by row from the top, along the curve from left to
 * right. The curve is the top edge, at y = 0; below, it is scaled so that radius ring->top becomes ring->bottom at y = -height. With the curve
 * anticlockwise seen from above, normals point outward. The mesh gets its flat pattern. */
cipc_status scene_mesh_panels(cipc_mesh *mesh, const cipc_panel_ring *ring, int columns, const double (*curve)[2], const char *place,
                              cipc_error *error);
/* Is it a ring of at least one panel, of sizes that can be? */
cipc_status scene_check_panel_ring(const cipc_panel_ring *ring, const char *place, cipc_error *error);

#endif
