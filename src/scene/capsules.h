/* A solid made of balls swept along segments: how deep a point lies in it. */
#ifndef SCENE_CAPSULES_H
#define SCENE_CAPSULES_H

#include "cipc/scene.h"

typedef struct scene_capsules {
    int count;
    const cipc_capsule *parts;
    double blend; /* m: where two parts are less than this apart in depth the corner between them is rounded off; 0: not at all */
} scene_capsules;

/* m, positive inside. For one part that does not taper, the distance from its surface; zero on the surface in any case. Continuous, and changes by no more than about the
 * distance of two points. */
double scene_capsules_depth(const scene_capsules *shape, const double x[3]);
/* A box around all of it. */
void scene_capsules_bounds(const scene_capsules *shape, double low[3], double high[3]);

#endif
