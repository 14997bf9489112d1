#include <math.h>

#include "base/vector.h"
#include "support/colliders.h"
#include "support/exact_geometry.h"

const char *const collider_names[COLLIDER_KINDS] = {"plane", "sphere", "box", "disc", "capsule"};

void random_direction(uint64_t *seed, double unit[3])
{
    double length;
    do {
        random_fill(seed, unit, 3, 1);
        length = v3_norm(unit);
    } while (!(length > 0.1 && length <= 1));
    v3_scale(unit, 1 / length, unit);
}

static void random_capsule(uint64_t *seed, cipc_collider *c, double least)
{
    double direction[3];
    const double difference = fabs(c->half[0] - c->half[1]), length = random_below(seed, 4) ? difference + random_uniform(seed, least, 1) : 0.9 * difference;
    random_direction(seed, direction);
    v3_copy(c->axis, c->center);
    v3_axpy(c->axis, length, direction);
}

cipc_collider random_collider(uint64_t *seed, cipc_collider_kind kind, double least)
{
    cipc_collider c = {.kind = kind};
    random_fill(seed, c.center, 3, 1);
    random_direction(seed, c.axis);
    for (int k = 0; k < 3; k++) c.half[k] = least * pow(1 / least, random_uniform(seed, 0, 1));
    if (kind == CIPC_COLLIDER_CAPSULE) random_capsule(seed, &c, least);
    return c;
}

/* max n . (y - centre) over the body. */
static double support(const cipc_collider *c, const double n[3])
{
    const double along = v3_dot(n, c->axis);
    double across[3], other[3];
    switch (c->kind) {
    case CIPC_COLLIDER_SPHERE: return c->half[0];
    case CIPC_COLLIDER_BOX: return fabs(n[0]) * c->half[0] + fabs(n[1]) * c->half[1] + fabs(n[2]) * c->half[2];
    case CIPC_COLLIDER_DISC:
        v3_cross(across, n, c->axis);
        return v3_norm(across) * c->half[0] + fabs(along) * c->half[1];
    case CIPC_COLLIDER_CAPSULE:
        v3_sub(other, c->axis, c->center);
        return fmax(c->half[0], v3_dot(n, other) + c->half[1]);
    default: return INFINITY;
    }
}

double collider_support_gap(const cipc_collider *c, const double n[3], const double x[3])
{
    double d[3];
    v3_sub(d, x, c->center);
    return v3_dot(n, d) - support(c, n);
}
