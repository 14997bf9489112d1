/* The loop of src/cli (simulation.c, steps.c) without its files: load, check the start, step; what each method does is in scene_run_implicit.c,
 * scene_run_asynchronous.c and scene_run_massspring.c. */
#include "support/scene_running.h"

#include <math.h>
#include <string.h>

void scene_outcome_free(scene_outcome *outcome)
{
    cipc_free(outcome->position);
    cipc_free(outcome->velocity);
    memset(outcome, 0, sizeof *outcome);
}

void scene_take_in(scene_running *r, const cipc_invariant_report *report)
{
    scene_outcome *o = r->outcome;
    o->points++;
    r->seen = *report;
    o->min_gap = fmin(o->min_gap, report->min_gap);
    o->max_stretch = fmax(o->max_stretch, report->max_stretch);
    o->max_stretch_ratio = fmax(o->max_stretch_ratio, report->max_stretch_ratio);
    o->exact_gap_checks += report->exact_gap_checks;
    o->exact_strain_checks += report->exact_strain_checks;
    o->paths_checked += report->paths_checked;
    o->exact_path_checks += report->exact_path_checks;
}

static const scene_method *method_of(cipc_method method)
{
    return method == CIPC_METHOD_ASYNCHRONOUS ? &scene_asynchronous : method == CIPC_METHOD_MASS_SPRING ? &scene_massspring : &scene_implicit;
}

/* ---- The start -------------------------------------------------------------------------------------------------------------- */

/* A number in [-1, 1) from a linear congruential generator (Knuth's MMIX constants): the same on every machine. */
static double draw(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-52 - 1;
}

/* Choose the probes, and displace the nodes that are free during the first step. */
static cipc_status prepare_nodes(scene_running *r, double jitter, unsigned long seed, cipc_error *error)
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

static cipc_status open_run(scene_running *r, const scene_request *request, cipc_error *error)
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
    if (status == CIPC_OK) {
        r->method = method_of(scene->method);
        status = r->method->begin(r, error);
    }
    return status;
}

/* ---- The steps, and the end --------------------------------------------------------------------------------------------------- */

static cipc_status take_step(scene_running *r, const scene_request *request, cipc_error *error)
{
    scene_outcome *o = r->outcome;
    const cipc_status status = r->method->take(r, error);
    if (status == CIPC_OK) {
        o->steps = r->scene->state->step;
        o->max_step_stretch = fmax(o->max_step_stretch, r->seen.max_stretch);
        r->stopped = request->watch != NULL && !request->watch(request->context, o->steps, &o->last);
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

static void begin_outcome(const scene_running *r)
{
    scene_outcome *o = r->outcome;
    const cipc_model *m = r->scene->model;
    o->min_gap = INFINITY;
    o->method = r->scene->method;
    o->time_step = r->scene->options.time_step;
    o->tolerance = r->scene->options.newton_tolerance;
    for (int b = 0; b < m->body_count; b++) {
        const double limit = m->bodies[b].material.strain_limit;
        o->stretch_limit = limit > 0 && (o->stretch_limit == 0 || limit < o->stretch_limit) ? limit : o->stretch_limit;
    }
}

static cipc_status finish_outcome(const scene_running *r, const double start[3], cipc_error *error)
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

static void close_run(scene_running *r)
{
    if (r->method != NULL) {
        r->method->end(r);
    }
    cipc_monitor_destroy(r->monitor);
    cipc_free(r->previous);
    cipc_scene_destroy(r->scene);
}

cipc_status scene_run(const scene_request *request, scene_outcome *outcome, cipc_error *error)
{
    memset(outcome, 0, sizeof *outcome);
    scene_running r = {.outcome = outcome};
    double start[3] = {0};
    cipc_status status = open_run(&r, request, error);
    if (status == CIPC_OK) {
        begin_outcome(&r);
        centre_of_mass(r.scene->model, r.scene->state->position, start, &outcome->moving_mass);
    }
    while (status == CIPC_OK && !r.stopped && r.scene->state->step < r.scene->steps) {
        status = take_step(&r, request, error);
    }
    if (status == CIPC_OK) {
        status = finish_outcome(&r, start, error);
    }
    close_run(&r);
    return status;
}
