/* Barrier of a point-triangle stencil: kappa w b(d^2 - xi^2), d the distance of the point to the triangle's plane
 * (SPEC C.4; docs/theory/energies.md (26)-(28)). */
#include "cipc/energy.h"
#include "energy/barrier.h"
#include "energy/blocks.h"

double cipc_barrier_point_triangle_value(const double x[12], const cipc_contact_barrier *params)
{
    return stencil_barrier_value(cipc_point_plane_distance2_value(x), params);
}

void cipc_barrier_point_triangle_gradient(const double x[12], const cipc_contact_barrier *params, double g[12])
{
    double b[3];
    stencil_barrier(cipc_point_plane_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(g, 12);
        return;
    }
    cipc_point_plane_distance2_gradient(x, g);
    chain_gradient(b, 12, g);
}

void cipc_barrier_point_triangle_hessian(const double x[12], const cipc_contact_barrier *params, double H[144])
{
    double b[3], dg[12];
    stencil_barrier(cipc_point_plane_distance2_value(x), params, b);
    if (b[1] == 0) {
        put_zeros(H, 144);
        return;
    }
    cipc_point_plane_distance2_gradient(x, dg);
    cipc_point_plane_distance2_hessian(x, H);
    chain_hessian(b, 12, dg, H);
}
