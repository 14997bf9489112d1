/* The clamped integrator, R2 [R] (SPEC B.4; docs/theory/massspring.md (F8), (F12)). */
#include <math.h>

#include "base/vector.h"
#include "massspring/friction.h"

/* In motion z is first brought within the bound, which may have fallen with the speed. That is no motion of the contact and has no part in the rate: it would be an impulse. */
double massspring_clamped_step(const cipc_friction_force *force, double v, double dt, double *z)
{
    double speed = fabs(v), level = cipc_friction_level(force, speed), bound = level / force->sigma0;
    if (speed * dt == 0) return force->sigma0 * *z;
    double begin = max2(-bound, min2(bound, *z));
    *z = v > 0 ? min2(bound, begin + v * dt) : max2(-bound, begin + v * dt);
    return force->sigma0 * *z + massspring_differential(force, level, speed) * ((*z - begin) / dt);
}

/* Straight on until the circle is met in front; then the part of the motion that leads out of it is lost and z turns towards the motion: with theta between them
 * theta' = -(|v|/bound) sin(theta), so tan(theta/2) decays exponentially with the travel. */
void massspring_clamped_slide(double bound, double travel, const double along[3], double z[3])
{
    if (bound == 0) return;
    double ahead = v3_dot(z, along), beside[3];
    v3_copy(beside, z);
    v3_axpy(beside, -ahead, along);
    double offset = min2(v3_norm(beside), bound), front = sqrt((bound - offset) * (bound + offset));
    if (ahead + travel <= front) {
        v3_axpy(z, travel, along);
        return;
    }
    double over = travel - max2(front - ahead, 0);
    double half = offset / (bound + front) * exp(-over / bound), part = bound / (1 + half * half);
    v3_scale(z, part * (1 - half * half), along);
    if (offset > 0) v3_axpy(z, part * (2 * half) / offset, beside);
}
