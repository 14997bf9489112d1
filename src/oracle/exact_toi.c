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
    double begin, end; /* the times of s = 0 and s = 1 */
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

/* The largest double <= begin + s (end - begin), or the least one >= it (up), for s = numerator / 2^bits. Nothing is rounded before: any sum of two doubles has at
 * most DOUBLE_SPAN bits. */
enum { DOUBLE_SPAN = 2200 };
static double time_of(const inquiry *q, const mpz_t numerator, unsigned long bits, bool up)
{
    mpfr_t t, s;
    mpfr_prec_t span = q->begin == 0 ? 64 : 2 * DOUBLE_SPAN + (mpfr_prec_t)bits;
    mpfr_inits2(span + (mpfr_prec_t)mpz_sizeinbase(numerator, 2), t, s, (mpfr_ptr)NULL);
    mpfr_set_d(t, q->end, MPFR_RNDN);
    mpfr_sub_d(t, t, q->begin, MPFR_RNDN);
    mpfr_set_z_2exp(s, numerator, -(mpfr_exp_t)bits, MPFR_RNDN);
    mpfr_mul(t, t, s, MPFR_RNDN);
    mpfr_add_d(t, t, q->begin, MPFR_RNDN);
    double result = mpfr_get_d(t, up ? MPFR_RNDU : MPFR_RNDD);
    mpfr_clears(t, s, (mpfr_ptr)NULL);
    return result;
}

/* Do both ends round to neighbouring doubles? Then narrowing the interval further tells nothing; nor does it, once the interval is very narrow, if there is one
 * double between them: an interval around a time that is a double itself rounds like that however narrow it is, where s is not dyadic. */
static bool is_sharp(const inquiry *q, const cluster *c, bool narrow)
{
    double lo = time_of(q, c->left, c->left_bits, false), hi = time_of(q, c->right, c->right_bits, true), next = nextafter(lo, INFINITY);
    return hi <= next || (narrow && hi <= nextafter(next, INFINITY));
}

/* Is the distance xi exactly at a time that is a double: at s = (t - begin)/(end - begin)? */
static bool meets_at(inquiry *q, double t)
{
    const double times[3] = {q->begin, q->end, t};
    mpz_t s[3];
    int unit = cipc_common_exponent(times, 3, 0);
    for (int i = 0; i < 3; i++) {
        mpz_init(s[i]);
        cipc_integer_from_double(s[i], times[i], unit);
    }
    mpz_sub(s[2], s[2], s[0]);
    mpz_sub(s[1], s[1], s[0]);
    int sign = oracle_path_compare_at_ratio(&q->path, q->xi, s[2], s[1]);
    for (int i = 0; i < 3; i++) mpz_clear(s[i]);
    return sign == 0;
}

/* The cluster's times as doubles: the one between the ends, if there is one and it is the time. */
static cipc_exact_impact impact_of(inquiry *q, const cluster *c)
{
    cipc_exact_impact impact = {CIPC_YES, time_of(q, c->left, c->left_bits, false), time_of(q, c->right, c->right_bits, true)};
    double between = nextafter(impact.lo, INFINITY);
    if (between < impact.hi && nextafter(between, INFINITY) == impact.hi && meets_at(q, between)) impact.lo = impact.hi = between;
    return impact;
}

/* Is the cluster beginning with event `first` an impact? Its intervals are narrowed until that is decided and, for a crossing whose time is wanted, known to
 * neighbouring doubles. *next: the first event after the cluster. A touch that the last width leaves open counts as one. */
static bool is_impact(inquiry *q, int first, bool want_time, cluster *c, int *next)
{
    for (unsigned long bits = FIRST_BITS;; bits += FIRST_BITS) {
        *next = gather(q, first, c);
        bool point = compare_dyadic(c->left, c->left_bits, c->right, c->right_bits) == 0;
        if (sign_after(q, c, *next) <= 0) {
            if (!want_time || point || is_sharp(q, c, bits > LAST_BITS + FIRST_BITS)) return true;
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
        if (is_impact(q, first, want_time, &c, &next)) result = impact_of(q, &c);
    }
    mpz_clears(c.left, c.right, NULL);
    return result;
}

/* The path of the inquiry is there. */
static cipc_exact_impact answer(inquiry *q, bool want_time)
{
    cipc_exact_impact result = {CIPC_INDETERMINATE, NAN, NAN};
    mpz_t start;
    mpz_init(start);
    if (oracle_path_compare_at(&q->path, q->xi, start, 0) <= 0) {
        result = (cipc_exact_impact){CIPC_YES, q->begin, q->begin};
    } else {
        find_events(q);
        sort_events(q);
        if (!q->capped) result = first_impact(q, want_time);
    }
    mpz_clear(start);
    for (int i = 0; i < q->count; i++) oracle_root_clear(&q->event[i]);
    return result;
}

static cipc_exact_impact ask(const cipc_stencil_path *motion, double xi, double t_max, bool want_time)
{
    cipc_exact_impact result = {CIPC_INDETERMINATE, NAN, NAN};
    inquiry q = {.begin = 0, .end = t_max};
    mpz_init(q.xi);
    if (oracle_path_init(&q.path, motion, xi, t_max, q.xi)) result = answer(&q, want_time);
    oracle_path_clear(&q.path);
    mpz_clear(q.xi);
    return result;
}

cipc_exact_impact cipc_exact_piece_toi(const cipc_stencil_piece *piece, double xi)
{
    cipc_exact_impact result = {CIPC_INDETERMINATE, NAN, NAN};
    inquiry q = {.begin = piece->begin, .end = piece->end};
    mpz_init(q.xi);
    if (oracle_path_init_piece(&q.path, piece, xi, q.xi)) result = answer(&q, true);
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
