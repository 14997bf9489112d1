/* The improved model with a differential term, R1 and R1s [R] (SPEC B.4; docs/theory/massspring.md (F4)-(F6)): Dahl's law with the level h(|v|) for Fc. */
#include <math.h>

#include "massspring/friction.h"

double massspring_banded_level(const cipc_friction_force *force, double speed)
{
    return speed <= force->band ? force->breakaway : force->coulomb; /* (F5) */
}

double massspring_smooth_level(const cipc_friction_force *force, double speed)
{
    if (speed == 0) return force->breakaway; /* also where the band is 0 */
    double part = speed / force->band;
    return force->coulomb + (force->breakaway - force->coulomb) * exp(-part * part); /* (F6) */
}

double massspring_bidirectional_step(const cipc_friction_force *force, double v, double dt, double *z)
{
    double speed = fabs(v), level = cipc_friction_level(force, speed);
    double change = massspring_dahl_change(v, dt, level / force->sigma0, *z);
    *z += change;
    return force->sigma0 * *z + massspring_differential(force, level, speed) * (change / dt);
}
