/* Barrier of a point-point stencil: kappa w b(d^2 - xi^2), d the distance of the two points
 * (SPEC C.4; docs/theory/energies.md (26)-(28)). */
#include "cipc/energy.h"
#include "energy/barrier.h"
#include "energy/blocks.h"

double cipc_barrier_point_point_value(const double x[6], const cipc_contact_barrier *params)
{
    return stencil_barrier_value(cipc_point_point_distance2_value(x), params);
}

void cipc_barrier_point_point_gradient(const double x[6], const cipc_contact_barrier *params, double g[6])
{
    double b[3];
    stencil_barrier(cipc_point_point_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(g, 6);
        return;
    }
    cipc_point_point_distance2_gradient(x, g);
    chain_gradient(b, 6, g);
}

void cipc_barrier_point_point_hessian(const double x[6], const cipc_contact_barrier *params, double H[36])
{
    double b[3], dg[6];
    stencil_barrier(cipc_point_point_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(H, 36);
        return;
    }
    cipc_point_point_distance2_gradient(x, dg);
    cipc_point_point_distance2_hessian(x, H);
    chain_hessian(b, 6, dg, H);
}
