/* Polynomials with integer coefficients of small degree, and their real roots in (0, 1], isolated exactly (docs/theory/oracle_impact.md, sections 2, 3). */
#ifndef CIPC_ORACLE_POLYNOMIAL_H
#define CIPC_ORACLE_POLYNOMIAL_H

#include <stdbool.h>
#include <gmp.h>

/* Squared plane and line-line distances of linear motion have degree 6, their products of pairs no more than 12. */
enum { ORACLE_DEGREE_LIMIT = 12 };

/* sum_i c[i] s^i; coefficients above the degree are 0 and stay so. The zero polynomial has degree -1. */
typedef struct oracle_polynomial {
    int degree;
    mpz_t c[ORACLE_DEGREE_LIMIT + 1];
} oracle_polynomial;

void oracle_polynomial_init(oracle_polynomial *p); /* zero */
void oracle_polynomial_clear(oracle_polynomial *p);
void oracle_polynomial_set(oracle_polynomial *r, const oracle_polynomial *a);
void oracle_polynomial_trim(oracle_polynomial *p); /* degree from the coefficients, after they were written directly */
void oracle_polynomial_add(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b); /* r may be a or b, here and below */
void oracle_polynomial_sub(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b);
void oracle_polynomial_mul(oracle_polynomial *r, const oracle_polynomial *a, const oracle_polynomial *b);
void oracle_polynomial_scale(oracle_polynomial *r, const oracle_polynomial *a, const mpz_t factor);
void oracle_polynomial_derivative(oracle_polynomial *r, const oracle_polynomial *a);
/* a without repeated factors: the same roots, each simple. a is not zero. */
void oracle_polynomial_square_free(oracle_polynomial *r, const oracle_polynomial *a);
/* Sign of p at numerator / 2^bits. */
int oracle_polynomial_sign_at(const oracle_polynomial *p, const mpz_t numerator, unsigned long bits);

/* The only root in an interval [numerator, numerator + 1] / 2^bits: either the point numerator / 2^bits itself (exact), or inside the open interval. */
typedef struct oracle_root {
    bool exact;
    unsigned long bits;
    mpz_t numerator;
    oracle_polynomial local; /* the polynomial over the interval, s in [0, 1]: local(0) != 0; not used if exact */
} oracle_root;

void oracle_root_init(oracle_root *root);
void oracle_root_clear(oracle_root *root);
/* Narrow the interval to a width of at most 2^-bits. */
void oracle_root_refine(oracle_root *root, unsigned long bits);

enum { ORACLE_ROOT_LIMIT = ORACLE_DEGREE_LIMIT };
/* Roots of p in (0, 1], ascending, each in an interval of its own; root[] initialised by the caller. Returns their number, 0 for p = 0 and constants, or -1:
 * the depth cap was met (which the separation of roots of such degrees and sizes forbids for all but absurd ranges of exponents). */
int oracle_polynomial_roots(const oracle_polynomial *p, oracle_root root[ORACLE_ROOT_LIMIT]);
/* Is it plain, without isolating anything, that p has no root in [0, 1]? */
bool oracle_polynomial_no_root(const oracle_polynomial *p);

#endif
