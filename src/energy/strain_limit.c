/* Isotropic strain limit: kappa_s V sum_i b(sigma_i) over the principal stretches, infinite at sigma = s
 * (SPEC C.2, F6; docs/theory/energies.md (15)-(20)). */
#include "cipc/energy.h"
#include "energy/stretch_energy.h"

bool cipc_strain_limit_init(cipc_strain_limit *params, const double rest[9], double thickness, double limit, double activation,
                            double stiffness)
{
    double area;
    if (!energy_rest_triangle(rest, params->inverse_rest, &area)) return false;
    params->volume = area * thickness;
    params->limit = limit;
    params->activation = activation;
    params->stiffness = stiffness;
    return true;
}

/* (17), in t = (sigma - shat)/(s - shat) and q = 1 - t: every sum is of terms of one sign. A lower limit has a negative width. */
void cipc_strain_limit_barrier(double sigma, double limit, double activation, double b[3])
{
    double width = limit - activation, t = (sigma - activation) / width, q = (limit - sigma) / width;
    b[0] = b[1] = b[2] = 0;
    if (t <= 0) return;
    double log_q = log_of_complement(t, q), ratio = t / q;
    b[0] = -t * t * log_q;
    b[1] = (-2 * t * log_q + t * ratio) / width;
    b[2] = (-2 * log_q + 4 * ratio + ratio * ratio) / (width * width);
}

void cipc_principal_stretches(const double x[9], const double inverse_rest[3], double sigma[2])
{
    double f[2][3];
    deformation_gradient(x, inverse_rest, f);
    metric m = metric_of(f);
    stretches_of(f, &m, sigma);
}

double cipc_strain_limit_value(const double x[9], const cipc_strain_limit *params)
{
    double sigma[2], b1[3], b2[3];
    cipc_principal_stretches(x, params->inverse_rest, sigma);
    if (!(sigma[0] < params->limit)) return INFINITY;
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    return params->stiffness * params->volume * (b1[0] + b2[0]);
}

void cipc_strain_limit_gradient(const double x[9], const cipc_strain_limit *params, double g[9])
{
    double f[2][3], alpha[2][3], b1[3], b2[3];
    deformation_gradient(x, params->inverse_rest, f);
    metric m = metric_of(f);
    if (sqrt(m.largest) <= params->activation) {
        put_zeros(g, 9);
        return;
    }
    singular s = singular_of(f, &m);
    singular_weights(&s, params->inverse_rest, alpha);
    cipc_strain_limit_barrier(s.sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(s.sigma[1], params->limit, params->activation, b2);
    double scale = params->stiffness * params->volume, slope[2] = {scale * b1[1], scale * b2[1]};
    stretch_gradient(&s, slope, alpha, g);
}

/* With one stretch active nothing cancels in the quotient (20). */
static curvature curvature_of(const double sigma[2], const cipc_strain_limit *params)
{
    double b1[3], b2[3], scale = params->stiffness * params->volume;
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    double difference =
        sigma[1] > params->activation ? slope_difference_quotient(sigma, params->limit, params->activation) : b1[1] / (sigma[0] - sigma[1]);
    double sum = (b1[1] + b2[1]) / (sigma[0] + sigma[1]);
    return (curvature){
        .along = {scale * b1[2], scale * b2[2]},
        .shear = 0.5 * scale * (difference + sum),
        .coupling = 0.5 * scale * (difference - sum),
        .out = {scale * b1[1] / sigma[0], sigma[1] > params->activation ? scale * b2[1] / sigma[1] : 0},
    };
}

void cipc_strain_limit_hessian(const double x[9], const cipc_strain_limit *params, double H[81])
{
    double f[2][3], alpha[2][3];
    deformation_gradient(x, params->inverse_rest, f);
    metric m = metric_of(f);
    if (sqrt(m.largest) <= params->activation) {
        put_zeros(H, 81);
        return;
    }
    singular s = singular_of(f, &m);
    singular_weights(&s, params->inverse_rest, alpha);
    curvature k = curvature_of(s.sigma, params);
    stretch_hessian(&s, &k, alpha, H);
}
