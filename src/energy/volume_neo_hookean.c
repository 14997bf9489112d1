/* Neo-Hookean tetrahedron: V [mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2] (SPEC C.6; docs/theory/energies.md (V3)-(V5)). */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/inverse3.h"
#include "energy/volume.h"

/* Below this size of the metric's change the logarithm is taken of 1 + change, which keeps the small strains that tr C - 3 - 2 ln J would cancel;
 * above, of J itself, which keeps the digits of flat tetrahedra. Both are right on either side. */
static const double SMALL_CHANGE = 0.25;

/* The state of one tetrahedron. */
typedef struct solid {
    double F[9], inverse[9], J;
} solid;

static solid solid_of(const double x[12], const cipc_volume *params)
{
    solid s;
    volume_deformation(x, params->inverse_rest, s.F);
    s.J = energy_inverse3(s.F, s.inverse);
    return s;
}

/* Invariants of M = C - 1: trace, sum of the principal minors, determinant. */
static void metric_invariants(const double F[9], double invariant[3])
{
    double M[3][3];
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) M[a][b] = F[a] * F[b] + F[3 + a] * F[3 + b] + F[6 + a] * F[6 + b] - (a == b);
    }
    double minor0 = M[1][1] * M[2][2] - M[1][2] * M[2][1], minor1 = M[0][0] * M[2][2] - M[0][2] * M[2][0], minor2 = M[0][0] * M[1][1] - M[0][1] * M[1][0];
    invariant[0] = M[0][0] + M[1][1] + M[2][2];
    invariant[1] = minor0 + minor1 + minor2;
    invariant[2] = M[0][0] * minor0 - M[0][1] * (M[1][0] * M[2][2] - M[1][2] * M[2][0]) + M[0][2] * (M[1][0] * M[2][1] - M[1][1] * M[2][0]);
}

/* (V4): *log_J = ln J, and the return value is tr C - 3 - 2 ln J. */
static double trace_minus_log(const solid *s, double *log_J)
{
    double m[3];
    metric_invariants(s->F, m);
    if (fmax(fabs(m[0]), fmax(fabs(m[1]), fabs(m[2]))) < SMALL_CHANGE) {
        double change = m[0] + m[1] + m[2], log_det = log1p(change); /* det C - 1 */
        *log_J = 0.5 * log_det;
        return (change - log_det) - (m[1] + m[2]);
    }
    *log_J = log(s->J);
    return m[0] - 2 * *log_J;
}

double cipc_volume_neo_hookean_value(const double x[12], const cipc_volume *params)
{
    solid s = solid_of(x, params);
    if (!(s.J > 0)) return INFINITY;
    double log_J, deviation = trace_minus_log(&s, &log_J);
    return params->volume * (0.5 * params->mu * deviation + 0.5 * params->lambda * log_J * log_J);
}

/* q_i = d(ln J)/dx_i = F^-T w_i. */
static void log_gradients(const solid *s, double w[4][3], double q[4][3])
{
    for (int i = 0; i < 4; i++) m3_transposed_times(q[i], s->inverse, w[i]);
}

void cipc_volume_neo_hookean_gradient(const double x[12], const cipc_volume *params, double g[12])
{
    solid s = solid_of(x, params);
    double w[4][3], q[4][3], log_J;
    volume_weights(params->inverse_rest, w);
    log_gradients(&s, w, q);
    (void)trace_minus_log(&s, &log_J);
    double on_F = params->volume * params->mu, on_q = params->volume * (params->lambda * log_J - params->mu);
    for (int i = 0; i < 4; i++) {
        double p[3];
        m3_times(p, s.F, w[i]);
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_F * p[k] + on_q * q[i][k];
    }
}

void cipc_volume_neo_hookean_hessian(const double x[12], const cipc_volume *params, double H[144])
{
    solid s = solid_of(x, params);
    double w[4][3], q[4][3], log_J;
    volume_weights(params->inverse_rest, w);
    log_gradients(&s, w, q);
    (void)trace_minus_log(&s, &log_J);
    double mu = params->volume * params->mu, lambda = params->volume * params->lambda, k = lambda * log_J - mu;
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double diagonal = mu * v3_dot(w[i], w[j]), K[3][3];
            for (int r = 0; r < 3; r++) {
                for (int c = 0; c < 3; c++) K[r][c] = lambda * (q[i][r] * q[j][c]) - k * (q[j][r] * q[i][c]);
                K[r][r] += diagonal;
            }
            put_block_pair(H, 12, i, j, K);
        }
    }
}
