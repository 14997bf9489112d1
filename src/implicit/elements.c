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

/* Take the next place of a group for an element of these nodes; returns its params. */
static void *next_element(cipc_element_group *g, const int *nodes)
{
    size_t count = (size_t)g->energy->nodes;
    memcpy(g->nodes + count * (size_t)g->count, nodes, count * sizeof *nodes);
    return (char *)g->params + g->energy->params_size * (size_t)g->count++;
}

static bool add_membrane(cipc_stepper *s, const int *nodes, const double *rest, const cipc_material *m)
{
    if (m->membrane == CIPC_MEMBRANE_NONE) return true;
    if (m->membrane == CIPC_MEMBRANE_ORTHOTROPIC) {
        const cipc_orthotropic_material *o = &m->orthotropic;
        return cipc_orthotropic_init(next_element(&s->groups[CIPC_GROUP_ORTHOTROPIC], nodes), rest, m->thickness, o->warp,
                                     v3_norm2(o->weft) > 0 ? o->weft : NULL, o->moduli, o->limits);
    }
    cipc_element_group *g = &s->groups[m->membrane == CIPC_MEMBRANE_STVK ? CIPC_GROUP_STVK : CIPC_GROUP_NEO_HOOKEAN];
    return cipc_membrane_init(next_element(g, nodes), rest, m->thickness, m->membrane_young, m->membrane_poisson);
}

static bool add_strain_limits(cipc_stepper *s, int t, const double *rest, const cipc_material *m)
{
    cipc_element_group *upper = &s->groups[CIPC_GROUP_STRAIN_LIMIT], *lower = &s->groups[CIPC_GROUP_STRAIN_LIMIT_LOWER];
    const int *nodes = s->model->triangles[t];
    bool good = true;
    if (m->strain_limit > 0) {
        upper->triangles[upper->count] = t;
        good = cipc_strain_limit_init(next_element(upper, nodes), rest, m->thickness, m->strain_limit, m->strain_activation, m->strain_stiffness);
    }
    if (m->strain_lower_limit > 0)
        good = good && cipc_strain_limit_lower_init(next_element(lower, nodes), rest, m->thickness, m->strain_lower_limit, m->strain_lower_activation, m->strain_stiffness);
    if (m->strain_limit > 0 || m->strain_lower_limit > 0) s->max_strain_stiffness = fmax(s->max_strain_stiffness, m->strain_stiffness);
    return good;
}

static cipc_status add_triangle(cipc_stepper *s, int t, cipc_error *error)
{
    const cipc_model *m = s->model;
    const cipc_body *body = &m->bodies[m->triangle_body[t]];
    const cipc_material *material = &body->material;
    double rest[9];
    if (body->fixed || body->kind != CIPC_BODY_SHELL) return CIPC_OK;
    gather_rest(m, m->triangles[t], 3, rest);
    if (!add_membrane(s, m->triangles[t], rest, material))
        return cipc_fail(error, CIPC_E_BAD_MESH, body->name, "triangle %d has no area at rest, or warp or weft goes across it", t);
    if (add_strain_limits(s, t, rest, material)) return CIPC_OK;
    return cipc_fail(error, CIPC_E_BAD_MESH, body->name, "triangle %d has no area at rest", t);
}

static const cipc_body *body_of(const cipc_model *m, const int *nodes) { return &m->bodies[m->node_body[nodes[0]]]; }

static void add_hinge(cipc_stepper *s, const int *nodes)
{
    const cipc_body *body = body_of(s->model, nodes);
    const cipc_material *m = &body->material;
    double rest[12];
    if (body->fixed || !(m->bending_young > 0)) return;
    gather_rest(s->model, nodes, 4, rest);
    cipc_hinge_bending_init(next_element(&s->groups[CIPC_GROUP_HINGE], nodes), rest, m->thickness, m->bending_young, m->bending_poisson,
                            m->hinge_constant == CIPC_HINGE_CIPC);
}

static cipc_status add_segment(cipc_stepper *s, const int *nodes, cipc_error *error)
{
    const cipc_body *body = body_of(s->model, nodes);
    double rest[6];
    if (body->fixed || !(body->material.young > 0)) return CIPC_OK;
    gather_rest(s->model, nodes, 2, rest);
    if (cipc_rod_stretching_init(next_element(&s->groups[CIPC_GROUP_ROD_STRETCHING], nodes), rest, body->material.thickness, body->material.young)) return CIPC_OK;
    return cipc_fail(error, CIPC_E_BAD_MESH, body->name, "the segment of nodes %d and %d has no length at rest", nodes[0], nodes[1]);
}

static cipc_status add_joint(cipc_stepper *s, const int *nodes, cipc_error *error)
{
    const cipc_body *body = body_of(s->model, nodes);
    const cipc_material *m = &body->material;
    double rest[9];
    if (body->fixed || !(m->bending_young > 0)) return CIPC_OK;
    gather_rest(s->model, nodes, 3, rest);
    if (cipc_rod_bending_init(next_element(&s->groups[CIPC_GROUP_ROD_BENDING], nodes), rest, m->thickness, m->bending_young, m->curved)) return CIPC_OK;
    return cipc_fail(error, CIPC_E_BAD_MESH, body->name, "the rod is folded back at node %d at rest", nodes[1]);
}

static cipc_status add_tetrahedron(cipc_stepper *s, const int *nodes, cipc_error *error)
{
    const cipc_body *body = body_of(s->model, nodes);
    double rest[12];
    if (body->fixed) return CIPC_OK;
    gather_rest(s->model, nodes, 4, rest);
    cipc_element_group *g = &s->groups[body->material.volume == CIPC_VOLUME_NEO_HOOKEAN ? CIPC_GROUP_VOLUME_NEO_HOOKEAN : CIPC_GROUP_COROTATIONAL];
    if (cipc_volume_init(next_element(g, nodes), rest, body->material.young, body->material.poisson)) return CIPC_OK;
    return cipc_fail(error, CIPC_E_BAD_MESH, body->name, "a tetrahedron at node %d has no volume at rest", nodes[0]);
}

static void add_stitch(cipc_stepper *s, const cipc_stitching *stitch)
{
    cipc_stitch *params = next_element(&s->groups[CIPC_GROUP_STITCH], stitch->nodes);
    *params = (cipc_stitch){.stiffness = stitch->stiffness, .ratio = stitch->ratio};
}

static cipc_status allocate_groups(cipc_stepper *s, cipc_error *error)
{
    const cipc_model *m = s->model;
    const struct { cipc_energy_id id; int most; } groups[CIPC_GROUP_COUNT] = {
        [CIPC_GROUP_NEO_HOOKEAN] = {CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN, m->triangle_count},
        [CIPC_GROUP_STVK] = {CIPC_ENERGY_MEMBRANE_STVK, m->triangle_count},
        [CIPC_GROUP_ORTHOTROPIC] = {CIPC_ENERGY_MEMBRANE_ORTHOTROPIC, m->triangle_count},
        [CIPC_GROUP_HINGE] = {CIPC_ENERGY_HINGE_BENDING, m->hinge_count},
        [CIPC_GROUP_ROD_STRETCHING] = {CIPC_ENERGY_ROD_STRETCHING, m->segment_count},
        [CIPC_GROUP_ROD_BENDING] = {CIPC_ENERGY_ROD_BENDING, m->joint_count},
        [CIPC_GROUP_COROTATIONAL] = {CIPC_ENERGY_VOLUME_COROTATIONAL, m->tetrahedron_count},
        [CIPC_GROUP_VOLUME_NEO_HOOKEAN] = {CIPC_ENERGY_VOLUME_NEO_HOOKEAN, m->tetrahedron_count},
        [CIPC_GROUP_STITCH] = {CIPC_ENERGY_STITCH, m->stitch_count},
        [CIPC_GROUP_STRAIN_LIMIT] = {CIPC_ENERGY_STRAIN_LIMIT, m->triangle_count},
        [CIPC_GROUP_STRAIN_LIMIT_LOWER] = {CIPC_ENERGY_STRAIN_LIMIT_LOWER, m->triangle_count},
    };
    cipc_status status = CIPC_OK;
    for (int g = 0; g < CIPC_GROUP_COUNT && !status; g++) status = allocate_group(&s->groups[g], groups[g].id, groups[g].most, error);
    if (status) return status;
    s->groups[CIPC_GROUP_STRAIN_LIMIT].triangles = cipc_alloc((size_t)m->triangle_count, sizeof(int));
    s->near_limit = cipc_alloc(2 * (size_t)m->triangle_count, sizeof(bool));
    if (!s->groups[CIPC_GROUP_STRAIN_LIMIT].triangles || !s->near_limit) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "elements", "no memory");
    return CIPC_OK;
}

cipc_status cipc_elements_create(cipc_stepper *s, cipc_error *error)
{
    const cipc_model *m = s->model;
    cipc_status status = allocate_groups(s, error);
    for (int t = 0; t < m->triangle_count && !status; t++) status = add_triangle(s, t, error);
    for (int i = 0; i < m->segment_count && !status; i++) status = add_segment(s, m->edges[m->first_segment + i], error);
    for (int i = 0; i < m->joint_count && !status; i++) status = add_joint(s, m->joints[i], error);
    for (int i = 0; i < m->tetrahedron_count && !status; i++) status = add_tetrahedron(s, m->tetrahedra[i], error);
    if (status) return status;
    for (int h = 0; h < m->hinge_count; h++) add_hinge(s, m->hinges[h]);
    for (int i = 0; i < m->stitch_count; i++) add_stitch(s, &m->stitches[i]);
    return CIPC_OK;
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
