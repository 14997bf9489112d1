/* Neo-Hookean volume: V [mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2] (SPEC C.6; docs/theory/energies.md (42)-(44)). */
#include "energy/blocks.h"
#include "energy/volume.h"

/* tr C - 3 and ln det C = 2 ln J from e = C - 1: near rest both are small sums of the same roundings, which then cancel in their difference (42). */
static void metric_change(deformation *d, double *trace, double *twice_log_J)
{
    double e[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) e[a][b] = v3_dot(d->f[a], d->f[b]) - (a == b ? 1 : 0);
    double minors = 0, cofactor[3];
    *trace = e[0][0] + e[1][1] + e[2][2];
    for (int a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        minors += e[a][a] * e[b][b] - e[a][b] * e[a][b];
    }
    v3_cross(cofactor, e[1], e[2]);
    double change = *trace + minors + v3_dot(e[0], cofactor); /* det C - 1 */
    *twice_log_J = fabs(change) < 0.5 ? log1p(change) : 2 * log(d->J);
}

double cipc_volume_neo_hookean_value(const double x[12], const cipc_volume *params)
{
    deformation d = deformation_of(x, params->inverse_rest);
    double trace, twice_log_J;
    if (!(d.J > 0)) return INFINITY;
    metric_change(&d, &trace, &twice_log_J);
    return params->volume * (0.5 * params->mu * (trace - twice_log_J) + 0.125 * params->lambda * twice_log_J * twice_log_J);
}

/* a_i = F^-T w_i. */
static void inverse_weights(deformation *d, double w[4][3], double a[4][3])
{
    for (int i = 0; i < 4; i++) {
        combine(a[i], d->cofactor, w[i]);
        v3_scale(a[i], 1 / d->J, a[i]);
    }
}

/* (43): P = mu F + (lambda ln J - mu) F^-T. */
void cipc_volume_neo_hookean_gradient(const double x[12], const cipc_volume *params, double g[12])
{
    deformation d = deformation_of(x, params->inverse_rest);
    double w[4][3], a[4][3], on_F = params->volume * params->mu, on_inverse = params->volume * (params->lambda * log(d.J) - params->mu);
    volume_weights(params->inverse_rest, w);
    inverse_weights(&d, w, a);
    for (int i = 0; i < 4; i++) {
        combine(g + 3 * i, d.f, w[i]);
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_F * g[3 * i + k] + on_inverse * a[i][k];
    }
}

/* (44): blocks mu (w_i.w_j) 1 + (mu - lambda ln J) a_j a_i^T + lambda a_i a_j^T, times V. */
void cipc_volume_neo_hookean_hessian(const double x[12], const cipc_volume *params, double H[144])
{
    deformation d = deformation_of(x, params->inverse_rest);
    double w[4][3], a[4][3], K[3][3], mu = params->volume * params->mu, lambda = params->volume * params->lambda, crossed = mu - lambda * log(d.J);
    volume_weights(params->inverse_rest, w);
    inverse_weights(&d, w, a);
    for (int i = 0; i < 4; i++) {
        for (int j = i; j < 4; j++) {
            double same = mu * v3_dot(w[i], w[j]);
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) K[r][c] = crossed * a[j][r] * a[i][c] + lambda * a[i][r] * a[j][c] + (r == c ? same : 0);
            put_block_pair(H, 12, i, j, K);
        }
    }
}
