/* What the two strain limits share: the singular values of F, and the derivatives of a sum sum_i b(sigma_i) over them
 * (docs/theory/energies.md (15), (18)-(20)). */
#ifndef CIPC_ENERGY_STRETCH_ENERGY_H
#define CIPC_ENERGY_STRETCH_ENERGY_H

#include "energy/blocks.h"
#include "energy/membrane.h"

/* Below one half, ln(1 - t) is taken as log1p(-t), above as ln of q = 1 - t, which callers have from a difference that is exact near q = 0. */
#define STRETCH_LOG_SWITCH 0.5

static inline double log_of_complement(double t, double q)
{
    return t < STRETCH_LOG_SWITCH ? log1p(-t) : log(q);
}

/* Metric C of F, its half difference and largest eigenvalue (15). */
typedef struct metric {
    double half_difference, c12, radius, largest;
} metric;

static inline metric metric_of(double f[2][3])
{
    double c11 = v3_norm2(f[0]), c22 = v3_norm2(f[1]);
    metric m = {.half_difference = 0.5 * (c11 - c22), .c12 = v3_dot(f[0], f[1])};
    m.radius = hypot(m.half_difference, m.c12);
    m.largest = 0.5 * (c11 + c22) + m.radius;
    return m;
}

/* sigma_1 is the root of the larger eigenvalue of C, where nothing cancels; sigma_2 = J/sigma_1 with J from the cross product. */
static inline void stretches_of(double f[2][3], const metric *m, double sigma[2])
{
    double normal[3];
    v3_cross(normal, f[0], f[1]);
    sigma[0] = sqrt(m->largest);
    sigma[1] = sigma[0] > 0 ? fmin(v3_norm(normal) / sigma[0], sigma[0]) : 0;
}

/* Singular value decomposition F = sigma_1 u_1 v_1^T + sigma_2 u_2 v_2^T. u_2 is 0 if sigma_2 is. */
typedef struct singular {
    double sigma[2], u[2][3], v[2][2];
} singular;

/* Unit eigenvector of C to its larger eigenvalue: of the two columns of C - lambda_2, the one that does not cancel. */
static inline void principal_direction(const metric *m, double v[2])
{
    double a = m->radius + fabs(m->half_difference), length = hypot(a, m->c12);
    v[0] = 1;
    v[1] = 0;
    if (length == 0) return; /* sigma_1 = sigma_2: any direction */
    v[m->half_difference < 0] = a / length;
    v[m->half_difference >= 0] = m->c12 / length;
}

static inline singular singular_of(double f[2][3], const metric *m)
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

/* Weights of the nodes in the singular basis: alpha[a][i] = w_i.v_a. */
static inline void singular_weights(const singular *s, const double inverse_rest[3], double alpha[2][3])
{
    double w[3][2];
    node_weights(inverse_rest, w);
    for (int a = 0; a < 2; a++) {
        for (int i = 0; i < 3; i++) alpha[a][i] = dot2(w[i], s->v[a]);
    }
}

/* (20): [b'(sigma[0]) - b'(sigma[1])] / (sigma[0] - sigma[1]) for two active stretches, sigma[0] the nearer to the limit; b'' where they meet. */
static inline double slope_difference_quotient(const double sigma[2], double limit, double activation)
{
    double width = limit - activation;
    double t1 = (sigma[0] - activation) / width, q1 = (limit - sigma[0]) / width;
    double t2 = (sigma[1] - activation) / width, q2 = (limit - sigma[1]) / width;
    double z = (sigma[0] - sigma[1]) / (limit - sigma[1]);
    double mean_log = z > 0 ? -log_of_complement(z, q1 / q2) / z : 1; /* -ln(1 - z)/z */
    return (-2 * log_of_complement(t1, q1) + 2 * (t2 / q2) * mean_log + (t1 + t2 * q1) / (q1 * q2)) / (width * width);
}

/* (18): slope[a] = b'(sigma_a), scale included. */
static inline void stretch_gradient(const singular *s, const double slope[2], double alpha[2][3], double g[9])
{
    for (int i = 0; i < 3; i++) {
        double on_u1 = slope[0] * alpha[0][i], on_u2 = slope[1] * alpha[1][i];
        for (int k = 0; k < 3; k++) g[3 * i + k] = on_u1 * s->u[0][k] + on_u2 * s->u[1][k];
    }
}

/* Curvatures of the sum in F-space (19): along each stretch, shared by the two shears, coupling of the shears, and of the columns out of the
 * plane. */
typedef struct curvature {
    double along[2], shear, coupling, out[2];
} curvature;

/* One block of (19) in the frame (u_1, u_2, n); n n^T is written as 1 - u_1 u_1^T - u_2 u_2^T, so that a collapsed triangle, whose n is
 * undefined, needs no special case: its terms in u_2 vanish with sigma_2. */
static inline void stretch_block(const singular *s, const curvature *k, double alpha[2][3], int i, int j, double K[3][3])
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

static inline void stretch_hessian(const singular *s, const curvature *k, double alpha[2][3], double H[81])
{
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double K[3][3];
            stretch_block(s, k, alpha, i, j, K);
            put_block_pair(H, 9, i, j, K);
        }
    }
}

#endif
