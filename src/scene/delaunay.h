/* Delaunay triangulation of points in the plane. */
#ifndef SCENE_DELAUNAY_H
#define SCENE_DELAUNAY_H

#include "cipc/base.h"

/* points: 2 * count. triangles: room for 2 * count of them, counter-clockwise; those of area up to smallest_area are left out (three
 * points on the edge of the hull may make one). Deterministic. BAD_MESH if qhull gives up (fewer than 3 points, all on a
 * line, not finite). */
cipc_status scene_delaunay(double *points, int count, double smallest_area, int (*triangles)[3], int *triangle_count, cipc_error *error);

#endif
