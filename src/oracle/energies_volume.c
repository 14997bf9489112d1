/* Energies of tetrahedra (SPEC C.6), from the invariants of C: neither a deformation gradient nor a rotation is formed. */
#include "oracle/energies.h"

/* Invariants of C = B^-T G B^-1, G the Gram matrix of the present edges: trace, sum of the principal minors, and J = det F. */
typedef struct invariants {
    mpfr_ptr first, second, J;
} invariants;

/* a b - c d. */
static mpfr_ptr minor(oracle_reals *s, mpfr_srcptr a, mpfr_srcptr b, mpfr_srcptr c, mpfr_srcptr d)
{
    return oracle_sub(s, oracle_mul(s, a, b), oracle_mul(s, c, d));
}

/* b_a . e: column a of B^-1 as combination of three numbers. */
static mpfr_ptr combined(oracle_reals *s, const double *b, int a, mpfr_srcptr e0, mpfr_srcptr e1, mpfr_srcptr e2)
{
    return oracle_add(s, oracle_add(s, oracle_scaled(s, b[a], e0), oracle_scaled(s, b[3 + a], e1)), oracle_scaled(s, b[6 + a], e2));
}

/* det B^-1, by its rows. */
static mpfr_ptr inverse_rest_determinant(oracle_reals *s, const double *b)
{
    oracle_real3 row[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) row[i].c[k] = oracle_number(s, b[3 * i + k]);
    }
    return oracle_dot(s, row[0], oracle_cross(s, row[1], row[2]));
}

static invariants invariants_of(oracle_reals *s, const mpfr_t *x, const double *b)
{
    oracle_real3 e[3] = {oracle_difference(s, x, 1, 0), oracle_difference(s, x, 2, 0), oracle_difference(s, x, 3, 0)};
    mpfr_ptr G[3][3], half[3][3], C[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) G[i][j] = oracle_dot(s, e[i], e[j]);
    }
    for (int i = 0; i < 3; i++) {
        for (int a = 0; a < 3; a++) half[i][a] = combined(s, b, a, G[i][0], G[i][1], G[i][2]);
    }
    for (int a = 0; a < 3; a++) {
        for (int c = 0; c < 3; c++) C[a][c] = combined(s, b, a, half[0][c], half[1][c], half[2][c]);
    }
    mpfr_ptr last = minor(s, C[1][1], C[2][2], C[1][2], C[2][1]);
    return (invariants){
        .first = oracle_add(s, oracle_add(s, C[0][0], C[1][1]), C[2][2]),
        .second = oracle_add(s, oracle_add(s, minor(s, C[0][0], C[1][1], C[0][1], C[1][0]), minor(s, C[0][0], C[2][2], C[0][2], C[2][0])), last),
        .J = oracle_mul(s, oracle_dot(s, e[0], oracle_cross(s, e[1], e[2])), inverse_rest_determinant(s, b)),
    };
}

/* inverse_rest[9], volume, mu, lambda: V [mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2]. */
mpfr_ptr oracle_volume_neo_hookean(oracle_reals *s, const mpfr_t *x, const double *f)
{
    invariants c = invariants_of(s, x, f);
    if (mpfr_sgn(c.J) <= 0) return NULL;
    mpfr_ptr log = oracle_log(s, c.J), shape = oracle_sub(s, oracle_sub(s, c.first, oracle_number(s, 3)), oracle_scaled(s, 2, log));
    mpfr_ptr sum = oracle_add(s, oracle_scaled(s, f[10], shape), oracle_scaled(s, f[11], oracle_mul(s, log, log)));
    return oracle_scaled(s, 0.5 * f[9], sum);
}

/* Newton's iteration for the root below comes down by a factor at least 2 in its distance from the root, at the end by its square: 1024 bits need no more. */
enum { MOST_STEPS = 1200 };

/* sigma_1 + sigma_2 + sigma_3. With t their sum and r = sigma_1 sigma_2 + sigma_1 sigma_3 + sigma_2 sigma_3,
 *   t^2 = I1 + 2 r,  r^2 = I2 + 2 J t,  hence  p(t) = (t^2 - I1)^2 - 4 I2 - 8 J t = 0.
 * t is the largest of the four roots (the others have two of the signs turned), p is convex beyond it, and sqrt(3 I1) >= t: Newton's iteration from there falls
 * until roundings stop it. No eigenvalue is formed, so that nothing is lost where two of them meet. */
static mpfr_ptr sum_of_stretches(oracle_reals *s, const invariants *c)
{
    mpfr_ptr t = oracle_sqrt(s, oracle_scaled(s, 3, c->first));
    int mark = s->used;
    for (int step = 0; step < MOST_STEPS; step++) {
        s->used = mark;
        mpfr_ptr r2 = oracle_sub(s, oracle_mul(s, t, t), c->first), eight_J = oracle_scaled(s, 8, c->J);
        mpfr_ptr p = oracle_sub(s, oracle_sub(s, oracle_mul(s, r2, r2), oracle_scaled(s, 4, c->second)), oracle_mul(s, eight_J, t));
        mpfr_ptr slope = oracle_sub(s, oracle_scaled(s, 4, oracle_mul(s, t, r2)), eight_J);
        if (mpfr_sgn(p) <= 0 || mpfr_sgn(slope) <= 0) break;
        mpfr_ptr next = oracle_sub(s, t, oracle_div(s, p, slope));
        if (!mpfr_less_p(next, t)) break;
        mpfr_set(t, next, MPFR_RNDN);
    }
    return t;
}

/* inverse_rest[9], volume, mu, lambda: V [mu sum (sigma_i - 1)^2 + lambda/2 (J - 1)^2], the sum being tr C - 2 sum sigma_i + 3. */
mpfr_ptr oracle_volume_corotational(oracle_reals *s, const mpfr_t *x, const double *f)
{
    invariants c = invariants_of(s, x, f);
    if (mpfr_sgn(c.J) <= 0) return NULL;
    mpfr_ptr shape = oracle_add(s, oracle_sub(s, c.first, oracle_scaled(s, 2, sum_of_stretches(s, &c))), oracle_number(s, 3));
    mpfr_ptr change = oracle_sub(s, c.J, oracle_number(s, 1)), size = oracle_scaled(s, 0.5 * f[11], oracle_mul(s, change, change));
    return oracle_scaled(s, f[9], oracle_add(s, oracle_scaled(s, f[10], shape), size));
}
