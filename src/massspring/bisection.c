/* How far a node may go on its way before it is inside a body: plain and improved bisection (SPEC B.6; docs/theory/massspring_collision.md, section 2). */
#include "base/vector.h"
#include "cipc/massspring.h"

/* (8): so many interpolations in a row may do worse than midpoints would have; then come midpoints, each time so many times as many. */
enum { MOST_TRIED = 3, GROWTH = 3 };

/* Outside at `low`, inside at `high`. */
typedef struct bracket {
    double low, high;
    double low_value, high_value;   /* distance less half the threshold: > 0, < 0 */
    double low_weight, high_weight; /* what the Illinois rule has left of them */
    int last;                       /* the end that the last interpolation has moved: -1 low, 1 high, 0 neither */
    int midpoints, next_midpoints;  /* still to be taken; how many it will be the next time */
    int tried;                      /* interpolations since the bracket was `length` long */
    double length;
} bracket;

static double distance_at(const cipc_collider *collider, const double x[3], const double d[3], double t)
{
    double at[3];
    v3_copy(at, x);
    v3_axpy(at, t, d);
    return cipc_collider_distance(collider, at, NULL);
}

/* The Illinois rule (7): an end that stays for the second time counts half. */
static void narrow(bracket *b, double t, double distance, double aim)
{
    const int moved = distance >= 0 ? -1 : 1;
    if (moved < 0) b->low = t, b->low_value = distance - aim, b->low_weight = 1;
    else b->high = t, b->high_value = distance - aim, b->high_weight = 1;
    if (moved < 0 && b->last < 0) b->high_weight *= 0.5;
    if (moved > 0 && b->last > 0) b->low_weight *= 0.5;
    b->last = moved;
}

static void begin_anew(bracket *b)
{
    b->tried = 0;
    b->length = b->high - b->low;
}

static void after_midpoint(bracket *b)
{
    b->midpoints--;
    b->low_weight = b->high_weight = 1;
    b->last = 0;
    begin_anew(b);
}

/* (8). */
static void after_interpolation(bracket *b)
{
    b->tried++;
    if (b->high - b->low <= ldexp(b->length, -b->tried)) {
        begin_anew(b);
    } else if (b->tried == MOST_TRIED) {
        b->midpoints = b->next_midpoints;
        b->next_midpoints *= GROWTH;
    }
}

static double midpoint(const bracket *b) { return 0.5 * (b->low + b->high); }

/* (6). */
static double interpolated(const bracket *b)
{
    const double f = b->low_weight * b->low_value, g = b->high_weight * b->high_value, t = b->low + (b->high - b->low) * (f / (f - g));
    return t > b->low && t < b->high ? t : midpoint(b);
}

cipc_bisection_result cipc_bisection(cipc_bisection_method method, const cipc_collider *collider, const double x[3], const double d[3], double threshold)
{
    const double aim = 0.5 * threshold, start = distance_at(collider, x, d, 0), end = distance_at(collider, x, d, 1);
    if (!(end < 0)) return (cipc_bisection_result){.hit = false, .t = 1, .distance = end};
    cipc_bisection_result r = {.hit = true, .t = 0, .distance = start};
    bracket b = {.high = 1, .low_value = start - aim, .high_value = end - aim, .low_weight = 1, .high_weight = 1, .next_midpoints = 1, .length = 1};
    while (!(r.distance < threshold)) {
        const bool halve = method == CIPC_BISECTION_PLAIN || b.midpoints > 0;
        const double t = halve ? midpoint(&b) : interpolated(&b);
        if (!(t > b.low && t < b.high)) break; /* no number is left in between: the threshold is finer than numbers here */
        const double distance = distance_at(collider, x, d, t);
        r.iterations++;
        if (distance >= 0) r.t = t, r.distance = distance;
        narrow(&b, t, distance, aim);
        if (method == CIPC_BISECTION_IMPROVED) (halve ? after_midpoint : after_interpolation)(&b);
    }
    return r;
}
