/* Sides of panels, and the nearest point of one. */
#include "scene/panel_sides.h"

#include <math.h>

#include "base/vector.h"

int scene_side_length(const cipc_mesh *mesh, scene_side side)
{
    return side == SCENE_SIDE_TOP || side == SCENE_SIDE_BOTTOM ? mesh->panel_columns : mesh->panel_rows;
}

int scene_side_node(const cipc_mesh *mesh, scene_side side, int panel, int i)
{
    int columns = mesh->panel_columns, rows = mesh->panel_rows, first = panel * columns * rows;
    switch (side) {
    case SCENE_SIDE_TOP:
        return first + i;
    case SCENE_SIDE_BOTTOM:
        return first + (rows - 1) * columns + i;
    case SCENE_SIDE_LEFT:
        return first + i * columns;
    default:
        return first + i * columns + columns - 1;
    }
}

static scene_side_point nearest_on_edge(const double *position, int a, int b, const double x[3])
{
    double along[3], from[3], apart[3];
    v3_sub(along, position + 3 * b, position + 3 * a);
    v3_sub(from, x, position + 3 * a);
    double ratio = fmin(fmax(v3_dot(from, along) / v3_norm2(along), 0), 1);
    for (int k = 0; k < 3; k++) apart[k] = from[k] - ratio * along[k];
    return (scene_side_point){{a, b}, ratio, v3_norm2(apart)};
}

scene_side_point scene_nearest_on_side(const cipc_mesh *mesh, const double *position, scene_side side, const double x[3], int except)
{
    scene_side_point nearest = {{-1, -1}, 0, INFINITY};
    int length = scene_side_length(mesh, side);
    for (int p = 0; p < mesh->panel_count; p++) {
        for (int i = 0; i + 1 < length; i++) {
            int a = scene_side_node(mesh, side, p, i), b = scene_side_node(mesh, side, p, i + 1);
            if (a == except || b == except) continue;
            scene_side_point point = nearest_on_edge(position, a, b, x);
            if (point.distance2 < nearest.distance2) nearest = point;
        }
    }
    return nearest;
}
