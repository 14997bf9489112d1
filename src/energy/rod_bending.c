/* Rod bending at the joint of two segments: k (|kb| - kbar)^2 (Bergou et al. 2008, isotropic; SPEC C.6; docs/theory/energies.md (R4)-(R11)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

/* (R4), (R5): the curvature binormal kb of two segments, and kappa = |kb| = 2 tan(phi/2). The denominator |e0||e1| + e0.e1 cancels when the rod folds
 * back; then it is taken from (|e0||e1|)^2 - (e0.e1)^2 = |e0 x e1|^2. INFINITY: folded back entirely, or a segment without length. */
static double curvature(const double e0[3], const double e1[3], double kb[3])
{
    double cross[3], lengths = v3_norm(e0) * v3_norm(e1), dot = v3_dot(e0, e1);
    v3_cross(cross, e0, e1);
    double denominator = dot >= 0 ? lengths + dot : v3_norm2(cross) / (lengths - dot);
    if (!(denominator > 0)) return INFINITY;
    v3_scale(kb, 2 / denominator, cross);
    return v3_norm(kb);
}

bool cipc_rod_bending_init(cipc_rod_bending *params, const double rest[9], double diameter, double young, bool curved)
{
    double e0[3], e1[3], kb[3];
    v3_sub(e0, rest + 3, rest);
    v3_sub(e1, rest + 6, rest + 3);
    double kappa = curvature(e0, e1, kb);
    if (!isfinite(kappa)) return false;
    double second_moment = M_PI / 64 * (diameter * diameter) * (diameter * diameter);
    params->stiffness = young * second_moment / (v3_norm(e0) + v3_norm(e1));
    params->rest_curvature = curved ? kappa : 0;
    return true;
}

double cipc_rod_bending_value(const double x[9], const cipc_rod_bending *params)
{
    double e0[3], e1[3], kb[3];
    v3_sub(e0, x + 3, x);
    v3_sub(e1, x + 6, x + 3);
    double bend = curvature(e0, e1, kb) - params->rest_curvature;
    return params->stiffness * bend * bend;
}

/* The joint as its derivatives see it. Nothing is divided by kappa but what the rest curvature makes singular: a straight rod of straight rest shape needs no
 * plane of bending. */
typedef struct joint {
    double length[2], t[2][3]; /* segments: |e|, unit tangents */
    double kb[3], kappa;
    double v[2][3];            /* kb x t: kappa times the direction in which t turns */
    double slope;              /* F = 2 k sigma */
    double sigma;              /* 1 + kappa^2/4 = d kappa / d phi */
    double rest_share;         /* rho = kbar / kappa; 0 where kappa = 0, by convention */
} joint;

static joint joint_of(const double x[9], const cipc_rod_bending *params)
{
    joint j;
    double e[2][3];
    for (int s = 0; s < 2; s++) {
        v3_sub(e[s], x + 3 * (s + 1), x + 3 * s);
        j.length[s] = v3_norm(e[s]);
        v3_scale(j.t[s], 1 / j.length[s], e[s]);
    }
    j.kappa = curvature(e[0], e[1], j.kb);
    for (int s = 0; s < 2; s++) v3_cross(j.v[s], j.kb, j.t[s]);
    j.sigma = 1 + 0.25 * j.kappa * j.kappa;
    j.slope = 2 * params->stiffness * j.sigma;
    j.rest_share = j.kappa > 0 ? params->rest_curvature / j.kappa : 0;
    return j;
}

/* 1 - rho, without the rounding of rho where it is near 1. */
static double moment_share(const joint *j, const cipc_rod_bending *params)
{
    return j->kappa > 0 ? (j->kappa - params->rest_curvature) / j->kappa : 1;
}

void cipc_rod_bending_gradient(const double x[9], const cipc_rod_bending *params, double g[9])
{
    joint j = joint_of(x, params);
    double moment = j.slope * moment_share(&j, params);
    for (int k = 0; k < 3; k++) { /* (R7) */
        double on_e0 = -moment * j.v[0][k] / j.length[0], on_e1 = moment * j.v[1][k] / j.length[1];
        g[k] = -on_e0;
        g[3 + k] = on_e0 - on_e1;
        g[6 + k] = on_e1;
    }
}

/* (R9): segment s against itself. */
static void same_segment(const joint *j, const cipc_rod_bending *params, int s, double K[3][3])
{
    double moment = j->slope * moment_share(j, params), kappa2 = j->kappa * j->kappa, per_area = 1 / (j->length[s] * j->length[s]);
    double turning = j->slope * (j->rest_share + kappa2 * (1 - 0.75 * j->rest_share)), isotropic = moment * (1 - 0.25 * kappa2);
    double side = s == 0 ? moment : -moment, inverse = j->kappa > 0 ? 1 / j->kappa : 0;
    const double *t = j->t[s], *v = j->v[s];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            double in_plane = turning * (v[r] * inverse) * (v[c] * inverse), swap = side * (t[r] * v[c] + v[r] * t[c]);
            K[r][c] = per_area * (in_plane + swap + isotropic * ((r == c ? 1 : 0) - t[r] * t[c]));
        }
    }
}

/* (R10): rows of e0, columns of e1. */
static void across_joint(const joint *j, const cipc_rod_bending *params, double K[3][3])
{
    double share = moment_share(j, params), moment = j->slope * share, kappa2 = j->kappa * j->kappa;
    double turning = j->slope * (j->sigma * j->rest_share + 0.5 * kappa2 * share);
    double inverse = j->kappa > 0 ? 1 / j->kappa : 0, per_area = -1 / (j->length[0] * j->length[1]);
    const double *b = j->kb, *t0 = j->t[0], *t1 = j->t[1];
    const double spin[3][3] = {{0, -b[2], b[1]}, {b[2], 0, -b[0]}, {-b[1], b[0], 0}}; /* [kb]x */
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            double in_plane = turning * (j->v[0][r] * inverse) * (j->v[1][c] * inverse);
            double about = (r == c ? 1 - 0.25 * kappa2 : 0) - spin[r][c] + 0.5 * b[r] * b[c] - j->sigma * t0[r] * t1[c];
            K[r][c] = per_area * (in_plane + moment * about);
        }
    }
}

void cipc_rod_bending_hessian(const double x[9], const cipc_rod_bending *params, double H[81])
{
    joint j = joint_of(x, params);
    double K00[3][3], K01[3][3], K11[3][3], first[3][3], last[3][3], minus[3][3], middle[3][3];
    same_segment(&j, params, 0, K00);
    same_segment(&j, params, 1, K11);
    across_joint(&j, params, K01);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) { /* (R11) */
            first[r][c] = K01[r][c] - K00[r][c];
            last[r][c] = K01[r][c] - K11[r][c];
            minus[r][c] = -K01[r][c];
            middle[r][c] = K00[r][c] + K11[r][c] - (K01[r][c] + K01[c][r]);
        }
    }
    put_block_pair(H, 9, 0, 0, K00);
    put_block_pair(H, 9, 0, 1, first);
    put_block_pair(H, 9, 0, 2, minus);
    put_block_pair(H, 9, 1, 1, middle);
    put_block_pair(H, 9, 1, 2, last);
    put_block_pair(H, 9, 2, 2, K11);
}
