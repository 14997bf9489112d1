/* Energies of woven and of incompressible cloth (SPEC C.2, C.3), from the dot products of the present edges. */
#include "oracle/energies.h"

/* Dot products of the edges of a triangle: d1.d1, d1.d2, d2.d2. */
typedef struct gram {
    mpfr_ptr d11, d12, d22;
} gram;

static gram gram_of(oracle_reals *s, const mpfr_t *x)
{
    oracle_real3 d1 = oracle_difference(s, x, 1, 0), d2 = oracle_difference(s, x, 2, 0);
    return (gram){oracle_dot(s, d1, d1), oracle_dot(s, d1, d2), oracle_dot(s, d2, d2)};
}

/* a.b of two combinations a = a[0] d1 + a[1] d2 and b likewise. */
static mpfr_ptr product(oracle_reals *s, const gram *g, const double a[2], const double b[2])
{
    mpfr_ptr on_d1 = oracle_add(s, oracle_scaled(s, b[0], g->d11), oracle_scaled(s, b[1], g->d12));
    mpfr_ptr on_d2 = oracle_add(s, oracle_scaled(s, b[0], g->d12), oracle_scaled(s, b[1], g->d22));
    return oracle_add(s, oracle_scaled(s, a[0], on_d1), oracle_scaled(s, a[1], on_d2));
}

/* eta(q; Q) = -Q ln((Q - q)/Q) for q = a b, Q = A B; NULL for |a| >= A. */
static mpfr_ptr eta(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b, double A, double B)
{
    mpfr_ptr Q = oracle_scaled(s, A, oracle_number(s, B)), ratio = oracle_div(s, oracle_sub(s, Q, oracle_mul(s, a, b)), Q);
    if (mpfr_cmpabs(a, oracle_number(s, A)) >= 0) return NULL;
    return oracle_scaled(s, -1, oracle_mul(s, Q, oracle_log(s, ratio)));
}

/* warp[2], weft[2], rest_cosine, volume, a11, a12, a22, g12, limit11, limit22, limit12. */
mpfr_ptr oracle_membrane_orthotropic(oracle_reals *s, const mpfr_t *x, const double *f)
{
    gram g = gram_of(s, x);
    mpfr_ptr one = oracle_number(s, 1);
    mpfr_ptr e11 = oracle_scaled(s, 0.5, oracle_sub(s, product(s, &g, f, f), one)), e22 = oracle_scaled(s, 0.5, oracle_sub(s, product(s, &g, f + 2, f + 2), one));
    mpfr_ptr e12 = oracle_scaled(s, 0.5, oracle_sub(s, product(s, &g, f, f + 2), oracle_number(s, f[4])));
    mpfr_ptr warp = eta(s, e11, e11, f[10], f[10]), weft = eta(s, e22, e22, f[11], f[11]), shear = eta(s, e12, e12, f[12], f[12]);
    if (warp == NULL || weft == NULL || shear == NULL) return NULL;
    mpfr_ptr both = eta(s, e11, e22, f[10], f[11]);
    mpfr_ptr sum = oracle_add(s, oracle_scaled(s, 0.5 * f[6], warp), oracle_scaled(s, 0.5 * f[8], weft));
    return oracle_scaled(s, f[5], oracle_add(s, sum, oracle_add(s, oracle_scaled(s, f[7], both), oracle_scaled(s, f[9], shear))));
}

/* b(sigma) = -y^2 ln(1 - y), y = (shat - sigma)/(shat - s), for sigma < shat; NULL at or below the limit s. */
static mpfr_ptr compression_barrier(oracle_reals *s, mpfr_srcptr sigma, double limit, double activation)
{
    mpfr_ptr below = oracle_sub(s, oracle_number(s, activation), sigma), range = oracle_sub(s, oracle_number(s, activation), oracle_number(s, limit));
    if (mpfr_sgn(below) <= 0) return oracle_number(s, 0);
    mpfr_ptr y = oracle_div(s, below, range), left = oracle_sub(s, oracle_number(s, 1), y);
    if (mpfr_sgn(left) <= 0) return NULL;
    return oracle_scaled(s, -1, oracle_mul(s, oracle_mul(s, y, y), oracle_log(s, left)));
}

/* inverse_rest[3], volume, limit, activation, stiffness. Stretches from their sum and difference: (sigma_1 +- sigma_2)^2 = tr C +- 2 J. */
mpfr_ptr oracle_strain_limit_lower(oracle_reals *s, const mpfr_t *x, const double *f)
{
    gram g = gram_of(s, x);
    const double first_column[2] = {f[0], 0}, second_column[2] = {f[1], f[2]};
    mpfr_ptr trace = oracle_add(s, product(s, &g, first_column, first_column), product(s, &g, second_column, second_column));
    mpfr_ptr det = oracle_sub(s, oracle_mul(s, g.d11, g.d22), oracle_mul(s, g.d12, g.d12));
    if (mpfr_sgn(det) <= 0) return NULL;
    mpfr_ptr twice_J = oracle_scaled(s, 2, oracle_scaled(s, f[2], oracle_scaled(s, f[0], oracle_sqrt(s, det)))), apart = oracle_sub(s, trace, twice_J);
    if (mpfr_sgn(apart) < 0) apart = oracle_number(s, 0); /* rounding of equal stretches */
    mpfr_ptr sum = oracle_sqrt(s, oracle_add(s, trace, twice_J)), difference = oracle_sqrt(s, apart);
    mpfr_ptr larger = oracle_scaled(s, 0.5, oracle_add(s, sum, difference)), smaller = oracle_scaled(s, 0.5, oracle_sub(s, sum, difference));
    mpfr_ptr first = compression_barrier(s, larger, f[4], f[5]), second = compression_barrier(s, smaller, f[4], f[5]);
    if (first == NULL || second == NULL) return NULL;
    return oracle_scaled(s, f[6], oracle_scaled(s, f[3], oracle_add(s, first, second)));
}
