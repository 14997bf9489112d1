/* The steps of the method mass-spring: what the monitors count, and what is told of a step. */
#include "cli/steps.h"

#include "cli/command.h"

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

static void write_violation(const cipc_simulation *s, const cipc_invariant_report *report, const cipc_error *violation)
{
    const cipc_state *state = s->scene->state;
    const double window[2] = {state->time, state->time};
    cipc_error error;
    cipc_simulation_write_state(s, "violation.obj", state->position);
    char *path = cipc_path_in(s->request->directory, "violation.json");
    if (path != NULL && cipc_asynchronous_violation_write(path, s->summary.steps_taken, s->summary.time, window, report, violation, &error) != CIPC_OK) {
        cipc_say(&error);
    }
    cipc_free(path);
}

/* An error that is this violation says that the frame breaks the invariant, and no more: the method does not guarantee it. The first is remembered in words. */
static cipc_status count(cipc_status status, cipc_status violation, const cipc_error *error, bool *broken, cipc_counted *counted)
{
    *broken = status == violation;
    if (*broken && counted->frames == 0) {
        counted->first = *error;
    }
    return *broken ? CIPC_OK : status;
}

/* M1 and M2, each whether or not the other is broken. */
static cipc_status count_contacts(cipc_simulation *s, cipc_invariant_report *report, cipc_error *error)
{
    const double *x = s->scene->state->position;
    cipc_massspring_totals *totals = &s->summary.massspring;
    cipc_status status = cipc_monitor_intersection(s->monitor, x, report, error);
    status = count(status, CIPC_E_VIOLATED_INTERSECTION, error, &s->seen.intersects, &totals->intersecting);
    if (status == CIPC_OK) {
        status = cipc_monitor_gap(s->monitor, x, report, error);
        status = count(status, CIPC_E_VIOLATED_GAP, error, &s->seen.too_near, &totals->too_near);
    }
    s->seen.counted = status == CIPC_OK;
    return status;
}

/* Where a step ends. M8 is demanded, and so are M3 and M4 if a scene should have anything for them. */
static cipc_status check_frame(cipc_simulation *s, cipc_error *error)
{
    const double *x = s->scene->state->position;
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    cipc_status status = cipc_monitor_finite(s->scene->model, x, error);
    if (status == CIPC_OK) {
        status = count_contacts(s, &report, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_strain(s->monitor, x, &report, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_inversion(s->monitor, x, &report, error);
    }
    cipc_step_invariants_add(&s->seen, &report);
    if (status != CIPC_OK) {
        char where[64];
        snprintf(where, sizeof where, "step %d, frame at %.9g s", s->summary.steps_taken + 1, s->scene->state->time);
        cipc_steps_found_at(error, where);
    }
    if (cipc_status_exit(status) == 3) {
        write_violation(s, &report, error);
    }
    return status;
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status create(cipc_simulation *s, cipc_error *error)
{
    const cipc_scene *scene = s->scene;
    return cipc_massspring_create(&s->massspring, scene->model, scene->colliders, scene->collider_count, &scene->massspring, error);
}

static void begin(cipc_simulation *s)
{
    s->times = (cipc_massspring_times){.frame = s->scene->massspring.frame}; /* nobody is told of anything in between: a step is short */
}

static cipc_status take(cipc_simulation *s)
{
    const double start = cipc_clock();
    cipc_status status = cipc_massspring_step(s->massspring, s->scene->state, &s->springs, &s->error);
    const double end = cipc_clock();
    s->times.step = end - start;
    if (status != CIPC_OK) {
        s->summary.converged = false;
        return status;
    }
    status = s->monitor != NULL ? check_frame(s, &s->error) : CIPC_OK;
    s->times.monitor = cipc_clock() - end;
    cipc_massspring_summary_add(&s->summary, &s->springs, &s->times, s->monitor != NULL ? &s->seen : NULL);
    return status;
}

/* ---- What is told of them --------------------------------------------------------------------------------------------------- */

static cipc_status write_line(cipc_simulation *s, cipc_error *error)
{
    return cipc_massspring_stats_write(s->stats, s->scene->state, &s->springs, &s->times, s->monitor != NULL ? &s->seen : NULL, error);
}

static void show_line(const cipc_simulation *s, double seconds_left)
{
    cipc_massspring_progress_line(stderr, s->scene->state->step, s->scene->steps, s->scene->state->time, &s->springs, &s->times, seconds_left);
}

static cipc_status plot(const cipc_simulation *s, const char *plots, const char *stats, cipc_error *error)
{
    return cipc_massspring_plots_png(plots, stats, s->scene->massspring.deformation, error);
}

const cipc_steps cipc_massspring_steps = {create, begin, take, write_line, show_line, plot};
