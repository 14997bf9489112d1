#include "support/cloth_soup.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/exact_geometry.h"

soup_shape soup_shape_default(void)
{
    soup_shape shape = {
        .sheets = 4, .cells = 4, .size = 1, .jitter = 0.1, .world = 0.7, .offset = 0.01, .motion = 0.3, .fixed_first = true};
    return shape;
}

/* An orthonormal pair u, v of random directions. */
static void draw_frame(uint64_t *seed, double u[3], double v[3])
{
    double a = random_uniform(seed, 0, 6.283), z = random_uniform(seed, -1, 1), r = sqrt(1 - z * z), b = random_uniform(seed, 0, 6.283);
    const double s[3] = {-sin(a), cos(a), 0}, t[3] = {-z * cos(a), -z * sin(a), r};
    for (int k = 0; k < 3; k++) {
        u[k] = cos(b) * s[k] + sin(b) * t[k];
        v[k] = cos(b) * t[k] - sin(b) * s[k];
    }
}

static double *numbers(int count)
{
    double *block = cipc_alloc((size_t)count, sizeof *block);
    assert_non_null(block);
    return block;
}

static int (*grid_triangles(int cells))[3]
{
    int(*triangles)[3] = cipc_alloc(2 * (size_t)cells * (size_t)cells, sizeof *triangles);
    assert_non_null(triangles);
    for (int j = 0, t = 0; j < cells; j++)
        for (int i = 0; i < cells; i++) {
            int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            const int two[2][3] = {{a, b, d}, {a, d, c}};
            memcpy(triangles[t], two, sizeof two);
            t += 2;
        }
    return triangles;
}

static cipc_body_description draw_sheet(const soup_shape *shape, int index, uint64_t *seed)
{
    int n = shape->cells + 1;
    double u[3], v[3], centre[3], *rest = numbers(3 * n * n), *position = numbers(3 * n * n);
    draw_frame(seed, u, v);
    random_fill(seed, centre, 3, 0.5 * shape->world);
    for (int i = 0; i < n * n; i++) {
        double s = shape->size * ((double)(i % n) / shape->cells - 0.5), t = shape->size * ((double)(i / n) / shape->cells - 0.5);
        for (int k = 0; k < 3; k++) {
            rest[3 * i + k] = centre[k] + s * u[k] + t * v[k];
            position[3 * i + k] = rest[3 * i + k] + random_uniform(seed, -shape->jitter, shape->jitter);
            if (shape->crease_allowed) rest[3 * i + k] = position[3 * i + k];
        }
    }
    cipc_body_description d = {
        .material =
            {.density = 200, .thickness = 1e-3, .membrane = CIPC_MEMBRANE_NEO_HOOKEAN, .membrane_young = 1e5, .membrane_poisson = 0.3},
        .offset = shape->offset * (1 + index % 2),
        .friction = 0.1 * (1 + index),
        .fixed = shape->fixed_first && index == 0,
        .node_count = n * n,
        .rest = rest,
        .position = position,
        .triangle_count = 2 * shape->cells * shape->cells,
        .triangles = (const int(*)[3])grid_triangles(shape->cells),
    };
    (void)snprintf(d.name, sizeof d.name, "sheet %d", index);
    return d;
}

soup soup_create(const soup_shape *shape, uint64_t seed)
{
    static const double gravity[3] = {0, -9.81, 0};
    soup s = {.bodies = cipc_alloc((size_t)shape->sheets, sizeof *s.bodies)};
    assert_non_null(s.bodies);
    for (int b = 0; b < shape->sheets; b++) s.bodies[b] = draw_sheet(shape, b, &seed);
    assert_int_equal(cipc_model_create(&s.model, s.bodies, shape->sheets, gravity, NULL), CIPC_OK);
    int n = s.model->node_count;
    s.x = numbers(3 * n);
    s.p = numbers(3 * n);
    s.is_dirichlet = cipc_alloc((size_t)n, sizeof *s.is_dirichlet);
    assert_non_null(s.is_dirichlet);
    for (int b = 0, first = 0; b < shape->sheets; first += s.bodies[b++].node_count)
        memcpy(s.x + 3 * first, s.bodies[b].position, 3 * (size_t)s.bodies[b].node_count * sizeof(double));
    for (int i = 0; i < n; i++) {
        const cipc_body *body = &s.model->bodies[s.model->node_body[i]];
        s.is_dirichlet[i] = body->fixed;
        if (!body->fixed) random_fill(&seed, s.p + 3 * i, 3, shape->motion);
    }
    return s;
}

void soup_destroy(soup *s)
{
    for (int b = 0; b < s->model->body_count; b++) {
        cipc_free((void *)s->bodies[b].rest);
        cipc_free((void *)s->bodies[b].position);
        cipc_free((void *)s->bodies[b].triangles);
    }
    cipc_model_destroy(s->model);
    cipc_free(s->bodies);
    cipc_free(s->x);
    cipc_free(s->p);
    cipc_free(s->is_dirichlet);
}

/* Shares a node, or wholly Dirichlet? `first` nodes belong to the first primitive. */
static bool left_out(const int nodes[4], int first, const bool *is_dirichlet)
{
    bool all = is_dirichlet != NULL;
    for (int i = 0; i < 4; i++) all = all && is_dirichlet[nodes[i]];
    for (int i = 0; i < first; i++)
        for (int j = first; j < 4; j++)
            if (nodes[i] == nodes[j]) return true;
    return all;
}

void visit_all_pairs(const cipc_model *m, const bool *is_dirichlet, pair_visitor visit, void *context)
{
    for (int i = 0; i < m->node_count; i++)
        for (int t = 0; t < m->triangle_count; t++) {
            const int pair[2] = {i, t}, *v = m->triangles[t], nodes[4] = {i, v[0], v[1], v[2]};
            double xi = 0.5 * (m->bodies[m->node_body[i]].offset + m->bodies[m->triangle_body[t]].offset);
            if (!left_out(nodes, 1, is_dirichlet)) visit(context, false, pair, nodes, xi);
        }
    for (int a = 0; a < m->edge_count; a++)
        for (int b = a + 1; b < m->edge_count; b++) {
            const int pair[2] = {a, b}, nodes[4] = {m->edges[a][0], m->edges[a][1], m->edges[b][0], m->edges[b][1]};
            double xi = 0.5 * (m->bodies[m->node_body[nodes[0]]].offset + m->bodies[m->node_body[nodes[2]]].offset);
            if (!left_out(nodes, 2, is_dirichlet)) visit(context, true, pair, nodes, xi);
        }
}

void soup_stencil(const double *x, const int nodes[4], double y[12])
{
    for (int i = 0; i < 4; i++) memcpy(y + 3 * i, x + 3 * nodes[i], 3 * sizeof *y);
}

void soup_moved_stencil(const double *x, const double *p, double t, const int nodes[4], double y[12])
{
    for (int i = 0; i < 12; i++) y[i] = x[3 * nodes[i / 3] + i % 3] + t * p[3 * nodes[i / 3] + i % 3];
}

double soup_box_distance(bool edge_edge, const double y[12])
{
    double apart = 0;
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 4; i++) {
            int side = i >= (edge_edge ? 2 : 1);
            lo[side] = fmin(lo[side], y[3 * i + k]);
            hi[side] = fmax(hi[side], y[3 * i + k]);
        }
        apart = fmax(apart, fmax(lo[0] - hi[1], lo[1] - hi[0]));
    }
    return apart;
}
