/* Making the integrator: what it accepts, memory, the rule for the stiffness, the sizes of balls; and giving all of it back. */
#include "asynchronous/integrator.h"

static cipc_status check_options(const cipc_asynchronous_options *o, cipc_error *error)
{
    const struct { const char *name; double value; bool good; } numbers[] = {
        {"frame", o->frame, o->frame > 0},
        {"thickness", o->thickness, o->thickness > 0},
        {"stiffness", o->stiffness, o->stiffness >= 0},
        {"layer_factor", o->layer_factor, o->layer_factor > 0 && o->layer_factor <= 1},
        {"element_factor", o->element_factor, o->element_factor > 0 && o->element_factor <= 1},
        {"gravity_step", o->gravity_step, o->gravity_step >= 0},
        {"script_step", o->script_step, o->script_step >= 0},
        {"restitution", o->restitution, o->restitution >= 0 && o->restitution <= 1},
        {"mirror", o->mirror, o->mirror >= 0},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!numbers[i].good || !isfinite(numbers[i].value)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "asynchronous", "%s = %g is out of range", numbers[i].name, numbers[i].value);
    if (o->event_limit < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "asynchronous", "event_limit = %ld is out of range", o->event_limit);
    if (o->always_layers < 0 || o->always_layers >= ASYNCHRONOUS_MOST_LAYERS) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "asynchronous", "always_layers = %d is out of range", o->always_layers);
    return CIPC_OK;
}

static cipc_status check_model(const cipc_model *m, cipc_error *error)
{
    for (int b = 0; b < m->body_count; b++) {
        const cipc_material *material = &m->bodies[b].material;
        if (m->bodies[b].fixed) continue;
        if (material->strain_limit > 0 || material->strain_lower_limit > 0 || material->membrane == CIPC_MEMBRANE_ORTHOTROPIC)
            return cipc_fail(error, CIPC_E_WRONG_TYPE, m->bodies[b].name, "the asynchronous method does not know strain limits");
        if (material->damping_mass > 0) return cipc_fail(error, CIPC_E_WRONG_TYPE, m->bodies[b].name, "the asynchronous method does not know damping by mass");
    }
    return CIPC_OK;
}

/* r(1) by rule: the mean free node, at rest on another, is a twentieth of eta(1) deep (SPEC A.11). */
static double chosen_stiffness(const cipc_model *m, double thickness)
{
    static const double earth = 9.81 /* m/s^2: where there is no gravity */, depth = 0.05;
    double mass = 0;
    int count = 0;
    for (int i = 0; i < m->node_count; i++) {
        if (m->bodies[m->node_body[i]].fixed) continue;
        mass += m->mass[i];
        count++;
    }
    const double g = v3_norm(m->gravity);
    return count > 0 ? mass / count * (g > 0 ? g : earth) / (depth * thickness) : 1;
}

static bool allocate(cipc_asynchronous *a)
{
    const size_t n = (size_t)a->model->node_count, layers = ASYNCHRONOUS_MOST_LAYERS + 3;
    a->nodes = cipc_alloc(n, sizeof *a->nodes);
    a->balls = cipc_alloc(n, sizeof *a->balls);
    a->kicked = cipc_alloc(n, sizeof *a->kicked);
    a->kicks = cipc_alloc(n, sizeof *a->kicks);
    a->dirty = cipc_alloc(n, sizeof *a->dirty);
    a->dirty_nodes = cipc_alloc(n, sizeof *a->dirty_nodes);
    a->is_dirichlet = cipc_alloc(n, sizeof *a->is_dirichlet);
    a->moves = cipc_alloc(n, sizeof *a->moves);
    a->pairs.of_node = cipc_alloc(n, sizeof *a->pairs.of_node);
    a->broad.shadow = cipc_alloc(n * ASYNCHRONOUS_AXES, sizeof *a->broad.shadow);
    double **vectors[] = {&a->before, &a->acceleration, &a->out_position, &a->out_velocity, &a->target};
    bool good = a->nodes && a->balls && a->kicked && a->kicks && a->dirty && a->dirty_nodes && a->is_dirichlet && a->moves && a->pairs.of_node && a->broad.shadow;
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) good = (*vectors[i] = cipc_alloc(3 * n, sizeof **vectors[i])) != NULL && good;
    a->eta = cipc_alloc(layers, sizeof *a->eta);
    a->layer_rate = cipc_alloc(layers, sizeof *a->layer_rate);
    if (!good || !a->eta || !a->layer_rate) return false;
    for (int l = 1; l < (int)layers; l++) {
        a->eta[l] = cipc_layer_thickness(1, l);
        a->layer_rate[l] = 1 / (l * sqrt(l));
    }
    return true;
}

/* Balls no smaller than half of eta(1); no larger than a fraction of the adjacent elements: a tenth near contact, elsewhere as large as leaves the elements around a flat node out of each
 * other's reach. */
static void size_balls(cipc_asynchronous *a)
{
    static const double near_contact = 0.1, elsewhere = 0.25, particle = 8 /* of `least` */;
    const cipc_model *m = a->model;
    for (int i = 0; i < m->node_count; i++) {
        a->balls[i].least = 0.5 * a->options.thickness;
        a->balls[i].most = INFINITY;
    }
    for (int e = 0; e < m->edge_count; e++) {
        double edge[3];
        v3_sub(edge, m->rest + 3 * m->edges[e][1], m->rest + 3 * m->edges[e][0]);
        for (int k = 0; k < 2; k++) {
            asynchronous_ball *ball = &a->balls[m->edges[e][k]];
            ball->most = fmin(ball->most, v3_norm(edge));
        }
    }
    for (int i = 0; i < m->node_count; i++) {
        asynchronous_ball *ball = &a->balls[i];
        const bool in_element = ball->most < INFINITY;
        ball->most_near = fmax(in_element ? near_contact * ball->most : particle * ball->least, ball->least);
        ball->most = fmax(in_element ? elsewhere * ball->most : particle * ball->least, ball->least);
    }
}

static cipc_status create_events(cipc_asynchronous *a, cipc_error *error)
{
    bool good = true;
    for (int i = 0; i < a->model->node_count && good; i++) {
        a->balls[i].event = asynchronous_queue_add(&a->queue, ASYNCHRONOUS_RANK_CELL, (uint64_t)i, i);
        good = a->balls[i].event >= 0;
    }
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for events");
}

cipc_status cipc_asynchronous_create(cipc_asynchronous **integrator, const cipc_model *model, const cipc_asynchronous_options *options, cipc_error *error)
{
    *integrator = NULL;
    cipc_status status = check_options(options, error);
    if (!status) status = check_model(model, error);
    if (status) return status;
    cipc_asynchronous *a = cipc_alloc(1, sizeof *a);
    if (!a) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for the integrator");
    a->model = model;
    a->options = *options;
    if (!(options->stiffness > 0)) a->options.stiffness = chosen_stiffness(model, options->thickness);
    if (!allocate(a)) status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for %d nodes", model->node_count);
    if (!status) size_balls(a);
    if (!status) status = create_events(a, error);
    if (!status) status = asynchronous_external_create(a, error);
    if (!status) status = asynchronous_elements_create(a, error);
    if (!status) status = asynchronous_primitives_create(a, error);
    if (status) cipc_asynchronous_destroy(a);
    else *integrator = a;
    return status;
}

void cipc_asynchronous_destroy(cipc_asynchronous *a)
{
    if (!a) return;
    asynchronous_pairs_free(a);
    asynchronous_broad_free(a);
    asynchronous_elements_free(a);
    asynchronous_queue_free(&a->queue);
    void *blocks[] = {a->nodes, a->balls, a->before, a->kicked, a->kicks, a->dirty, a->dirty_nodes, a->acceleration, a->eta, a->layer_rate, a->out_position, a->out_velocity,
                      a->is_dirichlet, a->target, a->moves, a->breaks, a->window_from, a->window_to, a};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}
