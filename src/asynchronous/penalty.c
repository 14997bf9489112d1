/* A tick of one penalty layer of one pair (SPEC A.4, A.7, A.8; docs/theory/asynchronous.md (4), (7), (8)). */
#include "asynchronous/integrator.h"

/* Velocity of the first closest point relative to the second. */
static void relative_velocity(const cipc_asynchronous *a, const asynchronous_pair *pair, const double *c, double v[3])
{
    for (int k = 0; k < 3; k++) v[k] = 0;
    for (int i = 0; i < pair->node_count; i++) v3_axpy(v, c[i], a->nodes[pair->nodes[i]].v);
}

/* w = sum c_i^2 / m_i, the inverse of the mass that the two points show each other. */
static double inverse_effective_mass(const cipc_asynchronous *a, const asynchronous_pair *pair, const double *c)
{
    double w = 0;
    for (int i = 0; i < pair->node_count; i++) w += c[i] * c[i] * a->nodes[pair->nodes[i]].inverse_mass;
    return w;
}

/* Friction, a reconstruction [R]: against the tangential velocity, at most mu times the normal impulse and at most what stops the sliding. */
static void add_friction(const cipc_asynchronous *a, const asynchronous_pair *pair, const asynchronous_closest *closest, const double *v, double normal_impulse, double impulse[3])
{
    double tangential[3];
    const double w = inverse_effective_mass(a, pair, closest->c), along = v3_dot(v, closest->n);
    for (int k = 0; k < 3; k++) tangential[k] = v[k] - along * closest->n[k];
    const double speed = v3_norm(tangential);
    if (!(speed > 0) || !(w > 0)) return;
    v3_axpy(impulse, -fmin(pair->friction * normal_impulse, speed / w) / speed, tangential);
}

static void apply(cipc_asynchronous *a, const asynchronous_pair *pair, const double *x, const double *c, const double impulse[3])
{
    for (int i = 0; i < pair->node_count; i++) {
        const double inverse_mass = a->nodes[pair->nodes[i]].inverse_mass;
        double dv[3];
        if (c[i] == 0 || !(inverse_mass > 0)) continue;
        v3_scale(dv, c[i] * inverse_mass, impulse);
        asynchronous_kick(a, pair->nodes[i], x + 3 * i, dv);
    }
}

static void strike(cipc_asynchronous *a, const asynchronous_pair *pair, int layer, double h, double depth, const asynchronous_closest *closest, const double *x)
{
    double v[3], impulse[3];
    relative_velocity(a, pair, closest->c, v);
    const double e = v3_dot(v, closest->n) > 0 ? a->options.restitution : 1; /* softer while separating: e^2 r gives back e v (F3) */
    const double normal_impulse = h * (e * e * cipc_layer_stiffness(a->options.stiffness, layer)) * depth;
    v3_scale(impulse, normal_impulse, closest->n);
    if (pair->friction > 0) add_friction(a, pair, closest, v, normal_impulse, impulse);
    apply(a, pair, x, closest->c, impulse);
    a->report.events[CIPC_EVENT_PENALTY]++;
    a->report.smallest_step = fmin(a->report.smallest_step, h);
}

/* The deepest layer may go to rest when it is out of reach; that its points also separate spares it from coming back at once (SPEC A.7). With it go all others that are out of reach: were each
 * to wait until it is the deepest and ticks, an impact of n layers would end in n^2/10 idle ticks. */
static bool may_rest(const cipc_asynchronous *a, const asynchronous_pair *pair, int layer, const asynchronous_closest *closest)
{
    double v[3];
    if (layer != pair->layers || a->options.always_layers > 0) return false;
    relative_velocity(a, pair, closest->c, v);
    return v3_dot(v, closest->n) > 0;
}

static void next_tick(cipc_asynchronous *a, asynchronous_pair *pair, int layer, double h)
{
    asynchronous_layer *clock = &pair->layer[layer - 1];
    clock->k = asynchronous_tick_after(a->options.mirror, clock->k);
    asynchronous_queue_schedule(&a->queue, clock->event, asynchronous_tick_time(a->options.mirror, h, clock->k));
}

void asynchronous_penalty_tick(cipc_asynchronous *a, int number, int layer)
{
    asynchronous_pair *pair = &a->pairs.pair[number];
    const double h = pair->first_step * a->layer_rate[layer], eta = a->options.thickness * a->eta[layer];
    double x[12];
    asynchronous_gather(a, pair->nodes, pair->node_count, x);
    const asynchronous_closest closest = asynchronous_closest_points(pair->kind, x);
    const double gap = closest.distance - pair->offset;
    a->report.min_gap = fmin(a->report.min_gap, gap);
    if (!(gap > 0)) {
        asynchronous_fail(a, CIPC_E_NO_PROGRESS, "the gap of a pair in contact is %.3g m: rounding has overtaken the layers", gap);
    } else if (a->options.always_layers > 0 && layer == pair->layers && gap < a->options.thickness * a->eta[layer + 1]) {
        asynchronous_fail(a, CIPC_E_NO_PROGRESS, "always_layers = %d are not enough at a gap of %.3g m", layer, gap);
    } else if (gap < eta) {
        strike(a, pair, layer, h, eta - gap, &closest, x);
        next_tick(a, pair, layer, h);
    } else if (may_rest(a, pair, layer, &closest)) {
        while (pair->layers > 0 && !(gap < a->options.thickness * a->eta[pair->layers])) asynchronous_pair_deactivate(a, number);
        asynchronous_pair_certify(a, number);
        a->report.events[CIPC_EVENT_IDLE]++;
    } else {
        next_tick(a, pair, layer, h);
        a->report.events[CIPC_EVENT_IDLE]++;
    }
}
