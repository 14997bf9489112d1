/* Building a model from bodies: one global numbering, lumped masses, edges and hinges. */
#include "cipc/model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "model/mesh_topology.h"

int cipc_model_find_body(const cipc_model *model, const char *name)
{
    for (int b = 0; b < model->body_count; b++)
        if (strcmp(model->bodies[b].name, name) == 0) return b;
    return -1;
}

double cipc_model_pair_offset(const cipc_model *model, int node_a, int node_b)
{
    return 0.5 * (model->bodies[model->node_body[node_a]].offset + model->bodies[model->node_body[node_b]].offset);
}

void cipc_model_set_friction(cipc_model *model, int body_a, int body_b, double mu)
{
    model->pair_friction[body_a * model->body_count + body_b] = mu;
    model->pair_friction[body_b * model->body_count + body_a] = mu;
}

static cipc_status check_number(bool good, const char *body, const char *name, double value, cipc_error *error)
{
    if (good) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, body, "%s = %g is out of range", name, value);
}

static cipc_status check_material(const cipc_body_description *d, cipc_error *error)
{
    const cipc_shell_material *m = &d->material;
    struct { const char *name; double value; bool good; } checks[] = {
        {"density", m->density, m->density > 0},
        {"thickness", m->thickness, m->thickness > 0},
        {"offset", d->offset, d->offset >= 0},
        {"friction", d->friction, d->friction >= 0},
        {"membrane.young", m->membrane_young, m->membrane == CIPC_MEMBRANE_NONE || m->membrane_young > 0},
        {"membrane.poisson", m->membrane_poisson, m->membrane == CIPC_MEMBRANE_NONE || (m->membrane_poisson > -1 && m->membrane_poisson < 1)},
        {"bending.young", m->bending_young, m->bending_young >= 0},
        {"bending.poisson", m->bending_poisson, m->bending_poisson > -1 && m->bending_poisson < 1},
        {"strain_limit.limit", m->strain_limit, m->strain_limit == 0 || m->strain_limit > 1},
        {"strain_limit.activation", m->strain_activation,
         m->strain_limit == 0 || (m->strain_activation >= 1 && m->strain_activation < m->strain_limit)},
        {"strain_limit.stiffness", m->strain_stiffness, m->strain_limit == 0 || m->strain_stiffness > 0},
    };
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        cipc_status status = check_number(checks[i].good && isfinite(checks[i].value), d->name, checks[i].name, checks[i].value, error);
        if (status) return status;
    }
    return CIPC_OK;
}

static bool all_finite(const double *values, int count)
{
    for (int i = 0; values && i < count; i++)
        if (!isfinite(values[i])) return false;
    return true;
}

double cipc_triangle_area(const double a[3], const double b[3], const double c[3])
{
    double e1[3], e2[3], n[3];
    v3_sub(e1, b, a);
    v3_sub(e2, c, a);
    v3_cross(n, e1, e2);
    return 0.5 * v3_norm(n);
}

/* Indices, areas and use of every node: what a shell needs to have a mass matrix and an inverse rest basis. */
static cipc_status check_mesh(const cipc_body_description *d, cipc_error *error)
{
    if (d->node_count < 1 || d->triangle_count < 1)
        return cipc_fail(error, CIPC_E_BAD_MESH, d->name, "the mesh has %d nodes and %d triangles", d->node_count, d->triangle_count);
    if (!all_finite(d->rest, 3 * d->node_count) || !all_finite(d->position, 3 * d->node_count) || !all_finite(d->velocity, 3 * d->node_count))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, d->name, "a node's position or velocity is not finite");
    bool *used = cipc_alloc((size_t)d->node_count, sizeof *used);
    if (!used) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, d->name, "no memory for %d nodes", d->node_count);
    cipc_status status = CIPC_OK;
    for (int t = 0; t < d->triangle_count && !status; t++) {
        const int *v = d->triangles[t];
        for (int k = 0; k < 3 && !status; k++)
            if (v[k] < 0 || v[k] >= d->node_count)
                status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "triangle %d has node index %d, but the mesh has %d nodes", t, v[k], d->node_count);
        if (status) break;
        for (int k = 0; k < 3; k++) used[v[k]] = true;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
            status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "triangle %d repeats a node (%d %d %d)", t, v[0], v[1], v[2]);
        else if (!(cipc_triangle_area(d->rest + 3 * v[0], d->rest + 3 * v[1], d->rest + 3 * v[2]) > 0))
            status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "triangle %d (%d %d %d) has no area", t, v[0], v[1], v[2]);
    }
    for (int i = 0; i < d->node_count && !status; i++)
        if (!used[i]) status = cipc_fail(error, CIPC_E_BAD_MESH, d->name, "node %d belongs to no triangle", i);
    cipc_free(used);
    return status;
}

static cipc_status allocate(cipc_model *m, int nodes, int triangles, int bodies, cipc_error *error)
{
    m->body_count = bodies;
    m->node_count = nodes;
    m->triangle_count = triangles;
    m->bodies = cipc_alloc((size_t)bodies, sizeof *m->bodies);
    m->pair_friction = cipc_alloc((size_t)bodies * (size_t)bodies, sizeof(double));
    m->rest = cipc_alloc(3 * (size_t)nodes, sizeof(double));
    m->mass = cipc_alloc((size_t)nodes, sizeof(double));
    m->node_area = cipc_alloc((size_t)nodes, sizeof(double));
    m->node_body = cipc_alloc((size_t)nodes, sizeof(int));
    m->triangles = cipc_alloc((size_t)triangles, sizeof *m->triangles);
    m->triangle_body = cipc_alloc((size_t)triangles, sizeof(int));
    if (m->bodies && m->pair_friction && m->rest && m->mass && m->node_area && m->node_body && m->triangles && m->triangle_body) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for %d nodes and %d triangles", nodes, triangles);
}

/* Copy a body behind those already there. Mass: A t rho / 3 of each triangle to each of its nodes (SPEC C.1). */
static void append_body(cipc_model *m, int b, const cipc_body_description *d, int first_node, int first_triangle)
{
    cipc_body *body = &m->bodies[b];
    memcpy(body->name, d->name, sizeof body->name);
    body->name[CIPC_NAME_SIZE - 1] = 0;
    body->material = d->material;
    body->offset = d->offset;
    body->friction = d->friction;
    body->fixed = d->fixed;
    body->first_node = first_node;
    body->node_count = d->node_count;
    body->first_triangle = first_triangle;
    body->triangle_count = d->triangle_count;
    memcpy(m->rest + 3 * first_node, d->rest, 3 * (size_t)d->node_count * sizeof(double));
    for (int i = 0; i < d->node_count; i++) m->node_body[first_node + i] = b;
    for (int t = 0; t < d->triangle_count; t++) {
        int *v = m->triangles[first_triangle + t];
        for (int k = 0; k < 3; k++) v[k] = first_node + d->triangles[t][k];
        m->triangle_body[first_triangle + t] = b;
        double area = cipc_triangle_area(m->rest + 3 * v[0], m->rest + 3 * v[1], m->rest + 3 * v[2]);
        for (int k = 0; k < 3; k++) {
            m->node_area[v[k]] += area / 3;
            m->mass[v[k]] += area * d->material.thickness * d->material.density / 3;
        }
    }
}

static cipc_status add_fixed_body(cipc_model *m, int b, cipc_error *error)
{
    const cipc_body *body = &m->bodies[b];
    cipc_dirichlet_set set = {.node_count = body->node_count, .release = INFINITY};
    set.nodes = cipc_alloc((size_t)body->node_count, sizeof(int));
    if (!set.nodes) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, body->name, "no memory for its fixed nodes");
    for (int i = 0; i < body->node_count; i++) set.nodes[i] = body->first_node + i;
    cipc_status status = cipc_model_add_dirichlet(m, &set, error);
    cipc_free(set.nodes);
    return status;
}

cipc_status cipc_model_create(cipc_model **model, const cipc_body_description *bodies, int body_count, const double gravity[3], cipc_error *error)
{
    *model = NULL;
    if (!all_finite(gravity, 3)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "gravity", "a component is not finite");
    if (body_count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "bodies", "a model needs at least one body");
    int nodes = 0, triangles = 0;
    for (int b = 0; b < body_count; b++) {
        cipc_status status = check_material(&bodies[b], error);
        if (!status) status = check_mesh(&bodies[b], error);
        if (status) return status;
        nodes += bodies[b].node_count;
        triangles += bodies[b].triangle_count;
    }
    cipc_model *m = cipc_alloc(1, sizeof *m);
    if (!m) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for a model");
    v3_copy(m->gravity, gravity);
    cipc_status status = allocate(m, nodes, triangles, body_count, error);
    if (!status) {
        for (int b = 0, n = 0, t = 0; b < body_count; n += bodies[b].node_count, t += bodies[b].triangle_count, b++)
            append_body(m, b, &bodies[b], n, t);
        for (int a = 0; a < body_count; a++)
            for (int b = 0; b < body_count; b++)
                m->pair_friction[a * body_count + b] = fmin(bodies[a].friction, bodies[b].friction);
        status = cipc_mesh_topology(m, error);
    }
    for (int b = 0; b < body_count && !status; b++)
        if (bodies[b].fixed) status = add_fixed_body(m, b, error);
    if (status) {
        cipc_model_destroy(m);
        return status;
    }
    *model = m;
    return CIPC_OK;
}

void cipc_model_destroy(cipc_model *m)
{
    if (!m) return;
    for (int s = 0; s < m->dirichlet_count; s++) {
        cipc_free(m->dirichlet[s].nodes);
        cipc_free(m->dirichlet[s].motions);
    }
    void *blocks[] = {m->bodies, m->pair_friction, m->rest, m->mass, m->node_body, m->triangles, m->triangle_body, m->edges,
                      m->hinges, m->tetrahedra, m->node_area, m->edge_area, m->dirichlet, m};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}
