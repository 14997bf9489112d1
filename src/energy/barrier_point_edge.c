/* Barrier of a point-edge stencil: kappa w b(d^2 - xi^2), d the distance of the point to the edge's line
 * (SPEC C.4; docs/theory/energies.md (26)-(28)). */
#include "cipc/energy.h"
#include "energy/barrier.h"
#include "energy/blocks.h"

double cipc_barrier_point_edge_value(const double x[9], const cipc_contact_barrier *params)
{
    return stencil_barrier_value(cipc_point_line_distance2_value(x), params);
}

void cipc_barrier_point_edge_gradient(const double x[9], const cipc_contact_barrier *params, double g[9])
{
    double b[3];
    stencil_barrier(cipc_point_line_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(g, 9);
        return;
    }
    cipc_point_line_distance2_gradient(x, g);
    chain_gradient(b, 9, g);
}

void cipc_barrier_point_edge_hessian(const double x[9], const cipc_contact_barrier *params, double H[81])
{
    double b[3], dg[9];
    stencil_barrier(cipc_point_line_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(H, 81);
        return;
    }
    cipc_point_line_distance2_gradient(x, dg);
    cipc_point_line_distance2_hessian(x, H);
    chain_hessian(b, 9, dg, H);
}
