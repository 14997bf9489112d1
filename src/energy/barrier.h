/* The chain rule from a squared distance to the barrier of one contact stencil (docs/theory/energies.md (26)-(28)). */
#ifndef CIPC_ENERGY_BARRIER_H
#define CIPC_ENERGY_BARRIER_H

#include <math.h>
#include "cipc/energy.h"

/* (26): kappa w (b, b', b'') at D = d^2 - xi^2, for support Dhat = dhat (2 xi + dhat). */
static inline void stencil_barrier(double distance2, const cipc_contact_barrier *params, double b[3])
{
    double D = distance2 - params->offset * params->offset, Dhat = params->dhat * (2 * params->offset + params->dhat);
    cipc_barrier(D, Dhat, b);
    double scale = params->stiffness * params->weight;
    for (int i = 0; i < 3; i++) b[i] *= scale;
}

/* INFINITY stays INFINITY whatever the scale, 0 included: a pair in contact is infeasible. */
static inline double stencil_barrier_value(double distance2, const cipc_contact_barrier *params)
{
    double b[3];
    if (!(distance2 > params->offset * params->offset)) return INFINITY;
    stencil_barrier(distance2, params, b);
    return b[0];
}

/* (28): g = b' dg, in place of dg = grad d^2. */
static inline void chain_gradient(const double b[3], int n, double *g)
{
    for (int i = 0; i < n; i++) g[i] *= b[1];
}

/* (28): H = b'' dg dg^T + b' dH, in place of dH = Hess d^2. */
static inline void chain_hessian(const double b[3], int n, const double *dg, double *H)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) H[i * n + j] = b[2] * (dg[i] * dg[j]) + b[1] * H[i * n + j];
    }
}

#endif
