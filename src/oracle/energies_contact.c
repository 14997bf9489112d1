/* Distances of flats, barriers, mollifier and friction (SPEC C.4, D.1-D.3, D.6). */
#include "oracle/energies.h"

mpfr_ptr oracle_flat_distance2(oracle_reals *s, const mpfr_t *x, const cipc_feature *feature)
{
    const int *n = feature->local;
    bool plane = feature->kind == CIPC_POINT_TRIANGLE;
    if (feature->kind == CIPC_POINT_POINT) {
        oracle_real3 u = oracle_difference(s, x, n[0], n[1]);
        return oracle_dot(s, u, u);
    }
    if (feature->kind == CIPC_POINT_EDGE) {
        /* |u|^2 - (u.e)^2/|e|^2, by Lagrange |u x e|^2 / |e|^2 */
        oracle_real3 u = oracle_difference(s, x, n[0], n[1]), e = oracle_difference(s, x, n[2], n[1]);
        mpfr_ptr along = oracle_dot(s, u, e);
        return oracle_sub(s, oracle_dot(s, u, u), oracle_div(s, oracle_mul(s, along, along), oracle_dot(s, e, e)));
    }
    oracle_real3 u = oracle_difference(s, x, n[0], plane ? n[1] : n[2]);
    oracle_real3 a = oracle_difference(s, x, plane ? n[2] : n[1], plane ? n[1] : n[0]), b = oracle_difference(s, x, n[3], plane ? n[1] : n[2]);
    oracle_real3 normal = oracle_cross(s, a, b);
    mpfr_ptr height = oracle_dot(s, u, normal);
    return oracle_div(s, oracle_mul(s, height, height), oracle_dot(s, normal, normal));
}

/* The whole stencil of a kind as its own feature. */
static mpfr_ptr whole_distance2(oracle_reals *s, const mpfr_t *x, cipc_pair_kind kind)
{
    cipc_feature feature = cipc_feature_at(kind, cipc_feature_count(kind) - 1);
    return oracle_flat_distance2(s, x, &feature);
}

mpfr_ptr oracle_distance2_point_point(oracle_reals *s, const mpfr_t *x, const double *f) { (void)f; return whole_distance2(s, x, CIPC_POINT_POINT); }
mpfr_ptr oracle_distance2_point_line(oracle_reals *s, const mpfr_t *x, const double *f) { (void)f; return whole_distance2(s, x, CIPC_POINT_EDGE); }
mpfr_ptr oracle_distance2_point_plane(oracle_reals *s, const mpfr_t *x, const double *f) { (void)f; return whole_distance2(s, x, CIPC_POINT_TRIANGLE); }
mpfr_ptr oracle_distance2_line_line(oracle_reals *s, const mpfr_t *x, const double *f) { (void)f; return whole_distance2(s, x, CIPC_EDGE_EDGE); }

/* e(c) = c/eps (2 - c/eps), c = |a|^2 |b|^2 - (a.b)^2 < eps; else 1. */
mpfr_ptr oracle_edge_edge_mollifier(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 a = oracle_difference(s, x, 1, 0), b = oracle_difference(s, x, 3, 2);
    mpfr_ptr ab = oracle_dot(s, a, b), c = oracle_sub(s, oracle_mul(s, oracle_dot(s, a, a), oracle_dot(s, b, b)), oracle_mul(s, ab, ab));
    mpfr_ptr ratio = oracle_div(s, c, oracle_number(s, f[0]));
    if (!(f[0] > 0)) return oracle_number(s, 1);
    bool below = mpfr_cmp_ui(ratio, 1) < 0;
    s->sides |= below ? ORACLE_BEND_BELOW : ORACLE_BEND_ABOVE;
    if (!below) return oracle_number(s, 1);
    return oracle_mul(s, ratio, oracle_sub(s, oracle_number(s, 2), ratio));
}

/* stiffness, weight, offset, dhat: kappa w b(d^2 - xi^2), b(D) = -(D - Dhat)^2 ln(D / Dhat) for 0 < D < Dhat. */
static mpfr_ptr barrier(oracle_reals *s, mpfr_srcptr d2, const double *f)
{
    mpfr_ptr xi = oracle_number(s, f[2]), dhat = oracle_number(s, f[3]), D = oracle_sub(s, d2, oracle_mul(s, xi, xi));
    mpfr_ptr reach = oracle_add(s, xi, dhat), Dhat = oracle_sub(s, oracle_mul(s, reach, reach), oracle_mul(s, xi, xi));
    if (mpfr_sgn(D) <= 0) return NULL;
    if (mpfr_cmp(D, Dhat) >= 0) return oracle_number(s, 0);
    mpfr_ptr gap = oracle_sub(s, D, Dhat), b = oracle_mul(s, oracle_mul(s, gap, gap), oracle_log(s, oracle_div(s, D, Dhat)));
    return oracle_scaled(s, -f[0], oracle_scaled(s, f[1], b));
}

mpfr_ptr oracle_barrier_point_point(oracle_reals *s, const mpfr_t *x, const double *f) { return barrier(s, whole_distance2(s, x, CIPC_POINT_POINT), f); }
mpfr_ptr oracle_barrier_point_edge(oracle_reals *s, const mpfr_t *x, const double *f) { return barrier(s, whole_distance2(s, x, CIPC_POINT_EDGE), f); }
mpfr_ptr oracle_barrier_point_triangle(oracle_reals *s, const mpfr_t *x, const double *f) { return barrier(s, whole_distance2(s, x, CIPC_POINT_TRIANGLE), f); }

/* ..., mollifier_eps, feature. */
mpfr_ptr oracle_barrier_edge_edge(oracle_reals *s, const mpfr_t *x, const double *f)
{
    cipc_feature feature = cipc_feature_at(CIPC_EDGE_EDGE, (int)f[5]);
    mpfr_ptr b = barrier(s, oracle_flat_distance2(s, x, &feature), f);
    return b == NULL ? NULL : oracle_mul(s, oracle_edge_edge_mollifier(s, x, f + 4), b);
}

/* coefficient, eps, weights[4], basis[6], start[12]: mu lambda f0(|u|), u = P^T sum_i w_i (x_i - start_i); f0 = y^2 (1 - y/(3 e))/e + e/3 for y < e, else y. */
mpfr_ptr oracle_friction(oracle_reals *s, const mpfr_t *x, const double *f)
{
    const double *weights = f + 2, *basis = f + 6, *start = f + 12;
    mpfr_ptr y2 = oracle_number(s, 0), e = oracle_number(s, f[1]);
    for (int t = 0; t < 2; t++) {
        mpfr_ptr u = oracle_number(s, 0);
        for (int i = 0; i < 12; i++) {
            mpfr_ptr moved = oracle_scaled(s, weights[i / 3], oracle_sub(s, x[i], oracle_number(s, start[i])));
            u = oracle_add(s, u, oracle_scaled(s, basis[3 * t + i % 3], moved));
        }
        y2 = oracle_add(s, y2, oracle_mul(s, u, u));
    }
    mpfr_ptr y = oracle_sqrt(s, y2), f0 = y;
    if (mpfr_less_p(y, e)) {
        mpfr_ptr third = oracle_div(s, y, oracle_scaled(s, 3, e));
        f0 = oracle_div(s, oracle_mul(s, y2, oracle_sub(s, oracle_number(s, 1), third)), e);
        f0 = oracle_add(s, f0, oracle_div(s, e, oracle_number(s, 3)));
    }
    return oracle_scaled(s, f[0], f0);
}
