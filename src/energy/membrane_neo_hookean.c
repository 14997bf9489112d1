/* Neo-Hookean membrane: V [mu/2 (tr C - 2 - 2 ln J) + lambda/2 (ln J)^2] (SPEC C.6; docs/theory/energies.md (8)-(11)). */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/membrane.h"

/* Below this change of area and metric the logarithm is taken of 1 + change, which keeps the small strains that tr C - 2 - 2 ln J would
 * cancel; above, of det C from the cross product, which keeps the digits of thin triangles. Both are right on either side. */
static const double SMALL_CHANGE = 0.25;

/* The state of one triangle: columns of F, N = f0 x f1, det C = |N|^2 = J^2. */
typedef struct surface {
    double f[2][3];
    double normal[3];
    double det;
} surface;

static surface surface_of(const double x[9], const cipc_membrane *params)
{
    surface s;
    deformation_gradient(x, params->inverse_rest, s.f);
    v3_cross(s.normal, s.f[0], s.f[1]);
    s.det = v3_norm2(s.normal);
    return s;
}

/* (9): *log_det = ln det C = 2 ln J, and the return value is tr C - 2 - ln det C. */
static double trace_minus_log(surface *s, double *log_det)
{
    metric_change m = metric_change_of(s->f);
    double trace = m.e11 + m.e22, product = m.e11 * m.e22 - m.c12 * m.c12;
    if (fabs(trace) < SMALL_CHANGE && fabs(product) < SMALL_CHANGE) {
        double change = trace + product; /* det C - 1 */
        *log_det = log1p(change);
        return (change - *log_det) - product;
    }
    *log_det = log(s->det);
    return trace - *log_det;
}

double cipc_membrane_neo_hookean_value(const double x[9], const cipc_membrane *params)
{
    surface s = surface_of(x, params);
    if (!(s.det > 0)) return INFINITY;
    double log_det, deviation = trace_minus_log(&s, &log_det);
    return params->volume * (0.5 * params->mu * deviation + 0.125 * params->lambda * log_det * log_det);
}

/* The vectors q_i = d(ln J)/dx_i (10), from the dual columns g_a of F, g_a.f_b = delta_ab. */
static void log_area_gradient(surface *s, double w[3][2], double q[3][3])
{
    double dual[2][3];
    v3_cross(dual[0], s->f[1], s->normal);
    v3_cross(dual[1], s->normal, s->f[0]);
    double inverse = 1 / s->det;
    for (int a = 0; a < 2; a++) v3_scale(dual[a], inverse, dual[a]);
    node_vectors(w, dual, q);
}

void cipc_membrane_neo_hookean_gradient(const double x[9], const cipc_membrane *params, double g[9])
{
    surface s = surface_of(x, params);
    double w[3][2], p[3][3], q[3][3], log_det;
    node_weights(params->inverse_rest, w);
    node_vectors(w, s.f, p);
    log_area_gradient(&s, w, q);
    (void)trace_minus_log(&s, &log_det);
    double on_p = params->volume * params->mu, on_q = params->volume * (0.5 * params->lambda * log_det - params->mu);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_p * p[i][k] + on_q * q[i][k];
    }
}

void cipc_membrane_neo_hookean_hessian(const double x[9], const cipc_membrane *params, double H[81])
{
    surface s = surface_of(x, params);
    double w[3][2], q[3][3], log_det;
    node_weights(params->inverse_rest, w);
    log_area_gradient(&s, w, q);
    (void)trace_minus_log(&s, &log_det);
    double mu = params->volume * params->mu, lambda = params->volume * params->lambda;
    double k = 0.5 * lambda * log_det - mu, k_normal = k / s.det; /* the normal here has length J */
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double diagonal = mu * dot2(w[i], w[j]), normal = k_normal * v3_dot(q[i], q[j]), K[3][3];
            for (int r = 0; r < 3; r++) {
                for (int c = 0; c < 3; c++) {
                    K[r][c] = lambda * (q[i][r] * q[j][c]) - k * (q[j][r] * q[i][c]) + normal * (s.normal[r] * s.normal[c]);
                }
                K[r][r] += diagonal;
            }
            put_block_pair(H, 9, i, j, K);
        }
    }
}
