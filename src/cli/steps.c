/* The steps of a run: step, look, write, show. */
#include "cli/simulation.h"

#include <math.h>
#include <string.h>
#include <unistd.h>
#include "cli/command.h"
#include "cli/interrupt.h"

void cipc_simulation_write_state(const cipc_simulation *s, const char *name, const double *position)
{
    cipc_error error;
    char *path = cipc_path_in(s->request->directory, name);
    if (path == NULL) {
        cipc_fail(&error, CIPC_E_OUT_OF_MEMORY, name, "no memory for a file's name");
        cipc_say(&error);
        return;
    }
    if (cipc_obj_write(path, s->scene->model, position, &error) != CIPC_OK) {
        cipc_say(&error);
    }
    cipc_free(path);
}

static void write_violation(const cipc_simulation *s, const cipc_accepted_point *point, const cipc_invariant_report *report,
                            const cipc_error *violation)
{
    cipc_error error;
    cipc_simulation_write_state(s, "violation.obj", point->x);
    char *path = cipc_path_in(s->request->directory, "violation.json");
    if (path != NULL && cipc_violation_write(path, point, s->scene->state->time, report, violation, &error) != CIPC_OK) {
        cipc_say(&error);
    }
    cipc_free(path);
}

/* Prefix the place of an error with the point at which it was found; the state goes to files if an invariant is broken. */
static cipc_status report_violation(cipc_simulation *s, const cipc_accepted_point *point, const cipc_invariant_report *report,
                                    cipc_error *error)
{
    char place[sizeof error->place + 64];
    const char *monitor = strncmp(error->place, "monitor", 7) == 0 ? error->place : "monitor";
    if (point->iteration < 0) {
        snprintf(place, sizeof place, "step %d, scripted motion, %s", point->step + 1, monitor);
    } else {
        snprintf(place, sizeof place, "step %d, iteration %d, %s", point->step + 1, point->iteration + 1, monitor);
    }
    char remedy[sizeof error->remedy];
    snprintf(remedy, sizeof remedy, "%s", error->remedy);
    cipc_fail(error, error->status, place, "%s", error->what);
    cipc_fail_remedy(error, "%s", remedy);
    if (cipc_status_exit(error->status) == 3) {
        write_violation(s, point, report, error);
    }
    return error->status;
}

static cipc_status check_point(cipc_simulation *s, const cipc_accepted_point *point, cipc_error *error)
{
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    cipc_status status = CIPC_OK;
    if (point->energy_valid) {
        s->seen.energy_checks++;
        status = cipc_monitor_energy(point->energy_before, point->energy_after, point->energy_noise, error);
    }
    if (status == CIPC_OK) {
        status = cipc_monitor_check(s->monitor, point->x, &report, error);
    }
    if (status == CIPC_OK && s->previous != NULL) {
        status = cipc_monitor_swept(s->monitor, s->previous, point->x, &report, error);
        memcpy(s->previous, point->x, 3 * (size_t)s->scene->model->node_count * sizeof *point->x);
    }
    cipc_step_invariants_add(&s->seen, &report);
    cipc_step_invariants_add_segments(&s->seen, s->scene->model, point->x);
    return status == CIPC_OK ? CIPC_OK : report_violation(s, point, &report, error);
}

/* The callback: called at every accepted point, also without a monitor, because this is where a signal is noticed in a long step. */
static cipc_status look(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    cipc_simulation *s = context;
    if (cipc_interrupt_seen()) {
        s->interrupted = true;
        return cipc_fail(error, CIPC_E_NO_PROGRESS, "run", "interrupted by a signal");
    }
    return s->monitor != NULL ? check_point(s, point, error) : CIPC_OK;
}

/* M7: the step ends with about the momentum it began with. */
static cipc_status check_momentum(cipc_simulation *s, cipc_error *error)
{
    const cipc_state *state = s->scene->state;
    const cipc_implicit_options *o = &s->scene->options;
    const cipc_momentum_rule rule = {.tolerance = o->newton_tolerance, .rms = o->newton_norm == CIPC_NORM_RMS, .time_step = o->time_step,
                                     .beta = o->integrator.beta, .minimisations = o->strain_coupling == CIPC_STRAIN_SPLIT ? 2 : 1};
    const double bound = cipc_momentum_bound(s->scene->model, state->position, &rule);
    cipc_status status = cipc_monitor_momentum(s->scene->model, s->velocity, state->velocity, bound, &s->seen.momentum_change, error);
    s->seen.momentum_checks = status == CIPC_OK ? 1 : 0;
    return status;
}

/* What holds of a whole step: it converged to the tolerance, and kept its momentum if nothing changes that; and where it ends has been looked at, and the
 * path there, accepted points or none. */
static cipc_status check_step(cipc_simulation *s, const cipc_step_report *report, cipc_error *error)
{
    const cipc_accepted_point end = {
        .x = s->scene->state->position, .step = s->scene->state->step - 1, .iteration = report->newton_iterations - 1};
    cipc_status status = cipc_monitor_residual(report->residual, s->scene->options.newton_tolerance, error);
    if (status == CIPC_OK && s->velocity != NULL) {
        status = check_momentum(s, error);
    }
    if (status != CIPC_OK) {
        return report_violation(s, &end, NULL, error);
    }
    const size_t size = 3 * (size_t)s->scene->model->node_count * sizeof *end.x;
    const bool moved_on = s->previous != NULL && memcmp(s->previous, end.x, size) != 0;
    return s->seen.points == 0 || moved_on ? check_point(s, &end, error) : CIPC_OK;
}

cipc_status cipc_simulation_frame_obj(const cipc_simulation *s, cipc_error *error)
{
    char name[64];
    snprintf(name, sizeof name, "obj/frame_%05d.obj", s->scene->state->step);
    char *path = cipc_path_in(s->request->directory, name);
    if (path == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, name, "no memory for a file's name");
    }
    cipc_status status = cipc_obj_write(path, s->scene->model, s->scene->state->position, error);
    cipc_free(path);
    return status;
}

static bool is_power_of_two(int n)
{
    return n > 0 && (n & (n - 1)) == 0;
}

/* The statistics' line comes before the frame: after a kill in between, the line is one too many, which resuming cuts off. The XDMF file is
 * rewritten whenever the number of frames has doubled, so that it costs little and a killed run has one that shows at least half. */
static cipc_status write_step(cipc_simulation *s, const cipc_step_report *report, cipc_error *error)
{
    const double begin = cipc_clock();
    const cipc_state *state = s->scene->state;
    cipc_status status = cipc_stats_write(s->stats, state, report, s->monitor != NULL ? &s->seen : NULL, error);
    if (status == CIPC_OK) {
        status = cipc_trajectory_append(s->trajectory, state, error);
    }
    if (status == CIPC_OK && s->request->write_obj) {
        status = cipc_simulation_frame_obj(s, error);
    }
    if (status == CIPC_OK && is_power_of_two(cipc_trajectory_frames(s->trajectory))) {
        status = cipc_simulation_xdmf(s, error);
    }
    s->summary.output_seconds += cipc_clock() - begin;
    return status;
}

static void show_progress(const cipc_simulation *s, const cipc_step_report *report)
{
    if (s->request->quiet || !isatty(STDERR_FILENO)) {
        return;
    }
    const int step = s->scene->state->step, done = step - s->first_step;
    const double left = done > 0 ? (cipc_clock() - s->begin) / done * (s->scene->steps - step) : NAN;
    const bool monitored = s->monitor != NULL;
    const double stretch = fmax(s->seen.worst.max_stretch, s->seen.max_segment_stretch);
    cipc_progress_line(stderr, step, s->scene->steps, s->scene->state->time, report->newton_iterations, report->contacts,
                       monitored ? s->seen.worst.min_gap : report->min_gap, monitored ? stretch : NAN, left);
}

static cipc_status take_step(cipc_simulation *s)
{
    cipc_step_report report;
    s->seen = cipc_step_invariants_none();
    if (s->previous != NULL) { /* the step's first path begins where the last step ended */
        memcpy(s->previous, s->scene->state->position, 3 * (size_t)s->scene->model->node_count * sizeof *s->previous);
    }
    if (s->velocity != NULL) {
        memcpy(s->velocity, s->scene->state->velocity, 3 * (size_t)s->scene->model->node_count * sizeof *s->velocity);
    }
    cipc_status status = cipc_step(s->stepper, s->scene->state, &report, &s->error);
    if (status == CIPC_OK && s->monitor != NULL) {
        status = check_step(s, &report, &s->error);
    }
    cipc_run_summary_add(&s->summary, &report, s->monitor != NULL ? &s->seen : NULL);
    if (status == CIPC_OK) {
        status = write_step(s, &report, &s->error);
    } else if (!s->interrupted && cipc_status_exit(status) != 3) {
        cipc_simulation_write_state(s, "failed.obj", s->scene->state->position);
    }
    if (status == CIPC_OK) {
        s->summary.steps_taken = s->scene->state->step;
        s->summary.time = s->scene->state->time;
        show_progress(s, &report);
    }
    return status;
}

cipc_status cipc_simulation_steps(cipc_simulation *s)
{
    cipc_status status = CIPC_OK;
    cipc_stepper_set_monitor(s->stepper, look, s);
    if (s->ccd_record != NULL) {
        cipc_stepper_set_ccd_watch(s->stepper, cipc_ccd_record_search, s->ccd_record);
    }
    while (status == CIPC_OK && s->scene->state->step < s->scene->steps) {
        if (cipc_interrupt_seen()) {
            s->interrupted = true;
            break;
        }
        status = take_step(s);
    }
    if (!s->request->quiet && isatty(STDERR_FILENO)) {
        cipc_progress_clear(stderr);
    }
    return s->interrupted ? CIPC_OK : status;
}
