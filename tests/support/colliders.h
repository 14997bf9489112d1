/* Bodies given by formulas, for tests: random ones, points near them, and their support functions. */
#ifndef SUPPORT_COLLIDERS_H
#define SUPPORT_COLLIDERS_H

#include <stdint.h>

#include "cipc/massspring.h"

enum { COLLIDER_KINDS = CIPC_COLLIDER_CAPSULE + 1 };
extern const char *const collider_names[COLLIDER_KINDS];

/* A unit vector, evenly distributed. */
void random_direction(uint64_t *seed, double unit[3]);

/* Of any size from `least` to 1 m, centre within 1 m, any orientation (boxes have none); one capsule in four is a ball inside another. */
cipc_collider random_collider(uint64_t *seed, cipc_collider_kind kind, double least);

/* n . x - max over the body of n . y: what the half space of unit normal n through the body's outermost point says of the distance of x. The signed distance of a convex body is the greatest of
 * it over all n (docs/theory/massspring_collision.md, section 1). Not of planes. */
double collider_support_gap(const cipc_collider *collider, const double n[3], const double x[3]);

#endif
