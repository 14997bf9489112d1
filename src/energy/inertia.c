/* Inertia of a lumped node: m/2 |x - xhat|^2 (SPEC C.1; docs/theory/energies.md (1)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

double cipc_inertia_value(const double x[3], const cipc_inertia *params)
{
    double away[3];
    v3_sub(away, x, params->target);
    return 0.5 * params->mass * v3_norm2(away);
}

void cipc_inertia_gradient(const double x[3], const cipc_inertia *params, double g[3])
{
    v3_sub(g, x, params->target);
    v3_scale(g, params->mass, g);
}

void cipc_inertia_hessian(const double x[3], const cipc_inertia *params, double H[9])
{
    (void)x;
    put_zeros(H, 9);
    H[0] = H[4] = H[8] = params->mass;
}
