/* Small scenes for the tests of the monitors. Header only. */
#ifndef SUPPORT_MONITOR_SCENE_H
#define SUPPORT_MONITOR_SCENE_H

#include <math.h>

#include "support/exact_geometry.h"
#include "support/hand_model.h"

/* Two crumpled cloths of unlike offset over one another, a loose point and a loose edge, over a fixed floor of two large triangles that a
 * fixed bump (tiny triangles) pierces. Nothing is nearer than about a tenth of the spacing of the layers. */
static inline hand_model *crumpled_scene(uint64_t *seed, int cells, double spacing)
{
    hand_model *h = hand_model_create();
    int lower = hand_body(h, "lower", 0, 1.15, false), upper = hand_body(h, "upper", 0.1 * spacing, 0, false),
        dust = hand_body(h, "dust", 0, 0, false), floor = hand_body(h, "floor", 0.02 * spacing, 0, true),
        bump = hand_body(h, "bump", 0, 0, true);
    const double corner[3] = {0, 0, 0}, above[3] = {0.03, 0.02, spacing}, below[3] = {-5, -5, -spacing}, u[3] = {1, 0, 0}, v[3] = {0, 1, 0},
                 wide[3] = {11, 0, 0}, deep[3] = {0, 11, 0}, spot[3] = {0.4, 0.4, -1.05 * spacing}, small[3] = {0.1, 0, 0},
                 rise[3] = {0, 0.05, 0.1 * spacing};
    hand_grid(h, lower, corner, u, v, cells, cells);
    hand_grid(h, upper, above, u, v, cells, cells);
    for (int i = 0; i < h->model.node_count; i++) { /* both layers follow one wave, so they stay apart */
        double *p = &h->x[3 * i];
        p[2] += 0.05 * sin(9 * p[0]) * cos(7 * p[1]) + 0.15 * spacing * random_uniform(seed, -1, 1) + 0.05;
    }
    hand_grid(h, floor, below, wide, deep, 1, 1);
    hand_grid(h, bump, spot, small, rise, 4, 4);
    hand_node(h, dust, 0.5, 0.5, 0.05 + 0.05 * sin(4.5) * cos(3.5) + 0.5 * spacing);
    int a = hand_node(h, dust, 0.2, 0.2, 0.3), b = hand_node(h, dust, 0.8, 0.1, 0.3);
    hand_edge(h, a, b);
    return h;
}

#endif
