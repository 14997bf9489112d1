/* The steps of the method c-ipc: what the monitors look at, and what is told of a step. */
#include "cli/steps.h"

#include <math.h>
#include <string.h>
#include "cli/command.h"

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

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

/* Name the point; the state goes to files if an invariant is broken. */
static cipc_status report_violation(cipc_simulation *s, const cipc_accepted_point *point, const cipc_invariant_report *report,
                                    cipc_error *error)
{
    char where[64];
    if (point->iteration < 0) {
        snprintf(where, sizeof where, "step %d, scripted motion", point->step + 1);
    } else {
        snprintf(where, sizeof where, "step %d, iteration %d", point->step + 1, point->iteration + 1);
    }
    cipc_steps_found_at(error, where);
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
    const cipc_status status = cipc_steps_interrupted(s, error);
    return status != CIPC_OK ? status : s->monitor != NULL ? check_point(s, point, error) : CIPC_OK;
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

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

static cipc_status create(cipc_simulation *s, cipc_error *error)
{
    return cipc_stepper_create(&s->stepper, s->scene->model, &s->scene->options, error);
}

static void begin(cipc_simulation *s)
{
    cipc_stepper_set_monitor(s->stepper, look, s);
    if (s->ccd_record != NULL) {
        cipc_stepper_set_ccd_watch(s->stepper, cipc_ccd_record_search, s->ccd_record);
    }
}

static cipc_status take(cipc_simulation *s)
{
    if (s->previous != NULL) { /* the step's first path begins where the last step ended */
        memcpy(s->previous, s->scene->state->position, 3 * (size_t)s->scene->model->node_count * sizeof *s->previous);
    }
    cipc_status status = cipc_step(s->stepper, s->scene->state, &s->report, &s->error);
    if (status == CIPC_OK && s->monitor != NULL) {
        status = check_step(s, &s->report, &s->error);
    }
    cipc_run_summary_add(&s->summary, &s->report, s->monitor != NULL ? &s->seen : NULL);
    return status;
}

/* ---- What is told of them --------------------------------------------------------------------------------------------------- */

static cipc_status write_line(cipc_simulation *s, cipc_error *error)
{
    return cipc_stats_write(s->stats, s->scene->state, &s->report, s->monitor != NULL ? &s->seen : NULL, error);
}

static void show_line(const cipc_simulation *s, double seconds_left)
{
    const bool monitored = s->monitor != NULL;
    const double stretch = fmax(s->seen.worst.max_stretch, s->seen.max_segment_stretch);
    cipc_progress_line(stderr, s->scene->state->step, s->scene->steps, s->scene->state->time, s->report.newton_iterations, s->report.contacts,
                       monitored ? s->seen.worst.min_gap : s->report.min_gap, monitored ? stretch : NAN, seconds_left);
}

/* The tightest limit of any body; 0: none is limited. */
static double smallest_strain_limit(const cipc_model *model)
{
    double smallest = 0;
    for (int b = 0; b < model->body_count; b++) {
        const double limit = model->bodies[b].material.strain_limit;
        if (limit > 0 && (smallest == 0 || limit < smallest)) {
            smallest = limit;
        }
    }
    return smallest;
}

static cipc_status plot(const cipc_simulation *s, const char *plots, const char *stats, cipc_error *error)
{
    return cipc_plots_png(plots, stats, smallest_strain_limit(s->scene->model), s->scene->options.contact.dhat, error);
}

const cipc_steps cipc_implicit_steps = {create, begin, take, write_line, show_line, plot};
