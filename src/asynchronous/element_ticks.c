/* Ticks of the forces inside bodies, and their damping (SPEC A.2, A.8; docs/theory/asynchronous.md (2), (11)). */
#include "asynchronous/integrator.h"

static double rate_along(const double *direction, const double *v, int numbers)
{
    double rate = 0;
    for (int i = 0; i < numbers; i++) rate += direction[i] * v[i];
    return rate;
}

/* k_d grad C (grad C . v) for C the length of each edge. */
static void damp_edges(int count, const double *x, const double *v, double kd, double *g)
{
    for (int e = 0; e < (count == 2 ? 1 : count); e++) {
        const int i = e, j = (e + 1) % count;
        double along[3], speed[3];
        v3_sub(along, x + 3 * j, x + 3 * i);
        v3_sub(speed, v + 3 * j, v + 3 * i);
        const double length2 = v3_norm2(along), pull = length2 > 0 ? kd * v3_dot(along, speed) / length2 : 0;
        v3_axpy(g + 3 * j, pull, along);
        v3_axpy(g + 3 * i, -pull, along);
    }
}

static void damp_angle(const double *x, const double *v, double kd, double *g)
{
    double angle[12];
    cipc_hinge_angle_gradient(x, angle);
    const double torque = kd * rate_along(angle, v, 12);
    for (int i = 0; i < 12; i++) g[i] += torque * angle[i];
}

/* For an energy k C^2 the gradient is 2 k C grad C, so that beta 2k grad C (grad C . v) = beta g (g . v)/(2 E); at rest, where E = 0, there is nothing to damp by. */
static void damp_gradient(const asynchronous_set *set, const void *params, const double *x, const double *v, double beta, double *g)
{
    const double energy = set->energy->value(x, params);
    if (!(energy > 0)) return;
    const double factor = 1 + beta * rate_along(g, v, 3 * set->energy->nodes) / (2 * energy);
    for (int i = 0; i < 3 * set->energy->nodes; i++) g[i] *= factor;
}

static void damp(const cipc_asynchronous *a, const asynchronous_set *set, int element, const double *x, double *g)
{
    const int count = set->energy->nodes, *nodes = set->nodes + (size_t)element * (size_t)count;
    const double kd = set->damping[element];
    double v[12];
    for (int i = 0; i < count; i++) v3_copy(v + 3 * i, a->nodes[nodes[i]].v);
    if (set->form == ASYNCHRONOUS_DAMP_EDGES) damp_edges(count, x, v, kd, g);
    else if (set->form == ASYNCHRONOUS_DAMP_ANGLE) damp_angle(x, v, kd, g);
    else damp_gradient(set, (const char *)set->params + (size_t)element * set->energy->params_size, x, v, kd, g);
}

/* v_i += h F_i / m_i (SPEC A.2). */
static void tick_element(cipc_asynchronous *a, const asynchronous_set *set, int element, double h)
{
    const int count = set->energy->nodes, *nodes = set->nodes + (size_t)element * (size_t)count;
    double x[12], g[12], sum = 0;
    asynchronous_gather(a, nodes, count, x);
    set->energy->gradient(x, (const char *)set->params + (size_t)element * set->energy->params_size, g);
    if (set->damping[element] > 0) damp(a, set, element, x, g);
    for (int i = 0; i < 3 * count; i++) sum += g[i];
    if (!isfinite(sum)) asynchronous_fail(a, CIPC_E_NO_PROGRESS, "%s at node %d (body \"%s\") has no finite force: shorter steps are needed (element_factor)", set->energy->name, nodes[0], asynchronous_body_of(a->model, nodes)->name);
    for (int i = 0; i < count && !a->status; i++) {
        const double inverse_mass = a->nodes[nodes[i]].inverse_mass;
        double dv[3];
        v3_scale(dv, -h * inverse_mass, g + 3 * i);
        if (inverse_mass > 0) asynchronous_kick(a, nodes[i], x + 3 * i, dv);
    }
}

void asynchronous_elements_tick(cipc_asynchronous *a, int number)
{
    asynchronous_clock *clock = &a->clocks[number];
    const asynchronous_set *set = &a->sets[clock->set];
    for (int i = 0; i < clock->count && !a->status; i++) tick_element(a, set, a->elements[clock->first + i], clock->h);
    clock->k = asynchronous_tick_after(a->options.mirror, clock->k);
    asynchronous_queue_schedule(&a->queue, clock->event, asynchronous_tick_time(a->options.mirror, clock->h, clock->k));
    a->report.events[set->kind] += clock->count;
    a->report.smallest_step = fmin(a->report.smallest_step, clock->h);
}

double asynchronous_elements_energy(const cipc_asynchronous *a, const double *positions)
{
    double sum = 0;
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) {
        const asynchronous_set *set = &a->sets[s];
        for (int e = 0; e < set->count; e++) {
            double x[12];
            for (int i = 0; i < set->energy->nodes; i++) v3_copy(x + 3 * i, positions + 3 * set->nodes[(size_t)e * (size_t)set->energy->nodes + (size_t)i]);
            sum += set->energy->value(x, (const char *)set->params + (size_t)e * set->energy->params_size);
        }
    }
    return sum;
}
