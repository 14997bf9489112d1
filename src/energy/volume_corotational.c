/* Fixed corotational volume: V [mu |F - R|^2 + lambda/2 (J - 1)^2], F = R S (SPEC C.6; docs/theory/energies.md (45)-(49)). */
#include "energy/blocks.h"
#include "energy/polar_rotation.h"
#include "energy/volume.h"

double cipc_volume_corotational_value(const double x[12], const cipc_volume *params)
{
    deformation d = deformation_of(x, params->inverse_rest);
    double R[3][3], off = 0;
    if (!(d.J > 0)) return INFINITY;
    energy_polar_rotation(d.f, R);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) off += (d.f[c][k] - R[c][k]) * (d.f[c][k] - R[c][k]);
    return params->volume * (params->mu * off + 0.5 * params->lambda * (d.J - 1) * (d.J - 1));
}

/* (47): P = 2 mu (F - R) + lambda (J - 1) cof F. */
void cipc_volume_corotational_gradient(const double x[12], const cipc_volume *params, double g[12])
{
    deformation d = deformation_of(x, params->inverse_rest);
    double R[3][3], P[3][3], w[4][3], shape = 2 * params->volume * params->mu, size = params->volume * params->lambda * (d.J - 1);
    energy_polar_rotation(d.f, R);
    volume_weights(params->inverse_rest, w);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) P[c][k] = shape * (d.f[c][k] - R[c][k]) + size * d.cofactor[c][k];
    for (int i = 0; i < 4; i++) combine(g + 3 * i, P, w[i]);
}

/* Inverse of the symmetric tr(S) 1 - S, S = R^T F, by its cofactors (its columns); its eigenvalues are sums of two stretches, all positive. */
static void invert_pair_sums(double R[3][3], double f[3][3], double inverse[3][3])
{
    double G[3][3], trace = v3_dot(R[0], f[0]) + v3_dot(R[1], f[1]) + v3_dot(R[2], f[2]);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) G[a][b] = (a == b ? trace : 0) - 0.5 * (v3_dot(R[a], f[b]) + v3_dot(R[b], f[a]));
    for (int c = 0; c < 3; c++) v3_cross(inverse[c], G[(c + 1) % 3], G[(c + 2) % 3]);
    double determinant = v3_dot(G[0], inverse[0]);
    for (int c = 0; c < 3; c++) v3_scale(inverse[c], 1 / determinant, inverse[c]);
}

/* (48): the change of R w_i with node j's coordinate c: R (omega x w_i), omega = (tr S - S)^-1 (w_j x R^T e_c). Columns c. */
static void rotation_block(double R[3][3], double inverse[3][3], const double wi[3], const double wj[3], double K[3][3])
{
    for (int c = 0; c < 3; c++) {
        const double row[3] = {R[0][c], R[1][c], R[2][c]};
        double twist[3], omega[3], turned[3], change[3];
        v3_cross(twist, wj, row);
        combine(omega, inverse, twist);
        v3_cross(turned, omega, wi);
        combine(change, R, turned);
        for (int r = 0; r < 3; r++) K[r][c] = change[r];
    }
}

/* (49). d(cof F w_i) for node j's coordinate c is e_c x F (w_i x w_j). */
void cipc_volume_corotational_hessian(const double x[12], const cipc_volume *params, double H[144])
{
    deformation d = deformation_of(x, params->inverse_rest);
    double R[3][3], inverse[3][3], w[4][3], b[4][3], K[3][3];
    double shape = 2 * params->volume * params->mu, lambda = params->volume * params->lambda, size = lambda * (d.J - 1);
    energy_polar_rotation(d.f, R);
    invert_pair_sums(R, d.f, inverse);
    volume_weights(params->inverse_rest, w);
    for (int i = 0; i < 4; i++) combine(b[i], d.cofactor, w[i]);
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double both[3], h[3], same = shape * v3_dot(w[i], w[j]);
            rotation_block(R, inverse, w[i], w[j], K);
            v3_cross(both, w[i], w[j]);
            combine(h, d.f, both);
            const double turn[3][3] = {{0, h[2], -h[1]}, {-h[2], 0, h[0]}, {h[1], -h[0], 0}}; /* e_c x h in column c */
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) K[r][c] = (r == c ? same : 0) - shape * K[r][c] + lambda * b[i][r] * b[j][c] + size * turn[r][c];
            put_block_pair(H, 12, i, j, K);
        }
    }
}
