/* Bodies that are too far to matter are not looked at (docs/theory/massspring_collision.md, section 4). */
#include "massspring/stepper.h"

#include <float.h>

#include "base/vector.h"

/* Roundings of a distance, in units of the coordinates that are in it and of itself: far more than any of collider.c has. */
static const double roundings = 1024;

static double size_of(const cipc_collider *b) { return v3_norm(b->center) + v3_norm(b->half) + (b->kind == CIPC_COLLIDER_CAPSULE ? v3_norm(b->axis) : 0); }

double massspring_look(cipc_massspring *s, int node, int collider, const double x[3], double normal[3])
{
    massspring_clearance *known = massspring_clearance_of(s, node, collider);
    const double distance = cipc_collider_distance(&s->colliders[collider], x, normal);
    known->distance = distance - roundings * DBL_EPSILON * (size_of(&s->colliders[collider]) + v3_norm(x) + fabs(distance));
    v3_copy(known->at, x);
    return distance;
}
