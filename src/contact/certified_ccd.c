/* Certified additive continuous collision detection (SPEC V.4; docs/theory/certified_ccd.md): the algorithm of additive_ccd.c on certified lower bounds of the
 * distance, with times rounded down. What it returns holds for the exact path of the given doubles. */
#include "contact/certified_ccd.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"
#include "contact/separation_bound.h"

/* A bound in doubles is taken as it is when it is at least this share of the gap as computed; below it, rounding has eaten too much, and MPFR is asked. */
static const double GOOD_SHARE = 1 - 0x1p-10;
/* options.refine: go on until the gap is below this share of the target, for at most so many more steps. */
static const double REFINED_SHARE = 0x1p-30;
enum { REFINED_STEPS = 256 };
/* So often MPFR is asked before the march ends where it is: it takes some 10 us each time, and gaps below rounding may ask for millions of steps. */
enum { MOST_ESCALATIONS = 1000 };
/* A step along a fixed direction aims at a little more than the gap at which the march ends, so that rounding does not end it there. */
static const double ALONG_SHARE = 1 + 0x1p-10;

/* A query under way: certified free of contact on [0, t] with a gap of at least `gap` at t. */
typedef struct advance {
    const cipc_stencil_path *path;
    contact_local_path local;
    double xi, t, gap;
    double n[3]; /* separating direction at t; all 0: none in doubles */
    int precision, escalations;
} advance;

/* a - b and a + b >= 0 rounded down. */
static double sum_below(double a, double b)
{
    double s = a + b, part = s - a, error = (a - (s - part)) + (b - part); /* the sum's own rounding error, exactly (Knuth) */
    return error < 0 ? nextafter(s, 0) : s;
}

/* (12) A positive number known to 4 u of itself, or to 3/2 of the least double where it is out of the normal range, made no larger than the exact one. */
static double below(double x) { return x >= 0x1p-1000 ? x * (1 - 0x1p-50) : nextafter(nextafter(nextafter(x, 0), 0), 0); }

/* part * gap / l_p rounded down. The quotient comes first: it may be large where the gap is next to nothing. */
static double time_below(double part, double gap, const contact_local_path *local)
{
    double way = local->speed_unit ? ldexp(gap, -local->speed_unit) : gap;
    return below(part * (way / local->speed));
}

/* Certified gap at time t; in MPFR if doubles do not suffice to say whether it is at least `wanted`. */
static contact_decision gap_at(advance *a, double t, double wanted, double *gap)
{
    contact_gap_bound bound = contact_gap_at(&a->local, a->xi, t);
    v3_copy(a->n, bound.n);
    *gap = bound.lower;
    if (bound.lower > 0 && (bound.lower >= GOOD_SHARE * bound.estimate || (wanted > 0 && bound.lower >= wanted))) return CONTACT_CLEAR;
    if (t == 0 && contact_surely_close(&a->local, a->xi)) return CONTACT_CLOSE;
    v3_scale(a->n, 0, a->n);
    a->escalations++;
    return contact_gap_mpfr(a->path, a->xi, t, gap, &a->precision);
}

/* (10) Do the boxes of the two primitives, swept over [0, t_max] and grown by xi, stay apart? */
static bool boxes_apart(const contact_local_path *local, double xi, double t_max)
{
    double slack = xi * (1 + 0x1p-50) + 0x1p-48 * local->size + DBL_MIN;
    for (int k = 0; k < 3; k++) {
        double lo[2], hi[2];
        for (int side = 0; side < 2; side++) {
            double least = INFINITY, most = -INFINITY;
            for (int i = side ? local->first : 0; i < (side ? local->nodes : local->first); i++) {
                double from = local->y[3 * i + k], to = from + t_max * local->q[3 * i + k];
                least = min2(least, min2(from, to));
                most = max2(most, max2(from, to));
            }
            lo[side] = least;
            hi[side] = most;
        }
        if (lo[0] - hi[1] > slack || lo[1] - hi[0] > slack) return true;
    }
    return false;
}

/* (11) A direction that separates at t and at a later time by more than xi does so all the time between, because the separation along a fixed direction is a
 * concave function of time. The last time, up to t_max, at which the present direction still leaves a gap of `wanted`; *gap is certified there. 0: none. */
static double separated_until(const advance *a, double t_max, double wanted, double *gap)
{
    if (a->n[0] == 0 && a->n[1] == 0 && a->n[2] == 0) return 0;
    double until = min2(t_max, contact_time_along(&a->local, a->n, a->xi, a->t, wanted));
    if (!(until > a->t)) return 0;
    *gap = contact_gap_along(&a->local, a->n, a->xi, until);
    return *gap > 0 && *gap >= 0.5 * wanted ? until : 0;
}

static cipc_ccd_result end(const advance *a, cipc_ccd_outcome outcome, double toi, int iterations)
{
    return (cipc_ccd_result){.toi = toi, .hit = outcome != CIPC_CCD_FREE, .iterations = iterations, .outcome = outcome, .precision = a->precision};
}

/* From a certified start on: (12)-(15) of docs/theory/certified_ccd.md. */
static cipc_ccd_result march(advance *a, double t_max, double bound, const cipc_ccd_options *options)
{
    double target = options->slackness * a->gap, last = options->refine ? REFINED_SHARE * target : target;
    double stop = -1; /* the last time with a gap of the target or more, once it has been passed */
    int refined = 0, i;
    for (i = 1; i <= options->max_iterations && a->escalations <= MOST_ESCALATIONS; i++) {
        double next = sum_below(a->t, time_below(1 - options->slackness, a->gap, &a->local)), along = 0;
        double floor = below(options->slackness * a->gap); /* (13) what the step leaves at least */
        double whole = options->refine ? sum_below(a->t, time_below(1, a->gap, &a->local)) : next;
        double until = separated_until(a, t_max, ALONG_SHARE * last, &along);
        if (whole > t_max || until == t_max) return end(a, CIPC_CCD_FREE, t_max, i);
        if (until > next) {
            next = until;
            floor = along;
        }
        if (stop < 0 && (a->t > bound || (a->t == 0 && next > bound))) return end(a, CIPC_CCD_FREE, t_max, i); /* whatever is found comes too late */
        if (next <= a->t) return end(a, a->t > 0 ? CIPC_CCD_HIT : CIPC_CCD_INDETERMINATE, stop > 0 ? stop : a->t, i);
        double gap = 0;
        contact_decision decision = gap_at(a, next, last, &gap);
        gap = decision == CONTACT_CLEAR ? max2(gap, floor) : floor;
        if (a->t > 0 && gap < target && stop < 0) stop = a->t;
        if (a->t > 0 && (gap < last || (stop > 0 && ++refined > REFINED_STEPS))) return end(a, CIPC_CCD_HIT, stop, i);
        a->t = next;
        a->gap = gap;
    }
    cipc_ccd_result result = end(a, CIPC_CCD_HIT, stop > 0 ? stop : a->t, i - 1);
    result.capped = true;
    return result;
}

cipc_ccd_result contact_certified_ccd_until(const cipc_stencil_path *path, double xi, double t_max, double bound, const cipc_ccd_options *options)
{
    advance a = {.path = path, .xi = xi, .precision = 53};
    if (!contact_local_path_init(&a.local, path) || !isfinite(xi) || !(t_max >= 0 && t_max <= 1)) return end(&a, CIPC_CCD_INDETERMINATE, 0, 0);
    if (boxes_apart(&a.local, xi, t_max)) return end(&a, CIPC_CCD_FREE, t_max, 0);
    contact_decision start = gap_at(&a, 0, 0, &a.gap);
    if (start == CONTACT_CLOSE) return end(&a, CIPC_CCD_INITIALLY_CLOSE, 0, 0);
    if (start == CONTACT_UNKNOWN) return end(&a, CIPC_CCD_INDETERMINATE, 0, 0);
    if (a.local.speed == 0) return end(&a, CIPC_CCD_FREE, t_max, 0);
    return march(&a, t_max, bound, options);
}

cipc_ccd_result cipc_certified_ccd(const cipc_stencil_path *path, double thickness, double t_max, const cipc_ccd_options *options)
{
    return contact_certified_ccd_until(path, thickness, t_max, t_max, options);
}
