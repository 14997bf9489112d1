/* Certified lower bound of a gap in MPFR, at rising precision (SPEC V.4 item 4; docs/theory/certified_ccd.md, section 4). Independent of the oracle. */
#include <math.h>
#include <mpfr.h>

#include "contact/separation_bound.h"

/* From a little more than twice a double's digits on; at the last one all sums and products of any stencil of doubles are exact (section 4). */
enum { FIRST_PRECISION = 128, LAST_PRECISION = 32768 };
/* (5) with the unit of the precision in use. */
enum { SEPARATION_ERROR_BITS = 4 };

enum { TEMPORARIES = 10 };
typedef struct workspace {
    mpfr_prec_t precision;
    int nodes, first;
    mpfr_t z[4][3], n[3], a[3], b[3], size, near, far, best;
    mpfr_t temporary[TEMPORARIES];
    bool any;             /* `best` holds a lower bound of d - xi */
    bool positions_exact; /* came without rounding */
    bool exact, clear;    /* all separations are known exactly; one of them is, and exceeds xi */
} workspace;

static void workspace_init(workspace *w, mpfr_prec_t precision, cipc_pair_kind kind)
{
    w->precision = precision;
    w->nodes = cipc_pair_nodes(kind);
    w->first = cipc_pair_first_nodes(kind);
    w->any = w->clear = false;
    w->exact = true;
    for (int i = 0; i < 12; i++) mpfr_init2(w->z[i / 3][i % 3], precision);
    for (int k = 0; k < 3; k++) mpfr_inits2(precision, w->n[k], w->a[k], w->b[k], (mpfr_ptr)NULL);
    mpfr_inits2(precision, w->size, w->near, w->far, w->best, (mpfr_ptr)NULL);
    for (int i = 0; i < TEMPORARIES; i++) mpfr_init2(w->temporary[i], precision);
}

static void workspace_clear(workspace *w)
{
    for (int i = 0; i < 12; i++) mpfr_clear(w->z[i / 3][i % 3]);
    for (int k = 0; k < 3; k++) mpfr_clears(w->n[k], w->a[k], w->b[k], (mpfr_ptr)NULL);
    mpfr_clears(w->size, w->near, w->far, w->best, (mpfr_ptr)NULL);
    for (int i = 0; i < TEMPORARIES; i++) mpfr_clear(w->temporary[i]);
}

/* most := max(most, |x|). */
static void raise_to(mpfr_t most, const mpfr_t x)
{
    if (mpfr_cmpabs(x, most) > 0) mpfr_abs(most, x, MPFR_RNDN);
}

/* (1) positions relative to node 0, which stands still: (x_i - x_0) + t (p_i - p_0); size as in (2). */
static void set_positions(workspace *w, const cipc_stencil_path *path, double t)
{
    mpfr_ptr q = w->temporary[0], r = w->temporary[1], most_y = w->temporary[2], most_q = w->temporary[3], most_r = w->temporary[4];
    mpfr_set_zero(most_y, 1);
    mpfr_set_zero(most_q, 1);
    mpfr_set_zero(most_r, 1);
    for (int i = 0; i < 3 * w->nodes; i++) {
        mpfr_ptr z = w->z[i / 3][i % 3];
        for (int node = 0; node < 2; node++) { /* node 0: q := p_0; then r := p_i */
            int j = node ? i : i % 3;
            mpfr_ptr p = node ? r : q;
            mpfr_set_d(p, path->p[j], MPFR_RNDN);
            if (path->to_end) mpfr_sub_d(p, p, path->x[j], MPFR_RNDN);
            raise_to(most_r, p);
        }
        mpfr_sub(q, r, q, MPFR_RNDN);
        raise_to(most_q, q);
        mpfr_set_d(z, path->x[i], MPFR_RNDN);
        mpfr_sub_d(z, z, path->x[i % 3], MPFR_RNDN);
        raise_to(most_y, z);
        mpfr_mul_d(q, q, t, MPFR_RNDN);
        mpfr_add(z, z, q, MPFR_RNDN);
    }
    mpfr_add(w->size, most_y, most_q, MPFR_RNDU);
    mpfr_add(w->size, w->size, most_r, MPFR_RNDU);
}

static void subtract(workspace *w, mpfr_t r[3], int i, int j)
{
    for (int k = 0; k < 3; k++) mpfr_sub(r[k], w->z[i][k], w->z[j][k], MPFR_RNDN);
}

static void dot(workspace *w, mpfr_t r, mpfr_t a[3], mpfr_t b[3])
{
    mpfr_ptr term = w->temporary[9];
    mpfr_mul(r, a[0], b[0], MPFR_RNDN);
    for (int k = 1; k < 3; k++) {
        mpfr_mul(term, a[k], b[k], MPFR_RNDN);
        mpfr_add(r, r, term, MPFR_RNDN);
    }
}

/* r := a x b; r is neither. */
static void cross(workspace *w, mpfr_t r[3], mpfr_t a[3], mpfr_t b[3])
{
    mpfr_ptr term = w->temporary[9];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mpfr_mul(r[k], a[i], b[j], MPFR_RNDN);
        mpfr_mul(term, a[j], b[i], MPFR_RNDN);
        mpfr_sub(r[k], r[k], term, MPFR_RNDN);
    }
}

/* The normal of a feature, up to its sign. */
static void set_normal(workspace *w, const cipc_feature *feature)
{
    const int *x = feature->local;
    mpfr_t m[3];
    switch (feature->kind) {
    case CIPC_POINT_POINT: subtract(w, w->n, x[0], x[1]); break;
    case CIPC_POINT_EDGE:
        for (int k = 0; k < 3; k++) mpfr_init2(m[k], w->precision);
        subtract(w, w->a, x[0], x[1]);
        subtract(w, w->b, x[2], x[1]);
        cross(w, m, w->a, w->b);
        cross(w, w->n, w->b, m);
        for (int k = 0; k < 3; k++) mpfr_clear(m[k]);
        break;
    case CIPC_POINT_TRIANGLE:
        subtract(w, w->a, x[2], x[1]);
        subtract(w, w->b, x[3], x[1]);
        cross(w, w->n, w->a, w->b);
        break;
    default:
        subtract(w, w->a, x[1], x[0]);
        subtract(w, w->b, x[3], x[2]);
        cross(w, w->n, w->a, w->b);
        break;
    }
}

/* near := the larger of (min first - max second) and (min second - max first) along n: n may point either way. */
static void set_separation(workspace *w)
{
    mpfr_ptr value = w->temporary[0], lo[2] = {w->temporary[1], w->temporary[2]}, hi[2] = {w->temporary[3], w->temporary[4]};
    for (int i = 0; i < w->nodes; i++) {
        int side = i >= w->first;
        dot(w, value, w->n, w->z[i]);
        bool fresh = i == 0 || i == w->first;
        if (fresh || mpfr_less_p(value, lo[side])) mpfr_set(lo[side], value, MPFR_RNDN);
        if (fresh || mpfr_greater_p(value, hi[side])) mpfr_set(hi[side], value, MPFR_RNDN);
    }
    mpfr_sub(w->near, lo[0], hi[1], MPFR_RNDN);
    mpfr_sub(w->far, lo[1], hi[0], MPFR_RNDN);
    if (mpfr_greater_p(w->far, w->near)) mpfr_set(w->near, w->far, MPFR_RNDN);
}

/* Is the separation, known exactly, more than xi: sep > 0 and sep^2 > xi^2 |n|^2? *known: the answer came without rounding. */
static bool exceeds_exactly(workspace *w, double xi, bool *known)
{
    mpfr_ptr norm2 = w->temporary[0], square = w->temporary[1];
    if (mpfr_sgn(w->near) <= 0) return false;
    mpfr_clear_inexflag();
    dot(w, norm2, w->n, w->n);
    mpfr_mul_d(norm2, norm2, xi, MPFR_RNDN);
    mpfr_mul_d(norm2, norm2, xi, MPFR_RNDN);
    mpfr_sqr(square, w->near, MPFR_RNDN);
    *known = *known && !mpfr_inexflag_p();
    return mpfr_greater_p(square, norm2) != 0;
}

/* |n| rounded up: squares are positive, so every step may be. */
static void length_above(workspace *w, mpfr_t length)
{
    mpfr_ptr square = w->temporary[9];
    mpfr_sqr(length, w->n[0], MPFR_RNDU);
    for (int k = 1; k < 3; k++) {
        mpfr_sqr(square, w->n[k], MPFR_RNDU);
        mpfr_add(length, length, square, MPFR_RNDU);
    }
    mpfr_sqrt(length, length, MPFR_RNDU);
}

/* (5) 16 u |n|_1 S, rounded up. */
static void separation_error(workspace *w, mpfr_t error)
{
    mpfr_ptr part = w->temporary[9];
    mpfr_set_zero(error, 1);
    for (int k = 0; k < 3; k++) {
        mpfr_abs(part, w->n[k], MPFR_RNDU);
        mpfr_add(error, error, part, MPFR_RNDU);
    }
    mpfr_mul(error, error, w->size, MPFR_RNDU);
    mpfr_mul_2si(error, error, SEPARATION_ERROR_BITS - (long)w->precision, MPFR_RNDU);
}

/* Offer the bound along the normal of a feature: (sep - error) / |n| - xi, rounded down, with error = 0 if sep is exact. */
static void offer(workspace *w, const cipc_feature *feature, double xi)
{
    mpfr_ptr error = w->temporary[5], length = w->temporary[6], value = w->temporary[7];
    mpfr_clear_inexflag();
    set_normal(w, feature);
    set_separation(w);
    bool known = w->positions_exact && !mpfr_inexflag_p();
    mpfr_set_zero(error, 1);
    if (!known) separation_error(w, error);
    w->clear = (exceeds_exactly(w, xi, &known) && known) || w->clear;
    w->exact = w->exact && known;
    mpfr_sub(value, w->near, error, MPFR_RNDD);
    if (mpfr_sgn(value) <= 0) return;
    length_above(w, length);
    mpfr_div(value, value, length, MPFR_RNDD);
    mpfr_sub_d(value, value, xi, MPFR_RNDD);
    if (!w->any || mpfr_greater_p(value, w->best)) mpfr_set(w->best, value, MPFR_RNDD);
    w->any = true;
}

/* One precision. The bound is accepted when it is positive and rounding - 2^8 units of the stencil's size, far more than any of the steps - is less than 2^-10 of
 * it; or when everything was exact, but for the last quotient. */
static contact_decision decide(workspace *w, const cipc_stencil_path *path, double xi, double t, double *lower)
{
    mpfr_clear_inexflag();
    set_positions(w, path, t);
    w->positions_exact = !mpfr_inexflag_p();
    for (int f = 0; f < cipc_feature_count(path->kind); f++) {
        cipc_feature feature = cipc_feature_at(path->kind, f);
        offer(w, &feature, xi);
    }
    if (w->exact && !w->clear) return CONTACT_CLOSE;
    if (!w->any || mpfr_sgn(w->best) <= 0) return CONTACT_UNKNOWN;
    mpfr_ptr slack = w->temporary[0];
    mpfr_mul_2si(slack, w->size, 18 - (long)w->precision, MPFR_RNDU);
    if (mpfr_cmp(slack, w->best) > 0) return CONTACT_UNKNOWN;
    *lower = mpfr_get_d(w->best, MPFR_RNDD);
    return *lower > 0 ? CONTACT_CLEAR : CONTACT_UNKNOWN;
}

contact_decision contact_gap_mpfr(const cipc_stencil_path *path, double xi, double t, double *lower, int *precision)
{
    contact_decision decision = CONTACT_UNKNOWN;
    for (int bits = FIRST_PRECISION; bits <= LAST_PRECISION && decision == CONTACT_UNKNOWN; bits *= 2) {
        workspace w;
        workspace_init(&w, bits, path->kind);
        decision = decide(&w, path, xi, t, lower);
        workspace_clear(&w);
        *precision = bits;
    }
    return decision;
}
