/* Forces inside bodies: membranes or springs, hinges, rods, tetrahedra, stitches, (SPEC A.8). Their steps and clocks are in
 * element_steps.c, their ticks in element_ticks.c. */
#include "asynchronous/integrator.h"

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
    asynchronous_gather_rest(a->model, nodes, 3, rest);
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
        const cipc_body *body = asynchronous_body_of(m, m->edges[e]);
        if (body->fixed || body->kind != CIPC_BODY_SHELL || body->material.membrane != CIPC_MEMBRANE_SPRINGS) continue;
        double rest[6];
        asynchronous_gather_rest(m, m->edges[e], 2, rest);
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
    const cipc_body *body = asynchronous_body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->bending_young > 0)) return;
    double rest[12];
    asynchronous_gather_rest(a->model, nodes, 4, rest);
    asynchronous_set *set = &a->sets[ASYNCHRONOUS_HINGES];
    cipc_hinge_bending *params = next_element(set, nodes, 0);
    cipc_hinge_bending_init(params, rest, m->thickness, m->bending_young, m->bending_poisson, m->hinge_constant == CIPC_HINGE_CIPC);
    set->damping[set->count - 1] = m->damping_stiffness * 2 * params->stiffness;
}

static bool add_segment(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = asynchronous_body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->young > 0)) return true;
    double rest[6];
    asynchronous_gather_rest(a->model, nodes, 2, rest);
    asynchronous_set *set = &a->sets[ASYNCHRONOUS_RODS];
    cipc_rod_stretching *params = next_element(set, nodes, 0);
    const bool good = cipc_rod_stretching_init(params, rest, m->thickness, m->young);
    set->damping[set->count - 1] = m->damping_stiffness * params->stiffness / params->length;
    return good;
}

static bool add_joint(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = asynchronous_body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed || !(m->bending_young > 0)) return true;
    double rest[9];
    asynchronous_gather_rest(a->model, nodes, 3, rest);
    return cipc_rod_bending_init(next_element(&a->sets[ASYNCHRONOUS_JOINTS], nodes, m->damping_stiffness), rest, m->thickness, m->bending_young, m->curved);
}

static bool add_tetrahedron(cipc_asynchronous *a, const int *nodes)
{
    const cipc_body *body = asynchronous_body_of(a->model, nodes);
    const cipc_material *m = &body->material;
    if (body->fixed) return true;
    double rest[12];
    asynchronous_gather_rest(a->model, nodes, 4, rest);
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

/* ---- All of them ---------------------------------------------------------------------------------------------------------------------------------- */

cipc_status asynchronous_elements_create(cipc_asynchronous *a, cipc_error *error)
{
    cipc_status status = allocate_sets(a, error);
    if (!status) status = add_elements(a, error);
    if (!status) status = asynchronous_clocks_create(a, error);
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
