/* The method c-ipc of a scene's run: every accepted point goes to the monitors, every step has to converge. */
#include "support/scene_running.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

static cipc_status at_point(const cipc_accepted_point *point, cipc_error *error)
{
    char place[sizeof error->place], remedy[sizeof error->remedy];
    snprintf(place, sizeof place, "step %d, iteration %d, %.400s", point->step + 1, point->iteration + 1, error->place);
    snprintf(remedy, sizeof remedy, "%s", error->remedy);
    cipc_fail(error, error->status, place, "%s", error->what);
    return cipc_fail_remedy(error, "%s", remedy);
}

static void take_in(scene_running *r, const cipc_invariant_report *report)
{
    r->points_of_step++;
    scene_take_in(r, report);
}

/* M6, then M8, M1 to M4, and M5 (docs/monitors.md). */
static cipc_status look(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    scene_running *r = context;
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    cipc_status status = CIPC_OK;
    if (point->energy_valid) {
        r->outcome->energy_checks++;
        status = cipc_monitor_energy(point->energy_before, point->energy_after, point->energy_noise, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_check(r->monitor, point->x, &report, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_swept(r->monitor, r->previous, point->x, &report, error);
        memcpy(r->previous, point->x, 3 * (size_t)r->scene->model->node_count * sizeof *point->x);
    }
    if (status != CIPC_OK) {
        return at_point(point, error);
    }
    take_in(r, &report);
    return CIPC_OK;
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status begin(scene_running *r, cipc_error *error)
{
    r->previous = cipc_alloc(3 * (size_t)r->scene->model->node_count, sizeof *r->previous);
    if (r->previous == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "scene_run", "no memory for the start of a path");
    }
    const cipc_status status = cipc_stepper_create(&r->stepper, r->scene->model, &r->scene->options, error);
    if (status == CIPC_OK) {
        cipc_stepper_set_monitor(r->stepper, look, r);
    }
    return status;
}

/* What a good step left. */
static void record_step(scene_running *r, const cipc_step_report *report)
{
    scene_outcome *o = r->outcome;
    const scene_step step = {.model = r->scene->model, .x = r->scene->state->position, .probe = o->probe, .seen = &r->seen, .reach = r->scene->monitor_reach, .before = &o->last};
    o->last = scene_frame_of(&step, report);
    o->max_contacts = report->max_contacts > o->max_contacts ? report->max_contacts : o->max_contacts;
    o->max_friction = fmax(o->max_friction, report->incremental.friction);
}

static cipc_status take(scene_running *r, cipc_error *error)
{
    cipc_step_report report;
    cipc_state *state = r->scene->state;
    r->points_of_step = 0;
    memcpy(r->previous, state->position, 3 * (size_t)r->scene->model->node_count * sizeof *r->previous);
    cipc_status status = cipc_step(r->stepper, state, &report, error);
    if (status == CIPC_OK) {
        status = cipc_monitor_residual(report.residual, r->scene->options.newton_tolerance, error);
    }
    if (status == CIPC_OK && r->points_of_step == 0) { /* a step without any accepted point has to leave a good state too */
        const cipc_accepted_point end = {.x = state->position, .step = state->step - 1, .iteration = report.newton_iterations - 1};
        status = look(r, &end, error);
    }
    if (status == CIPC_OK && !report.converged) {
        status = cipc_fail(error, CIPC_E_NOT_CONVERGED, "scene_run", "step %d ended well, yet is not reported as converged", state->step);
    }
    if (status == CIPC_OK) {
        record_step(r, &report);
    }
    return status;
}

static void end(scene_running *r)
{
    cipc_stepper_destroy(r->stepper);
}

const scene_method scene_implicit = {begin, take, end};
