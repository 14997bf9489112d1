/* Energies of tetrahedra and of orthotropic cloth (SPEC C.3, C.6), from the metric C = F^T F instead of F. */
#include "oracle/energies.h"

/* Invariants of C and J = det F. */
typedef struct invariants {
    mpfr_ptr trace, minors, J;
} invariants;

static invariants invariants_of(oracle_reals *s, const mpfr_t *x, const double *inverse_rest)
{
    oracle_real3 e[3], f[3];
    for (int i = 0; i < 3; i++) e[i] = oracle_difference(s, x, 1 + i, 0);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            f[c].c[k] = oracle_scaled(s, inverse_rest[c], e[0].c[k]);
            for (int i = 1; i < 3; i++) f[c].c[k] = oracle_add(s, f[c].c[k], oracle_scaled(s, inverse_rest[3 * i + c], e[i].c[k]));
        }
    mpfr_ptr c[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) c[a][b] = oracle_dot(s, f[a], f[b]);
    invariants v = {.trace = oracle_add(s, oracle_add(s, c[0][0], c[1][1]), c[2][2]), .minors = oracle_number(s, 0), .J = oracle_dot(s, f[0], oracle_cross(s, f[1], f[2]))};
    for (int a = 0; a < 3; a++) {
        int b = (a + 1) % 3;
        v.minors = oracle_add(s, v.minors, oracle_sub(s, oracle_mul(s, c[a][a], c[b][b]), oracle_mul(s, c[a][b], c[a][b])));
    }
    return v;
}

/* inverse_rest[9], volume, mu, lambda. */
mpfr_ptr oracle_volume_neo_hookean(oracle_reals *s, const mpfr_t *x, const double *f)
{
    invariants v = invariants_of(s, x, f);
    if (mpfr_sgn(v.J) <= 0) return NULL;
    mpfr_ptr log = oracle_log(s, v.J), shape = oracle_sub(s, oracle_sub(s, v.trace, oracle_number(s, 3)), oracle_scaled(s, 2, log));
    return oracle_scaled(s, f[9], oracle_add(s, oracle_scaled(s, 0.5 * f[10], shape), oracle_scaled(s, 0.5 * f[11], oracle_mul(s, log, log))));
}

/* Newton's steps from above to the largest root of a polynomial that is convex there: they gain two bits to begin with, and double the digits in the end. */
enum { ROOT_STEPS = 400 };

/* Sum of the principal stretches: the largest root of i^4 - 2 I i^2 - 8 J i + I^2 - 4 II, I and II the invariants of C. */
static mpfr_ptr sum_of_stretches(oracle_reals *s, const invariants *v)
{
    mpfr_ptr root = oracle_sqrt(s, oracle_scaled(s, 3, v->trace)); /* not below the sum: Cauchy-Schwarz */
    mpfr_ptr constant = oracle_sub(s, oracle_mul(s, v->trace, v->trace), oracle_scaled(s, 4, v->minors));
    for (int k = 0; k < ROOT_STEPS; k++) {
        mpfr_ptr square = oracle_mul(s, root, root);
        mpfr_ptr value = oracle_sub(s, oracle_mul(s, square, square), oracle_scaled(s, 2, oracle_mul(s, v->trace, square)));
        value = oracle_add(s, oracle_sub(s, value, oracle_scaled(s, 8, oracle_mul(s, v->J, root))), constant);
        mpfr_ptr slope = oracle_sub(s, oracle_mul(s, square, root), oracle_mul(s, v->trace, root));
        slope = oracle_scaled(s, 4, oracle_sub(s, slope, oracle_scaled(s, 2, v->J)));
        if (mpfr_sgn(slope) <= 0) break;
        mpfr_ptr step = oracle_div(s, value, slope);
        if (mpfr_zero_p(step) || mpfr_get_exp(step) < mpfr_get_exp(root) - (mpfr_exp_t)mpfr_get_prec(root) + 16) break;
        root = oracle_sub(s, root, step);
    }
    return root;
}

/* inverse_rest[9], volume, mu, lambda: |F - R|^2 = sum (sigma - 1)^2 = I - 2 sum sigma + 3. */
mpfr_ptr oracle_volume_corotational(oracle_reals *s, const mpfr_t *x, const double *f)
{
    invariants v = invariants_of(s, x, f);
    if (mpfr_sgn(v.J) <= 0) return NULL;
    mpfr_ptr off = oracle_add(s, oracle_sub(s, v.trace, oracle_scaled(s, 2, sum_of_stretches(s, &v))), oracle_number(s, 3));
    mpfr_ptr size = oracle_sub(s, v.J, oracle_number(s, 1));
    return oracle_scaled(s, f[9], oracle_add(s, oracle_scaled(s, f[10], off), oracle_scaled(s, 0.5 * f[11], oracle_mul(s, size, size))));
}

/* eta(q; Q) = -Q ln(1 - q/Q). */
static mpfr_ptr stiffening(oracle_reals *s, mpfr_srcptr q, mpfr_srcptr Q)
{
    return oracle_scaled(s, -1, oracle_mul(s, Q, oracle_log(s, oracle_div(s, oracle_sub(s, Q, q), Q))));
}

/* Quadratic form of the fundamental form of the triangle: sum of a_i b_j d_i.d_j. */
static mpfr_ptr form(oracle_reals *s, mpfr_ptr i11, mpfr_ptr i12, mpfr_ptr i22, const double a[2], const double b[2])
{
    mpfr_ptr a0 = oracle_number(s, a[0]), a1 = oracle_number(s, a[1]), b0 = oracle_number(s, b[0]), b1 = oracle_number(s, b[1]);
    mpfr_ptr mixed = oracle_add(s, oracle_mul(s, a0, b1), oracle_mul(s, a1, b0));
    mpfr_ptr sum = oracle_add(s, oracle_mul(s, oracle_mul(s, a0, b0), i11), oracle_mul(s, mixed, i12));
    return oracle_add(s, sum, oracle_mul(s, oracle_mul(s, a1, b1), i22));
}

/* warp[2], weft[2], rest_cosine, volume, moduli[4], limits[3]. */
mpfr_ptr oracle_membrane_orthotropic(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 d1 = oracle_difference(s, x, 1, 0), d2 = oracle_difference(s, x, 2, 0);
    mpfr_ptr i11 = oracle_dot(s, d1, d1), i12 = oracle_dot(s, d1, d2), i22 = oracle_dot(s, d2, d2), limit[3], square[3], E[3];
    const double rest[3] = {1, 1, f[4]};
    const double *const sides[3][2] = {{f, f}, {f + 2, f + 2}, {f, f + 2}};
    for (int k = 0; k < 3; k++) {
        E[k] = oracle_scaled(s, 0.5, oracle_sub(s, form(s, i11, i12, i22, sides[k][0], sides[k][1]), oracle_number(s, rest[k])));
        limit[k] = oracle_number(s, f[10 + k]);
        square[k] = oracle_mul(s, limit[k], limit[k]);
        if (mpfr_cmpabs(E[k], limit[k]) >= 0) return NULL;
    }
    mpfr_ptr warp = stiffening(s, oracle_mul(s, E[0], E[0]), square[0]), weft = stiffening(s, oracle_mul(s, E[1], E[1]), square[1]);
    mpfr_ptr both = stiffening(s, oracle_mul(s, E[0], E[1]), oracle_mul(s, limit[0], limit[1])), shear = stiffening(s, oracle_mul(s, E[2], E[2]), square[2]);
    mpfr_ptr sum = oracle_add(s, oracle_scaled(s, 0.5 * f[6], warp), oracle_scaled(s, f[7], both));
    sum = oracle_add(s, oracle_add(s, sum, oracle_scaled(s, 0.5 * f[8], weft)), oracle_scaled(s, f[9], shear));
    return oracle_scaled(s, f[5], sum);
}
