/* Exact squared distance, its features, and the gap above a thickness, of all four pair kinds (SPEC V.2). */
#include "cipc/oracle.h"

#include <math.h>

#include "oracle/exact_search.h"

/* Run the search in the unit 2^exponent that x, and xi and `extra` too, are integers in. */
typedef struct question {
    oracle_search search;
    mpz_t xi, difference; /* difference: numerator of d^2 - xi^2 over the least denominator */
    int exponent;
} question;

static void question_ask(question *q, cipc_pair_kind kind, const double *x, double xi)
{
    int nodes = cipc_pair_nodes(kind);
    oracle_search_init(&q->search);
    mpz_inits(q->xi, q->difference, NULL);
    q->exponent = cipc_common_exponent(x, 3 * nodes, cipc_common_exponent(&xi, 1, 0));
    for (int i = 0; i < nodes; i++) cipc_integer3_from_doubles(&q->search.node[i], &x[3 * i], q->exponent);
    cipc_integer_from_double(q->xi, xi, q->exponent);
    oracle_search_run(&q->search, kind);
    mpz_mul(q->difference, q->xi, q->xi);
    mpz_mul(q->difference, q->difference, q->search.least_denominator);
    mpz_sub(q->difference, q->search.least_numerator, q->difference);
}

static void question_clear(question *q)
{
    mpz_clears(q->xi, q->difference, NULL);
    oracle_search_clear(&q->search);
}

double cipc_exact_distance2(cipc_pair_kind kind, const double *x, unsigned *features)
{
    if (features != NULL) *features = 0;
    if (!cipc_all_finite(x, 3 * cipc_pair_nodes(kind))) return NAN;
    question q;
    question_ask(&q, kind, x, 0);
    double distance2 = cipc_nearest_double(q.search.least_numerator, q.search.least_denominator, 2L * q.exponent);
    if (features != NULL) *features = q.search.features;
    question_clear(&q);
    return distance2;
}

/* computed = c 2^e: the error is (c 2^(e - 2 exponent) D - N) / D in the unit's square, with everything moved to the smaller of the two units. */
double cipc_exact_distance2_error(cipc_pair_kind kind, const double *x, double computed)
{
    if (!cipc_all_finite(x, 3 * cipc_pair_nodes(kind)) || !isfinite(computed)) return NAN;
    question q;
    question_ask(&q, kind, x, 0);
    mpz_t c, n;
    mpz_inits(c, n, NULL);
    int unit = cipc_common_exponent(&computed, 1, 2 * q.exponent);
    cipc_integer_from_double(c, computed, unit);
    mpz_mul(c, c, q.search.least_denominator);
    mpz_mul_2exp(n, q.search.least_numerator, (mp_bitcnt_t)(2 * q.exponent - unit));
    mpz_sub(c, c, n);
    double error = cipc_nearest_double(c, q.search.least_denominator, unit);
    mpz_clears(c, n, NULL);
    question_clear(&q);
    return error;
}

int cipc_exact_distance_sign(cipc_pair_kind kind, const double *x, double xi)
{
    if (!cipc_all_finite(x, 3 * cipc_pair_nodes(kind)) || !isfinite(xi)) return -1;
    question q;
    question_ask(&q, kind, x, xi);
    int sign = mpz_sgn(q.difference);
    question_clear(&q);
    return sign;
}

/* (d - xi) / unit = (N - X^2 D) / (sqrt(N D) + X D) for d^2 = N/D, xi = X: no cancellation, and only the root is inexact. The root is
 * enclosed between integers over 2^bits; when both ends give the same double, that is the answer; else more bits. This ends: a gap that
 * lies on the border of two roundings is rational, hence so is the root, which is then found exactly. difference is not 0, so N or X is
 * not, and low > 0. */
static double rounded_quotient(const question *q)
{
    mpz_t product, root, remainder, low, high, numerator;
    mpz_inits(product, root, remainder, low, high, numerator, NULL);
    double below = 0, above = 1;
    for (unsigned long bits = 128; below != above; bits *= 2) {
        mpz_mul(product, q->search.least_numerator, q->search.least_denominator);
        mpz_mul_2exp(product, product, 2 * bits);
        mpz_sqrtrem(root, remainder, product);
        mpz_mul(low, q->xi, q->search.least_denominator);
        mpz_mul_2exp(low, low, bits);
        mpz_add(low, low, root);
        mpz_add_ui(high, low, mpz_sgn(remainder) != 0 ? 1 : 0);
        mpz_mul_2exp(numerator, q->difference, bits);
        above = cipc_nearest_double(numerator, high, q->exponent);
        below = cipc_nearest_double(numerator, low, q->exponent);
    }
    mpz_clears(product, root, remainder, low, high, numerator, NULL);
    return below;
}

double cipc_exact_distance_gap(cipc_pair_kind kind, const double *x, double xi)
{
    if (!cipc_all_finite(x, 3 * cipc_pair_nodes(kind)) || !isfinite(xi)) return NAN;
    question q;
    question_ask(&q, kind, x, xi);
    double gap = mpz_sgn(q.difference) != 0 ? rounded_quotient(&q) : 0.0;
    question_clear(&q);
    return gap;
}
