/* Penalty that draws a Dirichlet node towards its target when contact bars the direct way:
 * k m/2 |x - target|^2 (SPEC C.7; docs/theory/energies.md (3)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

double cipc_dirichlet_penalty_value(const double x[3], const cipc_dirichlet_penalty *params)
{
    double away[3];
    v3_sub(away, x, params->target);
    return 0.5 * params->stiffness * params->mass * v3_norm2(away);
}

void cipc_dirichlet_penalty_gradient(const double x[3], const cipc_dirichlet_penalty *params, double g[3])
{
    v3_sub(g, x, params->target);
    v3_scale(g, params->stiffness * params->mass, g);
}

void cipc_dirichlet_penalty_hessian(const double x[3], const cipc_dirichlet_penalty *params, double H[9])
{
    (void)x;
    put_zeros(H, 9);
    H[0] = H[4] = H[8] = params->stiffness * params->mass;
}
