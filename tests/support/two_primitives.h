/* Two primitives of one kind of pair, alone in the world, each a body of its own, under an asynchronous integrator whose inside is at hand: nodes are placed, moved and kicked
 * directly, without its loop. Anything that fails ends the test. */
#ifndef SUPPORT_TWO_PRIMITIVES_H
#define SUPPORT_TWO_PRIMITIVES_H

#include "asynchronous/integrator.h"
#include "support/asynchronous_scene.h"

typedef struct two_primitives {
    asynchronous_scene scene;
    cipc_asynchronous *a;
    cipc_pair_kind kind;
    int nodes[4], count, first; /* global nodes of the pair; how many; of the first primitive */
    double mass[4];             /* 0: prescribed */
} two_primitives;

/* Bodies of the kind's two primitives: a particle, a segment, a triangle, without forces of their own. `options`, thickness and so on, as given. */
void two_primitives_init(two_primitives *two, cipc_pair_kind kind, const cipc_asynchronous_options *options, double offset, double friction);
void two_primitives_free(two_primitives *two);
/* Masses of the nodes from the next placement on; 0: prescribed. */
void two_primitives_weigh(two_primitives *two, const double mass[4]);
/* Positions x and velocities v of the nodes at time t; no pair. */
void two_primitives_place(two_primitives *two, const double x[12], const double v[12], double t);
/* The pair, as it is made when its primitives come near; its number. */
int two_primitives_meet(two_primitives *two);
/* Positions at time t. */
void two_primitives_at(const two_primitives *two, double t, double x[12]);
/* Velocities now. */
void two_primitives_velocities(const two_primitives *two, double v[12]);

#endif
