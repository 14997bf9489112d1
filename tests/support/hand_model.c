#include "support/hand_model.h"

#include <stdlib.h>
#include <stdio.h>
#include <string.h>

/* realloc under its linker name: the tests' failing allocator does not see it. */
void *__real_realloc(void *block, size_t size);

static void *grow(void *block, int count, size_t size)
{
    /* Capacities are powers of two, so growing one by one stays linear. */
    if (count > 0 && (count & (count - 1)) != 0) { return block; }
    void *grown = __real_realloc(block, (count > 0 ? 2 * (size_t)count : 1) * size);
    if (grown == NULL) { abort(); }
    return grown;
}

hand_model *hand_model_create(void)
{
    hand_model *h = __real_realloc(NULL, sizeof *h);
    if (h == NULL) { abort(); }
    memset(h, 0, sizeof *h);
    return h;
}

void hand_model_destroy(hand_model *h)
{
    cipc_model *m = &h->model;
    free(m->bodies);
    free(m->rest);
    free(m->node_body);
    free(m->triangles);
    free(m->triangle_body);
    free(m->edges);
    free(m->tetrahedra);
    free(m->interior);
    free(m->pair_apart);
    free(m->stitches);
    free(h->x);
    free(h);
}

int hand_body(hand_model *h, const char *name, double offset, double strain_limit, bool fixed)
{
    cipc_model *m = &h->model;
    m->bodies = grow(m->bodies, m->body_count, sizeof *m->bodies);
    cipc_body *body = &m->bodies[m->body_count];
    memset(body, 0, sizeof *body);
    snprintf(body->name, sizeof body->name, "%s", name);
    body->offset = offset;
    body->material.membrane = CIPC_MEMBRANE_NEO_HOOKEAN;
    body->material.strain_limit = strain_limit;
    body->fixed = fixed;
    return m->body_count++;
}

int hand_body_of(hand_model *h, cipc_body_kind kind, const char *name, double offset, bool fixed)
{
    int body = hand_body(h, name, offset, 0, fixed);
    h->model.bodies[body].kind = kind;
    h->model.bodies[body].material.membrane = CIPC_MEMBRANE_NONE;
    return body;
}

int hand_node(hand_model *h, int body, double x, double y, double z)
{
    cipc_model *m = &h->model;
    m->rest = grow(m->rest, m->node_count, 3 * sizeof *m->rest);
    h->x = grow(h->x, m->node_count, 3 * sizeof *h->x);
    m->node_body = grow(m->node_body, m->node_count, sizeof *m->node_body);
    const double p[3] = {x, y, z};
    memcpy(&m->rest[3 * m->node_count], p, sizeof p);
    memcpy(&h->x[3 * m->node_count], p, sizeof p);
    m->node_body[m->node_count] = body;
    return m->node_count++;
}

static void add_edge(cipc_model *m, int a, int b)
{
    m->edges = grow(m->edges, m->edge_count, sizeof *m->edges);
    m->edges[m->edge_count][0] = a;
    m->edges[m->edge_count][1] = b;
    m->edge_count++;
}

void hand_edge(hand_model *h, int a, int b)
{
    cipc_model *m = &h->model;
    if (m->segment_count > 0) { abort(); } /* segments come last */
    int low = a < b ? a : b, high = a < b ? b : a;
    /* Edges of one mesh repeat soon if at all: look at the latest first. */
    for (int e = m->edge_count - 1; e >= 0; e--) {
        if (m->edges[e][0] == low && m->edges[e][1] == high) { return; }
    }
    add_edge(m, low, high);
    m->first_segment = m->edge_count;
}

void hand_segment(hand_model *h, int a, int b)
{
    add_edge(&h->model, a, b);
    h->model.segment_count++;
}

int hand_rope(hand_model *h, int body, const double from[3], const double to[3], int count)
{
    int first = h->model.node_count;
    for (int i = 0; i <= count; i++) {
        double t = (double)i / count, p[3];
        for (int k = 0; k < 3; k++) { p[k] = from[k] + t * (to[k] - from[k]); }
        hand_node(h, body, p[0], p[1], p[2]);
        if (i > 0) { hand_segment(h, first + i - 1, first + i); }
    }
    return first;
}

void hand_triangle(hand_model *h, int a, int b, int c)
{
    cipc_model *m = &h->model;
    m->triangles = grow(m->triangles, m->triangle_count, sizeof *m->triangles);
    m->triangle_body = grow(m->triangle_body, m->triangle_count, sizeof *m->triangle_body);
    const int nodes[3] = {a, b, c};
    memcpy(m->triangles[m->triangle_count], nodes, sizeof nodes);
    m->triangle_body[m->triangle_count] = m->node_body[a];
    m->triangle_count++;
    hand_edge(h, a, b);
    hand_edge(h, b, c);
    hand_edge(h, c, a);
}

int hand_new_triangle(hand_model *h, int body, const double x[9])
{
    int first = hand_node(h, body, x[0], x[1], x[2]);
    hand_node(h, body, x[3], x[4], x[5]);
    hand_node(h, body, x[6], x[7], x[8]);
    hand_triangle(h, first, first + 1, first + 2);
    return first;
}

void hand_tetrahedron(hand_model *h, int a, int b, int c, int d)
{
    cipc_model *m = &h->model;
    m->tetrahedra = grow(m->tetrahedra, m->tetrahedron_count, sizeof *m->tetrahedra);
    const int nodes[4] = {a, b, c, d};
    memcpy(m->tetrahedra[m->tetrahedron_count++], nodes, sizeof nodes);
}

int hand_grid(hand_model *h, int body, const double origin[3], const double u[3], const double v[3], int nx, int ny)
{
    int first = h->model.node_count;
    for (int j = 0; j <= ny; j++) {
        for (int i = 0; i <= nx; i++) {
            double s = (double)i / nx, t = (double)j / ny;
            hand_node(h, body, origin[0] + s * u[0] + t * v[0], origin[1] + s * u[1] + t * v[1], origin[2] + s * u[2] + t * v[2]);
        }
    }
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            int a = first + j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
            hand_triangle(h, a, b, d);
            hand_triangle(h, a, d, c);
        }
    }
    return first;
}

/* A table of flags, all false until the first is set. */
static bool *flags(bool *table, int count)
{
    if (table != NULL) { return table; }
    table = __real_realloc(NULL, (size_t)count * sizeof *table);
    if (table == NULL) { abort(); }
    memset(table, 0, (size_t)count * sizeof *table);
    return table;
}

void hand_interior(hand_model *h, int node)
{
    h->model.interior = flags(h->model.interior, h->model.node_count);
    h->model.interior[node] = true;
}

void hand_apart(hand_model *h, int body_a, int body_b)
{
    int n = h->model.body_count;
    h->model.pair_apart = flags(h->model.pair_apart, n * n);
    h->model.pair_apart[body_a * n + body_b] = h->model.pair_apart[body_b * n + body_a] = true;
}

void hand_sew(hand_model *h, int node_a, int node_b)
{
    cipc_model *m = &h->model;
    m->stitches = grow(m->stitches, m->stitch_count, sizeof *m->stitches);
    m->stitches[m->stitch_count++] = (cipc_stitching){.nodes = {node_a, node_b, node_b}, .stiffness = 1};
}

void hand_translate(hand_model *h, const double t[3])
{
    for (int i = 0; i < 3 * h->model.node_count; i++) { h->x[i] += t[i % 3]; }
}
