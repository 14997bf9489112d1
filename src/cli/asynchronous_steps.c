/* The steps of the method asynchronous: what the monitors look at, and what is told of a step. */
#include "cli/steps.h"

#include <math.h>
#include "cli/command.h"

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

/* What they look at: the frame at a time, or the window of paths that ends there. */
typedef struct look_at {
    double window[2];   /* s; of a frame the same twice */
    const double *x;    /* at the end */
} look_at;

static void write_violation(const cipc_simulation *s, const look_at *at, int steps_taken, const cipc_invariant_report *report, const cipc_error *violation)
{
    cipc_error error;
    cipc_simulation_write_state(s, "violation.obj", at->x);
    char *path = cipc_path_in(s->request->directory, "violation.json");
    if (path != NULL && cipc_asynchronous_violation_write(path, steps_taken, s->summary.time, at->window, report, violation, &error) != CIPC_OK) {
        cipc_say(&error);
    }
    cipc_free(path);
}

/* Name the place in time; the state goes to files if an invariant is broken. */
static cipc_status report_violation(cipc_simulation *s, const look_at *at, const cipc_invariant_report *report, cipc_error *error)
{
    char where[96];
    if (at->window[0] < at->window[1]) {
        snprintf(where, sizeof where, "step %d, paths from %.9g to %.9g s", s->summary.steps_taken + 1, at->window[0], at->window[1]);
    } else {
        snprintf(where, sizeof where, "step %d, frame at %.9g s", s->summary.steps_taken + 1, at->window[1]);
    }
    cipc_steps_found_at(error, where);
    if (cipc_status_exit(error->status) == 3) {
        write_violation(s, at, s->summary.steps_taken, report, error);
    }
    return error->status;
}

static cipc_status check_paths(cipc_simulation *s, const cipc_paths *paths, cipc_error *error)
{
    const look_at at = {{paths->begin, paths->end}, paths->to};
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    const cipc_status status = cipc_monitor_paths(s->monitor, paths, &report, error);
    cipc_step_invariants_add_window(&s->seen, &report);
    return status == CIPC_OK ? CIPC_OK : report_violation(s, &at, &report, error);
}

/* The callback: called window after window, also without a monitor, because this is where a signal is noticed in a long step. */
static cipc_status look(void *context, const cipc_paths *paths, cipc_error *error)
{
    cipc_simulation *s = context;
    const cipc_status status = cipc_steps_interrupted(s, error);
    const bool swept = s->monitor != NULL && s->scene->monitor_swept;
    return status == CIPC_OK && swept ? check_paths(s, paths, error) : status;
}

/* Ticks that change velocities without a force from outside. */
static long kicks_of(const cipc_asynchronous_report *report)
{
    return report->events[CIPC_EVENT_STRETCHING] + report->events[CIPC_EVENT_BENDING] + report->events[CIPC_EVENT_VOLUME] + report->events[CIPC_EVENT_PENALTY];
}

/* M7: kicks lose nothing of the momentum but rounding. */
static cipc_status check_momentum(cipc_simulation *s, cipc_error *error)
{
    const cipc_asynchronous_report *r = &s->events;
    const double energy = r->kinetic + r->elastic + r->contact, *after = s->scene->state->velocity;
    const double bound = cipc_momentum_rounding(s->scene->model, s->velocity, after, kicks_of(r), fmax(energy, s->energy));
    const cipc_status status = cipc_monitor_momentum(s->scene->model, s->velocity, after, bound, &s->seen.momentum_change, error);
    s->energy = energy;
    s->seen.momentum_checks = status == CIPC_OK ? 1 : 0;
    return status;
}

/* Where a step ends, and what it did to the momentum if nothing is to change that. */
static cipc_status check_frame(cipc_simulation *s, cipc_error *error)
{
    const cipc_state *state = s->scene->state;
    const look_at at = {{state->time, state->time}, state->position};
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    cipc_status status = cipc_monitor_check(s->monitor, state->position, &report, error);
    cipc_step_invariants_add(&s->seen, &report);
    cipc_step_invariants_add_segments(&s->seen, s->scene->model, state->position);
    if (status == CIPC_OK && s->velocity != NULL) {
        status = check_momentum(s, error);
    }
    return status == CIPC_OK ? CIPC_OK : report_violation(s, &at, &report, error);
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status create(cipc_simulation *s, cipc_error *error)
{
    return cipc_asynchronous_create(&s->integrator, s->scene->model, &s->scene->asynchronous, error);
}

static void begin(cipc_simulation *s)
{
    cipc_asynchronous_set_monitor(s->integrator, look, s);
}

static cipc_status take(cipc_simulation *s)
{
    cipc_status status = cipc_asynchronous_step(s->integrator, s->scene->state, &s->events, &s->error);
    s->summary.converged = s->summary.converged && status == CIPC_OK;
    if (status == CIPC_OK && s->monitor != NULL) {
        const double begin = cipc_clock();
        status = check_frame(s, &s->error);
        s->events.seconds[CIPC_ASYNCHRONOUS_PHASE_MONITOR] += cipc_clock() - begin;
    }
    cipc_asynchronous_summary_add(&s->summary, &s->events, s->monitor != NULL ? &s->seen : NULL);
    return status;
}

/* ---- What is told of them --------------------------------------------------------------------------------------------------- */

static cipc_status write_line(cipc_simulation *s, cipc_error *error)
{
    return cipc_asynchronous_stats_write(s->stats, s->scene->state, &s->events, s->monitor != NULL ? &s->seen : NULL, error);
}

static void show_line(const cipc_simulation *s, double seconds_left)
{
    const double gap = s->monitor != NULL ? s->seen.worst.min_gap : s->events.min_gap;
    cipc_asynchronous_progress_line(stderr, s->scene->state->step, s->scene->steps, s->scene->state->time, &s->events, gap, seconds_left);
}

static cipc_status plot(const cipc_simulation *s, const char *plots, const char *stats, cipc_error *error)
{
    return cipc_asynchronous_plots_png(plots, stats, s->scene->asynchronous.thickness, error);
}

const cipc_steps cipc_asynchronous_steps = {create, begin, take, write_line, show_line, plot};
