/* Friction laws: their names, their level, the bound of their differential term, one step (SPEC B.3, B.4; docs/theory/massspring.md, "Friction"). */
#include <math.h>

#include "base/vector.h"
#include "massspring/friction.h"

const char *cipc_friction_law_name(cipc_friction_law law)
{
    static const char *const names[CIPC_LAW_COUNT] = {"coulomb", "dahl", "bidirectional", "bidirectional-smooth", "clamped"};
    return law >= 0 && law < CIPC_LAW_COUNT ? names[law] : "unknown";
}

double cipc_friction_level(const cipc_friction_force *force, double speed)
{
    switch (force->law) {
    case CIPC_LAW_COULOMB: return speed == 0 ? force->breakaway : force->coulomb;
    case CIPC_LAW_BIDIRECTIONAL:
    case CIPC_LAW_CLAMPED: return massspring_banded_level(force, speed);
    case CIPC_LAW_BIDIRECTIONAL_SMOOTH: return massspring_smooth_level(force, speed);
    case CIPC_LAW_DAHL:
    case CIPC_LAW_COUNT: break;
    }
    return force->coulomb;
}

double massspring_differential(const cipc_friction_force *force, double level, double speed)
{
    if (force->law == CIPC_LAW_COULOMB || force->law == CIPC_LAW_DAHL) return 0;
    return speed * force->sigma1 <= 4 * level ? force->sigma1 : 4 * level / speed;
}

double cipc_friction_step(const cipc_friction_force *force, double v, double dt, double *z)
{
    switch (force->law) {
    case CIPC_LAW_COULOMB: return massspring_coulomb_step(force, v);
    case CIPC_LAW_BIDIRECTIONAL:
    case CIPC_LAW_BIDIRECTIONAL_SMOOTH: return massspring_bidirectional_step(force, v, dt, z);
    case CIPC_LAW_CLAMPED: return massspring_clamped_step(force, v, dt, z);
    case CIPC_LAW_DAHL:
    case CIPC_LAW_COUNT: break;
    }
    return massspring_dahl_step(force, v, dt, z);
}
