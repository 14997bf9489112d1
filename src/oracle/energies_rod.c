/* Energies of rods, stitches and damping (SPEC C.6), from squared lengths and dot products alone: no cross product, no tangent. */
#include "oracle/energies.h"

/* Where a root meets zero there is a cone, and no derivative: to be on both sides of a jump says so. */
static void note_cone(oracle_reals *s) { s->sides |= ORACLE_JUMP_BELOW | ORACLE_JUMP_ABOVE; }

/* stiffness, length: E A/(2 l0) ((l^2 - l0^2)/(l + l0))^2. */
mpfr_ptr oracle_rod_stretching(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 e = oracle_difference(s, x, 1, 0);
    mpfr_ptr l2 = oracle_dot(s, e, e), l0 = oracle_number(s, f[1]);
    if (mpfr_zero_p(l2)) note_cone(s);
    mpfr_ptr longer = oracle_div(s, oracle_sub(s, l2, oracle_mul(s, l0, l0)), oracle_add(s, oracle_sqrt(s, l2), l0));
    return oracle_div(s, oracle_scaled(s, 0.5 * f[0], oracle_mul(s, longer, longer)), l0);
}

/* stiffness, rest_curvature: k (kappa - kbar)^2, kappa^2 = 4 tan^2(phi/2) = 4 (|e0|^2 |e1|^2 - (e0.e1)^2)/(|e0||e1| + e0.e1)^2. */
mpfr_ptr oracle_rod_bending(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 e0 = oracle_difference(s, x, 1, 0), e1 = oracle_difference(s, x, 2, 1);
    mpfr_ptr squares = oracle_mul(s, oracle_dot(s, e0, e0), oracle_dot(s, e1, e1)), c = oracle_dot(s, e0, e1);
    mpfr_ptr sine2 = oracle_sub(s, squares, oracle_mul(s, c, c)), sum = oracle_add(s, oracle_sqrt(s, squares), c);
    bool straight = mpfr_sgn(sine2) <= 0;
    if (mpfr_zero_p(squares) || (straight && mpfr_sgn(c) < 0)) return NULL; /* no tangent; folded back */
    mpfr_ptr kappa2 = oracle_scaled(s, 4, straight ? oracle_number(s, 0) : oracle_div(s, sine2, oracle_mul(s, sum, sum)));
    if (f[1] == 0) return oracle_scaled(s, f[0], kappa2);
    if (straight) note_cone(s);
    mpfr_ptr bent = oracle_sub(s, oracle_sqrt(s, kappa2), oracle_number(s, f[1]));
    return oracle_scaled(s, f[0], oracle_mul(s, bent, bent));
}

/* stiffness, ratio: k/2 |x0 - ((1 - r) x1 + r x2)|^2. */
mpfr_ptr oracle_stitch(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 y;
    mpfr_ptr rest = oracle_sub(s, oracle_number(s, 1), oracle_number(s, f[1]));
    for (int k = 0; k < 3; k++) {
        mpfr_ptr place = oracle_add(s, oracle_mul(s, rest, x[3 + k]), oracle_scaled(s, f[1], x[6 + k]));
        y.c[k] = oracle_sub(s, x[k], place);
    }
    return oracle_scaled(s, 0.5 * f[0], oracle_dot(s, y, y));
}

/* factor, start[12], stiffness[78]: c times the sum over i <= j of K_ij d_i d_j, halved on the diagonal; d = x - start. */
mpfr_ptr oracle_damping(oracle_reals *s, const mpfr_t *x, const double *f)
{
    const double *K = f + 13;
    mpfr_ptr d[12], sum = oracle_number(s, 0);
    for (int i = 0; i < 12; i++) d[i] = oracle_sub(s, x[i], oracle_number(s, f[1 + i]));
    for (int i = 0; i < 12; i++) {
        for (int j = i; j < 12; j++, K++) sum = oracle_add(s, sum, oracle_scaled(s, i == j ? 0.5 * *K : *K, oracle_mul(s, d[i], d[j])));
    }
    return oracle_scaled(s, f[0], sum);
}
