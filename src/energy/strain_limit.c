/* Isotropic strain limit: kappa_s V sum_i b(sigma_i) over the principal stretches, infinite at sigma = s
 * (SPEC C.2, F6; docs/theory/energies.md (15)-(20)). An upper limit has s > shat, a lower one s < shat: in t = (sigma - shat)/(s - shat) both are the same. */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/membrane.h"

/* Below one half, ln(1 - t) is taken as log1p(-t), above as ln of the ratio q = 1 - t, which is exact to rounding near the limit. */
static const double LOG_SWITCH = 0.5;

static double log_of_complement(double t, double q)
{
    return t < LOG_SWITCH ? log1p(-t) : log(q);
}

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

/* (17), in t = (sigma - shat)/(s - shat) and q = 1 - t: every sum is of terms of one sign. */
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

/* (20): [b'(sigma_1) - b'(sigma_2)] / (sigma_1 - sigma_2) for sigma_1 >= sigma_2, both past shat; b'' where they meet. */
static double slope_difference_quotient(const double sigma[2], double limit, double activation)
{
    double width = limit - activation;
    double t1 = (sigma[0] - activation) / width, q1 = (limit - sigma[0]) / width;
    double t2 = (sigma[1] - activation) / width, q2 = (limit - sigma[1]) / width;
    double z = (sigma[0] - sigma[1]) / (limit - sigma[1]);
    double mean_log = z != 0 ? -log_of_complement(z, q1 / q2) / z : 1; /* -ln(1 - z)/z */
    return (-2 * log_of_complement(t1, q1) + 2 * (t2 / q2) * mean_log + (t1 + t2 * q1) / (q1 * q2)) / (width * width);
}

/* Metric C of F, its half difference and largest eigenvalue (15). */
typedef struct metric {
    double half_difference, c12, radius, largest;
} metric;

static metric metric_of(double f[2][3])
{
    double c11 = v3_norm2(f[0]), c22 = v3_norm2(f[1]);
    metric m = {.half_difference = 0.5 * (c11 - c22), .c12 = v3_dot(f[0], f[1])};
    m.radius = hypot(m.half_difference, m.c12);
    m.largest = 0.5 * (c11 + c22) + m.radius;
    return m;
}

/* sigma_1 is the root of the larger eigenvalue of C, where nothing cancels; sigma_2 = J/sigma_1 with J from the cross product. */
static void stretches_of(double f[2][3], const metric *m, double sigma[2])
{
    double normal[3];
    v3_cross(normal, f[0], f[1]);
    sigma[0] = sqrt(m->largest);
    sigma[1] = sigma[0] > 0 ? fmin(v3_norm(normal) / sigma[0], sigma[0]) : 0;
}

void cipc_principal_stretches(const double x[9], const double inverse_rest[3], double sigma[2])
{
    double f[2][3];
    deformation_gradient(x, inverse_rest, f);
    metric m = metric_of(f);
    stretches_of(f, &m, sigma);
}

/* Singular value decomposition F = sigma_1 u_1 v_1^T + sigma_2 u_2 v_2^T. u_2 is 0 if sigma_2 is. */
typedef struct singular {
    double sigma[2], u[2][3], v[2][2];
} singular;

/* Unit eigenvector of C to its larger eigenvalue: of the two columns of C - lambda_2, the one that does not cancel. */
static void principal_direction(const metric *m, double v[2])
{
    double a = m->radius + fabs(m->half_difference), length = hypot(a, m->c12);
    v[0] = 1;
    v[1] = 0;
    if (length == 0) return; /* sigma_1 = sigma_2: any direction */
    v[m->half_difference < 0] = a / length;
    v[m->half_difference >= 0] = m->c12 / length;
}

static singular singular_of(double f[2][3], const metric *m)
{
    singular s;
    stretches_of(f, m, s.sigma);
    principal_direction(m, s.v[0]);
    s.v[1][0] = -s.v[0][1];
    s.v[1][1] = s.v[0][0];
    for (int a = 0; a < 2; a++) {
        for (int k = 0; k < 3; k++) s.u[a][k] = f[0][k] * s.v[a][0] + f[1][k] * s.v[a][1];
        double length = v3_norm(s.u[a]);
        v3_scale(s.u[a], length > 0 ? 1 / length : 0, s.u[a]);
    }
    return s;
}

/* Is this stretch past the threshold, on the side of the limit? */
static bool is_active(double sigma, const cipc_strain_limit *params)
{
    return params->limit > params->activation ? sigma > params->activation : sigma < params->activation;
}

bool cipc_strain_limit_feasible(const double sigma[2], const cipc_strain_limit *params, double margin)
{
    if (params->limit > params->activation) return sigma[0] < params->limit * (1 - margin);
    return sigma[1] > params->limit * (1 + margin);
}

double cipc_strain_limit_value(const double x[9], const cipc_strain_limit *params)
{
    double sigma[2], b1[3], b2[3];
    cipc_principal_stretches(x, params->inverse_rest, sigma);
    if (!cipc_strain_limit_feasible(sigma, params, 0)) return INFINITY;
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    return params->stiffness * params->volume * (b1[0] + b2[0]);
}

/* Neither stretch is past the threshold: nothing acts, and no directions are needed. */
static bool is_idle(double f[2][3], const metric *m, const cipc_strain_limit *params)
{
    double sigma[2];
    stretches_of(f, m, sigma);
    return !is_active(sigma[0], params) && !is_active(sigma[1], params);
}

/* Weights of the nodes in the singular basis: alpha[a][i] = w_i.v_a. */
static void singular_weights(const singular *s, const double inverse_rest[3], double alpha[2][3])
{
    double w[3][2];
    node_weights(inverse_rest, w);
    for (int a = 0; a < 2; a++) {
        for (int i = 0; i < 3; i++) alpha[a][i] = dot2(w[i], s->v[a]);
    }
}

void cipc_strain_limit_gradient(const double x[9], const cipc_strain_limit *params, double g[9])
{
    double f[2][3], alpha[2][3], b1[3], b2[3];
    deformation_gradient(x, params->inverse_rest, f);
    metric m = metric_of(f);
    if (is_idle(f, &m, params)) {
        put_zeros(g, 9);
        return;
    }
    singular s = singular_of(f, &m);
    singular_weights(&s, params->inverse_rest, alpha);
    cipc_strain_limit_barrier(s.sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(s.sigma[1], params->limit, params->activation, b2);
    double scale = params->stiffness * params->volume;
    for (int i = 0; i < 3; i++) {
        double on_u1 = scale * b1[1] * alpha[0][i], on_u2 = scale * b2[1] * alpha[1][i];
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_u1 * s.u[0][k] + on_u2 * s.u[1][k];
    }
}

/* Curvatures of kappa_s V sum b(sigma_i) in F-space (19): along each stretch, shared by the two shears, coupling of the shears, and of the
 * columns out of the plane. */
typedef struct curvature {
    double along[2], shear, coupling, out[2];
} curvature;

static curvature curvature_of(const double sigma[2], const cipc_strain_limit *params)
{
    double b1[3], b2[3], scale = params->stiffness * params->volume;
    cipc_strain_limit_barrier(sigma[0], params->limit, params->activation, b1);
    cipc_strain_limit_barrier(sigma[1], params->limit, params->activation, b2);
    bool both = is_active(sigma[0], params) && is_active(sigma[1], params);
    double difference = both ? slope_difference_quotient(sigma, params->limit, params->activation) : (b1[1] - b2[1]) / (sigma[0] - sigma[1]);
    double sum = (b1[1] + b2[1]) / (sigma[0] + sigma[1]);
    return (curvature){
        .along = {scale * b1[2], scale * b2[2]},
        .shear = 0.5 * scale * (difference + sum),
        .coupling = 0.5 * scale * (difference - sum),
        .out = {scale * b1[1] / sigma[0], is_active(sigma[1], params) ? scale * b2[1] / sigma[1] : 0},
    };
}

/* One block of (19) in the frame (u_1, u_2, n); n n^T is written as 1 - u_1 u_1^T - u_2 u_2^T, so that a collapsed triangle, whose n is
 * undefined, needs no special case: its terms in u_2 vanish with sigma_2. */
static void hessian_block(const singular *s, const curvature *k, double alpha[2][3], int i, int j, double K[3][3])
{
    double aa = alpha[0][i] * alpha[0][j], bb = alpha[1][i] * alpha[1][j];
    double ba = alpha[1][i] * alpha[0][j], ab = alpha[0][i] * alpha[1][j];
    double n_n = k->out[0] * aa + k->out[1] * bb;
    double u1_u1 = k->along[0] * aa + k->shear * bb - n_n, u2_u2 = k->along[1] * bb + k->shear * aa - n_n;
    double u1_u2 = k->coupling * ba, u2_u1 = k->coupling * ab;
    for (int r = 0; r < 3; r++) {
        double on_u1 = u1_u1 * s->u[0][r] + u2_u1 * s->u[1][r], on_u2 = u1_u2 * s->u[0][r] + u2_u2 * s->u[1][r];
        for (int c = 0; c < 3; c++) K[r][c] = on_u1 * s->u[0][c] + on_u2 * s->u[1][c];
        K[r][r] += n_n;
    }
}

void cipc_strain_limit_hessian(const double x[9], const cipc_strain_limit *params, double H[81])
{
    double f[2][3], alpha[2][3];
    deformation_gradient(x, params->inverse_rest, f);
    metric m = metric_of(f);
    if (is_idle(f, &m, params)) {
        put_zeros(H, 81);
        return;
    }
    singular s = singular_of(f, &m);
    singular_weights(&s, params->inverse_rest, alpha);
    curvature k = curvature_of(s.sigma, params);
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double K[3][3];
            hessian_block(&s, &k, alpha, i, j, K);
            put_block_pair(H, 9, i, j, K);
        }
    }
}
