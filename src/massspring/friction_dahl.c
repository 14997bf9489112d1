/* Dahl's law with exponent 1 (SPEC B.3; docs/theory/massspring.md (F2), (F3)). */
#include <math.h>

#include "massspring/friction.h"

/* By expm1: where travel is small against bound, 1 - exp(...) would leave only rounding. */
double massspring_dahl_share(double travel, double bound)
{
    return -expm1(-travel / bound);
}

/* The change, not z', is what is computed: the rate needs it where it is small against z, and in steady motion it is exactly 0. The exponent is taken as travel/bound so that it
 * underflows only where z' does too. */
double massspring_dahl_change(double v, double dt, double bound, double z)
{
    double travel = fabs(v) * dt;
    return travel == 0 ? 0 : (copysign(bound, v) - z) * massspring_dahl_share(travel, bound);
}

double massspring_dahl_step(const cipc_friction_force *force, double v, double dt, double *z)
{
    *z += massspring_dahl_change(v, dt, force->coulomb / force->sigma0, *z);
    return force->sigma0 * *z;
}
