/* Crowds: small scenes in which bodies of every kind fall upon each other at once, for tests of what must hold whatever happens. */
#ifndef SUPPORT_ASYNCHRONOUS_CROWD_H
#define SUPPORT_ASYNCHRONOUS_CROWD_H

#include <stdint.h>
#include "support/asynchronous_scene.h"

/* What takes part besides the floor, a fixed square. Sheets: one of springs, one Neo-Hookean. Stitches: a corner of one sheet is sewn to an edge of the other. */
enum { CROWD_SHEETS = 1, CROWD_RODS = 2, CROWD_PARTICLES = 4, CROWD_VOLUME = 8, CROWD_STITCHES = 16, CROWD_ALL = 31 };

typedef struct crowd_shape {
    unsigned kinds;
    int cells;         /* of a sheet along either side; segments of a rod */
    double speed;      /* m/s: what all meet at, about */
    double offset;     /* xi of the odd bodies, m; even ones have half as much */
    double friction, damping; /* coefficient; damping_stiffness, s */
} crowd_shape;
/* Everything, 2 cells, 1 m/s, 4 mm, no friction or damping. */
crowd_shape crowd_shape_default(void);

/* Bodies and options (eta(1) = 4 mm, frames of 5 ms, layers' factor 0.1) into a scene just made; then change options and asynchronous_scene_build(). All have met after some 60 ms at 1 m/s.
 * The same shape and seed give the same crowd. */
void crowd_add(asynchronous_scene *scene, const crowd_shape *shape, uint64_t seed);
/* Model and integrator, with stitches if there are any. */
void crowd_build(asynchronous_scene *scene, const crowd_shape *shape);

/* Pairs of each kind that have an active layer now are added up. */
void crowd_count_contacts(const asynchronous_scene *scene, long contacts[CIPC_PAIR_KIND_COUNT]);

/* Every pair of primitives that meets, by the definition of cipc/contact.h, by brute force: of nodes in rods only those are asked that no edge-edge pair speaks for. Nodes first primitive
 * first, numbers as asynchronous_pair_order takes them. */
typedef void crowd_visitor(void *context, cipc_pair_kind kind, const int nodes[4], int first, int second);
void crowd_visit_pairs(const cipc_model *model, crowd_visitor *visit, void *context);

#endif
