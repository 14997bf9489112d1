/* Exact time of impact of a stencil in straight motion (SPEC V.3; docs/theory/oracle_impact.md).
 *
 * While the distance is not xi its sign against xi cannot change, and whenever it is xi the distance of some feature pair's flats is xi too. So the roots in s of
 *   G = (squared distance of flats - xi^2) * denominator
 * of all feature pairs cut [0, 1] into pieces on each of which d > xi or d < xi throughout: one exact distance in a piece decides it. What is left are touches
 * at the roots themselves, where d > xi on both sides: decided by the distance near the root, which changes by at most `speed` times the width of its interval. */
#include "cipc/oracle.h"

#include <math.h>
#include <mpfr.h>

#include "oracle/path.h"

/* Roots are isolated first, then narrowed in steps of FIRST_BITS as far as a question is open, for a touch to a width of 2^-LAST_BITS (SPEC V.3). */
enum { FIRST_BITS = 64, LAST_BITS = 200 };
enum { EVENT_LIMIT = CIPC_FEATURE_LIMIT * 6 };

/* G of a feature: square - xi^2 norm2, or height^2 - xi^2 norm2; for xi = 0 the height alone. */
static void contact_polynomial(const oracle_path *path, const cipc_feature *feature, const mpz_t xi2, oracle_polynomial *g)
{
    oracle_flat_distance d;
    oracle_polynomial term;
    oracle_flat_distance_init(&d);
    oracle_polynomial_init(&term);
    oracle_path_flat_distance(path, feature, &d);
    if (d.has_height && mpz_sgn(xi2) == 0) {
        oracle_polynomial_set(g, &d.height);
    } else {
        if (d.has_height) oracle_polynomial_mul(&d.square, &d.height, &d.height);
        oracle_polynomial_scale(&term, &d.norm2, xi2);
        oracle_polynomial_sub(g, &d.square, &term);
    }
    oracle_polynomial_clear(&term);
    oracle_flat_distance_clear(&d);
}

/* The question, its events (roots of all G, in no order), and what it takes to answer. */
typedef struct inquiry {
    oracle_path path;
    mpz_t xi;
    double t_max;
    int count;
    oracle_root event[EVENT_LIMIT];
    oracle_root *order[EVENT_LIMIT]; /* ascending */
    bool capped;
} inquiry;

static void find_events(inquiry *q)
{
    oracle_polynomial g;
    oracle_root root[ORACLE_ROOT_LIMIT];
    mpz_t xi2;
    mpz_init(xi2);
    oracle_polynomial_init(&g);
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_init(&root[i]);
    mpz_mul(xi2, q->xi, q->xi);
    for (int f = 0; f < cipc_feature_count(q->path.kind); f++) {
        cipc_feature feature = cipc_feature_at(q->path.kind, f);
        contact_polynomial(&q->path, &feature, xi2, &g);
        int found = oracle_polynomial_roots(&g, root);
        q->capped = q->capped || found < 0;
        for (int i = 0; i < found; i++) {
            oracle_root *event = &q->event[q->count];
            oracle_root_init(event);
            oracle_root swap = *event;
            *event = root[i];
            root[i] = swap;
            q->order[q->count++] = event;
        }
    }
    for (int i = 0; i < ORACLE_ROOT_LIMIT; i++) oracle_root_clear(&root[i]);
    oracle_polynomial_clear(&g);
    mpz_clear(xi2);
}

/* a / 2^i against b / 2^j. */
static int compare_dyadic(const mpz_t a, unsigned long i, const mpz_t b, unsigned long j)
{
    mpz_t scaled;
    mpz_init(scaled);
    int order;
    if (i < j) {
        mpz_mul_2exp(scaled, a, j - i);
        order = mpz_cmp(scaled, b);
    } else {
        mpz_mul_2exp(scaled, b, i - j);
        order = mpz_cmp(a, scaled);
    }
    mpz_clear(scaled);
    return order;
}

/* The right end of an event's interval: numerator or numerator + 1, over 2^bits. */
static void right_end(const oracle_root *event, mpz_t end)
{
    mpz_set(end, event->numerator);
    if (!event->exact) mpz_add_ui(end, end, 1);
}

static void sort_events(inquiry *q)
{
    for (int i = 1; i < q->count; i++) {
        oracle_root *event = q->order[i];
        int j = i;
        for (; j > 0 && compare_dyadic(event->numerator, event->bits, q->order[j - 1]->numerator, q->order[j - 1]->bits) < 0; j--) q->order[j] = q->order[j - 1];
        q->order[j] = event;
    }
}

/* One or more events whose intervals meet, as one interval [left / 2^left_bits, right / 2^right_bits]. */
typedef struct cluster {
    mpz_t left, right;
    unsigned long left_bits, right_bits;
} cluster;

/* The cluster that begins with event `first`. Returns the first event after it. */
static int gather(const inquiry *q, int first, cluster *c)
{
    mpz_t end;
    mpz_init(end);
    mpz_set(c->left, q->order[first]->numerator);
    c->left_bits = q->order[first]->bits;
    right_end(q->order[first], c->right);
    c->right_bits = c->left_bits;
    int next = first + 1;
    for (; next < q->count && compare_dyadic(q->order[next]->numerator, q->order[next]->bits, c->right, c->right_bits) <= 0; next++) {
        right_end(q->order[next], end);
        if (compare_dyadic(end, q->order[next]->bits, c->right, c->right_bits) > 0) {
            mpz_set(c->right, end);
            c->right_bits = q->order[next]->bits;
        }
    }
    mpz_clear(end);
    return next;
}

/* Sign of d - xi at a place between the cluster and the next event, or at s = 1; the place lies in the open piece behind the cluster. */
static int sign_after(inquiry *q, const cluster *c, int next)
{
    mpz_t place, other;
    mpz_inits(place, other, NULL);
    unsigned long bits = c->right_bits;
    mpz_set(place, c->right);
    if (next < q->count) {
        const oracle_root *event = q->order[next];
        unsigned long common = bits > event->bits ? bits : event->bits;
        mpz_mul_2exp(place, place, common - bits);
        mpz_mul_2exp(other, event->numerator, common - event->bits);
        mpz_add(place, place, other);
        bits = common + 1;
    } else {
        mpz_set_ui(place, 1);
        bits = 0;
    }
    int sign = oracle_path_compare_at(&q->path, q->xi, place, bits);
    mpz_clears(place, other, NULL);
    return sign;
}

/* Is d possibly <= xi somewhere in the cluster? d at its left end less speed times its width: d <= xi + speed w, all in units of 2^-left_bits or finer. An
 * exact event is a point: then the answer is exact. */
static bool may_touch(inquiry *q, const cluster *c)
{
    mpz_t width, bound, place;
    mpz_inits(width, bound, place, NULL);
    unsigned long bits = c->left_bits > c->right_bits ? c->left_bits : c->right_bits;
    mpz_mul_2exp(place, c->left, bits - c->left_bits);
    mpz_mul_2exp(width, c->right, bits - c->right_bits);
    mpz_sub(width, width, place);
    oracle_path_speed(&q->path, bound);
    mpz_mul(bound, bound, width); /* speed w, in the unit of positions at this place */
    mpz_mul_2exp(width, q->xi, bits);
    mpz_add(bound, bound, width);
    oracle_path_search_at(&q->path, place, bits);
    bool may = oracle_search_compare(&q->path.search, bound) <= 0;
    mpz_clears(width, bound, place, NULL);
    return may;
}

static void refine_events(inquiry *q, int first, int last, unsigned long bits)
{
    for (int i = first; i < last; i++) oracle_root_refine(q->order[i], bits);
    sort_events(q);
}

/* The largest double <= s t_max, or the least one >= it (up), for s = numerator / 2^bits. */
static double time_of(const inquiry *q, const mpz_t numerator, unsigned long bits, bool up)
{
    mpfr_t t, s;
    mpfr_inits2(64 + (mpfr_prec_t)mpz_sizeinbase(numerator, 2), t, s, (mpfr_ptr)NULL); /* products are exact */
    mpfr_set_z_2exp(s, numerator, -(mpfr_exp_t)bits, MPFR_RNDN);
    mpfr_mul_d(t, s, q->t_max, MPFR_RNDN);
    double result = mpfr_get_d(t, up ? MPFR_RNDU : MPFR_RNDD);
    mpfr_clears(t, s, (mpfr_ptr)NULL);
    return result;
}

/* Do both ends round to neighbouring doubles? Then narrowing the interval further tells nothing. */
static bool is_sharp(const inquiry *q, const cluster *c)
{
    double lo = time_of(q, c->left, c->left_bits, false), hi = time_of(q, c->right, c->right_bits, true);
    return hi <= nextafter(lo, INFINITY);
}

/* Is the cluster beginning with event `first` an impact? Its intervals are narrowed until that is decided and, for a crossing whose time is wanted, known to
 * neighbouring doubles. *next: the first event after the cluster. A touch that the last width leaves open counts as one. */
static bool is_impact(inquiry *q, int first, bool want_time, cluster *c, int *next)
{
    for (unsigned long bits = FIRST_BITS;; bits += FIRST_BITS) {
        *next = gather(q, first, c);
        bool point = compare_dyadic(c->left, c->left_bits, c->right, c->right_bits) == 0;
        if (sign_after(q, c, *next) <= 0) {
            if (!want_time || point || is_sharp(q, c)) return true;
        } else if (!may_touch(q, c)) {
            return false;
        } else if (point || bits > LAST_BITS + FIRST_BITS) {
            return true;
        }
        refine_events(q, first, *next, bits);
    }
}

/* The first cluster that is an impact; d(0) > xi. */
static cipc_exact_impact first_impact(inquiry *q, bool want_time)
{
    cipc_exact_impact result = {CIPC_NO, NAN, NAN};
    cluster c;
    mpz_inits(c.left, c.right, NULL);
    for (int first = 0, next; first < q->count && result.verdict == CIPC_NO; first = next) {
        if (is_impact(q, first, want_time, &c, &next)) {
            result = (cipc_exact_impact){CIPC_YES, time_of(q, c.left, c.left_bits, false), time_of(q, c.right, c.right_bits, true)};
        }
    }
    mpz_clears(c.left, c.right, NULL);
    return result;
}

static cipc_exact_impact ask(const cipc_stencil_path *motion, double xi, double t_max, bool want_time)
{
    cipc_exact_impact result = {CIPC_INDETERMINATE, NAN, NAN};
    inquiry q = {.t_max = t_max};
    mpz_init(q.xi);
    if (oracle_path_init(&q.path, motion, xi, t_max, q.xi)) {
        mpz_t start;
        mpz_init(start);
        if (oracle_path_compare_at(&q.path, q.xi, start, 0) <= 0) {
            result = (cipc_exact_impact){CIPC_YES, 0, 0};
        } else {
            find_events(&q);
            sort_events(&q);
            if (!q.capped) result = first_impact(&q, want_time);
        }
        mpz_clear(start);
    }
    for (int i = 0; i < q.count; i++) oracle_root_clear(&q.event[i]);
    oracle_path_clear(&q.path);
    mpz_clear(q.xi);
    return result;
}

cipc_exact_impact cipc_exact_toi(const cipc_stencil_path *path, double xi, double t_max) { return ask(path, xi, t_max, true); }

cipc_verdict cipc_exact_path_clear(const cipc_stencil_path *path, double xi, double t)
{
    cipc_verdict impact = ask(path, xi, t, false).verdict;
    return impact == CIPC_YES ? CIPC_NO : impact == CIPC_NO ? CIPC_YES : CIPC_INDETERMINATE;
}
