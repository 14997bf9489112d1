/* The loop of src/cli (simulation.c, steps.c) without its files: load, check the start, step, look at every accepted point. */
#include "support/scene_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/invariant.h"

void scene_outcome_free(scene_outcome *outcome)
{
    cipc_free(outcome->position);
    cipc_free(outcome->velocity);
    memset(outcome, 0, sizeof *outcome);
}

/* A run under way. */
typedef struct run {
    cipc_scene *scene;
    cipc_monitor *monitor;
    cipc_stepper *stepper;
    scene_outcome *outcome;
    long points_of_step;
    cipc_invariant_report seen; /* at the last accepted point */
    bool stopped;         /* the watcher has seen enough */
    double *previous;     /* the point accepted before: where the next path begins */
} run;

/* ---- The monitors ----------------------------------------------------------------------------------------------------------- */

static cipc_status at_point(const cipc_accepted_point *point, cipc_error *error)
{
    char place[sizeof error->place], remedy[sizeof error->remedy];
    snprintf(place, sizeof place, "step %d, iteration %d, %.400s", point->step + 1, point->iteration + 1, error->place);
    snprintf(remedy, sizeof remedy, "%s", error->remedy);
    cipc_fail(error, error->status, place, "%s", error->what);
    return cipc_fail_remedy(error, "%s", remedy);
}

static void take_in(run *r, const cipc_invariant_report *report)
{
    scene_outcome *o = r->outcome;
    o->points++;
    r->points_of_step++;
    r->seen = *report;
    o->min_gap = fmin(o->min_gap, report->min_gap);
    o->max_stretch = fmax(o->max_stretch, report->max_stretch);
    o->max_stretch_ratio = fmax(o->max_stretch_ratio, report->max_stretch_ratio);
    o->exact_gap_checks += report->exact_gap_checks;
    o->exact_strain_checks += report->exact_strain_checks;
    o->paths_checked += report->paths_checked;
    o->exact_path_checks += report->exact_path_checks;
}

/* M6, then M8, M1 to M4, and M5 (docs/monitors.md). */
static cipc_status look(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    run *r = context;
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

/* ---- The start -------------------------------------------------------------------------------------------------------------- */

/* A number in [-1, 1) from a linear congruential generator (Knuth's MMIX constants): the same on every machine. */
static double draw(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-52 - 1;
}

/* Choose the probes, and displace the nodes that are free during the first step. */
static cipc_status prepare_nodes(run *r, double jitter, unsigned long seed, cipc_error *error)
{
    const cipc_model *m = r->scene->model;
    cipc_state *state = r->scene->state;
    cipc_status status = CIPC_OK;
    bool *held = cipc_alloc((size_t)m->node_count, sizeof *held);
    double *target = cipc_alloc(3 * (size_t)m->node_count, sizeof *target);
    if (held != NULL && target != NULL) {
        cipc_dirichlet_targets(m, state->position, 0, r->scene->options.time_step, held, target, NULL);
        scene_probes(m, held, r->outcome->probe);
        unsigned long long generator = seed;
        for (int i = 0; i < 3 * m->node_count; i++) {
            const double offset = jitter * draw(&generator);
            state->position[i] += held[i / 3] ? 0 : offset;
        }
    } else {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "scene_run", "no memory for %d nodes", m->node_count);
    }
    cipc_free(held);
    cipc_free(target);
    return status;
}

static cipc_status open_run(run *r, const scene_request *request, cipc_error *error)
{
    int count = 0;
    while (request->overrides[count] != NULL) {
        count++;
    }
    cipc_status status = cipc_scene_load(&r->scene, request->file, count, request->overrides, error);
    if (status != CIPC_OK) {
        return status;
    }
    cipc_scene *scene = r->scene;
    scene->options.threads = request->threads;
    scene->options.newton_tolerance *= request->tolerance_factor > 0 ? request->tolerance_factor : 1;
    status = prepare_nodes(r, request->jitter, request->jitter_seed, error);
    if (status != CIPC_OK) {
        return status;
    }
    cipc_invariant_options options = cipc_invariant_options_default();
    options.reach = scene->monitor_reach;
    options.threads = request->threads;
    status = cipc_monitor_create(&r->monitor, scene->model, &options, error);
    if (status == CIPC_OK) {
        status = cipc_monitor_check(r->monitor, scene->state->position, NULL, error);
    }
    r->previous = cipc_alloc(3 * (size_t)scene->model->node_count, sizeof *r->previous);
    if (status == CIPC_OK && r->previous == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "scene_run", "no memory for the start of a path");
    }
    if (status == CIPC_OK) {
        status = cipc_stepper_create(&r->stepper, scene->model, &scene->options, error);
    }
    return status;
}

/* ---- The steps -------------------------------------------------------------------------------------------------------------- */

/* What a good step left. */
static void record_step(run *r, const cipc_step_report *report, const scene_request *request)
{
    scene_outcome *o = r->outcome;
    const cipc_scene *scene = r->scene;
    const scene_step step = {scene->model, scene->state->position, o->probe, report, &r->seen, scene->monitor_reach, o->last.newton_iterations[0]};
    o->last = scene_frame_of(&step);
    o->steps = scene->state->step;
    o->max_step_stretch = fmax(o->max_step_stretch, r->seen.max_stretch);
    o->max_contacts = report->max_contacts > o->max_contacts ? report->max_contacts : o->max_contacts;
    o->max_friction = fmax(o->max_friction, report->incremental.friction);
    r->stopped = request->watch != NULL && !request->watch(request->context, o->steps, &o->last);
}

static cipc_status take_step(run *r, const scene_request *request, cipc_error *error)
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
        record_step(r, &report, request);
    }
    return status;
}

static void centre_of_mass(const cipc_model *model, const double *x, double centre[3], double *mass)
{
    *mass = centre[0] = centre[1] = centre[2] = 0;
    for (int i = 0; i < model->node_count; i++) {
        if (scene_node_moves(model, i)) {
            *mass += model->mass[i];
            for (int k = 0; k < 3; k++) {
                centre[k] += model->mass[i] * x[3 * i + k];
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        centre[k] /= *mass;
    }
}

static void begin_outcome(const run *r)
{
    scene_outcome *o = r->outcome;
    const cipc_model *m = r->scene->model;
    o->min_gap = INFINITY;
    o->time_step = r->scene->options.time_step;
    o->tolerance = r->scene->options.newton_tolerance;
    for (int b = 0; b < m->body_count; b++) {
        const double limit = m->bodies[b].material.strain_limit;
        o->stretch_limit = limit > 0 && (o->stretch_limit == 0 || limit < o->stretch_limit) ? limit : o->stretch_limit;
    }
}

static cipc_status finish_outcome(const run *r, const double start[3], cipc_error *error)
{
    scene_outcome *o = r->outcome;
    const cipc_model *m = r->scene->model;
    const cipc_state *state = r->scene->state;
    double end[3], drift[3];
    centre_of_mass(m, state->position, end, &o->moving_mass);
    centre_of_mass(m, state->velocity, drift, &o->moving_mass);
    o->travel = hypot(hypot(end[0] - start[0], end[1] - start[1]), end[2] - start[2]);
    o->speed = hypot(hypot(drift[0], drift[1]), drift[2]);
    const size_t size = 3 * (size_t)m->node_count;
    o->node_count = m->node_count;
    o->position = cipc_alloc(size, sizeof(double));
    o->velocity = cipc_alloc(size, sizeof(double));
    if (o->position == NULL || o->velocity == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "scene_run", "no memory for %d nodes", m->node_count);
    }
    memcpy(o->position, state->position, size * sizeof(double));
    memcpy(o->velocity, state->velocity, size * sizeof(double));
    return CIPC_OK;
}

cipc_status scene_run(const scene_request *request, scene_outcome *outcome, cipc_error *error)
{
    memset(outcome, 0, sizeof *outcome);
    run r = {.outcome = outcome};
    double start[3] = {0};
    cipc_status status = open_run(&r, request, error);
    if (status == CIPC_OK) {
        begin_outcome(&r);
        centre_of_mass(r.scene->model, r.scene->state->position, start, &outcome->moving_mass);
        cipc_stepper_set_monitor(r.stepper, look, &r);
    }
    while (status == CIPC_OK && !r.stopped && r.scene->state->step < r.scene->steps) {
        status = take_step(&r, request, error);
    }
    if (status == CIPC_OK) {
        status = finish_outcome(&r, start, error);
    }
    cipc_stepper_destroy(r.stepper);
    cipc_monitor_destroy(r.monitor);
    cipc_free(r.previous);
    cipc_scene_destroy(r.scene);
    return status;
}
