/* Forces inside bodies: membranes or springs, hinges, rods, tetrahedra, stitches, each with its stable step and a regular clock (SPEC A.2, A.5, A.8). */
#include "asynchronous/integrator.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

/* ---- Which elements there are ----------------------------------------------------------------------------------------------------------- */

static cipc_status no_memory(cipc_error *error) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "asynchronous", "no memory for the forces inside bodies"); }

static bool allocate(asynchronous_set *set, cipc_energy_id id, cipc_event_kind kind, asynchronous_damping form, int most)
{
    *set = (asynchronous_set){.energy = cipc_energy_entry(id), .kind = kind, .form = form};
    set->nodes = cipc_alloc((size_t)most * (size_t)set->energy->nodes, sizeof *set->nodes);
    set->params = cipc_alloc((size_t)most, set->energy->params_size);
    set->damping = cipc_alloc((size_t)most, sizeof *set->damping);
    set->step = cipc_alloc((size_t)most, sizeof *set->step);
    return set->nodes && set->params && set->damping && set->step;
}

static cipc_status allocate_sets(cipc_asynchronous *a, cipc_error *error)
{
    const cipc_model *m = a->model;
    const cipc_event_kind stretching = CIPC_EVENT_STRETCHING, bending = CIPC_EVENT_BENDING, volume = CIPC_EVENT_VOLUME;
    asynchronous_set *s = a->sets;
    const bool good = allocate(&s[ASYNCHRONOUS_NEO_HOOKEAN], CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN, stretching, ASYNCHRONOUS_DAMP_EDGES, m->triangle_count) &&
                      allocate(&s[ASYNCHRONOUS_STVK], CIPC_ENERGY_MEMBRANE_STVK, stretching, ASYNCHRONOUS_DAMP_EDGES, m->triangle_count) &&
                      allocate(&s[ASYNCHRONOUS_SPRINGS], CIPC_ENERGY_ROD_STRETCHING, stretching, ASYNCHRONOUS_DAMP_EDGES, m->first_segment) &&
                      allocate(&s[ASYNCHRONOUS_HINGES], CIPC_ENERGY_HINGE_BENDING, bending, ASYNCHRONOUS_DAMP_ANGLE, m->hinge_count) &&
                      allocate(&s[ASYNCHRONOUS_RODS], CIPC_ENERGY_ROD_STRETCHING, stretching, ASYNCHRONOUS_DAMP_EDGES, m->segment_count) &&
                      allocate(&s[ASYNCHRONOUS_JOINTS], CIPC_ENERGY_ROD_BENDING, bending, ASYNCHRONOUS_DAMP_GRADIENT, m->joint_count) &&
                      allocate(&s[ASYNCHRONOUS_STITCHES], CIPC_ENERGY_STITCH, stretching, ASYNCHRONOUS_UNDAMPED, m->stitch_count) &&
                      allocate(&s[ASYNCHRONOUS_COROTATIONAL], CIPC_ENERGY_VOLUME_COROTATIONAL, volume, ASYNCHRONOUS_DAMP_GRADIENT, m->tetrahedron_count) &&
                      allocate(&s[ASYNCHRONOUS_VOLUME_NEO_HOOKEAN], CIPC_ENERGY_VOLUME_NEO_HOOKEAN, volume, ASYNCHRONOUS_DAMP_GRADIENT, m->tetrahedron_count);
    return good ? CIPC_OK : no_memory(error);
}

/* The next element of a set: its nodes are noted; returns its params. */
static void *next_element(asynchronous_set *set, const int *nodes, double damping)
{
    const size_t count = (size_t)set->energy->nodes;
    memcpy(set->nodes + count * (size_t)set->count, nodes, count * sizeof *nodes);
    set->damping[set->count] = damping;
    return (char *)set->params + set->energy->params_size * (size_t)set->count++;
}

static const cipc_body *body_of(const cipc_model *m, const int *nodes) { return &m->bodies[m->node_body[nodes[0]]]; }

static void gather_rest(const cipc_model *m, const int *nodes, int count, double *rest)
{
    for (int i = 0; i < count; i++) v3_copy(rest + 3 * i, m->rest + 3 * nodes[i]);
}

/* What a triangle adds to the stiffness of the springs along its edges, N/m: on an equilateral mesh springs of k = sqrt(3)/2 E t, half of it from either side, make a membrane of Young's
 * modulus E and Poisson's ratio 1/3 (docs/theory/asynchronous.md (9)). */
static double edge_stiffness(const cipc_material *m) { return 0.25 * sqrt(3.0) * m->membrane_young * m->thickness; }

static bool add_triangle(cipc_asynchronous *a, int t)
{
    const int *nodes = a->model->triangles[t];
    const cipc_body *body = &a->model->bodies[a->model->triangle_body[t]];
    const cipc_material *m = &body->material;
    if (body->fixed || body->kind != CIPC_BODY_SHELL || (m->membrane != CIPC_MEMBRANE_NEO_HOOKEAN && m->membrane != CIPC_MEMBRANE_STVK)) return true;
    double rest[9];
    gather_rest(a->model, nodes, 3, rest);
    asynchronous_set *set = &a->sets[m->membrane == CIPC_MEMBRANE_STVK ? ASYNCHRONOUS_STVK : ASYNCHRONOUS_NEO_HOOKEAN];
    return cipc_membrane_init(next_element(set, nodes, m->damping_stiffness * edge_stiffness(m)), rest, m->thickness, m->membrane_young, m->membrane_poisson);
}

/* Triangles at each edge of the mesh, in `sides` (zeroed). */
static void count_sides(const cipc_model *m, int *sides)
{
    for (int t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) sides[asynchronous_edge_of(m, m->triangles[t][k], m->triangles[t][(k + 1) % 3])]++;
}

static cipc_status add_springs(cipc_asynchronous *a, cipc_error *error)
{
    const cipc_model *m = a->model;
    int *sides = cipc_alloc((size_t)m->first_segment, sizeof *sides);
    if (!sides) return no_memory(error);
    count_sides(m, sides);
    bool good = true;
    for (int e = 0; e < m->first_segment && good; e++) {
        const cipc_body *body = body_of(m, m->edges[e]);
        if (body->fixed || body->kind != CIPC_BODY_SHELL || body->material.membrane != CIPC_MEMBRANE_SPRINGS) continue;
        double rest[6];
        gather_rest(m, m->edges[e], 2, rest);
        const double k = sides[e] * edge_stiffness(&body->material);
        cipc_rod_stretching *params = next_element(&a->sets[ASYNCHRONOUS_SPRINGS], m->edges[e], body->material.damping_stiffness * k);
        good = cipc_rod_stretching_init(params, rest, body->material.thickness, body->material.membrane_young);
        params->stiffness = k * params->length;
    }
    cipc_free(sides);
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_BAD_MESH, "asynchronous", "an edge has no length at rest");
}

static void add_hinge(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->bending_young > 0)) return;
    double rest[12];
    gather_rest(a->model, nodes, 4, rest);
    asynchronous_set *set = &a->sets[ASYNCHRONOUS_HINGES];
    cipc_hinge_bending *params = next_element(set, nodes, 0);
    cipc_hinge_bending_init(params, rest, m->thickness, m->bending_young, m->bending_poisson, m->hinge_constant == CIPC_HINGE_CIPC);
    set->damping[set->count - 1] = m->damping_stiffness * 2 * params->stiffness;
}

static bool add_segment(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->young > 0)) return true;
    double rest[6];
    gather_rest(a->model, nodes, 2, rest);
    asynchronous_set *set = &a->sets[ASYNCHRONOUS_RODS];
    cipc_rod_stretching *params = next_element(set, nodes, 0);
    const bool good = cipc_rod_stretching_init(params, rest, m->thickness, m->young);
    set->damping[set->count - 1] = m->damping_stiffness * params->stiffness / params->length;
    return good;
}

static bool add_joint(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->bending_young > 0)) return true;
    double rest[9];
    gather_rest(a->model, nodes, 3, rest);
    return cipc_rod_bending_init(next_element(&a->sets[ASYNCHRONOUS_JOINTS], nodes, m->damping_stiffness), rest, m->thickness, m->bending_young, m->curved);
}

static bool add_tetrahedron(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed) return true;
    double rest[12];
    gather_rest(a->model, nodes, 4, rest);
    asynchronous_set *set = &a->sets[m->volume == CIPC_VOLUME_NEO_HOOKEAN ? ASYNCHRONOUS_VOLUME_NEO_HOOKEAN : ASYNCHRONOUS_COROTATIONAL];
    return cipc_volume_init(next_element(set, nodes, m->damping_stiffness), rest, m->young, m->poisson);
}

static cipc_status add_elements(cipc_asynchronous *a, cipc_error *error)
{
    const cipc_model *m = a->model;
    bool good = true;
    for (int t = 0; t < m->triangle_count; t++) good = add_triangle(a, t) && good;
    for (int h = 0; h < m->hinge_count; h++) add_hinge(a, m->hinges[h]);
    for (int i = 0; i < m->segment_count; i++) good = add_segment(a, m->edges[m->first_segment + i]) && good;
    for (int i = 0; i < m->joint_count; i++) good = add_joint(a, m->joints[i]) && good;
    for (int i = 0; i < m->tetrahedron_count; i++) good = add_tetrahedron(a, m->tetrahedra[i]) && good;
    for (int i = 0; i < m->stitch_count; i++) {
        cipc_stitch *params = next_element(&a->sets[ASYNCHRONOUS_STITCHES], m->stitches[i].nodes, 0);
        *params = (cipc_stitch){.stiffness = m->stitches[i].stiffness, .ratio = m->stitches[i].ratio};
    }
    if (!good) return cipc_fail(error, CIPC_E_BAD_MESH, "asynchronous", "an element has no size at rest");
    return add_springs(a, error);
}

/* ---- Stable steps ----------------------------------------------------------------------------------------------------------------------- */

/* How many elements of the same kind of event share each node's mass. */
static void count_shares(const cipc_asynchronous *a, cipc_event_kind kind, int *shares)
{
    memset(shares, 0, (size_t)a->model->node_count * sizeof *shares);
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++)
        for (int i = 0; a->sets[s].kind == kind && i < a->sets[s].count * a->sets[s].energy->nodes; i++) shares[a->sets[s].nodes[i]]++;
}

/* Largest eigenvalue of M^(-1/2) H M^(-1/2) at rest, M the element's share of its nodes' masses: that of the assembled body is not larger, since the shares add up
 * to the masses (docs/theory/asynchronous.md (10)). */
static double largest_eigenvalue(const cipc_asynchronous *a, const asynchronous_set *set, int element, const int *shares, gsl_eigen_symm_workspace *work)
{
    const int count = set->energy->nodes, n = 3 * count, *nodes = set->nodes + (size_t)element * (size_t)count;
    double rest[12], H[144], eigenvalues[12];
    gather_rest(a->model, nodes, count, rest);
    set->energy->hessian(rest, (const char *)set->params + (size_t)element * set->energy->params_size, H);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) H[n * i + j] *= sqrt(shares[nodes[i / 3]] / a->model->mass[nodes[i / 3]]) * sqrt(shares[nodes[j / 3]] / a->model->mass[nodes[j / 3]]);
    gsl_matrix_view matrix = gsl_matrix_view_array(H, (size_t)n, (size_t)n);
    gsl_vector_view values = gsl_vector_view_array(eigenvalues, (size_t)n);
    gsl_eigen_symm(&matrix.matrix, &values.vector, work);
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, eigenvalues[i]);
    return largest;
}

/* h = gamma 2/omega, and with stiffness-proportional damping beta also h <= gamma 2/(beta omega^2) (SPEC A.5, A.8). */
static double stable_step(const cipc_asynchronous *a, const cipc_material *m, double eigenvalue)
{
    const double omega = sqrt(eigenvalue), most = a->options.frame;
    if (!(omega > 0)) return most;
    return fmin(most, a->options.element_factor * 2 / (omega * fmax(1, m->damping_stiffness * omega)));
}

/* The longest frame / 2^k that is not longer than h. */
static double nested_step(double frame, double h)
{
    double step = frame;
    while (step > h) step /= 2;
    return step;
}

static cipc_status choose_steps(cipc_asynchronous *a, asynchronous_set *set, const int *shares, cipc_error *error)
{
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3 * (size_t)set->energy->nodes);
    if (!work) return no_memory(error);
    for (int i = 0; i < set->count; i++) {
        const cipc_body *body = body_of(a->model, set->nodes + (size_t)i * (size_t)set->energy->nodes);
        const double h = stable_step(a, &body->material, largest_eigenvalue(a, set, i, shares, work));
        set->step[i] = a->options.clocks == CIPC_CLOCKS_NESTED ? nested_step(a->options.frame, h) : h;
    }
    gsl_eigen_symm_free(work);
    return CIPC_OK;
}

/* ---- Clocks ----------------------------------------------------------------------------------------------------------------------------- */

typedef struct numbered_step { double step; int element; } numbered_step;

static int compare_steps(const void *p, const void *q)
{
    const numbered_step *s = p, *t = q;
    if (s->step != t->step) return s->step < t->step ? 1 : -1;
    return (s->element > t->element) - (s->element < t->element);
}

/* The elements of a set from place `first` on, slowest first; elements with the same step get one clock. */
static bool make_clocks(cipc_asynchronous *a, int set_number, int first)
{
    const asynchronous_set *set = &a->sets[set_number];
    numbered_step *steps = cipc_alloc((size_t)set->count, sizeof *steps);
    if (!steps) return false;
    for (int i = 0; i < set->count; i++) steps[i] = (numbered_step){set->step[i], i};
    qsort(steps, (size_t)set->count, sizeof *steps, compare_steps);
    for (int i = 0; i < set->count; i++) {
        a->elements[first + i] = steps[i].element;
        if (i == 0 || steps[i].step != steps[i - 1].step) {
            const int number = a->clock_count++;
            const uint32_t rank = ASYNCHRONOUS_RANK_ELEMENTS + (uint32_t)set_number;
            a->clocks[number] = (asynchronous_clock){.h = steps[i].step, .set = set_number, .first = first + i};
            a->clocks[number].event = asynchronous_queue_add(&a->queue, rank, (uint64_t)i, number);
        }
        a->clocks[a->clock_count - 1].count++;
    }
    cipc_free(steps);
    return true;
}

cipc_status asynchronous_elements_create(cipc_asynchronous *a, cipc_error *error)
{
    int *shares = NULL, total = 0;
    cipc_status status = allocate_sets(a, error);
    if (!status) status = add_elements(a, error);
    if (status) return status;
    shares = cipc_alloc((size_t)a->model->node_count, sizeof *shares);
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) total += a->sets[s].count;
    a->elements = cipc_alloc((size_t)total, sizeof *a->elements);
    a->clocks = cipc_alloc((size_t)total, sizeof *a->clocks);
    if (!shares || !a->elements || !a->clocks) status = no_memory(error);
    for (int s = 0, first = 0; s < ASYNCHRONOUS_SETS && !status; first += a->sets[s++].count) {
        count_shares(a, a->sets[s].kind, shares);
        status = choose_steps(a, &a->sets[s], shares, error);
        if (!status && !make_clocks(a, s, first)) status = no_memory(error);
    }
    for (int c = 0; c < a->clock_count && !status; c++)
        if (a->clocks[c].event < 0) status = no_memory(error);
    cipc_free(shares);
    return status;
}

void asynchronous_elements_free(cipc_asynchronous *a)
{
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) {
        cipc_free(a->sets[s].nodes);
        cipc_free(a->sets[s].params);
        cipc_free(a->sets[s].damping);
        cipc_free(a->sets[s].step);
    }
    cipc_free(a->elements);
    cipc_free(a->clocks);
}

void asynchronous_elements_start(cipc_asynchronous *a)
{
    for (int c = 0; c < a->clock_count; c++) {
        asynchronous_clock *clock = &a->clocks[c];
        clock->k = asynchronous_first_tick(a->options.mirror, clock->h, a->now);
        asynchronous_queue_schedule(&a->queue, clock->event, asynchronous_tick_time(a->options.mirror, clock->h, clock->k));
    }
}

/* ---- Ticks ------------------------------------------------------------------------------------------------------------------------------ */

static double rate_along(const double *direction, const double *v, int numbers)
{
    double rate = 0;
    for (int i = 0; i < numbers; i++) rate += direction[i] * v[i];
    return rate;
}

/* k_d grad C (grad C . v) for C the length of each edge. */
static void damp_edges(int count, const double *x, const double *v, double kd, double *g)
{
    for (int e = 0; e < (count == 2 ? 1 : count); e++) {
        const int i = e, j = (e + 1) % count;
        double along[3], speed[3];
        v3_sub(along, x + 3 * j, x + 3 * i);
        v3_sub(speed, v + 3 * j, v + 3 * i);
        const double length2 = v3_norm2(along), pull = length2 > 0 ? kd * v3_dot(along, speed) / length2 : 0;
        v3_axpy(g + 3 * j, pull, along);
        v3_axpy(g + 3 * i, -pull, along);
    }
}

static void damp_angle(const double *x, const double *v, double kd, double *g)
{
    double angle[12];
    cipc_hinge_angle_gradient(x, angle);
    const double torque = kd * rate_along(angle, v, 12);
    for (int i = 0; i < 12; i++) g[i] += torque * angle[i];
}

/* For an energy k C^2 the gradient is 2 k C grad C, so that beta 2k grad C (grad C . v) = beta g (g . v)/(2 E); at rest, where E = 0, there is nothing to damp by. */
static void damp_gradient(const asynchronous_set *set, const void *params, const double *x, const double *v, double beta, double *g)
{
    const double energy = set->energy->value(x, params);
    if (!(energy > 0)) return;
    const double factor = 1 + beta * rate_along(g, v, 3 * set->energy->nodes) / (2 * energy);
    for (int i = 0; i < 3 * set->energy->nodes; i++) g[i] *= factor;
}

static void damp(const cipc_asynchronous *a, const asynchronous_set *set, int element, const double *x, double *g)
{
    const int count = set->energy->nodes, *nodes = set->nodes + (size_t)element * (size_t)count;
    const double kd = set->damping[element];
    double v[12];
    for (int i = 0; i < count; i++) v3_copy(v + 3 * i, a->nodes[nodes[i]].v);
    if (set->form == ASYNCHRONOUS_DAMP_EDGES) damp_edges(count, x, v, kd, g);
    else if (set->form == ASYNCHRONOUS_DAMP_ANGLE) damp_angle(x, v, kd, g);
    else damp_gradient(set, (const char *)set->params + (size_t)element * set->energy->params_size, x, v, kd, g);
}

/* v_i += h F_i / m_i (SPEC A.2). */
static void tick_element(cipc_asynchronous *a, const asynchronous_set *set, int element, double h)
{
    const int count = set->energy->nodes, *nodes = set->nodes + (size_t)element * (size_t)count;
    double x[12], g[12], sum = 0;
    asynchronous_gather(a, nodes, count, x);
    set->energy->gradient(x, (const char *)set->params + (size_t)element * set->energy->params_size, g);
    if (set->damping[element] > 0) damp(a, set, element, x, g);
    for (int i = 0; i < 3 * count; i++) sum += g[i];
    if (!isfinite(sum)) asynchronous_fail(a, CIPC_E_NO_PROGRESS, "%s at node %d (body \"%s\") has no finite force: shorter steps are needed (element_factor)", set->energy->name, nodes[0], body_of(a->model, nodes)->name);
    for (int i = 0; i < count && !a->status; i++) {
        const double inverse_mass = a->nodes[nodes[i]].inverse_mass;
        double dv[3];
        v3_scale(dv, -h * inverse_mass, g + 3 * i);
        if (inverse_mass > 0) asynchronous_kick(a, nodes[i], x + 3 * i, dv);
    }
}

void asynchronous_elements_tick(cipc_asynchronous *a, int number)
{
    asynchronous_clock *clock = &a->clocks[number];
    const asynchronous_set *set = &a->sets[clock->set];
    for (int i = 0; i < clock->count && !a->status; i++) tick_element(a, set, a->elements[clock->first + i], clock->h);
    clock->k = asynchronous_tick_after(a->options.mirror, clock->k);
    asynchronous_queue_schedule(&a->queue, clock->event, asynchronous_tick_time(a->options.mirror, clock->h, clock->k));
    a->report.events[set->kind] += clock->count;
    a->report.smallest_step = fmin(a->report.smallest_step, clock->h);
}

double asynchronous_elements_energy(const cipc_asynchronous *a, const double *positions)
{
    double sum = 0;
    for (int s = 0; s < ASYNCHRONOUS_SETS; s++) {
        const asynchronous_set *set = &a->sets[s];
        for (int e = 0; e < set->count; e++) {
            double x[12];
            for (int i = 0; i < set->energy->nodes; i++) v3_copy(x + 3 * i, positions + 3 * set->nodes[(size_t)e * (size_t)set->energy->nodes + (size_t)i]);
            sum += set->energy->value(x, (const char *)set->params + (size_t)e * set->energy->params_size);
        }
    }
    return sum;
}
