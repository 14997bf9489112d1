/* Saint Venant-Kirchhoff membrane: V [lambda/2 tr(E)^2 + mu tr(E^2)], E = (C - 1)/2 (SPEC C.6; docs/theory/energies.md (12)-(14)). */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/membrane.h"

double cipc_membrane_stvk_value(const double x[9], const cipc_membrane *params)
{
    double f[2][3];
    deformation_gradient(x, params->inverse_rest, f);
    metric_change m = metric_change_of(f); /* 2 E */
    double trace = m.e11 + m.e22, squares = m.e11 * m.e11 + m.e22 * m.e22 + 2 * m.c12 * m.c12;
    return params->volume * (0.125 * params->lambda * trace * trace + 0.25 * params->mu * squares);
}

/* Second Piola-Kirchhoff stress times volume, V S = V (lambda tr(E) 1 + 2 mu E), as (S11, S22, S12) (13). */
static void stress(double f[2][3], const cipc_membrane *params, double S[3])
{
    metric_change m = metric_change_of(f);
    double mean = 0.5 * params->lambda * (m.e11 + m.e22);
    S[0] = params->volume * (mean + params->mu * m.e11);
    S[1] = params->volume * (mean + params->mu * m.e22);
    S[2] = params->volume * params->mu * m.c12;
}

void cipc_membrane_stvk_gradient(const double x[9], const cipc_membrane *params, double g[9])
{
    double f[2][3], w[3][2], S[3];
    deformation_gradient(x, params->inverse_rest, f);
    node_weights(params->inverse_rest, w);
    stress(f, params, S);
    for (int i = 0; i < 3; i++) {
        double on_f0 = S[0] * w[i][0] + S[2] * w[i][1], on_f1 = S[2] * w[i][0] + S[1] * w[i][1];
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_f0 * f[0][k] + on_f1 * f[1][k];
    }
}

void cipc_membrane_stvk_hessian(const double x[9], const cipc_membrane *params, double H[81])
{
    double f[2][3], w[3][2], p[3][3], S[3], outer[3][3];
    deformation_gradient(x, params->inverse_rest, f);
    node_weights(params->inverse_rest, w);
    node_vectors(w, f, p);
    stress(f, params, S);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) outer[r][c] = f[0][r] * f[0][c] + f[1][r] * f[1][c]; /* F F^T */
    }
    double mu = params->volume * params->mu, lambda = params->volume * params->lambda;
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double w_dot = mu * dot2(w[i], w[j]), K[3][3];
            double w_S_w = S[0] * (w[i][0] * w[j][0]) + S[1] * (w[i][1] * w[j][1]) + S[2] * (w[i][0] * w[j][1] + w[i][1] * w[j][0]);
            for (int r = 0; r < 3; r++) {
                for (int c = 0; c < 3; c++) { K[r][c] = lambda * (p[i][r] * p[j][c]) + mu * (p[j][r] * p[i][c]) + w_dot * outer[r][c]; }
                K[r][r] += w_S_w;
            }
            put_block_pair(H, 9, i, j, K);
        }
    }
}
