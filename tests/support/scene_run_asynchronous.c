/* The method asynchronous of a scene's run, looked at as src/cli/asynchronous_steps.c does: the paths of all nodes, every frame, and momentum where it is kept. */
#include "support/scene_running.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

static cipc_status at_time(const scene_running *r, double time, cipc_error *error)
{
    char place[sizeof error->place], remedy[sizeof error->remedy];
    snprintf(place, sizeof place, "step %d, up to %.9g s, %.400s", r->outcome->steps + 1, time, error->place);
    snprintf(remedy, sizeof remedy, "%s", error->remedy);
    cipc_fail(error, error->status, place, "%s", error->what);
    return cipc_fail_remedy(error, "%s", remedy);
}

/* M5, window after window. */
static cipc_status look(void *context, const cipc_paths *paths, cipc_error *error)
{
    scene_running *r = context;
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    const cipc_status status = cipc_monitor_paths(r->monitor, paths, &report, error);
    r->outcome->windows++;
    r->outcome->paths_checked += report.paths_checked;
    r->outcome->exact_path_checks += report.exact_path_checks;
    return status == CIPC_OK ? CIPC_OK : at_time(r, paths->end, error);
}

/* M7: kicks that are not from outside lose nothing of the momentum but rounding. */
static cipc_status check_momentum(scene_running *r, const cipc_asynchronous_report *report, cipc_error *error)
{
    const long *events = report->events;
    const long kicks = events[CIPC_EVENT_STRETCHING] + events[CIPC_EVENT_BENDING] + events[CIPC_EVENT_VOLUME] + events[CIPC_EVENT_PENALTY];
    const double energy = report->kinetic + report->elastic + report->contact, *after = r->scene->state->velocity;
    const double bound = cipc_momentum_rounding(r->scene->model, r->previous, after, kicks, fmax(energy, r->energy));
    double change;
    r->energy = energy;
    r->outcome->momentum_checks++;
    return cipc_monitor_momentum(r->scene->model, r->previous, after, bound, &change, error);
}

/* M8, M1 to M4. */
static cipc_status check_frame(scene_running *r, const cipc_asynchronous_report *report, cipc_error *error)
{
    const cipc_state *state = r->scene->state;
    cipc_invariant_report seen;
    cipc_invariant_report_init(&seen);
    cipc_status status = cipc_monitor_check(r->monitor, state->position, &seen, error);
    if (status == CIPC_OK) {
        scene_take_in(r, &seen);
        status = r->previous != NULL ? check_momentum(r, report, error) : CIPC_OK;
    }
    return status == CIPC_OK ? CIPC_OK : at_time(r, state->time, error);
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status begin(scene_running *r, cipc_error *error)
{
    const cipc_model *m = r->scene->model;
    if (cipc_momentum_source(m) == NULL) {
        r->previous = cipc_alloc(3 * (size_t)m->node_count, sizeof *r->previous);
        if (r->previous == NULL) {
            return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "scene_run", "no memory for the velocities before a step");
        }
    }
    const cipc_status status = cipc_asynchronous_create(&r->integrator, m, &r->scene->asynchronous, error);
    if (status == CIPC_OK) {
        cipc_asynchronous_set_monitor(r->integrator, look, r);
    }
    return status;
}

/* What a good step left. */
static void record_step(scene_running *r, const cipc_asynchronous_report *report)
{
    scene_outcome *o = r->outcome;
    const scene_step step = {.model = r->scene->model, .x = r->scene->state->position, .probe = o->probe, .seen = &r->seen, .reach = r->scene->monitor_reach, .before = &o->last};
    o->last = scene_frame_of_asynchronous(&step, report);
    o->max_contacts = report->max_contacts > o->max_contacts ? report->max_contacts : o->max_contacts;
    o->max_layers = report->layers > o->max_layers ? report->layers : o->max_layers;
}

static cipc_status take(scene_running *r, cipc_error *error)
{
    cipc_asynchronous_report report;
    if (r->previous != NULL) {
        memcpy(r->previous, r->scene->state->velocity, 3 * (size_t)r->scene->model->node_count * sizeof *r->previous);
    }
    cipc_status status = cipc_asynchronous_step(r->integrator, r->scene->state, &report, error);
    if (status == CIPC_OK) {
        status = check_frame(r, &report, error);
    }
    if (status == CIPC_OK) {
        record_step(r, &report);
    }
    return status;
}

static void end(scene_running *r)
{
    cipc_asynchronous_destroy(r->integrator);
}

const scene_method scene_asynchronous = {begin, take, end};
