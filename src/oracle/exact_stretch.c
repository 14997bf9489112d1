/* Exact comparison of the principal stretches of a triangle with limits, in integers (SPEC V.5 M3).
 *
 * With the first fundamental forms Ibar (rest) and I (now), sigma_1^2 is the largest generalised eigenvalue of (I, Ibar), so
 *   sigma_1 < s  <=>  M = s^2 Ibar - I is positive definite  <=>  M11 > 0 and det M > 0,
 * and sigma_2 > s if -M is.
 * All entries are polynomials in the doubles given. */
#include "cipc/oracle.h"

#include <math.h>

#include "oracle/integers.h"

/* First fundamental form of a triangle in units of 2^(2 exponent): form = |e1|^2, e1.e2, |e2|^2. */
static void fundamental_form(mpz_t form[3], const double x[9], int exponent)
{
    cipc_integer3 a, b, c;
    cipc_integer3_init(&a);
    cipc_integer3_init(&b);
    cipc_integer3_init(&c);
    cipc_integer3_from_doubles(&a, &x[0], exponent);
    cipc_integer3_from_doubles(&b, &x[3], exponent);
    cipc_integer3_from_doubles(&c, &x[6], exponent);
    cipc_integer3_sub(&b, &b, &a);
    cipc_integer3_sub(&c, &c, &a);
    cipc_integer3_dot(form[0], &b, &b);
    cipc_integer3_dot(form[1], &b, &c);
    cipc_integer3_dot(form[2], &c, &c);
    cipc_integer3_clear(&a);
    cipc_integer3_clear(&b);
    cipc_integer3_clear(&c);
}

/* +1 positive definite, 0 positive semi-definite, -1 neither; m = m11, m12, m22. */
static int definiteness(mpz_t m[3])
{
    mpz_t determinant;
    mpz_init(determinant);
    mpz_mul(determinant, m[0], m[2]);
    mpz_submul(determinant, m[1], m[1]);
    int sign = mpz_sgn(determinant), first = mpz_sgn(m[0]), last = mpz_sgn(m[2]);
    mpz_clear(determinant);
    if (sign < 0 || first < 0 || last < 0) { return -1; }
    return sign > 0 ? 1 : 0;
}

/* Definiteness of M, or of -M. */
static int compare(const double rest[9], const double x[9], double limit, bool negative)
{
    if (!cipc_all_finite(rest, 9) || !cipc_all_finite(x, 9) || !isfinite(limit)) { return -1; }
    mpz_t square, now[3], m[3];
    mpz_inits(square, now[0], now[1], now[2], m[0], m[1], m[2], NULL);
    int exponent = cipc_common_exponent(x, 9, cipc_common_exponent(rest, 9, 0));
    int limit_exponent = cipc_common_exponent(&limit, 1, 0); /* <= 0: s^2 = square / 2^(-2 limit_exponent) */
    fundamental_form(m, rest, exponent);
    fundamental_form(now, x, exponent);
    cipc_integer_from_double(square, limit, limit_exponent);
    mpz_mul(square, square, square);
    for (int i = 0; i < 3; i++) {
        mpz_mul(m[i], m[i], square);
        mpz_mul_2exp(now[i], now[i], (mp_bitcnt_t)(-2 * limit_exponent));
        mpz_sub(m[i], m[i], now[i]);
        if (negative) { mpz_neg(m[i], m[i]); }
    }
    int sign = definiteness(m);
    mpz_clears(square, now[0], now[1], now[2], m[0], m[1], m[2], NULL);
    return sign;
}

int cipc_exact_compare_stretch(const double rest[9], const double x[9], double limit)
{
    return compare(rest, x, limit, false);
}

int cipc_exact_compare_least_stretch(const double rest[9], const double x[9], double limit)
{
    return compare(rest, x, limit, true);
}
