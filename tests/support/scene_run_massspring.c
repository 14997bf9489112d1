/* The method mass-spring of a scene's run, looked at as src/cli/massspring_steps.c does: whether a frame intersects is counted, not demanded. */
#include "support/scene_running.h"

#include <stdio.h>

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

/* An error that is this violation counts, and is none. */
static cipc_status count(cipc_status status, cipc_status violation, long *frames)
{
    *frames += status == violation;
    return status == violation ? CIPC_OK : status;
}

/* M8 is demanded, and so are M3 and M4 if a scene should have anything for them. M1 and M2 are looked at whether or not the other is broken. */
static cipc_status check_frame(scene_running *r, cipc_error *error)
{
    const double *x = r->scene->state->position;
    scene_outcome *o = r->outcome;
    cipc_invariant_report seen;
    cipc_invariant_report_init(&seen);
    cipc_status status = cipc_monitor_finite(r->scene->model, x, error);
    if (status == CIPC_OK) {
        status = count(cipc_monitor_intersection(r->monitor, x, &seen, error), CIPC_E_VIOLATED_INTERSECTION, &o->intersecting);
    }
    if (status == CIPC_OK) {
        status = count(cipc_monitor_gap(r->monitor, x, &seen, error), CIPC_E_VIOLATED_GAP, &o->too_near);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_strain(r->monitor, x, &seen, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_inversion(r->monitor, x, &seen, error);
    }
    if (status == CIPC_OK) {
        scene_take_in(r, &seen);
    }
    return status;
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status begin(scene_running *r, cipc_error *error)
{
    const cipc_scene *scene = r->scene;
    return cipc_massspring_create(&r->springs, scene->model, scene->colliders, scene->collider_count, &scene->massspring, error);
}

/* What a good step left. */
static void record_step(scene_running *r, const cipc_massspring_report *report)
{
    scene_outcome *o = r->outcome;
    const scene_step step = {.model = r->scene->model, .x = r->scene->state->position, .probe = o->probe, .seen = &r->seen, .reach = r->scene->monitor_reach, .before = &o->last};
    o->last = scene_frame_of_massspring(&step, report);
    o->max_contacts = report->contacts > o->max_contacts ? report->contacts : o->max_contacts;
}

static cipc_status take(scene_running *r, cipc_error *error)
{
    cipc_massspring_report report;
    cipc_status status = cipc_massspring_step(r->springs, r->scene->state, &report, error);
    if (status == CIPC_OK) {
        status = check_frame(r, error);
    }
    if (status == CIPC_OK) {
        record_step(r, &report);
        return CIPC_OK;
    }
    char place[sizeof error->place];
    snprintf(place, sizeof place, "step %d, %.400s", r->outcome->steps + 1, error->place);
    return cipc_fail(error, error->status, place, "%s", error->what);
}

static void end(scene_running *r)
{
    cipc_massspring_destroy(r->springs);
}

const scene_method scene_massspring = {begin, take, end};
