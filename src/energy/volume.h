/* What the volume energies share: deformation gradient, weights of nodes, cofactors (docs/theory/energies.md (40)-(43)). */
#ifndef CIPC_ENERGY_VOLUME_H
#define CIPC_ENERGY_VOLUME_H

#include "base/vector.h"
#include "cipc/energy.h"

/* F as its columns, J = det F, and cof F = J F^-T as its columns f2 x f3, f3 x f1, f1 x f2. */
typedef struct deformation {
    double f[3][3], cofactor[3][3], J;
} deformation;

/* (40): F = [x1 - x0, x2 - x0, x3 - x0] B^-1. */
static inline deformation deformation_of(const double x[12], const double inverse_rest[9])
{
    deformation d;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            d.f[c][k] = 0;
            for (int i = 0; i < 3; i++) d.f[c][k] += (x[3 + 3 * i + k] - x[k]) * inverse_rest[3 * i + c];
        }
    for (int c = 0; c < 3; c++) v3_cross(d.cofactor[c], d.f[(c + 1) % 3], d.f[(c + 2) % 3]);
    d.J = v3_dot(d.f[0], d.cofactor[0]);
    return d;
}

/* (41): dF = sum_i dx_i w_i^T: the rows of B^-1 for the nodes 1 to 3, minus their sum for node 0. */
static inline void volume_weights(const double inverse_rest[9], double w[4][3])
{
    for (int k = 0; k < 3; k++) {
        w[0][k] = 0;
        for (int i = 0; i < 3; i++) {
            w[1 + i][k] = inverse_rest[3 * i + k];
            w[0][k] -= inverse_rest[3 * i + k];
        }
    }
}

/* M w for a matrix given by its columns. */
static inline void combine(double r[3], double columns[3][3], const double w[3])
{
    for (int k = 0; k < 3; k++) r[k] = columns[0][k] * w[0] + columns[1][k] * w[1] + columns[2][k] * w[2];
}

#endif
