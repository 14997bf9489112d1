/* Collision response: the way of a substep is cut by bisection, and goes on along the surface (SPEC B.6). */
#include "massspring/stepper.h"

#include <math.h>

#include "base/vector.h"

/* The first body in the way of x to x + d. */
static cipc_bisection_result first_hit(cipc_massspring *s, int node, const double x[3], const double d[3], int *collider)
{
    cipc_bisection_result first = {.hit = false, .t = 1};
    const double length = v3_norm(d);
    for (int c = 0; c < s->collider_count; c++) {
        if (massspring_is_clear(s, node, c, x, length)) continue;
        const cipc_bisection_result r = cipc_bisection(s->options.bisection, &s->colliders[c], x, d, s->options.threshold);
        s->report.iterations += r.iterations;
        if (!r.hit || r.t > first.t) continue;
        first = r;
        *collider = c;
    }
    return first;
}

/* Without what points inward; returns that, m/s or m. */
static double take_inward(double v[3], const double normal[3])
{
    const double along = v3_dot(v, normal);
    if (!(along < 0)) return 0;
    v3_axpy(v, -along, normal);
    return -along;
}

/* What is left of the way, along the surface, as far as that is free. */
static void slide_on(cipc_massspring *s, int node, double x[3], const double d[3], double rest, const double normal[3])
{
    double way[3];
    int collider;
    v3_scale(way, rest, d);
    take_inward(way, normal);
    const cipc_bisection_result r = first_hit(s, node, x, way, &collider);
    v3_axpy(x, r.t, way);
}

void massspring_respond(cipc_massspring *s, int node, double x[3], double v[3])
{
    double d[3], normal[3];
    int collider = -1;
    v3_scale(d, s->h, v);
    const cipc_bisection_result hit = first_hit(s, node, x, d, &collider);
    v3_axpy(x, hit.t, d);
    if (!hit.hit) return;
    s->report.hits++;
    s->report.arrivals += hit.iterations > 0;
    cipc_collider_distance(&s->colliders[collider], x, normal);
    s->contacts[node].impulse += s->model->mass[node] * take_inward(v, normal);
    slide_on(s, node, x, d, 1 - hit.t, normal);
}

/* Bodies that overlap push a node from one into the other: so many turns, and what is then still inside stays. */
enum { TURNS = 4 };

bool massspring_leave_bodies(cipc_massspring *s, int node, double x[3], double v[3])
{
    bool inside = true, moved = false;
    for (int turn = 0; turn < TURNS && inside; turn++) {
        inside = false;
        for (int c = 0; c < s->collider_count; c++) {
            double normal[3];
            if (massspring_is_clear(s, node, c, x, 0)) continue;
            const double distance = massspring_look(s, node, c, x, normal);
            if (distance >= 0) continue;
            v3_axpy(x, 0.5 * s->options.threshold - distance, normal);
            const double lost = take_inward(v, normal);
            s->contacts[node].impulse += s->model->mass[node] * lost;
            inside = moved = true;
        }
    }
    return moved;
}
