/* Orthotropic membrane with limits of its Green strains (SPEC C.3, eqs 8-10 as corrected there; docs/theory/energies.md (14a)-(14g)). */
#include "cipc/energy.h"
#include "energy/blocks.h"
#include "energy/stretch_energy.h"

/* Least sine of the angles between a direction and the triangle's normal, and between warp and weft. Below it a direction in the plane, or the second of two
 * directions, would be made of the last digits of what was given: nine of sixteen are lost. */
static const double LEAST_SINE = 1e-9;

/* The rest edges, their unit normal and the dual edges g_a, g_a.e_b = delta_ab. */
typedef struct rest_frame {
    double e[2][3], normal[3], dual[2][3], area;
} rest_frame;

static bool rest_frame_of(const double rest[9], rest_frame *r)
{
    double n[3];
    v3_sub(r->e[0], rest + 3, rest);
    v3_sub(r->e[1], rest + 6, rest);
    v3_cross(n, r->e[0], r->e[1]);
    double twice_area = v3_norm(n);
    if (!(twice_area > 0) || !isfinite(twice_area)) return false;
    v3_scale(r->normal, 1 / twice_area, n);
    v3_cross(r->dual[0], r->e[1], r->normal);
    v3_cross(r->dual[1], r->normal, r->e[0]);
    for (int a = 0; a < 2; a++) v3_scale(r->dual[a], 1 / twice_area, r->dual[a]);
    r->area = 0.5 * twice_area;
    return true;
}

/* (14a): the unit vector d along the part of a direction in the plane, and its coefficients, d = c[0] e_0 + c[1] e_1. */
static bool coefficients(const rest_frame *r, const double direction[3], double d[3], double c[2])
{
    v3_copy(d, direction);
    v3_axpy(d, -v3_dot(direction, r->normal), r->normal);
    double length = v3_norm(d);
    if (!(length > LEAST_SINE * v3_norm(direction)) || !isfinite(length)) return false;
    v3_scale(d, 1 / length, d);
    for (int a = 0; a < 2; a++) c[a] = v3_dot(d, r->dual[a]);
    return true;
}

bool cipc_orthotropic_init(cipc_orthotropic *params, const double rest[9], double thickness, const double warp[3], const double *weft, const double moduli[4],
                           const double limits[3])
{
    rest_frame r;
    cipc_orthotropic p = {.a11 = moduli[0], .a12 = moduli[1], .a22 = moduli[2], .g12 = moduli[3], .limit11 = limits[0], .limit22 = limits[1], .limit12 = limits[2]};
    double d1[3], d2[3], across[3];
    if (!rest_frame_of(rest, &r) || !coefficients(&r, warp, d1, p.warp)) return false;
    v3_cross(across, r.normal, d1);
    if (!coefficients(&r, weft != NULL ? weft : across, d2, p.weft)) return false;
    if (!(fabs(v3_dot(across, d2)) > LEAST_SINE)) return false; /* the sine of the angle from warp to weft */
    p.rest_cosine = weft != NULL ? v3_dot(d1, d2) : 0;
    p.volume = r.area * thickness;
    *params = p;
    return true;
}

/* Images f_1, f_2 of the directions, weights w_i with df_a = sum_i w_i[a] dx_i, and strains (14b). */
typedef struct fabric {
    double f[2][3], w[3][2], e11, e22, e12;
} fabric;

static fabric fabric_of(const double x[9], const cipc_orthotropic *p)
{
    fabric s;
    for (int k = 0; k < 3; k++) {
        double e1 = x[3 + k] - x[k], e2 = x[6 + k] - x[k];
        s.f[0][k] = p->warp[0] * e1 + p->warp[1] * e2;
        s.f[1][k] = p->weft[0] * e1 + p->weft[1] * e2;
    }
    for (int i = 0; i < 2; i++) {
        s.w[1 + i][0] = p->warp[i];
        s.w[1 + i][1] = p->weft[i];
    }
    for (int a = 0; a < 2; a++) s.w[0][a] = -(s.w[1][a] + s.w[2][a]);
    s.e11 = 0.5 * (v3_norm2(s.f[0]) - 1);
    s.e22 = 0.5 * (v3_norm2(s.f[1]) - 1);
    s.e12 = 0.5 * (v3_dot(s.f[0], s.f[1]) - p->rest_cosine);
    return s;
}

/* (14c): eta(q; Q), eta', eta'' at q = a b, Q = A B, for |a| < A and |b| < B. Q - q is a sum of two positive terms that are exact where they are small. */
static void eta(double a, double b, double A, double B, double e[3])
{
    double q = a * b, Q = A * B, left = q > 0 ? (A - fabs(a)) * B + fabs(a) * (B - fabs(b)) : Q - q;
    e[0] = -Q * log_of_complement(q / Q, left / Q);
    e[1] = Q / left;
    e[2] = e[1] / left;
}

double cipc_membrane_orthotropic_value(const double x[9], const cipc_orthotropic *params)
{
    const cipc_orthotropic *p = params;
    fabric s = fabric_of(x, p);
    if (!(fabs(s.e11) < p->limit11 && fabs(s.e22) < p->limit22 && fabs(s.e12) < p->limit12)) return INFINITY;
    double warp[3], weft[3], both[3], shear[3];
    eta(s.e11, s.e11, p->limit11, p->limit11, warp);
    eta(s.e22, s.e22, p->limit22, p->limit22, weft);
    eta(s.e11, s.e22, p->limit11, p->limit22, both);
    eta(s.e12, s.e12, p->limit12, p->limit12, shear);
    return p->volume * (0.5 * p->a11 * warp[0] + p->a12 * both[0] + 0.5 * p->a22 * weft[0] + p->g12 * shear[0]);
}

/* First and second derivatives of the energy by the three strains, volume included (14d), (14e); E12 is coupled to none. */
typedef struct law {
    double s11, s22, s12, k11, k22, k12, k1122;
} law;

static law law_of(const fabric *s, const cipc_orthotropic *p)
{
    double warp[3], weft[3], both[3], shear[3], V = p->volume;
    eta(s->e11, s->e11, p->limit11, p->limit11, warp);
    eta(s->e22, s->e22, p->limit22, p->limit22, weft);
    eta(s->e11, s->e22, p->limit11, p->limit22, both);
    eta(s->e12, s->e12, p->limit12, p->limit12, shear);
    return (law){
        .s11 = V * (p->a11 * warp[1] * s->e11 + p->a12 * both[1] * s->e22),
        .s22 = V * (p->a22 * weft[1] * s->e22 + p->a12 * both[1] * s->e11),
        .s12 = V * 2 * p->g12 * shear[1] * s->e12,
        .k11 = V * (p->a11 * (warp[1] + 2 * s->e11 * s->e11 * warp[2]) + p->a12 * s->e22 * s->e22 * both[2]),
        .k22 = V * (p->a22 * (weft[1] + 2 * s->e22 * s->e22 * weft[2]) + p->a12 * s->e11 * s->e11 * both[2]),
        .k12 = V * 2 * p->g12 * (shear[1] + 2 * s->e12 * s->e12 * shear[2]),
        .k1122 = V * p->a12 * (both[1] + s->e11 * s->e22 * both[2]),
    };
}

/* Gradients of the three strains by one node (14f). */
static void strain_gradients(const fabric *s, int i, double p[3][3])
{
    for (int k = 0; k < 3; k++) {
        p[0][k] = s->w[i][0] * s->f[0][k];
        p[1][k] = s->w[i][1] * s->f[1][k];
        p[2][k] = 0.5 * (s->w[i][0] * s->f[1][k] + s->w[i][1] * s->f[0][k]);
    }
}

void cipc_membrane_orthotropic_gradient(const double x[9], const cipc_orthotropic *params, double g[9])
{
    fabric s = fabric_of(x, params);
    law l = law_of(&s, params);
    for (int i = 0; i < 3; i++) {
        double p[3][3];
        strain_gradients(&s, i, p);
        for (int k = 0; k < 3; k++) g[3 * i + k] = l.s11 * p[0][k] + l.s22 * p[1][k] + l.s12 * p[2][k];
    }
}

void cipc_membrane_orthotropic_hessian(const double x[9], const cipc_orthotropic *params, double H[81])
{
    fabric s = fabric_of(x, params);
    law l = law_of(&s, params);
    double p[3][3][3];
    for (int i = 0; i < 3; i++) strain_gradients(&s, i, p[i]);
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            const double *a = s.w[i], *b = s.w[j];
            double geometric = l.s11 * (a[0] * b[0]) + l.s22 * (a[1] * b[1]) + 0.5 * l.s12 * (a[0] * b[1] + a[1] * b[0]), K[3][3];
            for (int r = 0; r < 3; r++) {
                double on_warp = l.k11 * p[i][0][r] + l.k1122 * p[i][1][r], on_weft = l.k1122 * p[i][0][r] + l.k22 * p[i][1][r];
                for (int c = 0; c < 3; c++) K[r][c] = on_warp * p[j][0][c] + on_weft * p[j][1][c] + l.k12 * p[i][2][r] * p[j][2][c];
                K[r][r] += geometric;
            }
            put_block_pair(H, 9, i, j, K);
        }
    }
}
