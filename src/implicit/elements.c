/* Elements of the model as groups of like energies with their constants computed once. */
#include "implicit/stepper.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static cipc_status allocate_group(cipc_element_group *group, cipc_energy_id id, int count, cipc_error *error)
{
    group->energy = cipc_energy_entry(id);
    group->nodes = cipc_alloc((size_t)count * (size_t)group->energy->nodes, sizeof(int));
    group->params = cipc_alloc((size_t)count, group->energy->params_size);
    if (group->nodes && group->params) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "elements", "no memory for %d elements of %s", count, group->energy->name);
}

static void gather_rest(const cipc_model *m, const int *nodes, int count, double *rest)
{
    for (int i = 0; i < count; i++) v3_copy(rest + 3 * i, m->rest + 3 * nodes[i]);
}

/* A membrane element and, where the body has a limit, a strain-limit element for each triangle of bodies that move. */
static cipc_status add_triangle(cipc_stepper *s, int t, cipc_error *error)
{
    const cipc_model *m = s->model;
    const cipc_material *material = &m->bodies[m->triangle_body[t]].material;
    double rest[9];
    bool good = true;
    gather_rest(m, m->triangles[t], 3, rest);
    if (material->membrane != CIPC_MEMBRANE_NONE) {
        cipc_element_group *g = &s->groups[material->membrane == CIPC_MEMBRANE_STVK ? CIPC_GROUP_STVK : CIPC_GROUP_NEO_HOOKEAN];
        cipc_membrane *params = (cipc_membrane *)g->params + g->count;
        good = cipc_membrane_init(params, rest, material->thickness, material->membrane_young, material->membrane_poisson);
        memcpy(g->nodes + 3 * g->count++, m->triangles[t], sizeof m->triangles[t]);
    }
    if (material->strain_limit > 0) {
        cipc_element_group *g = &s->groups[CIPC_GROUP_STRAIN_LIMIT];
        cipc_strain_limit *params = (cipc_strain_limit *)g->params + g->count;
        good = good && cipc_strain_limit_init(params, rest, material->thickness, material->strain_limit, material->strain_activation, material->strain_stiffness);
        g->triangles[g->count] = t;
        memcpy(g->nodes + 3 * g->count++, m->triangles[t], sizeof m->triangles[t]);
        s->max_strain_stiffness = fmax(s->max_strain_stiffness, material->strain_stiffness);
    }
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_BAD_MESH, m->bodies[m->triangle_body[t]].name, "triangle %d has no area at rest", t);
}

static void add_hinge(cipc_stepper *s, int h)
{
    const cipc_model *m = s->model;
    const int *nodes = m->hinges[h];
    const cipc_body *body = &m->bodies[m->node_body[nodes[0]]];
    const cipc_material *material = &body->material;
    if (body->fixed || !(material->bending_young > 0)) return;
    double rest[12];
    gather_rest(m, nodes, 4, rest);
    cipc_element_group *g = &s->groups[CIPC_GROUP_HINGE];
    cipc_hinge_bending *params = (cipc_hinge_bending *)g->params + g->count;
    cipc_hinge_bending_init(params, rest, material->thickness, material->bending_young, material->bending_poisson,
                            material->hinge_constant == CIPC_HINGE_CIPC);
    memcpy(g->nodes + 4 * g->count++, nodes, sizeof m->hinges[h]);
}

cipc_status cipc_elements_create(cipc_stepper *s, cipc_error *error)
{
    static const cipc_energy_id ids[CIPC_GROUP_COUNT] = {CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN, CIPC_ENERGY_MEMBRANE_STVK, CIPC_ENERGY_HINGE_BENDING,
                                                         CIPC_ENERGY_STRAIN_LIMIT};
    const cipc_model *m = s->model;
    cipc_status status = CIPC_OK;
    for (int g = 0; g < CIPC_GROUP_COUNT && !status; g++)
        status = allocate_group(&s->groups[g], ids[g], g == CIPC_GROUP_HINGE ? m->hinge_count : m->triangle_count, error);
    if (status) return status;
    s->groups[CIPC_GROUP_STRAIN_LIMIT].triangles = cipc_alloc((size_t)m->triangle_count, sizeof(int));
    s->near_limit = cipc_alloc((size_t)m->triangle_count, sizeof(bool));
    if (!s->groups[CIPC_GROUP_STRAIN_LIMIT].triangles || !s->near_limit) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "elements", "no memory");
    for (int t = 0; t < m->triangle_count && !status; t++)
        if (!m->bodies[m->triangle_body[t]].fixed) status = add_triangle(s, t, error);
    for (int h = 0; h < m->hinge_count; h++) add_hinge(s, h);
    return status;
}

void cipc_elements_destroy(cipc_stepper *s)
{
    for (int g = 0; g < CIPC_GROUP_COUNT; g++) {
        cipc_free(s->groups[g].nodes);
        cipc_free(s->groups[g].params);
        cipc_free(s->groups[g].triangles);
    }
    cipc_free(s->near_limit);
}
