/* What the three triangle energies share: the rest triangle, the deformation gradient and the weights of the nodes.
 * Formulas: docs/theory/energies.md (4)-(7). */
#ifndef CIPC_ENERGY_MEMBRANE_H
#define CIPC_ENERGY_MEMBRANE_H

#include <stdbool.h>
#include "base/vector.h"

/* Inverse rest matrix B^-1 = [[b0, b1], [0, b2]] and area of a rest triangle (4). Returns false, and writes nothing, if the area is not a
 * positive finite number. */
bool energy_rest_triangle(const double rest[9], double inverse_rest[3], double *area);

/* Columns f[0], f[1] of F = [x1 - x0, x2 - x0] B^-1 (5). */
static inline void deformation_gradient(const double x[9], const double inverse_rest[3], double f[2][3])
{
    for (int k = 0; k < 3; k++) {
        double e1 = x[3 + k] - x[k], e2 = x[6 + k] - x[k];
        f[0][k] = inverse_rest[0] * e1;
        f[1][k] = inverse_rest[1] * e1 + inverse_rest[2] * e2;
    }
}

/* Weights w[i] with dF = sum_i dx_i w_i^T (6): the rows of B^-1 for the nodes 1 and 2, minus their sum for node 0. */
static inline void node_weights(const double inverse_rest[3], double w[3][2])
{
    w[1][0] = inverse_rest[0];
    w[1][1] = inverse_rest[1];
    w[2][0] = 0;
    w[2][1] = inverse_rest[2];
    for (int a = 0; a < 2; a++) w[0][a] = -(w[1][a] + w[2][a]);
}

static inline double dot2(const double a[2], const double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

/* The vectors p_i = w_i[0] a_0 + w_i[1] a_1 of the three nodes, for a pair of columns a. */
static inline void node_vectors(double w[3][2], double a[2][3], double p[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) p[i][k] = w[i][0] * a[0][k] + w[i][1] * a[1][k];
    }
}

/* Metric minus one, (7): e11, e22 are the diagonal of C - 1 and c12 its off-diagonal. */
typedef struct metric_change {
    double e11, e22, c12;
} metric_change;

static inline metric_change metric_change_of(double f[2][3])
{
    return (metric_change){v3_norm2(f[0]) - 1, v3_norm2(f[1]) - 1, v3_dot(f[0], f[1])};
}

#endif
