/* Energies of one node (SPEC C.1, C.7). */
#include "oracle/energies.h"

/* factor / 2 |x - target|^2. */
static mpfr_ptr quadratic(oracle_reals *s, const mpfr_t *x, mpfr_srcptr factor, const double target[3])
{
    mpfr_ptr sum = oracle_number(s, 0);
    for (int k = 0; k < 3; k++) {
        mpfr_ptr d = oracle_sub(s, x[k], oracle_number(s, target[k]));
        sum = oracle_add(s, sum, oracle_mul(s, d, d));
    }
    return oracle_scaled(s, 0.5, oracle_mul(s, factor, sum));
}

/* mass, target[3]: 1/2 m |x - xhat|^2. */
mpfr_ptr oracle_inertia(oracle_reals *s, const mpfr_t *x, const double *f) { return quadratic(s, x, oracle_number(s, f[0]), f + 1); }

/* stiffness, mass, target[3]: 1/2 k m |x - target|^2. */
mpfr_ptr oracle_dirichlet_penalty(oracle_reals *s, const mpfr_t *x, const double *f)
{
    return quadratic(s, x, oracle_mul(s, oracle_number(s, f[0]), oracle_number(s, f[1])), f + 2);
}

/* mass, acceleration[3]: -m a.x. */
mpfr_ptr oracle_gravity(oracle_reals *s, const mpfr_t *x, const double *f)
{
    mpfr_ptr sum = oracle_number(s, 0);
    for (int k = 0; k < 3; k++) sum = oracle_add(s, sum, oracle_scaled(s, f[1 + k], x[k]));
    return oracle_scaled(s, -f[0], sum);
}
