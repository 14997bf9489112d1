/* Repulsion of nodes near the surface of a body (SPEC B.6; docs/theory/massspring_collision.md, section 3). */
#include "base/vector.h"
#include "cipc/massspring.h"

/* (9): rises towards round bodies, is constant at flat ones. */
static double depth(const cipc_collider *collider, double distance, double threshold)
{
    if (!(distance < threshold)) return 0;
    const bool is_round = collider->kind == CIPC_COLLIDER_SPHERE || collider->kind == CIPC_COLLIDER_CAPSULE;
    return is_round ? threshold - distance : threshold;
}

void cipc_collider_repulsion(const cipc_collider *collider, double stiffness, double threshold, const double x[3], const double v[3], double f[3])
{
    double n[3];
    const double distance = cipc_collider_distance(collider, x, n);
    const bool separating = v3_dot(v, n) > 0;
    v3_scale(f, separating ? 0 : stiffness * depth(collider, distance, threshold), n);
}
