/* Depths of the parts, joined by a maximum that is rounded off where two are nearly alike. */
#include "scene/capsules.h"

#include <math.h>

#include "base/vector.h"

/* Of one part: the radius at the nearest point of its segment less the distance from there. */
static double depth_in(const cipc_capsule *part, const double x[3])
{
    double axis[3], from[3];
    v3_sub(axis, part->end, part->begin);
    v3_sub(from, x, part->begin);
    double length2 = v3_norm2(axis), t = length2 > 0 ? min2(max2(v3_dot(axis, from) / length2, 0), 1) : 0;
    v3_axpy(from, -t, axis);
    return part->radius[0] + t * (part->radius[1] - part->radius[0]) - v3_norm(from);
}

/* The larger one, and up to blend/4 more where they are less than `blend` apart: continuous with its first derivative. */
static double join(double a, double b, double blend)
{
    double nearness = max2(blend - fabs(a - b), 0);
    return max2(a, b) + (nearness > 0 ? nearness * nearness / (4 * blend) : 0);
}

double scene_capsules_depth(const scene_capsules *shape, const double x[3])
{
    double depth = depth_in(&shape->parts[0], x);
    for (int p = 1; p < shape->count; p++) depth = join(depth, depth_in(&shape->parts[p], x), shape->blend);
    return depth;
}

void scene_capsules_bounds(const scene_capsules *shape, double low[3], double high[3])
{
    double grown = 0; /* what the joins may add outside the parts: blend/4 each */
    if (shape->count > 1) grown = 0.25 * shape->blend * (shape->count - 1);
    for (int a = 0; a < 3; a++) {
        low[a] = INFINITY;
        high[a] = -INFINITY;
        for (int p = 0; p < shape->count; p++) {
            const cipc_capsule *part = &shape->parts[p];
            low[a] = fmin(low[a], fmin(part->begin[a] - part->radius[0], part->end[a] - part->radius[1]) - grown);
            high[a] = fmax(high[a], fmax(part->begin[a] + part->radius[0], part->end[a] + part->radius[1]) + grown);
        }
    }
}
