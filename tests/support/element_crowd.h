/* Crowds for tests of the forces inside bodies: rest shapes out of the regular, so that every element has a step of its own. Header only. */
#ifndef SUPPORT_ELEMENT_CROWD_H
#define SUPPORT_ELEMENT_CROWD_H

#include <stdint.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"

static const double ELEMENT_FACTOR = 0.3;

/* Odd seeds have a StVK sheet and a corotational block for Neo-Hookean ones. */
static inline void element_crowd(asynchronous_scene *s, uint64_t seed, cipc_clocks clocks, double damping)
{
    const bool odd = seed % 2 == 1;
    crowd_shape shape = crowd_shape_default();
    shape.cells = 3;
    shape.damping = damping;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    s->options.element_factor = ELEMENT_FACTOR;
    s->options.frame = 1; /* longer than the step of any element */
    s->options.clocks = clocks;
    for (int b = 1; b < s->sheet.body_count; b++) {
        double *rest = (double *)(uintptr_t)s->sheet.bodies[b].rest;
        for (int i = 0; i < 3 * s->sheet.bodies[b].node_count; i++) rest[i] += random_uniform(&seed, -2e-3, 2e-3);
    }
    if (odd) s->sheet.bodies[6].material.membrane = CIPC_MEMBRANE_STVK;
    if (odd) s->sheet.bodies[5].material.volume = CIPC_VOLUME_COROTATIONAL;
    crowd_build(s, &shape);
}

static inline const int *nodes_of(const asynchronous_set *set, int element) { return set->nodes + element * set->energy->nodes; }
static inline const void *params_of(const asynchronous_set *set, int element) { return (const char *)set->params + (size_t)element * set->energy->params_size; }

static inline void gather_from(const double *from, const asynchronous_set *set, int element, double *x)
{
    for (int i = 0; i < set->energy->nodes; i++) v3_copy(x + 3 * i, from + 3 * nodes_of(set, element)[i]);
}

#endif
