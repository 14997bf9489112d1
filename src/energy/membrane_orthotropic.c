/* Orthotropic cloth that stiffens without bound towards its strain limits (paper, eqs 8-10, as corrected in SPEC C.3; docs/theory/energies.md (50)-(54)). */
#include "energy/blocks.h"
#include "energy/membrane.h"
#include "cipc/energy.h"

/* Unit direction in the plane of the triangle as coefficients on its edges e1, e2 (50); false if the direction has no part in the plane. */
static bool edge_coefficients(const double e1[3], const double e2[3], const double direction[3], double coefficients[2], double unit[3])
{
    double n[3], across1[3], across2[3];
    v3_cross(n, e1, e2);
    v3_copy(unit, direction);
    v3_axpy(unit, -v3_dot(direction, n) / v3_norm2(n), n);
    double length = v3_norm(unit);
    if (!(length > 0)) return false;
    v3_scale(unit, 1 / length, unit);
    v3_cross(across1, e2, n);
    v3_cross(across2, n, e1);
    coefficients[0] = v3_dot(unit, across1) / v3_norm2(n);
    coefficients[1] = v3_dot(unit, across2) / v3_norm2(n);
    return true;
}

bool cipc_orthotropic_init(cipc_orthotropic *params, const double rest[9], double thickness, const double warp[3], const double weft[3], const double moduli[4],
                           const double limits[3])
{
    double e1[3], e2[3], n[3], d1[3], d2[3], across[3], sine[3];
    v3_sub(e1, rest + 3, rest);
    v3_sub(e2, rest + 6, rest);
    v3_cross(n, e1, e2);
    double twice_area = v3_norm(n);
    if (!(twice_area > 0) || !isfinite(twice_area)) return false;
    if (!edge_coefficients(e1, e2, warp, params->warp, d1)) return false;
    v3_cross(across, n, d1);
    if (!edge_coefficients(e1, e2, v3_norm2(weft) > 0 ? weft : across, params->weft, d2)) return false;
    v3_cross(sine, d1, d2);
    params->rest_cosine = v3_norm2(weft) > 0 ? v3_dot(d1, d2) : 0;
    params->volume = 0.5 * twice_area * thickness;
    for (int i = 0; i < 4; i++) params->moduli[i] = moduli[i];
    for (int i = 0; i < 3; i++) params->limits[i] = limits[i];
    return v3_norm2(sine) > 0;
}

/* Present directions f1, f2 and Green strains (51). */
typedef struct strains {
    double f1[3], f2[3], e11, e22, e12;
} strains;

static strains strains_of(const double x[9], const cipc_orthotropic *p)
{
    strains s;
    for (int k = 0; k < 3; k++) {
        double a = x[3 + k] - x[k], b = x[6 + k] - x[k];
        s.f1[k] = p->warp[0] * a + p->warp[1] * b;
        s.f2[k] = p->weft[0] * a + p->weft[1] * b;
    }
    s.e11 = 0.5 * (v3_norm2(s.f1) - 1);
    s.e22 = 0.5 * (v3_norm2(s.f2) - 1);
    s.e12 = 0.5 * (v3_dot(s.f1, s.f2) - p->rest_cosine);
    return s;
}

void cipc_orthotropic_strains(const double x[9], const cipc_orthotropic *params, double strain[3])
{
    strains s = strains_of(x, params);
    strain[0] = s.e11;
    strain[1] = s.e22;
    strain[2] = s.e12;
}

/* eta(q; Q) = -Q ln((Q - q)/Q) and two derivatives, left = Q - q (52). Below one half ln(1 - q/Q) is taken as log1p. */
static void stiffening(double q, double Q, double left, double eta[3])
{
    eta[0] = -Q * (q < 0.5 * Q ? log1p(-q / Q) : log(left / Q));
    eta[1] = Q / left;
    eta[2] = Q / (left * left);
}

/* eta of a squared strain: L^2 - E^2 as a product does not cancel. */
static void stiffening_of_square(double strain, double limit, double eta[3])
{
    stiffening(strain * strain, limit * limit, (limit - strain) * (limit + strain), eta);
}

static bool is_feasible(const strains *s, const double limits[3])
{
    return fabs(s->e11) < limits[0] && fabs(s->e22) < limits[1] && fabs(s->e12) < limits[2];
}

/* The four etas: warp, both, weft, shear. */
static void stiffenings(const strains *s, const double limits[3], double eta[4][3])
{
    double product = s->e11 * s->e22, most = limits[0] * limits[1];
    stiffening_of_square(s->e11, limits[0], eta[0]);
    stiffening(product, most, most - product, eta[1]);
    stiffening_of_square(s->e22, limits[1], eta[2]);
    stiffening_of_square(s->e12, limits[2], eta[3]);
}

double cipc_membrane_orthotropic_value(const double x[9], const cipc_orthotropic *p)
{
    strains s = strains_of(x, p);
    double eta[4][3];
    if (!is_feasible(&s, p->limits)) return INFINITY;
    stiffenings(&s, p->limits, eta);
    const double *m = p->moduli;
    return p->volume * (0.5 * m[0] * eta[0][0] + m[1] * eta[1][0] + 0.5 * m[2] * eta[2][0] + m[3] * eta[3][0]);
}

/* Stresses and moduli: derivatives of V psi with respect to E11, E22, E12 (53). */
typedef struct response {
    double on11, on22, on12, by1111, by2222, by1122, by1212;
} response;

static response response_of(const strains *s, const cipc_orthotropic *p)
{
    double eta[4][3], a = s->e11, b = s->e22, c = s->e12;
    stiffenings(s, p->limits, eta);
    double m11 = p->volume * p->moduli[0], m12 = p->volume * p->moduli[1], m22 = p->volume * p->moduli[2], g = p->volume * p->moduli[3];
    return (response){
        .on11 = m11 * eta[0][1] * a + m12 * eta[1][1] * b,
        .on22 = m22 * eta[2][1] * b + m12 * eta[1][1] * a,
        .on12 = 2 * g * eta[3][1] * c,
        .by1111 = m11 * (eta[0][1] + 2 * a * a * eta[0][2]) + m12 * b * b * eta[1][2],
        .by2222 = m22 * (eta[2][1] + 2 * b * b * eta[2][2]) + m12 * a * a * eta[1][2],
        .by1122 = m12 * (eta[1][1] + a * b * eta[1][2]),
        .by1212 = 2 * g * (eta[3][1] + 2 * c * c * eta[3][2]),
    };
}

/* Weights of the nodes in f1 and f2. */
static void direction_weights(const cipc_orthotropic *p, double w1[3], double w2[3])
{
    w1[0] = -(p->warp[0] + p->warp[1]);
    w2[0] = -(p->weft[0] + p->weft[1]);
    for (int i = 0; i < 2; i++) {
        w1[1 + i] = p->warp[i];
        w2[1 + i] = p->weft[i];
    }
}

/* dE11 = f1.df1, dE22 = f2.df2, dE12 = (f1.df2 + f2.df1)/2: the derivatives with respect to one node. */
static void strain_gradients(const strains *s, double w1, double w2, double d[3][3])
{
    for (int k = 0; k < 3; k++) {
        d[0][k] = w1 * s->f1[k];
        d[1][k] = w2 * s->f2[k];
        d[2][k] = 0.5 * (w2 * s->f1[k] + w1 * s->f2[k]);
    }
}

void cipc_membrane_orthotropic_gradient(const double x[9], const cipc_orthotropic *p, double g[9])
{
    strains s = strains_of(x, p);
    response r = response_of(&s, p);
    double w1[3], w2[3], d[3][3];
    direction_weights(p, w1, w2);
    for (int i = 0; i < 3; i++) {
        strain_gradients(&s, w1[i], w2[i], d);
        for (int k = 0; k < 3; k++) g[3 * i + k] = r.on11 * d[0][k] + r.on22 * d[1][k] + r.on12 * d[2][k];
    }
}

/* (54) */
void cipc_membrane_orthotropic_hessian(const double x[9], const cipc_orthotropic *p, double H[81])
{
    strains s = strains_of(x, p);
    response m = response_of(&s, p);
    double w1[3], w2[3], d[3][3][3], K[3][3];
    direction_weights(p, w1, w2);
    for (int i = 0; i < 3; i++) strain_gradients(&s, w1[i], w2[i], d[i]);
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double same = m.on11 * w1[i] * w1[j] + m.on22 * w2[i] * w2[j] + 0.5 * m.on12 * (w1[i] * w2[j] + w2[i] * w1[j]);
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) {
                    double material = m.by1111 * d[i][0][r] * d[j][0][c] + m.by2222 * d[i][1][r] * d[j][1][c] + m.by1212 * d[i][2][r] * d[j][2][c] +
                                      m.by1122 * (d[i][0][r] * d[j][1][c] + d[i][1][r] * d[j][0][c]);
                    K[r][c] = material + (r == c ? same : 0);
                }
            put_block_pair(H, 9, i, j, K);
        }
    }
}
