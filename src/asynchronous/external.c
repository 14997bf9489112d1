/* What acts from outside: gravity and loads on a clock of their own, prescribed motion (SPEC A.1, A.2). */
#include "asynchronous/integrator.h"

#include <string.h>

/* The longest frame / 2^k that is not longer than what is asked for: ticks then fall on frames to the last bit. */
static double within_frame(double frame, double asked)
{
    double step = frame;
    while (step > asked) step /= 2;
    return step;
}

cipc_status asynchronous_external_create(cipc_asynchronous *a, cipc_error *error)
{
    const cipc_asynchronous_options *o = &a->options;
    a->gravity_step = within_frame(o->frame, o->gravity_step > 0 ? o->gravity_step : o->frame / 16);
    a->script_step = within_frame(o->frame, o->script_step > 0 ? o->script_step : o->frame);
    if (asynchronous_is_too_short(a, a->gravity_step) || asynchronous_is_too_short(a, a->script_step))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "asynchronous", "gravity_step = %g, script_step = %g: more than %d ticks in a frame of %g s", o->gravity_step, o->script_step, ASYNCHRONOUS_MOST_TICKS, o->frame);
    a->gravity_event = asynchronous_queue_add(&a->queue, ASYNCHRONOUS_RANK_GRAVITY, 0, 0);
    a->script_event = asynchronous_queue_add(&a->queue, ASYNCHRONOUS_RANK_SCRIPT, 0, 0);
    if (a->gravity_event >= 0 && a->script_event >= 0) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for events");
}

static bool has_external_forces(const cipc_model *m) { return v3_norm2(m->gravity) > 0 || m->load_count > 0; }

void asynchronous_external_start(cipc_asynchronous *a)
{
    const double mirror = a->options.mirror;
    a->gravity_k = asynchronous_first_tick(mirror, a->gravity_step, a->now);
    a->script_k = asynchronous_first_tick(0, a->script_step, a->now);
    if (has_external_forces(a->model)) asynchronous_queue_schedule(&a->queue, a->gravity_event, asynchronous_tick_time(mirror, a->gravity_step, a->gravity_k));
    if (a->model->dirichlet_count > 0) asynchronous_queue_schedule(&a->queue, a->script_event, asynchronous_tick_time(0, a->script_step, a->script_k));
}

static void find_acceleration(cipc_asynchronous *a)
{
    const cipc_model *m = a->model;
    for (int i = 0; i < m->node_count; i++) v3_copy(a->acceleration + 3 * i, m->gravity);
    for (int l = 0; l < m->load_count; l++) {
        const cipc_load *load = &m->loads[l];
        if (a->now < load->begin || a->now >= load->end) continue;
        for (int i = 0; i < load->node_count; i++) v3_axpy(a->acceleration + 3 * load->nodes[i], 1 / m->mass[load->nodes[i]], load->force);
    }
}

void asynchronous_gravity_tick(cipc_asynchronous *a)
{
    find_acceleration(a);
    for (int i = 0; i < a->model->node_count; i++) {
        double x[3], dv[3];
        v3_scale(dv, a->gravity_step, a->acceleration + 3 * i);
        if (!(a->nodes[i].inverse_mass > 0) || !(v3_norm2(dv) > 0)) continue;
        asynchronous_position(&a->nodes[i], a->now, x);
        asynchronous_kick(a, i, x, dv);
    }
    a->gravity_k = asynchronous_tick_after(a->options.mirror, a->gravity_k);
    asynchronous_queue_schedule(&a->queue, a->gravity_event, asynchronous_tick_time(a->options.mirror, a->gravity_step, a->gravity_k));
    a->report.events[CIPC_EVENT_GRAVITY]++;
    a->report.smallest_step = fmin(a->report.smallest_step, a->gravity_step);
}

/* Straight to where the script has the node at the end of the script's step. A node that has just been released keeps the velocity that it had. */
static void steer(cipc_asynchronous *a, int node, const double x[3])
{
    static const double rest[3] = {0, 0, 0};
    double v[3];
    v3_sub(v, a->target + 3 * node, x);
    v3_scale(v, 1 / a->script_step, v);
    const double *wanted = a->moves[node] ? v : rest, *present = a->nodes[node].v;
    a->nodes[node].inverse_mass = 0;
    if (memcmp(wanted, present, sizeof v) != 0) asynchronous_steer(a, node, x, wanted);
}

/* Velocities that hold until the next tick of the script. Also called when a state is taken up: what it finds is then what it found when the state was left. */
void asynchronous_script_tick(cipc_asynchronous *a)
{
    const cipc_model *m = a->model;
    double *x = a->acceleration; /* free to use between ticks of gravity */
    for (int i = 0; i < m->node_count; i++) asynchronous_position(&a->nodes[i], a->now, x + 3 * i);
    cipc_dirichlet_targets(m, x, a->now, a->script_step, a->is_dirichlet, a->target, a->moves);
    for (int i = 0; i < m->node_count; i++) {
        if (a->is_dirichlet[i]) steer(a, i, x + 3 * i);
        else a->nodes[i].inverse_mass = 1 / m->mass[i];
    }
}
