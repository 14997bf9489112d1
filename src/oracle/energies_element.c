/* Energies of triangles and hinges (SPEC C.2, C.6), from first fundamental forms instead of deformation gradients. */
#include "oracle/energies.h"

/* The Cauchy-Green tensor C = B^-T I B^-1 of the present fundamental form I = (d1.d1, d1.d2, d2.d2), B^-1 = [[b0, b1], [0, b2]]. */
typedef struct tensor {
    mpfr_ptr c11, c12, c22, determinant;
} tensor;

static tensor cauchy_green(oracle_reals *s, const mpfr_t *x, const double b[3])
{
    oracle_real3 d1 = oracle_difference(s, x, 1, 0), d2 = oracle_difference(s, x, 2, 0);
    mpfr_ptr i11 = oracle_dot(s, d1, d1), i12 = oracle_dot(s, d1, d2), i22 = oracle_dot(s, d2, d2);
    mpfr_ptr b0 = oracle_number(s, b[0]), b1 = oracle_number(s, b[1]), b2 = oracle_number(s, b[2]);
    mpfr_ptr mixed = oracle_add(s, oracle_mul(s, b1, i11), oracle_mul(s, b2, i12)); /* d1 . (b1 d1 + b2 d2) */
    mpfr_ptr last = oracle_add(s, oracle_mul(s, b1, i12), oracle_mul(s, b2, i22));  /* d2 . (b1 d1 + b2 d2) */
    mpfr_ptr det = oracle_sub(s, oracle_mul(s, i11, i22), oracle_mul(s, i12, i12)), scale = oracle_mul(s, b0, b2);
    return (tensor){
        .c11 = oracle_mul(s, oracle_mul(s, b0, b0), i11),
        .c12 = oracle_mul(s, b0, mixed),
        .c22 = oracle_add(s, oracle_mul(s, b1, mixed), oracle_mul(s, b2, last)),
        .determinant = oracle_mul(s, det, oracle_mul(s, scale, scale)),
    };
}

/* inverse_rest[3], area, volume, mu, lambda: V [mu/2 (tr C - 2 - ln det C) + lambda/8 (ln det C)^2], det C = J^2. */
mpfr_ptr oracle_membrane_neo_hookean(oracle_reals *s, const mpfr_t *x, const double *f)
{
    tensor t = cauchy_green(s, x, f);
    if (mpfr_sgn(t.determinant) <= 0) return NULL;
    mpfr_ptr log = oracle_log(s, t.determinant), trace = oracle_add(s, t.c11, t.c22);
    mpfr_ptr shape = oracle_scaled(s, 0.5 * f[5], oracle_sub(s, oracle_sub(s, trace, oracle_number(s, 2)), log));
    mpfr_ptr size = oracle_scaled(s, 0.125 * f[6], oracle_mul(s, log, log));
    return oracle_scaled(s, f[4], oracle_add(s, shape, size));
}

/* V [lambda/2 (tr E)^2 + mu tr E^2], E = (C - 1)/2: with e11, e12, e22 = C - 1, V/4 [lambda/2 (e11 + e22)^2 + mu (e11^2 + 2 e12^2 + e22^2)]. */
mpfr_ptr oracle_membrane_stvk(oracle_reals *s, const mpfr_t *x, const double *f)
{
    tensor t = cauchy_green(s, x, f);
    mpfr_ptr one = oracle_number(s, 1), e11 = oracle_sub(s, t.c11, one), e22 = oracle_sub(s, t.c22, one), trace = oracle_add(s, e11, e22);
    mpfr_ptr squares = oracle_add(s, oracle_mul(s, e11, e11), oracle_mul(s, e22, e22));
    squares = oracle_add(s, squares, oracle_scaled(s, 2, oracle_mul(s, t.c12, t.c12)));
    mpfr_ptr sum = oracle_add(s, oracle_scaled(s, 0.5 * f[6], oracle_mul(s, trace, trace)), oracle_scaled(s, f[5], squares));
    return oracle_scaled(s, 0.25 * f[4], sum);
}

/* b(sigma) = -y^2 ln(1 + y), y = (shat - sigma)/(s - shat), for sigma > shat; NULL at or beyond the limit s. */
static mpfr_ptr stretch_barrier(oracle_reals *s, mpfr_srcptr sigma, double limit, double activation)
{
    mpfr_ptr over = oracle_sub(s, sigma, oracle_number(s, activation)), left = oracle_sub(s, oracle_number(s, limit), sigma);
    mpfr_ptr range = oracle_sub(s, oracle_number(s, limit), oracle_number(s, activation));
    if (mpfr_sgn(over) <= 0) return oracle_number(s, 0);
    if (mpfr_sgn(left) <= 0) return NULL;
    mpfr_ptr y = oracle_div(s, over, range);
    return oracle_scaled(s, -1, oracle_mul(s, oracle_mul(s, y, y), oracle_log(s, oracle_div(s, left, range))));
}

/* inverse_rest[3], volume, limit, activation, stiffness. Stretches: roots of the eigenvalues of C, mean +- radius. */
mpfr_ptr oracle_strain_limit(oracle_reals *s, const mpfr_t *x, const double *f)
{
    tensor t = cauchy_green(s, x, f);
    mpfr_ptr mean = oracle_scaled(s, 0.5, oracle_add(s, t.c11, t.c22)), half = oracle_scaled(s, 0.5, oracle_sub(s, t.c11, t.c22));
    mpfr_ptr radius = oracle_sqrt(s, oracle_add(s, oracle_mul(s, half, half), oracle_mul(s, t.c12, t.c12)));
    mpfr_ptr larger = oracle_add(s, mean, radius), smaller = oracle_sub(s, mean, radius);
    if (mpfr_sgn(smaller) < 0) smaller = oracle_number(s, 0); /* rounding of a collapsed triangle */
    mpfr_ptr first = stretch_barrier(s, oracle_sqrt(s, larger), f[4], f[5]), second = stretch_barrier(s, oracle_sqrt(s, smaller), f[4], f[5]);
    if (first == NULL || second == NULL) return NULL;
    return oracle_scaled(s, f[6], oracle_scaled(s, f[3], oracle_add(s, first, second)));
}

/* Beyond this angle, rad, a hinge is on one side of the jump from pi to -pi: anything between 0 and pi serves. */
static const double NEAR_FOLDED = 3;

/* stiffness, rest_angle: k (theta - thetabar)^2. theta from the heights of v2 and v3 over the edge, not from normals: with e along the edge, h2 and h3 the parts
 * of v2 and v3 across it, the dihedral angle is that from h2 to -h3 about e. */
mpfr_ptr oracle_hinge_bending(oracle_reals *s, const mpfr_t *x, const double *f)
{
    oracle_real3 e = oracle_difference(s, x, 1, 0), a = oracle_difference(s, x, 2, 0), b = oracle_difference(s, x, 3, 0), h2, h3;
    oracle_real3 area2 = oracle_cross(s, e, a), area3 = oracle_cross(s, e, b);
    if (mpfr_zero_p(oracle_dot(s, area2, area2)) || mpfr_zero_p(oracle_dot(s, area3, area3))) return NULL; /* no normal */
    mpfr_ptr ee = oracle_dot(s, e, e), ta = oracle_div(s, oracle_dot(s, a, e), ee), tb = oracle_div(s, oracle_dot(s, b, e), ee);
    for (int k = 0; k < 3; k++) {
        h2.c[k] = oracle_sub(s, a.c[k], oracle_mul(s, ta, e.c[k]));
        h3.c[k] = oracle_sub(s, oracle_mul(s, tb, e.c[k]), b.c[k]); /* reversed */
    }
    mpfr_ptr sine = oracle_div(s, oracle_dot(s, e, oracle_cross(s, h2, h3)), oracle_sqrt(s, ee)), cosine = oracle_dot(s, h2, h3);
    mpfr_ptr theta = oracle_number(s, 0);
    mpfr_atan2(theta, sine, cosine, MPFR_RNDN);
    if (mpfr_cmp_d(theta, NEAR_FOLDED) > 0) s->sides |= ORACLE_JUMP_ABOVE;
    if (mpfr_cmp_d(theta, -NEAR_FOLDED) < 0) s->sides |= ORACLE_JUMP_BELOW;
    mpfr_ptr bent = oracle_sub(s, theta, oracle_number(s, f[1]));
    return oracle_scaled(s, f[0], oracle_mul(s, bent, bent));
}
