/* Exact squared distance of point-triangle and edge-edge, in integers (SPEC V.2).
 *
 * d^2 is the least of a few candidates, each the squared distance to a point that really lies on the primitive. In integer coordinates
 * each candidate is a ratio numerator / denominator of integers:
 *   point-point           |p - q|^2 / 1
 *   point-edge            |(p - e0) x d|^2 / |d|^2,  d = e1 - e0,   if 0 < (p - e0).d < |d|^2
 *   point-triangle inside ((p - t0).n)^2 / |n|^2,    n = (t1 - t0) x (t2 - t0), if n != 0 and all three barycentrics are positive
 *   edge-edge inside      ((b0 - a0).n)^2 / |n|^2,   n = (a1 - a0) x (b1 - b0), if n != 0 and both line parameters are in (0, 1) */
#include "cipc/oracle.h"

#include <math.h>

#include "oracle/integers.h"

/* The nodes of the stencil, the candidate being made, the least one so far, and scratch. */
typedef struct search {
    cipc_integer3 node[4];
    cipc_integer3 u, v, w, n, s;
    mpz_t numerator, denominator;
    mpz_t least_numerator, least_denominator; /* least_denominator 0: none yet */
    mpz_t p, q;
} search;

static void search_init(search *f)
{
    for (int i = 0; i < 4; i++) { cipc_integer3_init(&f->node[i]); }
    cipc_integer3 *vectors[] = {&f->u, &f->v, &f->w, &f->n, &f->s};
    for (int i = 0; i < 5; i++) { cipc_integer3_init(vectors[i]); }
    mpz_inits(f->numerator, f->denominator, f->least_numerator, f->least_denominator, f->p, f->q, NULL);
}

static void search_clear(search *f)
{
    for (int i = 0; i < 4; i++) { cipc_integer3_clear(&f->node[i]); }
    cipc_integer3 *vectors[] = {&f->u, &f->v, &f->w, &f->n, &f->s};
    for (int i = 0; i < 5; i++) { cipc_integer3_clear(vectors[i]); }
    mpz_clears(f->numerator, f->denominator, f->least_numerator, f->least_denominator, f->p, f->q, NULL);
}

/* Keep the candidate if it is less than the least: n/d < N/D <=> n D < N d. */
static void offer_candidate(search *f)
{
    if (mpz_sgn(f->least_denominator) != 0) {
        mpz_mul(f->p, f->numerator, f->least_denominator);
        mpz_mul(f->q, f->least_numerator, f->denominator);
        if (mpz_cmp(f->p, f->q) >= 0) { return; }
    }
    mpz_set(f->least_numerator, f->numerator);
    mpz_set(f->least_denominator, f->denominator);
}

static void offer_point_point(search *f, int i, int j)
{
    cipc_integer3_sub(&f->u, &f->node[i], &f->node[j]);
    cipc_integer3_dot(f->numerator, &f->u, &f->u);
    mpz_set_ui(f->denominator, 1);
    offer_candidate(f);
}

static void offer_point_edge(search *f, int point, int e0, int e1)
{
    cipc_integer3_sub(&f->v, &f->node[e1], &f->node[e0]);
    cipc_integer3_sub(&f->u, &f->node[point], &f->node[e0]);
    cipc_integer3_dot(f->denominator, &f->v, &f->v);
    cipc_integer3_dot(f->p, &f->u, &f->v);
    if (mpz_sgn(f->p) <= 0 || mpz_cmp(f->p, f->denominator) >= 0) {
        return; /* the foot is not inside the edge, or the edge has no length */
    }
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->numerator, &f->n, &f->n);
    offer_candidate(f);
}

/* The candidate (w.n)^2 / |n|^2 for the n and w of the search. */
static void offer_normal(search *f)
{
    cipc_integer3_dot(f->p, &f->w, &f->n);
    mpz_mul(f->numerator, f->p, f->p);
    offer_candidate(f);
}

/* (a x b).n into r; uses s. */
static void triple(search *f, mpz_t r, const cipc_integer3 *a, const cipc_integer3 *b)
{
    cipc_integer3_cross(&f->s, a, b);
    cipc_integer3_dot(r, &f->s, &f->n);
}

static void offer_triangle_interior(search *f)
{
    cipc_integer3_sub(&f->u, &f->node[2], &f->node[1]);
    cipc_integer3_sub(&f->v, &f->node[3], &f->node[1]);
    cipc_integer3_sub(&f->w, &f->node[0], &f->node[1]);
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->denominator, &f->n, &f->n);
    /* Barycentric coordinates times |n|^2: beta1 = (w x v).n, beta2 = (u x w).n, beta0 = |n|^2 - beta1 - beta2. */
    triple(f, f->p, &f->w, &f->v);
    triple(f, f->q, &f->u, &f->w);
    bool positive = mpz_sgn(f->p) > 0 && mpz_sgn(f->q) > 0;
    mpz_add(f->p, f->p, f->q);
    if (positive && mpz_cmp(f->p, f->denominator) < 0) { offer_normal(f); }
}

static void offer_edges_interior(search *f)
{
    cipc_integer3_sub(&f->u, &f->node[1], &f->node[0]);
    cipc_integer3_sub(&f->v, &f->node[3], &f->node[2]);
    cipc_integer3_sub(&f->w, &f->node[2], &f->node[0]);
    cipc_integer3_cross(&f->n, &f->u, &f->v);
    cipc_integer3_dot(f->denominator, &f->n, &f->n);
    /* Parameters of the closest points of the lines, times |n|^2: (w x v).n on the first, (w x u).n on the second. */
    triple(f, f->p, &f->w, &f->v);
    triple(f, f->q, &f->w, &f->u);
    if (mpz_sgn(f->p) > 0 && mpz_cmp(f->p, f->denominator) < 0 && mpz_sgn(f->q) > 0 && mpz_cmp(f->q, f->denominator) < 0) {
        offer_normal(f);
    }
}

static void search_point_triangle(search *f)
{
    for (int i = 1; i < 4; i++) {
        offer_point_point(f, 0, i);
        offer_point_edge(f, 0, i, i % 3 + 1);
    }
    offer_triangle_interior(f);
}

static void search_edge_edge(search *f)
{
    for (int i = 0; i < 2; i++) {
        offer_point_point(f, i, 2);
        offer_point_point(f, i, 3);
        offer_point_edge(f, i, 2, 3);
        offer_point_edge(f, i + 2, 0, 1);
    }
    offer_edges_interior(f);
}

/* The least candidate in units of 2^(2 exponent), and xi in units of 2^exponent; returns the exponent. */
static int search_run(search *f, bool edge_edge, const double x[12], double xi, mpz_t integer_xi)
{
    int exponent = cipc_common_exponent(&xi, 1, 0);
    exponent = cipc_common_exponent(x, 12, exponent);
    for (int i = 0; i < 4; i++) { cipc_integer3_from_doubles(&f->node[i], &x[3 * i], exponent); }
    cipc_integer_from_double(integer_xi, xi, exponent);
    if (edge_edge) {
        search_edge_edge(f);
    } else {
        search_point_triangle(f);
    }
    return exponent;
}

/* difference = numerator of d^2 - xi^2 over the least denominator. */
static void squared_difference(const search *f, const mpz_t integer_xi, mpz_t difference)
{
    mpz_mul(difference, integer_xi, integer_xi);
    mpz_mul(difference, difference, f->least_denominator);
    mpz_sub(difference, f->least_numerator, difference);
}

int cipc_exact_compare_distance(bool edge_edge, const double x[12], double xi, double *distance2)
{
    if (!cipc_all_finite(x, 12) || !isfinite(xi)) {
        if (distance2 != NULL) { *distance2 = NAN; }
        return -1;
    }
    search f;
    mpz_t integer_xi, difference;
    search_init(&f);
    mpz_inits(integer_xi, difference, NULL);
    int exponent = search_run(&f, edge_edge, x, xi, integer_xi);
    squared_difference(&f, integer_xi, difference);
    int sign = mpz_sgn(difference);
    if (distance2 != NULL) { *distance2 = cipc_nearest_double(f.least_numerator, f.least_denominator, 2L * exponent); }
    mpz_clears(integer_xi, difference, NULL);
    search_clear(&f);
    return sign;
}

/* (d - xi) / unit = (N - X^2 D) / (sqrt(N D) + X D) for d^2 = N/D, xi = X: no cancellation, and only the root is inexact. The root is
 * enclosed between integers over 2^bits; when both ends give the same double, that is the answer; else more bits. This ends: a gap that
 * lies on the border of two roundings is rational, hence so is the root, which is then found exactly. difference is not 0, so N or X is
 * not, and low > 0. */
static double rounded_quotient(const search *f, const mpz_t integer_xi, const mpz_t difference, int exponent)
{
    mpz_t product, root, remainder, low, high, numerator;
    mpz_inits(product, root, remainder, low, high, numerator, NULL);
    double below = 0, above = 1;
    for (unsigned long bits = 128; below != above; bits *= 2) {
        mpz_mul(product, f->least_numerator, f->least_denominator);
        mpz_mul_2exp(product, product, 2 * bits);
        mpz_sqrtrem(root, remainder, product);
        mpz_mul(low, integer_xi, f->least_denominator);
        mpz_mul_2exp(low, low, bits);
        mpz_add(low, low, root);
        mpz_add_ui(high, low, mpz_sgn(remainder) != 0 ? 1 : 0);
        mpz_mul_2exp(numerator, difference, bits);
        above = cipc_nearest_double(numerator, high, exponent);
        below = cipc_nearest_double(numerator, low, exponent);
    }
    mpz_clears(product, root, remainder, low, high, numerator, NULL);
    return below;
}

double cipc_exact_gap(bool edge_edge, const double x[12], double xi)
{
    if (!cipc_all_finite(x, 12) || !isfinite(xi)) { return NAN; }
    search f;
    mpz_t integer_xi, difference;
    search_init(&f);
    mpz_inits(integer_xi, difference, NULL);
    int exponent = search_run(&f, edge_edge, x, xi, integer_xi);
    squared_difference(&f, integer_xi, difference);
    double gap = mpz_sgn(difference) != 0 ? rounded_quotient(&f, integer_xi, difference, exponent) : 0.0;
    mpz_clears(integer_xi, difference, NULL);
    search_clear(&f);
    return gap;
}
