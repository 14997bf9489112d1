/* Collision response: the way of a substep is cut by bisection, and goes on along the surface (SPEC B.6). */
#include "massspring/stepper.h"

#include <math.h>

#include "base/vector.h"

typedef struct free_way {
    double way[3]; /* m: what is left of it */
    double part;   /* of the way asked for */
    int collider;  /* that ends it; -1: none */
    bool looked;   /* bisection had to look */
} free_way;

static bool cut_at(cipc_massspring *s, int node, int collider, const double x[3], free_way *f)
{
    if (massspring_is_clear(s, node, collider, x, v3_norm(f->way))) return false;
    const cipc_bisection_result r = cipc_bisection(s->options.bisection, &s->colliders[collider], x, f->way, s->options.threshold);
    s->report.iterations += r.iterations;
    if (!r.hit) return false;
    v3_scale(f->way, r.t, f->way);
    f->part *= r.t;
    f->collider = collider;
    f->looked = f->looked || r.iterations > 0;
    return true;
}

/* The part of the way d from x after which the node is outside of all bodies. Of a way only the end is looked at; so what one body leaves of it has an end that has to be looked at again, for the others. */
static free_way free_of_bodies(cipc_massspring *s, int node, const double x[3], const double d[3])
{
    free_way f = {.part = 1, .collider = -1};
    v3_copy(f.way, d);
    for (bool cut = true; cut && f.part > 0;) {
        cut = false;
        for (int c = 0; c < s->collider_count && f.part > 0; c++) cut |= cut_at(s, node, c, x, &f);
    }
    return f;
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
    v3_scale(way, rest, d);
    take_inward(way, normal);
    const free_way f = free_of_bodies(s, node, x, way);
    v3_add(x, x, f.way);
}

void massspring_respond(cipc_massspring *s, int node, double x[3], double v[3])
{
    double d[3], normal[3];
    v3_scale(d, s->h, v);
    const free_way f = free_of_bodies(s, node, x, d);
    v3_add(x, x, f.way);
    if (f.collider < 0) return;
    s->report.hits++;
    s->report.arrivals += f.looked;
    cipc_collider_distance(&s->colliders[f.collider], x, normal);
    s->contacts[node].impulse += s->model->mass[node] * take_inward(v, normal);
    slide_on(s, node, x, d, 1 - f.part, normal);
}

/* Bodies that overlap push a node from one into the other, nearer and nearer to where they meet: so many turns, and what is then still inside stays. */
enum { TURNS = 100 };

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
