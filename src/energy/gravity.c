/* Potential of uniform gravity: -m a.x (docs/theory/energies.md (2)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

double cipc_gravity_value(const double x[3], const cipc_gravity *params)
{
    return -params->mass * v3_dot(params->acceleration, x);
}

void cipc_gravity_gradient(const double x[3], const cipc_gravity *params, double g[3])
{
    (void)x;
    v3_scale(g, -params->mass, params->acceleration);
}

void cipc_gravity_hessian(const double x[3], const cipc_gravity *params, double H[9])
{
    (void)x;
    (void)params;
    put_zeros(H, 9);
}
