/* Crowds. Levels one above the other are thrown at the floor so that they all arrive at once. */
#include "support/asynchronous_crowd.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "asynchronous/integrator.h"
#include "base/vector.h"
#include "support/exact_geometry.h"

enum { MOST_NODES = 200 };
static const double LEVEL = 0.06;  /* m: from one level to the next */
static const double SIZE = 0.12;   /* m: of bodies */

crowd_shape crowd_shape_default(void) { return (crowd_shape){.kinds = CROWD_ALL, .cells = 2, .speed = 1, .offset = 4e-3}; }

/* A body under way to be added: arrays that sheet_add copies. */
typedef struct draft {
    int count;
    double x[3 * MOST_NODES], v[3 * MOST_NODES];
} draft;

static void add_node(draft *d, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    assert_true(d->count < MOST_NODES);
    v3_copy(d->x + 3 * d->count++, p);
}

/* Rest shape as drafted; tilted a little and turned about the vertical at the start, at its level, thrown down. */
static void throw_body(asynchronous_scene *s, const crowd_shape *shape, uint64_t *seed, cipc_body_description *body, draft *d)
{
    static double at[3 * MOST_NODES];
    const int level = s->sheet.body_count; /* the floor is number 0 */
    const double turn = random_uniform(seed, -0.3, 0.3), tilt = random_uniform(seed, -0.15, 0.15), down = shape->speed * level;
    for (int i = 0; i < d->count; i++) {
        const double *p = d->x + 3 * i;
        double *q = at + 3 * i;
        q[0] = cos(turn) * p[0] + sin(turn) * p[2];
        q[2] = cos(turn) * p[2] - sin(turn) * p[0];
        q[1] = LEVEL * level + p[1] + tilt * q[0];
        for (int k = 0; k < 3; k++) d->v[3 * i + k] = (k == 1 ? -down : 0) + random_uniform(seed, -0.05, 0.05) * shape->speed;
    }
    body->node_count = d->count;
    body->rest = d->x;
    body->position = at;
    body->velocity = d->v;
    body->friction = shape->friction;
    body->offset = level % 2 ? shape->offset : 0.5 * shape->offset;
    body->material.damping_stiffness = shape->damping;
    (void)snprintf(body->name, sizeof body->name, "body %d", level);
    sheet_add(&s->sheet, body);
}

static void add_sheet(asynchronous_scene *s, const crowd_shape *shape, uint64_t *seed, cipc_membrane_model membrane)
{
    static int triangles[2 * MOST_NODES][3];
    static draft d;
    const int n = shape->cells;
    int count = 0;
    d.count = 0;
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) add_node(&d, SIZE * ((double)i / n - 0.5), 0, SIZE * ((double)j / n - 0.5));
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, e = c + 1, two[2][3] = {{a, b, e}, {a, e, c}};
            memcpy(triangles[count], two, sizeof two);
            count += 2;
        }
    cipc_body_description body = {.kind = CIPC_BODY_SHELL, .triangle_count = count, .triangles = (const int(*)[3])triangles};
    body.material = (cipc_material){.density = 400, .thickness = 1e-3, .membrane = membrane, .membrane_young = 2e5, .membrane_poisson = 0.3, .bending_young = 2e5, .bending_poisson = 0.3};
    throw_body(s, shape, seed, &body, &d);
}

static void add_rod(asynchronous_scene *s, const crowd_shape *shape, uint64_t *seed)
{
    static int segments[MOST_NODES][2];
    static draft d;
    d.count = 0;
    for (int i = 0; i <= shape->cells; i++) add_node(&d, SIZE * ((double)i / shape->cells - 0.5), 0, 0);
    for (int i = 0; i < shape->cells; i++) segments[i][0] = i, segments[i][1] = i + 1;
    cipc_body_description body = {.kind = CIPC_BODY_RODS, .segment_count = shape->cells, .segments = (const int(*)[2])segments};
    body.material = (cipc_material){.density = 1000, .thickness = 4e-3, .young = 2e5, .bending_young = 1e6};
    throw_body(s, shape, seed, &body, &d);
}

static void add_grains(asynchronous_scene *s, const crowd_shape *shape, uint64_t *seed)
{
    static draft d;
    d.count = 0;
    for (int i = -1; i <= 1; i++) add_node(&d, 0.25 * SIZE * i, 0, random_uniform(seed, -1e-3, 1e-3));
    cipc_body_description body = {.kind = CIPC_BODY_PARTICLES};
    body.material = (cipc_material){.density = 2000, .thickness = 1e-2};
    throw_body(s, shape, seed, &body, &d);
}

static void add_block(asynchronous_scene *s, const crowd_shape *shape, uint64_t *seed)
{
    static const int tetrahedra[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    static draft d;
    d.count = 0;
    for (int i = 0; i < 8; i++) add_node(&d, 0.03 * (i % 2), 0.03 * (i / 2 % 2), 0.03 * (i / 4));
    cipc_body_description body = {.kind = CIPC_BODY_VOLUME, .tetrahedron_count = 5, .tetrahedra = tetrahedra};
    body.material = (cipc_material){.density = 500, .young = 1e5, .poisson = 0.3, .volume = CIPC_VOLUME_NEO_HOOKEAN};
    throw_body(s, shape, seed, &body, &d);
}

void crowd_add(asynchronous_scene *s, const crowd_shape *shape, uint64_t seed)
{
    s->options.thickness = 4e-3;
    s->options.frame = 5e-3;
    s->options.layer_factor = 0.1;
    s->options.element_factor = 0.3;
    s->options.event_limit = 5000000;
    s->sheet.gravity[1] = -9.81;
    asynchronous_add_floor(s, 0, 0.2);
    s->sheet.bodies[0].friction = shape->friction;
    if (shape->kinds & CROWD_SHEETS) add_sheet(s, shape, &seed, CIPC_MEMBRANE_SPRINGS);
    if (shape->kinds & CROWD_RODS) add_rod(s, shape, &seed);
    if (shape->kinds & CROWD_PARTICLES) add_grains(s, shape, &seed);
    if (shape->kinds & CROWD_PARTICLES) add_grains(s, shape, &seed);
    if (shape->kinds & CROWD_VOLUME) add_block(s, shape, &seed);
    if (shape->kinds & CROWD_SHEETS) add_sheet(s, shape, &seed, CIPC_MEMBRANE_NEO_HOOKEAN);
}

void crowd_build(asynchronous_scene *s, const crowd_shape *shape)
{
    asynchronous_scene_model(s);
    const cipc_body *first = &s->sheet.model->bodies[1], *last = &s->sheet.model->bodies[s->sheet.model->body_count - 1];
    const cipc_stitching stitch = {.nodes = {first->first_node, last->first_node, last->first_node + 1}, .ratio = 0.25, .stiffness = 0.5};
    if ((shape->kinds & CROWD_STITCHES) && (shape->kinds & CROWD_SHEETS)) assert_int_equal(cipc_model_add_stitches(s->sheet.model, &stitch, 1, &s->error), CIPC_OK);
    asynchronous_scene_start(s);
}

void crowd_count_contacts(const asynchronous_scene *s, long contacts[CIPC_PAIR_KIND_COUNT])
{
    const asynchronous_pairs *pairs = &s->integrator->pairs;
    for (int i = 0; i < pairs->live_count; i++)
        if (pairs->pair[pairs->live[i]].layers > 0) contacts[pairs->pair[pairs->live[i]].kind]++;
}

/* ---- All pairs, by brute force ---- */

typedef struct visit { const cipc_model *model; crowd_visitor *visitor; void *context; } visit;

static void consider(const visit *v, cipc_pair_kind kind, const int *first_nodes, int first, const int *second_nodes, int second)
{
    int nodes[4] = {-1, -1, -1, -1}, fixed = 0;
    const int count = cipc_pair_nodes(kind), own = cipc_pair_first_nodes(kind);
    for (int i = 0; i < count; i++) nodes[i] = i < own ? first_nodes[i] : second_nodes[i - own];
    for (int i = 0; i < count; i++) fixed += v->model->bodies[v->model->node_body[nodes[i]]].fixed;
    if (fixed < count && cipc_model_meet(v->model, nodes, own, nodes + own, count - own)) v->visitor(v->context, kind, nodes, first, second);
}

static cipc_body_kind kind_of(const cipc_model *m, int node) { return m->bodies[m->node_body[node]].kind; }

/* Does a segment at the node meet the segment? Then the two segments' pair tells the node's distance as well. */
static bool is_spoken_for(const cipc_model *m, int node, int segment)
{
    for (int e = m->first_segment; e < m->edge_count; e++)
        if ((m->edges[e][0] == node || m->edges[e][1] == node) && cipc_model_meet(m, m->edges[e], 2, m->edges[segment], 2)) return true;
    return false;
}

void crowd_visit_pairs(const cipc_model *m, crowd_visitor *visitor, void *context)
{
    const visit v = {m, visitor, context};
    for (int i = 0; i < m->node_count; i++) {
        const bool particle = kind_of(m, i) == CIPC_BODY_PARTICLES, rod = kind_of(m, i) == CIPC_BODY_RODS;
        for (int t = 0; t < m->triangle_count && !m->interior[i]; t++) consider(&v, CIPC_POINT_TRIANGLE, &i, i, m->triangles[t], t);
        for (int e = m->first_segment; e < m->edge_count; e++)
            if (particle || (rod && !is_spoken_for(m, i, e))) consider(&v, CIPC_POINT_EDGE, &i, i, m->edges[e], e);
        for (int j = i + 1; j < m->node_count && particle; j++)
            if (kind_of(m, j) == CIPC_BODY_PARTICLES) consider(&v, CIPC_POINT_POINT, &i, i, &j, j);
    }
    for (int e = 0; e < m->edge_count; e++)
        for (int f = e + 1; f < m->edge_count; f++) consider(&v, CIPC_EDGE_EDGE, m->edges[e], e, m->edges[f], f);
}
