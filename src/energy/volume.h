/* What the two tetrahedral energies share: the deformation gradient and the weights of the nodes. Formulas: docs/theory/energies.md (V1)-(V2). */
#ifndef CIPC_ENERGY_VOLUME_H
#define CIPC_ENERGY_VOLUME_H

#include "base/vector.h"

/* F = [x1 - x0, x2 - x0, x3 - x0] B^-1, row-major (V1). */
static inline void volume_deformation(const double x[12], const double inverse_rest[9], double F[9])
{
    for (int k = 0; k < 3; k++) {
        double e1 = x[3 + k] - x[k], e2 = x[6 + k] - x[k], e3 = x[9 + k] - x[k];
        for (int a = 0; a < 3; a++) F[3 * k + a] = e1 * inverse_rest[a] + e2 * inverse_rest[3 + a] + e3 * inverse_rest[6 + a];
    }
}

/* Weights w[i] with dF = sum_i dx_i w_i^T (V2): the rows of B^-1 for the nodes 1, 2, 3, minus their sum for node 0. */
static inline void volume_weights(const double inverse_rest[9], double w[4][3])
{
    for (int a = 0; a < 3; a++) {
        for (int i = 0; i < 3; i++) w[1 + i][a] = inverse_rest[3 * i + a];
        w[0][a] = -(w[1][a] + w[2][a] + w[3][a]);
    }
}

static inline void m3_times(double r[3], const double A[9], const double v[3])
{
    for (int i = 0; i < 3; i++) r[i] = v3_dot(A + 3 * i, v);
}

static inline void m3_transposed_times(double r[3], const double A[9], const double v[3])
{
    for (int i = 0; i < 3; i++) r[i] = A[i] * v[0] + A[3 + i] * v[1] + A[6 + i] * v[2];
}

#endif
