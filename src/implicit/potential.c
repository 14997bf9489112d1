/* The incremental potential E (SPEC C.1): value, gradient, and the bound on its rounding error.
 *
 * Rounding. Each term is evaluated in some tens of operations on numbers no larger than its own intermediate values, so its error is at most
 * C u (|e_k| + sum_i |g_i . (y_i - y_0)| + s_k), u = 2^-53: the first part is the relative error of the result, the second what a relative error of
 * the position differences does, the third the size s_k of terms that cancel inside (tr C - 2 - 2 ln J in a membrane: V (mu + lambda);
 * theta^2 in a hinge: its stiffness; the displacements of a friction contact's nodes, which may slide along together). For elements and friction the third
 * part outweighs the first, which is left out. C = 32 covers the longest chain, a line-line distance inside a mollified barrier. The sum over terms is
 * compensated and adds no more than 2u|E| (docs/theory/time_step.md, eq. 12). */
#include "implicit/stepper.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vector.h"

static const double rounding_chain = 32;

static double scale_of_elastic(const cipc_stepper *s)
{
    double h = s->options.time_step;
    return s->options.integrator.alpha * h * h;
}

/* With split limits the predictor has no limits, and the projection nothing but limits, besides inertia and contact. */
static bool takes_part(const cipc_stepper *s, bool limit)
{
    return s->stage == CIPC_STAGE_WHOLE || limit == (s->stage == CIPC_STAGE_PROJECT);
}

void cipc_term_lists(const cipc_stepper *s, const cipc_contact_set *contacts, cipc_term_list lists[CIPC_LIST_COUNT])
{
    double elastic = scale_of_elastic(s), beta = s->options.integrator.beta;
    memset(lists, 0, CIPC_LIST_COUNT * sizeof *lists);
    for (int g = 0; g < CIPC_GROUP_COUNT; g++) {
        const cipc_element_group *group = &s->groups[g];
        /* The strain limit is a constraint on the iterate itself, so it sees x, not the blend; the factor beta gives it the same force scale. */
        bool limit = cipc_is_strain_limit(g);
        cipc_term_list list = {.energy = group->energy, .count = group->count, .params = group->params, .params_stride = group->energy->params_size,
                               .nodes = (const char *)group->nodes, .nodes_stride = (size_t)group->energy->nodes * sizeof(int),
                               .scale = limit ? elastic * beta * s->strain_factor : elastic, .chain = limit ? 1 : beta, .blended = !limit};
        if (!takes_part(s, limit)) list.count = 0;
        lists[g] = list;
    }
    cipc_term_list contact = {.count = contacts->count, .params = (const char *)contacts->contacts, .params_stride = sizeof *contacts->contacts,
                              .nodes = contacts->count ? (const char *)contacts->contacts->nodes : NULL, .nodes_stride = sizeof *contacts->contacts,
                              .scale = 1, .chain = 1};
    lists[CIPC_LIST_CONTACT] = contact;
    cipc_term_list friction = {.energy = cipc_energy_entry(CIPC_ENERGY_FRICTION), .count = s->friction.count, .params = (const char *)s->friction.params,
                               .params_stride = sizeof *s->friction.params, .nodes = (const char *)s->friction.nodes,
                               .nodes_stride = sizeof *s->friction.nodes, .scale = 1, .chain = 1, .convex = true};
    lists[CIPC_LIST_FRICTION] = friction;
    cipc_term_list damping = {.energy = cipc_energy_entry(CIPC_ENERGY_DAMPING), .count = s->stage == CIPC_STAGE_PROJECT ? 0 : s->damping.count,
                              .params = (const char *)s->damping.params, .params_stride = sizeof *s->damping.params, .nodes = (const char *)s->damping.nodes,
                              .nodes_stride = sizeof *s->damping.nodes, .scale = elastic * beta, .chain = 1, .convex = true};
    lists[CIPC_LIST_DAMPING] = damping;
}

static void gather(const double *x, const int *nodes, int count, double *y)
{
    for (int i = 0; i < count; i++) v3_copy(y + 3 * i, x + 3 * nodes[i]);
}

/* Neumaier's compensated sum: its error does not grow with the number of terms. */
typedef struct compensated { double sum, lost; } compensated;
static void add(compensated *c, double value)
{
    double sum = c->sum + value;
    c->lost += fabs(c->sum) >= fabs(value) ? (c->sum - sum) + value : (value - sum) + c->sum;
    c->sum = sum;
}
static double total(const compensated *c) { return isfinite(c->sum) ? c->sum + c->lost : INFINITY; }

static void blend_positions(const cipc_stepper *s, const double *x, double *blend)
{
    double beta = s->options.integrator.beta, gamma = s->options.integrator.gamma;
    for (int i = 0; i < 3 * s->model->node_count; i++) blend[i] = beta == 1 ? x[i] : beta * x[i] + gamma * s->x_start[i];
}

/* Values of a list into slots of their own, then summed in order: the same sum for any number of threads. */
static double list_value(cipc_stepper *s, const cipc_term_list *list, const double *x)
{
    const double *positions = list->blended ? s->blend : x;
#pragma omp parallel for schedule(static) num_threads(s->options.threads)
    for (int i = 0; i < list->count; i++) {
        double y[12];
        const cipc_energy *energy = cipc_term_energy(list, i);
        gather(positions, cipc_term_nodes(list, i), energy->nodes, y);
        s->values[i] = list->scale * energy->value(y, cipc_term_params(list, i));
    }
    compensated sum = {0, 0};
    for (int i = 0; i < list->count; i++) add(&sum, s->values[i]);
    return total(&sum);
}

/* An equilibrium has weight instead of inertia: -h^2 m g.x. The distance that the projection of a split step minimises is inertia's in any case. */
static bool has_weight(const cipc_stepper *s) { return s->options.quasistatic && s->stage != CIPC_STAGE_PROJECT; }

static cipc_gravity weight_of(const cipc_stepper *s, int node)
{
    cipc_gravity params = {.mass = scale_of_elastic(s) * s->options.integrator.beta * s->model->mass[node]};
    v3_copy(params.acceleration, s->model->gravity);
    return params;
}

/* Nodes whose inertia enters E: the free ones, and with the released code's convention the fixed ones too (their term is constant). */
static bool has_inertia(const cipc_stepper *s, int node) { return s->options.released || !s->is_dirichlet[node]; }

static cipc_inertia inertia_of(const cipc_stepper *s, int node)
{
    cipc_inertia params = {.mass = s->model->mass[node]};
    v3_copy(params.target, s->x_hat + 3 * node);
    return params;
}

/* Mass-proportional Rayleigh damping, a h/2 m |x - x^n|^2: the force -a m (x - x^n)/h. */
static cipc_inertia drag_of(const cipc_stepper *s, int node)
{
    cipc_inertia params = {.mass = cipc_drag_mass(s, node)};
    v3_copy(params.target, s->x_start + 3 * node);
    return params;
}

static bool is_penalised(const cipc_stepper *s, int node) { return s->penalty > 0 && s->moves[node] && !s->is_dirichlet[node]; }

static cipc_dirichlet_penalty penalty_of(const cipc_stepper *s, int node)
{
    cipc_dirichlet_penalty params = {.stiffness = s->penalty, .mass = s->model->mass[node]};
    v3_copy(params.target, s->target + 3 * node);
    return params;
}

/* Inertia or weight of a node, and mass-proportional damping. */
static double node_value(const cipc_stepper *s, int i, const double y[3])
{
    cipc_inertia drag = drag_of(s, i);
    double value = drag.mass > 0 ? cipc_inertia_value(y, &drag) : 0;
    if (has_weight(s)) {
        cipc_gravity weight = weight_of(s, i);
        return value + cipc_gravity_value(y, &weight);
    }
    cipc_inertia inertia = inertia_of(s, i);
    return value + cipc_inertia_value(y, &inertia);
}

static void node_values(const cipc_stepper *s, const double *x, double *inertia, double *penalty)
{
    compensated sum = {0, 0}, penalties = {0, 0};
    for (int i = 0; i < s->model->node_count; i++) {
        if (has_inertia(s, i)) add(&sum, node_value(s, i, x + 3 * i));
        if (is_penalised(s, i)) {
            cipc_dirichlet_penalty params = penalty_of(s, i);
            add(&penalties, cipc_dirichlet_penalty_value(x + 3 * i, &params));
        }
    }
    *inertia = total(&sum);
    *penalty = total(&penalties);
}

static int largest_count(const cipc_term_list lists[CIPC_LIST_COUNT])
{
    int most = 1;
    for (int l = 0; l < CIPC_LIST_COUNT; l++)
        if (lists[l].count > most) most = lists[l].count;
    return most;
}

cipc_status cipc_potential_value(cipc_stepper *s, const double *x, const cipc_contact_set *contacts, cipc_energy_terms *terms, cipc_error *error)
{
    cipc_term_list lists[CIPC_LIST_COUNT];
    double value[CIPC_LIST_COUNT];
    cipc_term_lists(s, contacts, lists);
    cipc_status status = cipc_reserve_values(s, (size_t)largest_count(lists), error);
    if (status) return status;
    blend_positions(s, x, s->blend);
    for (int l = 0; l < CIPC_LIST_COUNT; l++) value[l] = list_value(s, &lists[l], x);
    node_values(s, x, &terms->inertia, &terms->penalty);
    terms->membrane = value[CIPC_GROUP_NEO_HOOKEAN] + value[CIPC_GROUP_STVK] + value[CIPC_GROUP_ORTHOTROPIC];
    terms->bending = value[CIPC_GROUP_HINGE] + value[CIPC_GROUP_ROD_BENDING];
    terms->stretching = value[CIPC_GROUP_ROD_STRETCHING];
    terms->volume = value[CIPC_GROUP_COROTATIONAL] + value[CIPC_GROUP_VOLUME_NEO_HOOKEAN];
    terms->stitches = value[CIPC_GROUP_STITCH];
    terms->strain_limit = value[CIPC_GROUP_STRAIN_LIMIT] + value[CIPC_GROUP_STRAIN_LIMIT_LOWER];
    terms->barrier = value[CIPC_LIST_CONTACT];
    terms->friction = value[CIPC_LIST_FRICTION];
    terms->damping = value[CIPC_LIST_DAMPING];
    terms->total = terms->inertia + terms->membrane + terms->bending + terms->strain_limit + terms->barrier + terms->friction + terms->penalty +
                   terms->damping + terms->stretching + terms->volume + terms->stitches;
    terms->noise = s->noise;
    return CIPC_OK;
}

/* Size of the terms that cancel inside an energy at y, see the head of the file. */
static double cancelling_size(int list, const void *params, const double *y)
{
    if (list == CIPC_GROUP_HINGE) return ((const cipc_hinge_bending *)params)->stiffness;
    if (list == CIPC_GROUP_NEO_HOOKEAN || list == CIPC_GROUP_STVK) {
        const cipc_membrane *m = params;
        return m->volume * (m->mu + fabs(m->lambda));
    }
    if (list == CIPC_GROUP_ORTHOTROPIC) {
        const cipc_orthotropic *m = params;
        return m->volume * (m->a11 + fabs(m->a12) + m->a22 + m->g12);
    }
    if (list == CIPC_GROUP_ROD_BENDING) {
        const cipc_rod_bending *rod = params;
        return rod->stiffness * (1 + rod->rest_curvature);
    }
    if (list == CIPC_GROUP_COROTATIONAL || list == CIPC_GROUP_VOLUME_NEO_HOOKEAN) {
        const cipc_volume *m = params;
        return m->volume * (m->mu + fabs(m->lambda));
    }
    if (list == CIPC_LIST_FRICTION) {
        const cipc_friction *f = params;
        double slide = f->eps;
        for (int k = 0; k < 12; k++) slide += fabs(f->weights[k / 3] * (y[k] - f->start[k]));
        return f->coefficient * slide;
    }
    return 0;
}

/* Local gradients of a list (12 doubles each) and its contribution to the noise. */
static void list_gradients(cipc_stepper *s, int which, const cipc_term_list *list)
{
    const double *positions = list->blended ? s->blend : s->x;
#pragma omp parallel for schedule(static) num_threads(s->options.threads)
    for (int i = 0; i < list->count; i++) {
        double y[12], *g = s->locals + 12 * (size_t)i;
        const cipc_energy *energy = cipc_term_energy(list, i);
        const void *params = cipc_term_params(list, i);
        gather(positions, cipc_term_nodes(list, i), energy->nodes, y);
        energy->gradient(y, params, g);
        double size = cancelling_size(which, params, y);
        if (which == CIPC_LIST_CONTACT) size += energy->value(y, params); /* its logarithm may outgrow its gradient's part */
        for (int k = 0; k < 3 * energy->nodes; k++) size += fabs(g[k] * (y[k] - y[k % 3]));
        s->values[i] = list->scale * size;
        for (int k = 0; k < 3 * energy->nodes; k++) g[k] *= list->scale * list->chain;
    }
}

static void scatter_gradients(cipc_stepper *s, const cipc_term_list *list, double *gradient)
{
    for (int i = 0; i < list->count; i++) {
        const int *nodes = cipc_term_nodes(list, i);
        int count = cipc_term_energy(list, i)->nodes;
        for (int k = 0; k < count; k++) v3_axpy(gradient + 3 * nodes[k], 1, s->locals + 12 * (size_t)i + 3 * k);
        s->noise += s->values[i];
    }
}

static void add_node_gradient(cipc_stepper *s, int i, double *gradient)
{
    double g[3];
    cipc_inertia drag = drag_of(s, i);
    if (drag.mass > 0) {
        cipc_inertia_gradient(s->x + 3 * i, &drag, g);
        v3_axpy(gradient + 3 * i, 1, g);
    }
    if (has_weight(s)) {
        cipc_gravity weight = weight_of(s, i);
        cipc_gravity_gradient(s->x + 3 * i, &weight, g);
    } else {
        cipc_inertia inertia = inertia_of(s, i);
        cipc_inertia_gradient(s->x + 3 * i, &inertia, g);
    }
    v3_axpy(gradient + 3 * i, 1, g);
    if (has_inertia(s, i)) s->noise += fabs(node_value(s, i, s->x + 3 * i));
}

static void node_gradients(cipc_stepper *s, double *gradient)
{
    for (int i = 0; i < s->model->node_count; i++) {
        double g[3];
        add_node_gradient(s, i, gradient);
        if (is_penalised(s, i)) {
            cipc_dirichlet_penalty penalty = penalty_of(s, i);
            cipc_dirichlet_penalty_gradient(s->x + 3 * i, &penalty, g);
            v3_axpy(gradient + 3 * i, 1, g);
            s->noise += cipc_dirichlet_penalty_value(s->x + 3 * i, &penalty);
        }
        if (s->is_dirichlet[i]) memset(gradient + 3 * i, 0, 3 * sizeof(double));
    }
}

static cipc_status prepare_gradients(cipc_stepper *s, cipc_term_list lists[CIPC_LIST_COUNT], cipc_error *error)
{
    cipc_term_lists(s, &s->contacts, lists);
    size_t most = (size_t)largest_count(lists);
    cipc_status status = cipc_reserve_values(s, most, error);
    if (!status) status = cipc_reserve_locals(s, 12 * most, error);
    blend_positions(s, s->x, s->blend);
    return status;
}

cipc_status cipc_potential_gradient(cipc_stepper *s, cipc_error *error)
{
    cipc_term_list lists[CIPC_LIST_COUNT];
    cipc_status status = prepare_gradients(s, lists, error);
    if (status) return status;
    memset(s->gradient, 0, 3 * (size_t)s->model->node_count * sizeof(double));
    s->noise = 0;
    for (int l = 0; l < CIPC_LIST_COUNT; l++) {
        list_gradients(s, l, &lists[l]);
        scatter_gradients(s, &lists[l], s->gradient);
    }
    node_gradients(s, s->gradient);
    s->noise *= rounding_chain * 0.5 * DBL_EPSILON;
    return CIPC_OK;
}

/* The stiffness that balances the barrier against the rest of E in the least-squares sense: -grad B1 . grad E / |grad B1|^2 (SPEC D.4). */
cipc_status cipc_fit_stiffness(cipc_stepper *s, double *kappa, cipc_error *error)
{
    cipc_term_list lists[CIPC_LIST_COUNT];
    *kappa = 0;
    cipc_status status = prepare_gradients(s, lists, error);
    if (status) return status;
    size_t bytes = 3 * (size_t)s->model->node_count * sizeof(double);
    double *barrier = s->trial, *rest = s->gradient; /* both are free between iterations */
    memset(barrier, 0, bytes);
    memset(rest, 0, bytes);
    for (int l = 0; l < CIPC_LIST_COUNT; l++) {
        if (l == CIPC_LIST_FRICTION) continue;
        list_gradients(s, l, &lists[l]);
        scatter_gradients(s, &lists[l], l == CIPC_LIST_CONTACT ? barrier : rest);
    }
    node_gradients(s, rest);
    double across = 0, along = 0;
    for (int i = 0; i < 3 * s->model->node_count; i++) {
        if (s->is_dirichlet[i / 3]) continue;
        across += barrier[i] * rest[i];
        along += barrier[i] * barrier[i];
    }
    if (along > 0 && s->kappa > 0) *kappa = -across / along * s->kappa; /* barrier was evaluated with the present kappa */
    return CIPC_OK;
}
