/* Energies of rods and stitches (SPEC C.6): bending from the half angle, |kb| = 2 tan(phi/2) = 2 |t0 - t1|/|t0 + t1|, without a cross product. */
#include "oracle/energies.h"

/* stiffness, length: k l0/2 (l/l0 - 1)^2. */
mpfr_ptr oracle_rod_stretching(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 e = oracle_difference(s, x, 1, 0);
    mpfr_ptr rest = oracle_number(s, f[1]), strain = oracle_sub(s, oracle_div(s, oracle_sqrt(s, oracle_dot(s, e, e)), rest), oracle_number(s, 1));
    return oracle_scaled(s, 0.5 * f[0], oracle_mul(s, rest, oracle_mul(s, strain, strain)));
}

/* stiffness, rest_curvature: k (|kb| - kbar)^2. */
mpfr_ptr oracle_rod_bending(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 e[2] = {oracle_difference(s, x, 1, 0), oracle_difference(s, x, 2, 1)}, sum, difference;
    mpfr_ptr length[2];
    for (int a = 0; a < 2; a++) {
        length[a] = oracle_sqrt(s, oracle_dot(s, e[a], e[a]));
        if (mpfr_zero_p(length[a])) return NULL;
    }
    for (int k = 0; k < 3; k++) {
        mpfr_ptr t = oracle_div(s, e[0].c[k], length[0]), u = oracle_div(s, e[1].c[k], length[1]);
        sum.c[k] = oracle_add(s, t, u);
        difference.c[k] = oracle_sub(s, t, u);
    }
    mpfr_ptr below = oracle_dot(s, sum, sum);
    if (mpfr_zero_p(below)) return NULL;
    mpfr_ptr q = oracle_scaled(s, 4, oracle_div(s, oracle_dot(s, difference, difference), below));
    if (f[1] == 0) return oracle_scaled(s, f[0], q);
    mpfr_ptr bent = oracle_sub(s, oracle_sqrt(s, q), oracle_number(s, f[1]));
    return oracle_scaled(s, f[0], oracle_mul(s, bent, bent));
}

/* stiffness, ratio: k/2 |x0 - (1 - r) x1 - r x2|^2. */
mpfr_ptr oracle_stitch(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 p = oracle_point(x, 0), a = oracle_point(x, 1), b = oracle_point(x, 2), d;
    mpfr_ptr r = oracle_number(s, f[1]), rest = oracle_sub(s, oracle_number(s, 1), r);
    for (int k = 0; k < 3; k++) d.c[k] = oracle_sub(s, p.c[k], oracle_add(s, oracle_mul(s, rest, a.c[k]), oracle_mul(s, r, b.c[k])));
    return oracle_scaled(s, 0.5 * f[0], oracle_dot(s, d, d));
}
