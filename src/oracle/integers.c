/* Doubles as exact integers in a common unit, and the nearest double of a ratio of integers (SPEC V.1). */
#include "oracle/integers.h"

#include <math.h>

/* IEEE 754 binary64: digits, the unit of the subnormal numbers, and an exponent that overflows any mantissa. */
enum { MANTISSA_BITS = 53, SMALLEST_EXPONENT = -1074, LARGE_EXPONENT = 2048 };

bool cipc_all_finite(const double *x, int n)
{
    for (int i = 0; i < n; i++) {
        if (!isfinite(x[i])) { return false; }
    }
    return true;
}

/* x = mantissa * 2^*exponent with an odd integer mantissa; x is finite and not 0. */
static long long odd_mantissa(double x, int *exponent)
{
    int e;
    long long mantissa = (long long)ldexp(frexp(x, &e), MANTISSA_BITS);
    e -= MANTISSA_BITS;
    while (mantissa % 2 == 0) {
        mantissa /= 2;
        e++;
    }
    *exponent = e;
    return mantissa;
}

int cipc_common_exponent(const double *x, int n, int limit)
{
    int common = limit;
    for (int i = 0; i < n; i++) {
        if (x[i] != 0) {
            int e;
            odd_mantissa(x[i], &e);
            common = e < common ? e : common;
        }
    }
    return common;
}

void cipc_integer_from_double(mpz_t z, double x, int exponent)
{
    if (x == 0) {
        mpz_set_ui(z, 0);
        return;
    }
    int e;
    double mantissa = (double)odd_mantissa(x, &e); /* below 2^53: exact */
    mpz_set_d(z, mantissa);
    mpz_mul_2exp(z, z, (mp_bitcnt_t)(e - exponent));
}

static long bit_length(const mpz_t z)
{
    return (long)mpz_sizeinbase(z, 2);
}

/* Drop the lowest bits of q >= 0, rounding to nearest, ties to even; `sticky`: a non-zero tail below q was cut off before. */
static void round_off(mpz_t q, long drop, bool sticky)
{
    if (drop <= 0) { return; }
    bool half = mpz_tstbit(q, (mp_bitcnt_t)(drop - 1)) != 0;
    bool below = sticky || (mpz_sgn(q) != 0 && mpz_scan1(q, 0) < (mp_bitcnt_t)(drop - 1));
    mpz_fdiv_q_2exp(q, q, (mp_bitcnt_t)drop);
    if (half && (below || mpz_odd_p(q))) { mpz_add_ui(q, q, 1); }
}

double cipc_nearest_double(const mpz_t numerator, const mpz_t denominator, long exponent)
{
    if (mpz_sgn(numerator) == 0) { return 0.0; }
    mpz_t q, d, r;
    mpz_inits(q, d, r, NULL);
    mpz_abs(q, numerator);
    mpz_set(d, denominator);
    /* Scale the quotient to MANTISSA_BITS + 2 or + 3 bits, so that at least two bits are rounded off. */
    long shift = MANTISSA_BITS + 3 - (bit_length(q) - bit_length(d));
    if (shift >= 0) {
        mpz_mul_2exp(q, q, (mp_bitcnt_t)shift);
    } else {
        mpz_mul_2exp(d, d, (mp_bitcnt_t)-shift);
    }
    mpz_fdiv_qr(q, r, q, d);
    long unit = exponent - shift, drop = bit_length(q) - MANTISSA_BITS;
    if (unit + drop < SMALLEST_EXPONENT) { drop = SMALLEST_EXPONENT - unit; }
    round_off(q, drop, mpz_sgn(r) != 0);
    long scale = unit + drop;
    scale = scale > LARGE_EXPONENT ? LARGE_EXPONENT : scale;
    double value = ldexp(mpz_get_d(q), (int)scale);
    mpz_clears(q, d, r, NULL);
    return mpz_sgn(numerator) < 0 ? -value : value;
}

void cipc_integer3_init(cipc_integer3 *v)
{
    mpz_inits(v->c[0], v->c[1], v->c[2], NULL);
}

void cipc_integer3_clear(cipc_integer3 *v)
{
    mpz_clears(v->c[0], v->c[1], v->c[2], NULL);
}

void cipc_integer3_from_doubles(cipc_integer3 *v, const double x[3], int exponent)
{
    for (int k = 0; k < 3; k++) { cipc_integer_from_double(v->c[k], x[k], exponent); }
}

void cipc_integer3_sub(cipc_integer3 *r, const cipc_integer3 *a, const cipc_integer3 *b)
{
    for (int k = 0; k < 3; k++) { mpz_sub(r->c[k], a->c[k], b->c[k]); }
}

void cipc_integer3_cross(cipc_integer3 *r, const cipc_integer3 *a, const cipc_integer3 *b)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mpz_mul(r->c[k], a->c[i], b->c[j]);
        mpz_submul(r->c[k], a->c[j], b->c[i]);
    }
}

void cipc_integer3_dot(mpz_t r, const cipc_integer3 *a, const cipc_integer3 *b)
{
    mpz_t sum;
    mpz_init(sum);
    for (int k = 0; k < 3; k++) { mpz_addmul(sum, a->c[k], b->c[k]); }
    mpz_swap(r, sum);
    mpz_clear(sum);
}
