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

/* The same with bodies of the other kinds between and above the layers: ropes of unlike thickness that hang in loops, one of them sewn to
 * the upper cloth, grains, a volume with a node inside, and two bodies that pass through each other. */
static inline hand_model *mixed_scene(uint64_t *seed, int cells, double spacing)
{
    hand_model *h = crumpled_scene(seed, cells, spacing);
    int rope = hand_body_of(h, CIPC_BODY_RODS, "rope", 0.05 * spacing, false), hair = hand_body_of(h, CIPC_BODY_RODS, "hair", 0, false),
        grains = hand_body_of(h, CIPC_BODY_PARTICLES, "grains", 0.1 * spacing, false),
        jelly = hand_body_of(h, CIPC_BODY_VOLUME, "jelly", 0, false), ghost = hand_body_of(h, CIPC_BODY_SHELL, "ghost", 0, false);
    const double top = 3 * spacing + 0.2, size = 0.1;
    const double corners[5][3] = {{0.6, 0.6, top}, {0.6 + size, 0.6, top}, {0.6, 0.6 + size, top}, {0.6, 0.6, top + size}, {0.62, 0.62, top + 0.02}};
    int v = hand_node(h, jelly, corners[0][0], corners[0][1], corners[0][2]);
    for (int i = 1; i < 5; i++) { hand_node(h, jelly, corners[i][0], corners[i][1], corners[i][2]); }
    hand_triangle(h, v, v + 2, v + 1);
    hand_triangle(h, v, v + 1, v + 3);
    hand_triangle(h, v + 1, v + 2, v + 3);
    hand_triangle(h, v + 2, v, v + 3);
    hand_new_triangle(h, ghost, (const double[9]){0.1, 0.1, -1, 0.9, 0.1, 1, 0.5, 0.9, 1}); /* cuts everything */
    const double over[3] = {0, 0.5, top - 0.1}, beyond[3] = {1, 0.55, top - 0.1}, across[3] = {0.5, 0, top - 0.1 + 0.3 * spacing},
                 past[3] = {0.52, 1, top - 0.1 + 0.3 * spacing};
    int sewn = hand_rope(h, rope, over, beyond, 2 * cells);
    hand_rope(h, hair, across, past, 2 * cells);
    for (int i = 0; i < 4 * cells; i++) {
        double along = 0.4 + 0.6 * spacing * (i + 0.1 * random_uniform(seed, -1, 1));
        hand_node(h, grains, along, 0.5 + 0.05 * along, top - 0.1 + 0.6 * spacing);
    }
    hand_interior(h, v + 4);
    for (int body = 0; body < h->model.body_count; body++) { hand_apart(h, ghost, body); }
    hand_sew(h, sewn, (cells + 1) * (cells + 1)); /* the upper cloth's first node */
    return h;
}

#endif
