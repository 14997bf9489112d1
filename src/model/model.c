/* Building a model from bodies: one global numbering of nodes and elements. */
#include "cipc/model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "model/body_check.h"
#include "model/measures.h"
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

void cipc_model_set_apart(cipc_model *model, int body_a, int body_b)
{
    model->pair_apart[body_a * model->body_count + body_b] = true;
    model->pair_apart[body_b * model->body_count + body_a] = true;
}

static cipc_status allocate(cipc_model *m, int nodes, int triangles, int tetrahedra, int bodies, cipc_error *error)
{
    m->body_count = bodies;
    m->node_count = nodes;
    m->triangle_count = triangles;
    m->tetrahedron_count = tetrahedra;
    m->bodies = cipc_alloc((size_t)bodies, sizeof *m->bodies);
    m->pair_friction = cipc_alloc((size_t)bodies * (size_t)bodies, sizeof(double));
    m->pair_apart = cipc_alloc((size_t)bodies * (size_t)bodies, sizeof(bool));
    m->rest = cipc_alloc(3 * (size_t)nodes, sizeof(double));
    m->mass = cipc_alloc((size_t)nodes, sizeof(double));
    m->node_area = cipc_alloc((size_t)nodes, sizeof(double));
    m->node_weight = cipc_alloc((size_t)nodes, sizeof(double));
    m->node_body = cipc_alloc((size_t)nodes, sizeof(int));
    m->interior = cipc_alloc((size_t)nodes, sizeof(bool));
    m->triangles = cipc_alloc((size_t)triangles, sizeof *m->triangles);
    m->triangle_body = cipc_alloc((size_t)triangles, sizeof(int));
    m->tetrahedra = cipc_alloc((size_t)tetrahedra, sizeof *m->tetrahedra);
    if (m->bodies && m->pair_friction && m->pair_apart && m->rest && m->mass && m->node_area && m->node_weight && m->node_body && m->interior &&
        m->triangles && m->triangle_body && m->tetrahedra)
        return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for %d nodes and %d triangles", nodes, triangles);
}

/* How far the model is filled. */
typedef struct filled {
    int nodes, triangles, segments, tetrahedra;
} filled;

/* The triangles of a body in its own numbering: those of a shell, or the surface of a volume (made; the caller frees it). */
typedef struct body_triangles {
    int count;
    const int (*triangles)[3];
    int (*made)[3];
} body_triangles;

static void append_elements(int *to, const int *from, int numbers, int first_node)
{
    for (int i = 0; i < numbers; i++) to[i] = first_node + from[i];
}

/* Nodes, triangles and tetrahedra of a body behind those already there. Segments follow when the edges of all triangles are known. */
static void append_body(cipc_model *m, int b, const cipc_body_description *d, const body_triangles *surface, filled *at)
{
    cipc_body body = {.kind = d->kind, .material = d->material, .offset = d->offset, .friction = d->friction, .fixed = d->fixed,
                      .first_node = at->nodes, .node_count = d->node_count,
                      .first_triangle = at->triangles, .triangle_count = surface->count,
                      .first_segment = at->segments, .segment_count = d->kind == CIPC_BODY_RODS ? d->segment_count : 0,
                      .first_tetrahedron = at->tetrahedra, .tetrahedron_count = d->kind == CIPC_BODY_VOLUME ? d->tetrahedron_count : 0};
    memcpy(body.name, d->name, sizeof body.name);
    body.name[CIPC_NAME_SIZE - 1] = 0;
    m->bodies[b] = body;
    memcpy(m->rest + 3 * at->nodes, d->rest, 3 * (size_t)d->node_count * sizeof(double));
    for (int i = 0; i < d->node_count; i++) m->node_body[at->nodes + i] = b;
    for (int t = 0; t < surface->count; t++) m->triangle_body[at->triangles + t] = b;
    if (surface->count) append_elements(m->triangles[at->triangles], surface->triangles[0], 3 * surface->count, at->nodes);
    if (body.tetrahedron_count) append_elements(m->tetrahedra[at->tetrahedra], d->tetrahedra[0], 4 * body.tetrahedron_count, at->nodes);
    at->nodes += d->node_count;
    at->triangles += surface->count;
    at->segments += body.segment_count;
    at->tetrahedra += body.tetrahedron_count;
}

/* Edges of triangles, then the segments behind them, then what hangs on both. */
static cipc_status build_topology(cipc_model *m, const cipc_body_description *bodies, cipc_error *error)
{
    cipc_status status = cipc_mesh_topology(m, error);
    if (status) return status;
    m->first_segment = m->edge_count;
    m->edge_count += m->segment_count;
    for (int b = 0; b < m->body_count; b++) {
        const cipc_body *body = &m->bodies[b];
        if (body->segment_count) append_elements(m->edges[m->first_segment + body->first_segment], bodies[b].segments[0], 2 * body->segment_count, body->first_node);
    }
    for (int b = 0; b < m->body_count; b++) cipc_body_masses(m, &m->bodies[b]);
    cipc_model_areas(m);
    m->edge_weight = cipc_alloc((size_t)m->edge_count, sizeof(double));
    if (!m->edge_weight) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for %d edges", m->edge_count);
    status = cipc_model_weights(m, error);
    return status ? status : cipc_rod_topology(m, error);
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

/* The triangles of every body, and the totals of everything. */
static cipc_status count_elements(const cipc_body_description *bodies, int count, body_triangles *surfaces, filled *total, cipc_error *error)
{
    cipc_status status = CIPC_OK;
    for (int b = 0; b < count && !status; b++) {
        const cipc_body_description *d = &bodies[b];
        if (d->kind == CIPC_BODY_SHELL) surfaces[b] = (body_triangles){d->triangle_count, d->triangles, NULL};
        if (d->kind == CIPC_BODY_VOLUME) {
            status = cipc_volume_surface(d->tetrahedra, d->tetrahedron_count, d->name, &surfaces[b].made, &surfaces[b].count, error);
            surfaces[b].triangles = (const int(*)[3])surfaces[b].made;
            total->tetrahedra += d->tetrahedron_count;
        }
        if (d->kind == CIPC_BODY_RODS) total->segments += d->segment_count;
        total->nodes += d->node_count;
        total->triangles += surfaces[b].count;
    }
    return status;
}

static cipc_status build(cipc_model *m, const cipc_body_description *bodies, int body_count, body_triangles *surfaces, cipc_error *error)
{
    filled total = {0}, at = {0};
    cipc_status status = count_elements(bodies, body_count, surfaces, &total, error);
    if (!status) status = allocate(m, total.nodes, total.triangles, total.tetrahedra, body_count, error);
    if (status) return status;
    m->segment_count = total.segments;
    for (int b = 0; b < body_count; b++) append_body(m, b, &bodies[b], &surfaces[b], &at);
    for (int a = 0; a < body_count; a++)
        for (int b = 0; b < body_count; b++) m->pair_friction[a * body_count + b] = fmin(bodies[a].friction, bodies[b].friction);
    status = build_topology(m, bodies, error);
    for (int b = 0; b < body_count && !status; b++)
        if (bodies[b].fixed) status = add_fixed_body(m, b, error);
    return status;
}

cipc_status cipc_model_create(cipc_model **model, const cipc_body_description *bodies, int body_count, const double gravity[3], cipc_error *error)
{
    *model = NULL;
    if (!cipc_numbers_finite(gravity, 3)) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "gravity", "a component is not finite");
    if (body_count < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "bodies", "a model needs at least one body");
    for (int b = 0; b < body_count; b++) {
        cipc_status status = cipc_body_check(&bodies[b], error);
        if (status) return status;
    }
    cipc_model *m = cipc_alloc(1, sizeof *m);
    body_triangles *surfaces = cipc_alloc((size_t)body_count, sizeof *surfaces);
    cipc_status status = m && surfaces ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for a model");
    if (!status) {
        v3_copy(m->gravity, gravity);
        status = build(m, bodies, body_count, surfaces, error);
    }
    for (int b = 0; surfaces && b < body_count; b++) cipc_free(surfaces[b].made);
    cipc_free(surfaces);
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
        cipc_free(m->dirichlet[s].track.frames);
    }
    for (int i = 0; i < m->load_count; i++) cipc_free(m->loads[i].nodes);
    void *blocks[] = {m->bodies, m->pair_friction, m->rest, m->mass, m->node_body, m->triangles, m->triangle_body, m->edges,
                      m->hinges, m->joints, m->tetrahedra, m->node_area, m->edge_area, m->node_weight, m->edge_weight, m->interior, m->pair_apart, m->stitches,
                      m->links, m->dirichlet, m->loads, m};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) cipc_free(blocks[i]);
}
