/* Friction in the plane of contact (SPEC B.4; docs/theory/massspring.md (F9)-(F12)): the laws for vectors, and z carried along when the plane turns. */
#include "base/vector.h"
#include "massspring/friction.h"

static void into_plane(const double normal[3], double r[3])
{
    v3_axpy(r, -v3_dot(normal, r), normal);
}

/* (F9): z turns with the plane and keeps its length. What stood upright on the plane has no direction in it and is dropped. */
static void carry(const double normal[3], double z[3])
{
    double before = v3_norm(z);
    into_plane(normal, z);
    double after = v3_norm(z);
    v3_scale(z, after == 0 ? 0 : before / after, z);
}

/* Speed in the plane and its direction, 0 at rest. Squares of speeds below 1e-162 m/s underflow: that is rest. */
static double motion(const double normal[3], const double v[3], double along[3])
{
    v3_copy(along, v);
    into_plane(normal, along);
    double speed = v3_norm(along);
    for (int k = 0; k < 3; k++) along[k] = speed == 0 ? 0 : along[k] / speed;
    return speed;
}

/* (F10): every component goes the same part of its way. */
static void relax(double bound, double travel, const double along[3], double z[3], double change[3])
{
    double share = massspring_dahl_share(travel, bound);
    for (int k = 0; k < 3; k++) {
        change[k] = (bound * along[k] - z[k]) * share;
        z[k] += change[k];
    }
}

static void clamp(double bound, double travel, const double along[3], double z[3], double change[3])
{
    double length = v3_norm(z);
    if (length > bound) v3_scale(z, bound / length, z);
    v3_scale(change, -1, z);
    massspring_clamped_slide(bound, travel, along, z);
    v3_add(change, change, z);
}

void cipc_friction_step_plane(const cipc_friction_force *force, const double normal[3], const double v[3], double dt, double z[3], double f[3])
{
    double along[3], change[3] = {0, 0, 0}, speed = motion(normal, v, along), level = cipc_friction_level(force, speed);
    if (force->law == CIPC_LAW_COULOMB) {
        v3_scale(f, level, along);
        return;
    }
    carry(normal, z);
    double bound = level / force->sigma0, travel = speed * dt, differential = massspring_differential(force, level, speed);
    if (travel != 0) {
        if (force->law == CIPC_LAW_CLAMPED) clamp(bound, travel, along, z, change);
        else relax(bound, travel, along, z, change);
    }
    for (int k = 0; k < 3; k++) f[k] = force->sigma0 * z[k] + differential * (change[k] / dt);
}
