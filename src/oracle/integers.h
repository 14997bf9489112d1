/* Doubles as exact integers: every finite double is an integer times a power of two, so a handful of them become integers in a common
 * unit 2^exponent, and everything that is polynomial in them is exact in GMP integers (SPEC V.1). Also the way back: the nearest double
 * of a ratio. */
#ifndef CIPC_ORACLE_INTEGERS_H
#define CIPC_ORACLE_INTEGERS_H

#include <stdbool.h>
#include <gmp.h>

/* Are all n numbers finite? */
bool cipc_all_finite(const double *x, int n);
/* The largest exponent e <= limit such that every one of the n finite doubles is an integer multiple of 2^e. */
int cipc_common_exponent(const double *x, int n, int limit);
/* z = x / 2^exponent, exactly; 2^exponent must divide x. */
void cipc_integer_from_double(mpz_t z, double x, int exponent);
/* The double nearest to numerator / denominator * 2^exponent, ties to even; gradual underflow and overflow as in IEEE 754. denominator >
 * 0. */
double cipc_nearest_double(const mpz_t numerator, const mpz_t denominator, long exponent);

/* Vectors of three integers. */
typedef struct cipc_integer3 {
    mpz_t c[3];
} cipc_integer3;

void cipc_integer3_init(cipc_integer3 *v);
void cipc_integer3_clear(cipc_integer3 *v);
void cipc_integer3_from_doubles(cipc_integer3 *v, const double x[3], int exponent);
void cipc_integer3_sub(cipc_integer3 *r, const cipc_integer3 *a, const cipc_integer3 *b);
void cipc_integer3_cross(cipc_integer3 *r, const cipc_integer3 *a, const cipc_integer3 *b); /* r is neither a nor b */
void cipc_integer3_dot(mpz_t r, const cipc_integer3 *a, const cipc_integer3 *b);

#endif
