/* The asynchronous integrator: from state to state by events alone (SPEC A; docs/theory/asynchronous.md). */
#include "asynchronous/integrator.h"

#include <stdio.h>
#include <string.h>

void cipc_asynchronous_set_monitor(cipc_asynchronous *a, cipc_paths_callback *callback, void *context)
{
    a->monitor = callback;
    a->monitor_context = context;
    a->loaded = false; /* windows begin where a state is taken up */
}

/* ---- Taking up a state ---------------------------------------------------------------------------------------------------------------------- */

/* The deepest pair in words: where to look. */
enum { PAIR_WORDS = 512 };
static void name_deepest(const cipc_asynchronous *a, char words[PAIR_WORDS])
{
    const cipc_contact_place *deepest = &a->report.deepest;
    char nodes[64];
    int used = 0;
    snprintf(words, PAIR_WORDS, "no pair is in contact");
    if (deepest->layers == 0) return;
    const char *first = a->model->bodies[a->model->node_body[deepest->nodes[0]]].name;
    const char *second = a->model->bodies[a->model->node_body[deepest->nodes[cipc_pair_first_nodes(deepest->kind)]]].name;
    for (int i = 0; i < cipc_pair_nodes(deepest->kind); i++) used += snprintf(nodes + used, sizeof nodes - (size_t)used, "%s%d", i > 0 ? " " : "", deepest->nodes[i]);
    snprintf(words, PAIR_WORDS, "the deepest pair is %s of nodes %s (bodies \"%s\", \"%s\"), gap %.6g m, layer %d, steps of %.3g s", cipc_pair_name(deepest->kind), nodes, first, second,
             deepest->gap, deepest->layers, deepest->step);
}

static bool is_as_left(const cipc_asynchronous *a, const cipc_state *state)
{
    const size_t size = 3 * (size_t)a->model->node_count * sizeof(double);
    return a->loaded && a->now == state->time && memcmp(a->out_position, state->position, size) == 0 && memcmp(a->out_velocity, state->velocity, size) == 0;
}

/* The reference without culling: every pair that meets. */
static void create_all_pairs(cipc_asynchronous *a)
{
    while (a->pairs.live_count > 0) asynchronous_pair_destroy(a, a->pairs.live[a->pairs.live_count - 1]);
    for (int p = 0; p < a->broad.leaf_count; p++)
        for (int q = p + 1; q < a->broad.leaf_count; q++)
            for (int i = 0; i < ASYNCHRONOUS_COMBINATIONS && !a->status; i++) {
                asynchronous_combination c;
                if (asynchronous_combination_of(a, &a->broad.leaves[p], &a->broad.leaves[q], i, &c)) asynchronous_pair_create(a, c.kind, c.nodes, c.order);
            }
}

static cipc_status start_contact(cipc_asynchronous *a, cipc_error *error)
{
    if (a->options.always_layers > 0) {
        create_all_pairs(a);
    } else {
        for (int i = 0; i < a->model->node_count; i++) asynchronous_ball_start(a, i);
        const cipc_status status = asynchronous_tree_create(a, error);
        if (status) return status;
        asynchronous_separation_start(a);
    }
    return CIPC_OK;
}

static void place_nodes(cipc_asynchronous *a, const cipc_state *state)
{
    for (int i = 0; i < a->model->node_count; i++) {
        asynchronous_node *n = &a->nodes[i];
        v3_copy(n->q, state->position + 3 * i);
        v3_copy(n->v, state->velocity + 3 * i);
        v3_copy(a->before + 3 * i, n->v);
        n->t = state->time;
        n->inverse_mass = 1 / a->model->mass[i];
        a->dirty[i] = false;
        a->kicked[i] = -INFINITY;
        for (int k = 0; k < 3; k++) a->scale = fmax(a->scale, fabs(n->q[k]));
    }
    a->dirty_count = 0;
}

/* Pairs so near that time would not resolve the layers they are in. */
static cipc_status tell_refusal(const cipc_asynchronous *a, cipc_error *error)
{
    char pair[PAIR_WORDS];
    if (error) *error = a->error;
    if (a->status != CIPC_E_NO_PROGRESS) return a->status;
    name_deepest(a, pair);
    cipc_fail(error, CIPC_E_INITIAL_GAP, "asynchronous", "at the start pairs are too near for a thickness eta(1) of %.6g m: %s", a->options.thickness, pair);
    return cipc_fail_remedy(error, "move the bodies apart, or lower asynchronous.thickness below the elements' size");
}

static cipc_status take_up(cipc_asynchronous *a, const cipc_state *state, cipc_error *error)
{
    a->loaded = false;
    a->now = state->time;
    a->status = CIPC_OK;
    place_nodes(a, state);
    cipc_paths_callback *monitor = a->monitor;
    a->monitor = NULL; /* nothing moves yet */
    asynchronous_script_tick(a);
    a->monitor = monitor;
    asynchronous_elements_start(a);
    asynchronous_external_start(a);
    cipc_status status = start_contact(a, error);
    if (!status && a->status) status = tell_refusal(a, error);
    if (!status) status = asynchronous_windows_start(a, error);
    a->loaded = !status;
    return status;
}

/* ---- Events --------------------------------------------------------------------------------------------------------------------------------- */

/* Certificates of the nodes whose velocities have changed; before time goes on (SPEC A.3). */
static void look_at_certificates(cipc_asynchronous *a)
{
    const bool culling = a->options.always_layers == 0;
    double begin = asynchronous_phase_begin(a);
    for (int i = 0; i < a->dirty_count && culling; i++) asynchronous_ball_check(a, a->dirty_nodes[i]);
    asynchronous_phase_end(a, CIPC_ASYNCHRONOUS_PHASE_CELL_CHECK, begin);
    begin = asynchronous_phase_begin(a);
    for (int i = 0; i < a->dirty_count && culling; i++) asynchronous_pairs_check(a, a->dirty_nodes[i]);
    asynchronous_phase_end(a, CIPC_ASYNCHRONOUS_PHASE_SLAB_CHECK, begin);
    for (int i = 0; i < a->dirty_count; i++) a->dirty[a->dirty_nodes[i]] = false;
    a->dirty_count = 0;
}

static void execute(cipc_asynchronous *a, asynchronous_event event)
{
    const double begin = asynchronous_phase_begin(a);
    cipc_asynchronous_phase phase = CIPC_ASYNCHRONOUS_PHASE_INTEGRATION;
    if (event.rank == ASYNCHRONOUS_RANK_CELL) {
        phase = CIPC_ASYNCHRONOUS_PHASE_CELL;
        asynchronous_ball_event(a, event.owner);
    } else if (event.rank == ASYNCHRONOUS_RANK_SLAB) {
        phase = CIPC_ASYNCHRONOUS_PHASE_SLAB;
        asynchronous_pair_certify(a, event.owner);
        a->report.events[CIPC_EVENT_SLAB]++;
    } else if (event.rank > ASYNCHRONOUS_RANK_PENALTY) {
        phase = CIPC_ASYNCHRONOUS_PHASE_PENALTY;
        asynchronous_penalty_tick(a, event.owner, (int)(event.rank - ASYNCHRONOUS_RANK_PENALTY));
    } else if (event.rank == ASYNCHRONOUS_RANK_SCRIPT) {
        asynchronous_script_tick(a);
        a->script_k++;
        asynchronous_queue_schedule(&a->queue, a->script_event, asynchronous_tick_time(0, a->script_step, a->script_k));
        a->report.events[CIPC_EVENT_SCRIPT]++;
    } else if (event.rank == ASYNCHRONOUS_RANK_GRAVITY) {
        asynchronous_gravity_tick(a);
    } else {
        asynchronous_elements_tick(a, event.owner);
    }
    asynchronous_phase_end(a, phase, begin);
}

/* How many events the next one is timed for. */
static int timing(cipc_asynchronous *a, asynchronous_event event)
{
    const bool large = event.rank == ASYNCHRONOUS_RANK_SCRIPT || event.rank == ASYNCHRONOUS_RANK_GRAVITY ||
                       (event.rank >= ASYNCHRONOUS_RANK_ELEMENTS && event.rank < ASYNCHRONOUS_RANK_PENALTY && a->clocks[event.owner].count >= ASYNCHRONOUS_SAMPLE);
    if (large) return 1;
    return a->event_count++ % ASYNCHRONOUS_SAMPLE == 0 ? ASYNCHRONOUS_SAMPLE : 0;
}

static long count_events(const cipc_asynchronous *a)
{
    long sum = 0;
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) sum += a->report.events[k];
    return sum;
}

/* Every certificate is looked at again before time passes, and before certificates of the same instant are dealt with. */
static bool is_time_for_certificates(const cipc_asynchronous *a, int next)
{
    return a->dirty_count > 0 && (next < 0 || asynchronous_queue_time(&a->queue, next) > a->now || a->queue.events[next].rank <= ASYNCHRONOUS_RANK_SLAB);
}

/* A list made afresh makes its pairs anew, whose layers then tick at the first time after this instant: when all that ticks in it has ticked. */
static bool is_time_for_lists(const cipc_asynchronous *a, int next)
{
    return a->broad.stale && !a->status && (next < 0 || asynchronous_queue_time(&a->queue, next) > a->now);
}

/* Between two instants, so that what is due in one is done, and the state can be taken up there; in one that does not end, after as many again. */
static bool has_stalled(cipc_asynchronous *a, int next)
{
    const long events = count_events(a), limit = a->options.event_limit;
    if (events <= limit || (events - limit <= limit && asynchronous_queue_time(&a->queue, next) <= a->now)) return false;
    asynchronous_fail(a, CIPC_E_NO_PROGRESS, "stalled: more than %ld events in this step", limit);
    return true;
}

static void run_until(cipc_asynchronous *a, double end)
{
    while (!a->status) {
        int next = asynchronous_queue_next(&a->queue);
        if (is_time_for_certificates(a, next)) {
            look_at_certificates(a);
            next = asynchronous_queue_next(&a->queue);
        }
        if (is_time_for_lists(a, next)) {
            asynchronous_separation_start(a);
            next = asynchronous_queue_next(&a->queue);
        }
        if (a->status || next < 0 || asynchronous_queue_time(&a->queue, next) > end || has_stalled(a, next)) break;
        a->now = asynchronous_queue_time(&a->queue, next);
        a->timed = timing(a, a->queue.events[next]);
        execute(a, a->queue.events[next]);
    }
}

/* ---- Steps ---------------------------------------------------------------------------------------------------------------------------------- */

static void give_back(cipc_asynchronous *a, cipc_state *state)
{
    asynchronous_synchronise(a, a->now);
    for (int i = 0; i < a->model->node_count; i++) {
        v3_copy(state->position + 3 * i, a->nodes[i].q);
        v3_copy(state->velocity + 3 * i, a->nodes[i].v);
    }
    const size_t size = 3 * (size_t)a->model->node_count * sizeof(double);
    memcpy(a->out_position, state->position, size);
    memcpy(a->out_velocity, state->velocity, size);
    state->time = a->now;
}

/* What stopped the step, and the deepest pair. */
static cipc_status tell_failure(const cipc_asynchronous *a, const cipc_state *state, cipc_error *error)
{
    char place[128], pair[PAIR_WORDS];
    if (error) *error = a->error;
    if (a->status != CIPC_E_NO_PROGRESS) return a->status;
    snprintf(place, sizeof place, "step %d, t = %.9g s", state->step + 1, a->now);
    name_deepest(a, pair);
    cipc_fail(error, a->status, place, "%s; %s", a->error.what, pair);
    return cipc_fail_remedy(error, "check the scripted motion for an impossible squeeze; --resume goes on from the last frame, with asynchronous.events raised");
}

cipc_status cipc_asynchronous_step(cipc_asynchronous *a, cipc_state *state, cipc_asynchronous_report *report, cipc_error *error)
{
    const double begin = asynchronous_seconds(), end = (state->step + 1) * a->options.frame;
    asynchronous_report_begin(a);
    cipc_status status = CIPC_OK;
    if (!(state->time < end)) status = cipc_fail(error, CIPC_E_OUT_OF_RANGE, "asynchronous", "the state is of t = %.9g s, but step %d ends at %.9g s", state->time, state->step + 1, end);
    else if (!is_as_left(a, state)) status = take_up(a, state, error);
    *report = a->report;
    if (status) return status;
    run_until(a, end);
    if (!a->status) a->now = end;
    if (!a->status || a->status == CIPC_E_NO_PROGRESS) {
        status = asynchronous_windows_flush(a, a->now, error);
        give_back(a, state);
    }
    a->report.total_events = count_events(a);
    asynchronous_report_end(a, report);
    double told = 0;
    for (int k = 0; k < CIPC_ASYNCHRONOUS_PHASE_OTHER; k++) told += report->seconds[k];
    report->seconds[CIPC_ASYNCHRONOUS_PHASE_OTHER] = fmax(asynchronous_seconds() - begin - told, 0);
    a->loaded = !a->status && !status;
    if (status) return status;
    if (a->status) return tell_failure(a, state, error);
    state->step++;
    return CIPC_OK;
}
