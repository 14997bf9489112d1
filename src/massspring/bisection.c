/* How far a node may go on its way before it is inside a body: plain and improved bisection (SPEC B.6; docs/theory/massspring_collision.md, section 2). */
#include "base/vector.h"
#include "cipc/massspring.h"

/* How many iterations beyond those of plain bisection in its worst case the improved one may take, (8). */
static const int spare_iterations = 5;

/* Outside at `low`, inside at `high`. The values are those of the distance less half the threshold, but for what the Illinois rule has halved. */
typedef struct bracket {
    double low, high, low_value, high_value;
    int last; /* the end that the last step has moved: -1 low, 1 high, 0 neither */
} bracket;

static double distance_at(const cipc_collider *collider, const double x[3], const double d[3], double t)
{
    double at[3];
    v3_copy(at, x);
    v3_axpy(at, t, d);
    return cipc_collider_distance(collider, at, NULL);
}

/* (6), the Illinois rule (7): an end that stays for the second time counts half. */
static void narrow(bracket *b, double t, double distance, double aim)
{
    const int moved = distance >= 0 ? -1 : 1;
    if (moved < 0) b->low = t, b->low_value = distance - aim;
    else b->high = t, b->high_value = distance - aim;
    if (moved < 0 && b->last < 0) b->high_value *= 0.5;
    if (moved > 0 && b->last > 0) b->low_value *= 0.5;
    b->last = moved;
}

static double midpoint(const bracket *b) { return 0.5 * (b->low + b->high); }

/* (6), kept where the bracket will be at most `allowed` long whatever end is moved (8). */
static double interpolated(const bracket *b, int iterations)
{
    const double allowed = ldexp(1, spare_iterations - 1 - iterations);
    const double t = b->low + (b->high - b->low) * (b->low_value / (b->low_value - b->high_value));
    const double kept = fmax(b->high - allowed, fmin(t, b->low + allowed));
    return kept > b->low && kept < b->high ? kept : midpoint(b);
}

cipc_bisection_result cipc_bisection(cipc_bisection_method method, const cipc_collider *collider, const double x[3], const double d[3], double threshold)
{
    const double aim = 0.5 * threshold, start = distance_at(collider, x, d, 0), end = distance_at(collider, x, d, 1);
    if (!(end < 0)) return (cipc_bisection_result){.hit = false, .t = 1, .distance = end};
    cipc_bisection_result r = {.hit = true, .t = 0, .distance = start};
    bracket b = {.low = 0, .high = 1, .low_value = start - aim, .high_value = end - aim};
    while (!(r.distance < threshold)) {
        const double t = method == CIPC_BISECTION_IMPROVED ? interpolated(&b, r.iterations) : midpoint(&b);
        if (!(t > b.low && t < b.high)) break; /* no number is left in between: the threshold is finer than numbers here */
        const double distance = distance_at(collider, x, d, t);
        r.iterations++;
        if (distance >= 0) r.t = t, r.distance = distance;
        narrow(&b, t, distance, aim);
    }
    return r;
}
