/* Rod bending, isotropic: E I/Lbar (|kb| - |kb|_rest)^2 at a joint of two segments, kb the curvature binormal (Bergou 2008; SPEC C.6; docs/theory/energies.md (33)-(38)).
 * The gradients of c = t0.t1 are written with the cross product b = t0 x t1, which does not cancel where the joint is nearly straight. */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

static const double pi = 3.14159265358979323846;

/* Joint of the segments e0 = x1 - x0 and e1 = x2 - x1. */
typedef struct joint {
    double length[2], t[2][3]; /* |e|, unit tangents */
    double cosine;             /* c = t0.t1 */
    double sum;                /* 1 + c = |t0 + t1|^2/2, which does not cancel where the joint is folded back */
    double b[3];               /* t0 x t1 */
    double q;                  /* |kb|^2 = 4 |b|^2/(1 + c)^2, (34) */
} joint;

static joint joint_of(const double x[9])
{
    joint j;
    double both[3];
    v3_sub(j.t[0], x + 3, x);
    v3_sub(j.t[1], x + 6, x + 3);
    for (int a = 0; a < 2; a++) {
        j.length[a] = v3_norm(j.t[a]);
        v3_scale(j.t[a], 1 / j.length[a], j.t[a]);
    }
    v3_add(both, j.t[0], j.t[1]);
    v3_cross(j.b, j.t[0], j.t[1]);
    j.cosine = v3_dot(j.t[0], j.t[1]);
    j.sum = 0.5 * v3_norm2(both);
    j.q = 4 * v3_norm2(j.b) / (j.sum * j.sum);
    return j;
}

bool cipc_rod_bending_init(cipc_rod_bending *params, const double rest[9], double diameter, double young, bool curved)
{
    joint j = joint_of(rest);
    double d2 = diameter * diameter;
    params->stiffness = young * pi * d2 * d2 / 64 / (j.length[0] + j.length[1]);
    params->rest_curvature = curved ? sqrt(j.q) : 0;
    return j.length[0] > 0 && j.length[1] > 0 && j.sum > 0;
}

double cipc_rod_bending_value(const double x[9], const cipc_rod_bending *params)
{
    joint j = joint_of(x);
    if (!(j.length[0] > 0) || !(j.length[1] > 0) || !(j.sum > 0)) return INFINITY;
    if (params->rest_curvature == 0) return params->stiffness * j.q;
    double bend = sqrt(j.q) - params->rest_curvature;
    return params->stiffness * bend * bend;
}

/* First and second derivative of the energy with respect to c, (35), (36). Where a curved rod is exactly straight, the energy has the tip of a cone; what is given there is
 * that of a straight rod. */
static void slopes(const joint *j, const cipc_rod_bending *params, double *first, double *second)
{
    double s = j->sum, on_q = params->stiffness, on_qq = 0, r = sqrt(j->q);
    if (params->rest_curvature > 0 && r > 0) {
        on_q *= 1 - params->rest_curvature / r;
        on_qq = params->stiffness * params->rest_curvature / (2 * r * j->q);
    }
    double dq = -8 / (s * s), ddq = 16 / (s * s * s);
    *first = on_q * dq;
    *second = on_q * ddq + on_qq * dq * dq;
}

/* Gradients of c with respect to e0 and e1, (37): (b x t0)/|e0| and (t1 x b)/|e1|. */
static void cosine_gradients(const joint *j, double d[2][3])
{
    v3_cross(d[0], j->b, j->t[0]);
    v3_cross(d[1], j->t[1], j->b);
    for (int a = 0; a < 2; a++) v3_scale(d[a], 1 / j->length[a], d[a]);
}

void cipc_rod_bending_gradient(const double x[9], const cipc_rod_bending *params, double g[9])
{
    joint j = joint_of(x);
    double first, second, d[2][3];
    slopes(&j, params, &first, &second);
    cosine_gradients(&j, d);
    for (int k = 0; k < 3; k++) {
        g[k] = -first * d[0][k];
        g[6 + k] = first * d[1][k];
        g[3 + k] = -(g[k] + g[6 + k]);
    }
}

/* (38): blocks (0,0), (1,1), (0,1) of the Hessian with respect to e0, e1. */
static void segment_hessian(const joint *j, const cipc_rod_bending *params, double K[3][3][3])
{
    double first, second, d[2][3];
    slopes(j, params, &first, &second);
    cosine_gradients(j, d);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            double one = r == c ? 1 : 0;
            for (int a = 0; a < 2; a++) {
                const double *t = j->t[a];
                double l = j->length[a], across = j->cosine * (one - t[r] * t[c]) / (l * l);
                K[a][r][c] = second * d[a][r] * d[a][c] - first * ((t[r] * d[a][c] + d[a][r] * t[c]) / l + across);
            }
            const double *t = j->t[0], *u = j->t[1];
            double mixed = (one - u[r] * u[c] - t[r] * t[c] + j->cosine * t[r] * u[c]) / (j->length[0] * j->length[1]);
            K[2][r][c] = second * d[0][r] * d[1][c] + first * mixed;
        }
    }
}

/* e0 = x1 - x0, e1 = x2 - x1: with A, B, M the blocks of (38), nodes 0, 1, 2 have A, -A + M, -M; A - M - M^T + B, M - B; B. */
void cipc_rod_bending_hessian(const double x[9], const cipc_rod_bending *params, double H[81])
{
    joint j = joint_of(x);
    double K[3][3][3], blocks[4][3][3];
    segment_hessian(&j, params, K);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            double A = K[0][r][c], B = K[1][r][c], M = K[2][r][c], N = K[2][c][r];
            blocks[0][r][c] = M - A;         /* 0, 1 */
            blocks[1][r][c] = -M;            /* 0, 2 */
            blocks[2][r][c] = A - M - N + B; /* 1, 1 */
            blocks[3][r][c] = M - B;         /* 1, 2 */
        }
    }
    put_block_pair(H, 9, 0, 0, K[0]);
    put_block_pair(H, 9, 0, 1, blocks[0]);
    put_block_pair(H, 9, 0, 2, blocks[1]);
    put_block_pair(H, 9, 1, 1, blocks[2]);
    put_block_pair(H, 9, 1, 2, blocks[3]);
    put_block_pair(H, 9, 2, 2, K[1]);
}
