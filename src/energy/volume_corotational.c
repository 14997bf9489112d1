/* Fixed corotational tetrahedron: V [mu |F - R|^2 + lambda/2 (J - 1)^2] (the C-IPC paper; docs/theory/energies.md (V6)-(V9)). */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/inverse3.h"
#include "energy/polar_rotation.h"
#include "energy/volume.h"

/* The state of one tetrahedron: F, its rotation, J. */
typedef struct solid {
    double F[9], R[9], J;
} solid;

/* False if the tetrahedron is flat or inverted. */
static bool solid_of(const double x[12], const cipc_volume *params, solid *s)
{
    double inverse[9];
    volume_deformation(x, params->inverse_rest, s->F);
    s->J = energy_inverse3(s->F, inverse);
    return s->J > 0 && energy_polar_rotation(s->F, s->R);
}

double cipc_volume_corotational_value(const double x[12], const cipc_volume *params)
{
    solid s;
    double shape = 0;
    if (!solid_of(x, params, &s)) return INFINITY;
    for (int i = 0; i < 9; i++) shape += (s.F[i] - s.R[i]) * (s.F[i] - s.R[i]);
    return params->volume * (params->mu * shape + 0.5 * params->lambda * (s.J - 1) * (s.J - 1));
}

/* c_i = dJ/dx_i = cof(F) w_i (V7). The rows of cof F are the cross products of the rows of F. */
static void volume_gradients(const double F[9], double w[4][3], double c[4][3])
{
    double cofactor[9];
    for (int k = 0; k < 3; k++) v3_cross(cofactor + 3 * k, F + 3 * ((k + 1) % 3), F + 3 * ((k + 2) % 3));
    for (int i = 0; i < 4; i++) m3_times(c[i], cofactor, w[i]);
}

void cipc_volume_corotational_gradient(const double x[12], const cipc_volume *params, double g[12])
{
    solid s;
    double w[4][3], c[4][3], apart[9];
    (void)solid_of(x, params, &s);
    volume_weights(params->inverse_rest, w);
    volume_gradients(s.F, w, c);
    for (int i = 0; i < 9; i++) apart[i] = s.F[i] - s.R[i];
    double on_shape = 2 * params->volume * params->mu, on_volume = params->volume * params->lambda * (s.J - 1);
    for (int i = 0; i < 4; i++) {
        double p[3];
        m3_times(p, apart, w[i]);
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_shape * p[k] + on_volume * c[i][k];
    }
}

/* T = (tr S - S)^-1, S = R^T F, which takes the turning of F to that of R (V8). Positive definite, its eigenvalues are 1/(sigma_a + sigma_b). */
static void turning_compliance(const solid *s, double T[9])
{
    double S[9], A[9];
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) S[3 * a + b] = s->R[a] * s->F[b] + s->R[3 + a] * s->F[3 + b] + s->R[6 + a] * s->F[6 + b];
    }
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) A[3 * a + b] = -0.5 * (S[3 * a + b] + S[3 * b + a]);
        A[4 * a] = S[4 * ((a + 1) % 3)] + S[4 * ((a + 2) % 3)];
    }
    (void)energy_inverse3(A, T);
}

/* The columns of R [w]x: y -> R (w x y). */
static void turned_cross(const double R[9], const double w[3], double M[3][3])
{
    for (int r = 0; r < 3; r++) v3_cross(M[r], R + 3 * r, w); /* row r of R, times [w]x */
}

void cipc_volume_corotational_hessian(const double x[12], const cipc_volume *params, double H[144])
{
    solid s;
    double w[4][3], c[4][3], T[9], M[4][3][3];
    (void)solid_of(x, params, &s);
    volume_weights(params->inverse_rest, w);
    volume_gradients(s.F, w, c);
    turning_compliance(&s, T);
    for (int i = 0; i < 4; i++) turned_cross(s.R, w[i], M[i]);
    double twice_mu = 2 * params->volume * params->mu, lambda = params->volume * params->lambda, pressure = lambda * (s.J - 1);
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double diagonal = twice_mu * v3_dot(w[i], w[j]), across[3], z[3], K[3][3];
            v3_cross(across, w[i], w[j]);
            m3_times(z, s.F, across);
            const double minus_z_cross[3][3] = {{0, z[2], -z[1]}, {-z[2], 0, z[0]}, {z[1], -z[0], 0}};
            for (int r = 0; r < 3; r++) {
                double turned[3];
                m3_transposed_times(turned, T, M[i][r]);
                for (int k = 0; k < 3; k++) K[r][k] = lambda * (c[i][r] * c[j][k]) + pressure * minus_z_cross[r][k] - twice_mu * v3_dot(turned, M[j][k]);
                K[r][r] += diagonal;
            }
            put_block_pair(H, 12, i, j, K);
        }
    }
}
