/* Smoothed, lagged Coulomb friction of one contact: mu lambda f0(|u|) (SPEC D.6; docs/theory/energies.md (30)-(33)). */
#include "base/vector.h"
#include "cipc/energy.h"

/* (31): f0, f1 = f0', f1' for y >= 0. */
void cipc_friction_mollifier(double y, double e, double f[3])
{
    double ratio = y / e;
    if (ratio >= 1) {
        f[0] = y;
        f[1] = 1;
        f[2] = 0;
        return;
    }
    f[0] = y * ratio * (1 - ratio / 3) + e / 3;
    f[1] = ratio * (2 - ratio);
    f[2] = 2 * (1 - ratio) / e;
}

/* (30): tangential sliding u = P^T sum_i w_i (x_i - start_i). */
static void sliding(const double x[12], const cipc_friction *params, double u[2])
{
    double slip[3] = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) slip[k] += params->weights[i] * (x[3 * i + k] - params->start[3 * i + k]);
    }
    u[0] = v3_dot(params->basis, slip);
    u[1] = v3_dot(params->basis + 3, slip);
}

/* f1(y)/y without the division by zero: (2 - y/e)/e while it sticks, 1/y while it slides. */
static double slope_over_length(double y, double e)
{
    return y < e ? (2 - y / e) / e : 1 / y;
}

double cipc_friction_value(const double x[12], const cipc_friction *params)
{
    double u[2], f[3];
    sliding(x, params, u);
    cipc_friction_mollifier(sqrt(u[0] * u[0] + u[1] * u[1]), params->eps, f);
    return params->coefficient * f[0];
}

void cipc_friction_gradient(const double x[12], const cipc_friction *params, double g[12])
{
    double u[2];
    sliding(x, params, u);
    double drag = params->coefficient * slope_over_length(sqrt(u[0] * u[0] + u[1] * u[1]), params->eps);
    for (int k = 0; k < 3; k++) {
        double along = drag * (params->basis[k] * u[0] + params->basis[3 + k] * u[1]);
        for (int i = 0; i < 4; i++) g[3 * i + k] = params->weights[i] * along;
    }
}

/* (33): mu lambda [f1/y 1 + (f1' - f1/y) u u^T/y^2] as (11, 22, 12); positive semi-definite. */
static void sliding_hessian(const double u[2], const cipc_friction *params, double M[3])
{
    double e = params->eps, y = sqrt(u[0] * u[0] + u[1] * u[1]), across = slope_over_length(y, e);
    double along_minus_across = y < e ? -y / (e * e) : -across;
    double inverse = y > 0 ? 1 / y : 0, t[2] = {u[0] * inverse, u[1] * inverse};
    M[0] = params->coefficient * (across + along_minus_across * t[0] * t[0]);
    M[1] = params->coefficient * (across + along_minus_across * t[1] * t[1]);
    M[2] = params->coefficient * along_minus_across * t[0] * t[1];
}

/* W^T P M P^T W, W the weights: M, as (11, 22, 12), on the nodes of the stencil. */
static void on_nodes(const cipc_friction *params, const double M[3], double H[144])
{
    double K[3][3];
    const double *p = params->basis, *q = params->basis + 3, *w = params->weights;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) K[r][c] = M[0] * (p[r] * p[c]) + M[1] * (q[r] * q[c]) + M[2] * (p[r] * q[c] + q[r] * p[c]);
    }
    for (int r = 0; r < 3; r++) {
        double row[12]; /* the row of a node of weight 1 */
        for (int j = 0; j < 12; j++) row[j] = w[j / 3] * K[r][j % 3];
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 12; j++) H[12 * (3 * i + r) + j] = w[i] * row[j];
        }
    }
}

void cipc_friction_hessian(const double x[12], const cipc_friction *params, double H[144])
{
    double u[2], M[3];
    sliding(x, params, u);
    sliding_hessian(u, params, M);
    on_nodes(params, M, H);
}

void cipc_friction_majorizer(const double x[12], const cipc_friction *params, double H[144])
{
    double u[2];
    sliding(x, params, u);
    const double m = params->coefficient * slope_over_length(sqrt(u[0] * u[0] + u[1] * u[1]), params->eps); /* (34) */
    on_nodes(params, (const double[3]){m, m, 0}, H);
}
