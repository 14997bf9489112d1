/* Lower strain limit: kappa_s V sum_i b(sigma_i), infinite where the smaller principal stretch comes down to s
 * (SPEC C.2; docs/theory/energies.md (20a)-(20c)). */
#include "cipc/energy.h"
#include "energy/stretch_energy.h"

bool cipc_strain_limit_lower_init(cipc_strain_limit *params, const double rest[9], double thickness, double limit, double activation,
                                  double stiffness)
{
    if (!(0 < limit && limit < activation && activation <= 1)) return false;
    return cipc_strain_limit_init(params, rest, thickness, limit, activation, stiffness);
}

double cipc_strain_limit_lower_value(const double x[9], const cipc_strain_limit *params)
{
    double sigma[2], b1[3], b2[3];
    cipc_principal_stretches(x, params->inverse_rest, sigma);
    if (!(sigma[1] > params->limit)) return INFINITY;
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    return params->stiffness * params->volume * (b1[0] + b2[0]);
}

/* Singular values and vectors of F; false if neither stretch is below the activation. */
static bool compressed(const double x[9], const cipc_strain_limit *params, singular *s)
{
    double f[2][3];
    deformation_gradient(x, params->inverse_rest, f);
    metric m = metric_of(f);
    *s = singular_of(f, &m);
    return s->sigma[1] < params->activation;
}

void cipc_strain_limit_lower_gradient(const double x[9], const cipc_strain_limit *params, double g[9])
{
    double alpha[2][3], b1[3], b2[3];
    singular s;
    if (!compressed(x, params, &s)) {
        put_zeros(g, 9);
        return;
    }
    singular_weights(&s, params->inverse_rest, alpha);
    cipc_strain_limit_barrier(s.sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(s.sigma[1], params->limit, params->activation, b2);
    double scale = params->stiffness * params->volume, slope[2] = {scale * b1[1], scale * b2[1]};
    stretch_gradient(&s, slope, alpha, g);
}

/* As for the upper limit, with the stretches in the other order: sigma_2 is the one near the limit and active first (20c). */
static curvature curvature_of(const double sigma[2], const cipc_strain_limit *params)
{
    double b1[3], b2[3], scale = params->stiffness * params->volume, nearer_first[2] = {sigma[1], sigma[0]};
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    double difference = sigma[0] < params->activation ? slope_difference_quotient(nearer_first, params->limit, params->activation)
                                                      : b2[1] / (sigma[1] - sigma[0]);
    double sum = (b1[1] + b2[1]) / (sigma[0] + sigma[1]);
    return (curvature){
        .along = {scale * b1[2], scale * b2[2]},
        .shear = 0.5 * scale * (difference + sum),
        .coupling = 0.5 * scale * (difference - sum),
        .out = {scale * b1[1] / sigma[0], scale * b2[1] / sigma[1]},
    };
}

void cipc_strain_limit_lower_hessian(const double x[9], const cipc_strain_limit *params, double H[81])
{
    double alpha[2][3];
    singular s;
    if (!compressed(x, params, &s)) {
        put_zeros(H, 81);
        return;
    }
    singular_weights(&s, params->inverse_rest, alpha);
    curvature k = curvature_of(s.sigma, params);
    stretch_hessian(&s, &k, alpha, H);
}
