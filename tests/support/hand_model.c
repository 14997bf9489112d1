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

void hand_edge(hand_model *h, int a, int b)
{
    cipc_model *m = &h->model;
    int low = a < b ? a : b, high = a < b ? b : a;
    /* Edges of one mesh repeat soon if at all: look at the latest first. */
    for (int e = m->edge_count - 1; e >= 0; e--) {
        if (m->edges[e][0] == low && m->edges[e][1] == high) { return; }
    }
    m->edges = grow(m->edges, m->edge_count, sizeof *m->edges);
    m->edges[m->edge_count][0] = low;
    m->edges[m->edge_count][1] = high;
    m->edge_count++;
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

void hand_translate(hand_model *h, const double t[3])
{
    for (int i = 0; i < 3 * h->model.node_count; i++) { h->x[i] += t[i % 3]; }
}
