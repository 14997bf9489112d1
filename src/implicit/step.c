/* One time step: targets and predictor, contacts, stiffness, friction lag, Newton, new velocity (SPEC C.1, C.7). */
#include "implicit/stepper.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"

static cipc_status check_options(const cipc_implicit_options *o, cipc_error *error)
{
    struct { const char *name; double value; bool good; } checks[] = {
        {"time_step", o->time_step, o->time_step > 0},
        {"integrator.alpha", o->integrator.alpha, o->integrator.alpha > 0},
        {"integrator.beta", o->integrator.beta, o->integrator.beta > 0 && o->integrator.beta <= 1},
        {"integrator.gamma", o->integrator.gamma, o->integrator.gamma >= 0 && o->integrator.gamma < 1},
        {"newton.tolerance", o->newton_tolerance, o->newton_tolerance > 0},
        {"newton.iterations", o->newton_iterations, o->newton_iterations >= 1},
        {"newton.line_search_halvings", o->line_search_halvings, o->line_search_halvings >= 1},
        {"contact.friction_iterations", o->friction_iterations, o->friction_iterations >= 0},
        {"contact.friction_velocity", o->friction_velocity, o->friction_velocity > 0},
        {"contact.dhat", o->contact.dhat, o->contact.dhat > 0},
        {"contact.slackness", o->ccd.slackness, o->ccd.slackness > 0 && o->ccd.slackness < 1},
        {"contact.barrier_stiffness", o->barrier_stiffness, o->barrier_stiffness >= 0},
        {"threads", o->threads, o->threads >= 1},
    };
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++)
        if (!checks[i].good || !isfinite(checks[i].value))
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "options", "%s = %g is out of range", checks[i].name, checks[i].value);
    return CIPC_OK;
}

static cipc_status allocate(cipc_stepper *s, cipc_error *error)
{
    size_t n = (size_t)s->model->node_count;
    double **arrays[] = {&s->x_start, &s->x_hat, &s->x, &s->trial, &s->blend, &s->gradient, &s->direction, &s->target, &s->right, &s->solution,
                         &s->cache.reference};
    bool good = true;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) good = (*arrays[i] = cipc_alloc(3 * n, sizeof(double))) && good;
    s->is_dirichlet = cipc_alloc(n, sizeof(bool));
    s->moves = cipc_alloc(n, sizeof(bool));
    s->passive = cipc_alloc(n, sizeof(bool));
    s->free_index = cipc_alloc(n, sizeof(int));
    s->free_nodes = cipc_alloc(n, sizeof(int));
    if (good && s->is_dirichlet && s->moves && s->passive && s->free_index && s->free_nodes) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stepper", "no memory for %zu nodes", n);
}

/* Diagonal of the rest shapes' bounding box; mean nodal mass: of all nodes with the released rule, of nodes that may move otherwise. */
static void measure(cipc_stepper *s)
{
    const cipc_model *m = s->model;
    double lo[3], hi[3], mass = 0;
    int count = 0;
    v3_copy(lo, m->rest);
    v3_copy(hi, m->rest);
    for (int i = 0; i < m->node_count; i++) {
        for (int k = 0; k < 3; k++) {
            lo[k] = fmin(lo[k], m->rest[3 * i + k]);
            hi[k] = fmax(hi[k], m->rest[3 * i + k]);
        }
        if (!s->options.released && m->bodies[m->node_body[i]].fixed) continue;
        mass += m->mass[i];
        count++;
    }
    v3_sub(hi, hi, lo);
    s->bounding_box_diagonal = v3_norm(hi);
    s->mean_mass = count ? mass / count : m->mass[0];
}

/* What only another method knows would be left out silently. */
static cipc_status check_model(const cipc_model *model, cipc_error *error)
{
    if (model->load_count > 0) return cipc_fail(error, CIPC_E_WRONG_TYPE, "model", "it has loads, which the implicit method does not know");
    for (int b = 0; b < model->body_count; b++)
        if (model->bodies[b].material.membrane == CIPC_MEMBRANE_SPRINGS)
            return cipc_fail(error, CIPC_E_WRONG_TYPE, model->bodies[b].name, "its membrane is of springs, which the implicit method does not know");
    return CIPC_OK;
}

cipc_status cipc_stepper_create(cipc_stepper **stepper, const cipc_model *model, const cipc_implicit_options *options, cipc_error *error)
{
    *stepper = NULL;
    cipc_status status = check_options(options, error);
    if (!status) status = check_model(model, error);
    if (status) return status;
    cipc_stepper *s = cipc_alloc(1, sizeof *s);
    if (!s) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stepper", "no memory");
    s->model = model;
    s->options = *options;
    if (options->released) { /* SPEC R.1, R.2: choices that have no key of their own in a scene */
        s->options.contact.merge_directed = true;
        s->options.ccd.gap_first = true;
    }
    status = allocate(s, error);
    if (!status) status = cipc_elements_create(s, error);
    if (!status) status = cipc_broad_phase_create(&s->cache.broad_phase, model, error);
    if (!status) status = cipc_linear_solver_create(&s->solver, error);
    if (status) {
        cipc_stepper_destroy(s);
        return status;
    }
    measure(s);
    cipc_number_free_nodes(s);
    *stepper = s;
    return CIPC_OK;
}

void cipc_stepper_destroy(cipc_stepper *s)
{
    if (!s) return;
    cipc_elements_destroy(s);
    cipc_broad_phase_destroy(s->cache.broad_phase);
    cipc_candidates_free(&s->cache.candidates);
    cipc_contact_set_free(&s->contacts);
    cipc_contact_set_free(&s->trial_contacts);
    cipc_block_matrix_free(&s->matrix);
    cipc_linear_solver_destroy(s->solver);
    void *blocks[] = {s->x_start, s->x_hat, s->x, s->trial, s->blend, s->gradient, s->direction, s->target, s->right, s->solution, s->cache.reference,
                      s->is_dirichlet, s->moves, s->passive, s->free_index, s->free_nodes, s->friction.params, s->friction.nodes, s->damping.params, s->damping.nodes, s->static_slots, s->contact_slots,
                      s->kept_pairs, s->values, s->locals, s};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}

void cipc_stepper_set_monitor(cipc_stepper *s, cipc_monitor_callback *callback, void *context)
{
    s->monitor = callback;
    s->monitor_context = context;
}

static cipc_status reserve(double **block, size_t *capacity, size_t count, cipc_error *error)
{
    if (count <= *capacity) return CIPC_OK;
    double *larger = cipc_realloc(*block, count + count / 4, sizeof(double));
    if (!larger) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "stepper", "no memory for %zu numbers", count);
    *block = larger;
    *capacity = count + count / 4;
    return CIPC_OK;
}

cipc_status cipc_reserve_values(cipc_stepper *s, size_t count, cipc_error *error) { return reserve(&s->values, &s->value_capacity, count, error); }
cipc_status cipc_reserve_locals(cipc_stepper *s, size_t count, cipc_error *error) { return reserve(&s->locals, &s->local_capacity, count, error); }

cipc_status cipc_accept(cipc_stepper *s, int iteration, bool energy_valid, double before, double after, cipc_error *error)
{
    s->report->max_contacts = s->contacts.count > s->report->max_contacts ? s->contacts.count : s->report->max_contacts;
    /* A predictor's points are no states: nothing is promised of them. */
    if (!s->monitor || s->stage == CIPC_STAGE_PREDICT) return CIPC_OK;
    cipc_accepted_point point = {.x = s->x, .step = s->step, .iteration = iteration, .energy_valid = energy_valid, .energy_before = before,
                                 .energy_after = after, .energy_noise = s->noise};
    double begin = cipc_seconds();
    cipc_status status = s->monitor(s->monitor_context, &point, error);
    s->report->seconds[CIPC_PHASE_MONITOR] += cipc_seconds() - begin;
    return status;
}

/* xhat = x^n + h v^n + alpha beta h^2 g: with implicit Euler SPEC C.1's, with the midpoint rule the same force weight as the elastic energy's. */
static void predict(cipc_stepper *s, const cipc_state *state)
{
    const cipc_model *m = s->model;
    double h = s->options.time_step, weight = s->options.integrator.alpha * s->options.integrator.beta * h * h;
    for (int i = 0; i < m->node_count; i++)
        for (int k = 0; k < 3; k++)
            s->x_hat[3 * i + k] = s->x_start[3 * i + k] + h * state->velocity[3 * i + k] + weight * m->gravity[k];
}

/* kappa at the start of a step (SPEC D.4): fitted within its range; as released: once for all, then only doubled. */
static cipc_status choose_stiffness(cipc_stepper *s, cipc_error *error)
{
    if (s->options.released || s->options.barrier_stiffness > 0) {
        double first = s->options.barrier_stiffness;
        if (first == 0) first = cipc_barrier_stiffness_range_released(s->mean_mass, s->options.contact.dhat).minimum;
        if (s->kappa == 0) s->kappa = first;
        return cipc_contacts_at(s, s->x, &s->contacts, error);
    }
    double xi = 0, fitted;
    for (int b = 0; b < s->model->body_count; b++) xi = fmax(xi, s->model->bodies[b].offset);
    cipc_stiffness_range range = cipc_barrier_stiffness_range(s->bounding_box_diagonal, s->mean_mass, xi, s->options.contact.dhat);
    s->kappa = range.minimum;
    cipc_status status = cipc_contacts_at(s, s->x, &s->contacts, error);
    if (!status) status = cipc_fit_stiffness(s, &fitted, error);
    if (status) return status;
    s->kappa = fmin(fmax(fitted, range.minimum), range.maximum);
    for (int i = 0; i < s->contacts.count; i++) s->contacts.contacts[i].barrier.stiffness = s->kappa;
    return CIPC_OK;
}

/* Minimise, with friction data lagged again from each solution as often as asked. The last Newton step with the last data tells convergence. */
static cipc_status minimise(cipc_stepper *s, cipc_error *error)
{
    int asked = s->options.friction_iterations, cap = asked > 0 ? asked : s->options.friction_cap;
    for (int pass = 0; pass < cap; pass++) {
        int before = s->report->newton_iterations;
        /* The predictor has had its friction. */
        cipc_status status = s->stage == CIPC_STAGE_PROJECT ? CIPC_OK : cipc_friction_lag(s, error);
        if (!status) status = cipc_newton(s, error);
        if (status) return status;
        s->report->friction_passes = pass + 1;
        /* With new friction data one step sufficed: normal forces and sliding agree. */
        bool agrees = pass > 0 && s->report->newton_iterations - before == 1;
        if (s->friction.count == 0 || agrees) return CIPC_OK;
    }
    if (asked > 0) return CIPC_OK;
    char place[64];
    (void)snprintf(place, sizeof place, "step %d", s->step);
    cipc_fail(error, CIPC_E_NOT_CONVERGED, place, "friction forces do not settle in %d lagging passes", cap);
    return cipc_fail_remedy(error, "ask for a fixed number of contact.friction_iterations");
}

/* v^{n+1} = (x^{n+1} - x^n)/(beta h) - (1 - beta)/beta v^n: implicit Euler's and the midpoint rule's velocity. */
static void finish_state(const cipc_stepper *s, cipc_state *state)
{
    double h = s->options.time_step, beta = s->options.integrator.beta;
    for (int i = 0; i < 3 * s->model->node_count; i++) {
        double average = (s->x[i] - s->x_start[i]) / h;
        bool prescribed = s->is_dirichlet[i / 3];
        if (s->options.quasistatic) average = 0;
        state->velocity[i] = s->options.quasistatic || prescribed || beta == 1 ? average : average / beta - (1 - beta) / beta * state->velocity[i];
    }
    state->step++;
    state->time = state->step * h;
}

/* Psi at the end of the step: with the midpoint rule E has it in the middle. */
static cipc_status elastic_energy(cipc_stepper *s, double *elastic, cipc_error *error)
{
    const cipc_integrator euler = {1, 1, 0}, own = s->options.integrator;
    cipc_energy_terms terms = s->report->incremental;
    cipc_status status = CIPC_OK;
    s->options.integrator = euler;
    if (own.beta != 1 || own.alpha != 1) status = cipc_potential_value(s, s->x, &s->contacts, &terms, error);
    s->options.integrator = own;
    *elastic = (terms.membrane + terms.bending + terms.stretching + terms.volume + terms.stitches + terms.strain_limit) / (s->options.time_step * s->options.time_step);
    return status;
}

/* Energies of the state reached, for the statistics. */
static cipc_status physical_energies(cipc_stepper *s, const cipc_state *state, cipc_error *error)
{
    cipc_step_report *r = s->report;
    cipc_status status = cipc_potential_value(s, s->x, &s->contacts, &r->incremental, error);
    if (!status) status = elastic_energy(s, &r->elastic, error);
    for (int k = 0; k < s->free_count; k++) {
        int i = s->free_nodes[k];
        r->kinetic += 0.5 * s->model->mass[i] * v3_norm2(state->velocity + 3 * i);
        r->gravitational -= s->model->mass[i] * v3_dot(s->model->gravity, s->x + 3 * i);
    }
    return status;
}

/* From x^n: scripted motion, contacts, stiffness, then the minimum of the present stage's E. */
static cipc_status solve(cipc_stepper *s, double time, cipc_error *error)
{
    memcpy(s->x, s->x_start, 3 * (size_t)s->model->node_count * sizeof(double));
    s->noise = 0;
    s->friction.count = 0;
    s->contacts.count = 0;
    memset(&s->limit, 0, sizeof s->limit);
    cipc_status status = cipc_dirichlet_begin(s, time, error);
    if (!status) status = cipc_cache_cover(s, s->x, NULL, error);
    if (!status) status = choose_stiffness(s, error);
    return status ? status : minimise(s, error);
}

/* Split limits: the predictor may leave the limits; the projection starts from x^n again, which keeps them, and goes as near to the predictor as they and contact let it. */
static cipc_status solve_split(cipc_stepper *s, double time, cipc_error *error)
{
    s->stage = CIPC_STAGE_PREDICT;
    cipc_status status = solve(s, time, error);
    if (status) {
        memcpy(s->x, s->x_start, 3 * (size_t)s->model->node_count * sizeof(double)); /* the last point that keeps the limits */
        return status;
    }
    memcpy(s->x_hat, s->x, 3 * (size_t)s->model->node_count * sizeof(double));
    s->stage = CIPC_STAGE_PROJECT;
    return solve(s, time, error);
}

static cipc_status take_step(cipc_stepper *s, cipc_state *state, cipc_error *error)
{
    memcpy(s->x_start, state->position, 3 * (size_t)s->model->node_count * sizeof(double));
    s->kappa = state->barrier_stiffness;
    s->strain_factor = state->strain_stiffness_factor;
    s->step = state->step;
    predict(s, state);
    cipc_status damped = cipc_damping_lag(s, error);
    if (damped) {
        memcpy(s->x, s->x_start, 3 * (size_t)s->model->node_count * sizeof(double));
        return damped;
    }
    bool split = s->options.strain_coupling == CIPC_STRAIN_SPLIT &&
                 s->groups[CIPC_GROUP_STRAIN_LIMIT].count + s->groups[CIPC_GROUP_STRAIN_LIMIT_LOWER].count > 0;
    cipc_status status = split ? solve_split(s, state->time, error) : solve(s, state->time, error);
    s->stage = CIPC_STAGE_WHOLE;
    if (split) predict(s, state); /* E is reported as of the whole step, not as of the projection */
    return status;
}

static void fill_report(const cipc_stepper *s, cipc_step_report *r, double seconds)
{
    r->contacts = s->contacts.count;
    r->barrier_stiffness = s->kappa;
    r->strain_stiffness_factor = s->strain_factor;
    r->min_gap = s->contacts.count ? s->contacts.min_gap : INFINITY;
    double accounted = 0;
    for (int p = 0; p < CIPC_PHASE_COUNT; p++)
        if (p != CIPC_PHASE_OTHER) accounted += r->seconds[p];
    r->seconds[CIPC_PHASE_OTHER] = seconds - accounted;
}

cipc_status cipc_step(cipc_stepper *s, cipc_state *state, cipc_step_report *report, cipc_error *error)
{
    double begin = cipc_seconds();
    memset(report, 0, sizeof *report);
    s->report = report;
    cipc_status status = take_step(s, state, error);
    state->barrier_stiffness = s->kappa;
    state->strain_stiffness_factor = s->strain_factor;
    if (!status) {
        finish_state(s, state);
        status = physical_energies(s, state, error);
        report->converged = !status;
    }
    memcpy(state->position, s->x, 3 * (size_t)s->model->node_count * sizeof(double));
    fill_report(s, report, cipc_seconds() - begin);
    s->report = NULL;
    return status;
}
