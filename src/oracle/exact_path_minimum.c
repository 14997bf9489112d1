/* The least distance of a stencil over a straight motion (SPEC V.3; docs/theory/oracle_impact.md, section 5).
 *
 * At a local minimum over time every feature pair that attains the distance has a flat distance N/D that is critical there: N'D - N D' = 0. So the least
 * distance is attained at one of these roots, or at an end. For N = m^2 the condition is m (2 m'D - m D') = 0. */
#include "cipc/oracle.h"

#include <math.h>
#include <mpfr.h>

#include "oracle/path.h"

/* Roots are narrowed to this width; the distance changes by at most speed 2^-ROOT_BITS over it. */
enum { ROOT_BITS = 200, DISTANCE_BITS = 512 };

typedef struct minimum {
    oracle_path path;
    mpz_t speed;
    bool found, capped;
    mpfr_t lo, hi, at; /* lo <= least distance <= hi, m; at: s */
} minimum;

/* The exact distance at s = numerator / 2^bits is a candidate; the true candidate lies within 2^-bits of it (0: exactly there). */
static void offer(minimum *m, const mpz_t numerator, unsigned long bits, bool exact)
{
    mpfr_t d, below, slack;
    mpfr_inits2(DISTANCE_BITS, d, below, slack, (mpfr_ptr)NULL);
    oracle_path_search_at(&m->path, numerator, bits);
    long exponent = m->path.exponent - (long)bits;
    mpfr_set_z(d, m->path.search.least_numerator, MPFR_RNDU);
    mpfr_set_z(slack, m->path.search.least_denominator, MPFR_RNDD);
    mpfr_div(d, d, slack, MPFR_RNDU);
    mpfr_sqrt(d, d, MPFR_RNDU);
    mpfr_mul_2si(d, d, exponent, MPFR_RNDU);
    if (!m->found || mpfr_less_p(d, m->hi)) {
        mpfr_set(m->hi, d, MPFR_RNDU);
        mpfr_set_z_2exp(m->at, numerator, -(mpfr_exp_t)bits, MPFR_RNDN);
    }
    /* Below: the rounding of DISTANCE_BITS, and the way to the root. */
    mpfr_mul_2si(below, d, -(DISTANCE_BITS - 4), MPFR_RNDU);
    mpfr_sub(below, d, below, MPFR_RNDD);
    mpfr_set_z_2exp(slack, m->speed, exponent, MPFR_RNDU);
    if (!exact) mpfr_sub(below, below, slack, MPFR_RNDD);
    if (mpfr_sgn(below) < 0) mpfr_set_zero(below, 1);
    if (!m->found || mpfr_less_p(below, m->lo)) mpfr_set(m->lo, below, MPFR_RNDD);
    m->found = true;
    mpfr_clears(d, below, slack, (mpfr_ptr)NULL);
}

static void offer_roots(minimum *m, const oracle_polynomial *p, oracle_root root[ORACLE_ROOT_LIMIT])
{
    int found = oracle_polynomial_roots(p, root);
    m->capped = m->capped || found < 0;
    for (int i = 0; i < found; i++) {
        oracle_root_refine(&root[i], ROOT_BITS);
        offer(m, root[i].numerator, root[i].bits, root[i].exact);
    }
}

static void offer_feature(minimum *m, const cipc_feature *feature, oracle_root root[ORACLE_ROOT_LIMIT])
{
    oracle_flat_distance d;
    oracle_polynomial slope, term;
    mpz_t two;
    mpz_init_set_ui(two, 2);
    oracle_flat_distance_init(&d);
    oracle_polynomial_init(&slope);
    oracle_polynomial_init(&term);
    oracle_path_flat_distance(&m->path, feature, &d);
    const oracle_polynomial *n = d.has_height ? &d.height : &d.square;
    oracle_polynomial_derivative(&slope, n);
    oracle_polynomial_mul(&slope, &slope, &d.norm2);
    if (d.has_height) oracle_polynomial_scale(&slope, &slope, two);
    oracle_polynomial_derivative(&term, &d.norm2);
    oracle_polynomial_mul(&term, &term, n);
    oracle_polynomial_sub(&slope, &slope, &term);
    offer_roots(m, &slope, root);
    if (d.has_height) offer_roots(m, &d.height, root);
    oracle_polynomial_clear(&slope);
    oracle_polynomial_clear(&term);
    oracle_flat_distance_clear(&d);
    mpz_clear(two);
}

static void search(minimum *m)
{
    mpz_t end;
    oracle_root root[ORACLE_ROOT_LIMIT];
    mpz_init(end);
    oracle_path_speed(&m->path, m->speed);
    offer(m, end, 0, true);
    mpz_set_ui(end, 1);
    offer(m, end, 0, true);
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_init(&root[i]);
    for (int f = 0; f < cipc_feature_count(m->path.kind); f++) {
        cipc_feature feature = cipc_feature_at(m->path.kind, f);
        offer_feature(m, &feature, root);
    }
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_clear(&root[i]);
    mpz_clear(end);
}

cipc_verdict cipc_exact_path_minimum(const cipc_stencil_path *path, double t, double *lo, double *hi, double *at)
{
    minimum m = {.found = false};
    mpz_t none;
    mpz_inits(m.speed, none, NULL);
    mpfr_inits2(DISTANCE_BITS, m.lo, m.hi, m.at, (mpfr_ptr)NULL);
    if (oracle_path_init(&m.path, path, 0, t, none)) search(&m);
    bool known = m.found && !m.capped;
    if (lo != NULL) *lo = known ? mpfr_get_d(m.lo, MPFR_RNDD) : NAN;
    if (hi != NULL) *hi = known ? mpfr_get_d(m.hi, MPFR_RNDU) : NAN;
    if (at != NULL) *at = known ? mpfr_get_d(m.at, MPFR_RNDN) * t : NAN;
    oracle_path_clear(&m.path);
    mpfr_clears(m.lo, m.hi, m.at, (mpfr_ptr)NULL);
    mpz_clears(m.speed, none, NULL);
    return known ? CIPC_YES : CIPC_INDETERMINATE;
}
