/* The sides of a garment's panels: rows of nodes that seams name without numbers, whatever the resolution. */
#ifndef SCENE_PANEL_SIDES_H
#define SCENE_PANEL_SIDES_H

#include "cipc/scene.h"

typedef enum scene_side { SCENE_SIDE_TOP = 0, SCENE_SIDE_BOTTOM, SCENE_SIDE_LEFT, SCENE_SIDE_RIGHT } scene_side;

/* Nodes that a side has in each panel: 2 or more; 0 of a mesh that is not made of panels. */
int scene_side_length(const cipc_mesh *mesh, scene_side side);
/* Its node `i` in a panel, from left to right or from the top. */
int scene_side_node(const cipc_mesh *mesh, scene_side side, int panel, int i);

/* A point of a side: on the edge from nodes[0] to nodes[1], at nodes[0] + ratio * (nodes[1] - nodes[0]). */
typedef struct scene_side_point {
    int nodes[2];
    double ratio; /* 0 to 1 */
    double distance2;
} scene_side_point;

/* The point of a side, in whichever panel, that is nearest to x; the first of equally near ones. Edges with the node `except` (-1: none) are passed
 * over. distance2 is INFINITY if no edge is left. `position`: of the mesh's nodes. */
scene_side_point scene_nearest_on_side(const cipc_mesh *mesh, const double *position, scene_side side, const double x[3], int except);

#endif
