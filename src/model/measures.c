/* Lumped masses, areas and contact weights. */
#include "model/measures.h"

#include <math.h>

#include "base/vector.h"

static const double pi = 3.14159265358979323846;

double cipc_segment_length(const double a[3], const double b[3])
{
    double e[3];
    v3_sub(e, b, a);
    return v3_norm(e);
}

double cipc_triangle_area(const double a[3], const double b[3], const double c[3])
{
    double e1[3], e2[3], n[3];
    v3_sub(e1, b, a);
    v3_sub(e2, c, a);
    v3_cross(n, e1, e2);
    return 0.5 * v3_norm(n);
}

double cipc_tetrahedron_volume(const double a[3], const double b[3], const double c[3], const double d[3])
{
    double e1[3], e2[3], e3[3], n[3];
    v3_sub(e1, b, a);
    v3_sub(e2, c, a);
    v3_sub(e3, d, a);
    v3_cross(n, e1, e2);
    return v3_dot(n, e3) / 6;
}

static double area_of(const cipc_model *m, int triangle)
{
    const int *v = m->triangles[triangle];
    return cipc_triangle_area(m->rest + 3 * v[0], m->rest + 3 * v[1], m->rest + 3 * v[2]);
}

static void add_shell_mass(cipc_model *m, const cipc_body *body)
{
    for (int t = body->first_triangle; t < body->first_triangle + body->triangle_count; t++)
        for (int k = 0; k < 3; k++) m->mass[m->triangles[t][k]] += area_of(m, t) * body->material.thickness * body->material.density / 3;
}

/* Half of a segment's cylinder to each end. */
static void add_rod_mass(cipc_model *m, const cipc_body *body)
{
    double section = pi * body->material.thickness * body->material.thickness / 4;
    for (int i = body->first_segment; i < body->first_segment + body->segment_count; i++) {
        const int *v = m->edges[m->first_segment + i];
        double half = cipc_segment_length(m->rest + 3 * v[0], m->rest + 3 * v[1]) * section * body->material.density / 2;
        m->mass[v[0]] += half;
        m->mass[v[1]] += half;
    }
}

/* A ball each. */
static void add_particle_mass(cipc_model *m, const cipc_body *body)
{
    double d = body->material.thickness;
    for (int i = body->first_node; i < body->first_node + body->node_count; i++) m->mass[i] = body->material.density * pi * d * d * d / 6;
}

/* A quarter of a tetrahedron to each of its nodes. */
static void add_volume_mass(cipc_model *m, const cipc_body *body)
{
    for (int i = body->first_tetrahedron; i < body->first_tetrahedron + body->tetrahedron_count; i++) {
        const int *v = m->tetrahedra[i];
        double quarter = cipc_tetrahedron_volume(m->rest + 3 * v[0], m->rest + 3 * v[1], m->rest + 3 * v[2], m->rest + 3 * v[3]) * body->material.density / 4;
        for (int k = 0; k < 4; k++) m->mass[v[k]] += quarter;
    }
    for (int i = body->first_node; i < body->first_node + body->node_count; i++) m->interior[i] = true;
    for (int t = body->first_triangle; t < body->first_triangle + body->triangle_count; t++)
        for (int k = 0; k < 3; k++) m->interior[m->triangles[t][k]] = false;
}

void cipc_body_masses(cipc_model *m, const cipc_body *body)
{
    static void (*const add[])(cipc_model *, const cipc_body *) = {add_shell_mass, add_rod_mass, add_particle_mass, add_volume_mass};
    add[body->kind](m, body);
}

void cipc_model_areas(cipc_model *m)
{
    for (int t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) m->node_area[m->triangles[t][k]] += area_of(m, t) / 3;
}

/* Divide the sizes of one class, those that are not 0, by their mean. */
static void divide_by_mean(double *size, const int *classes, int wanted, int count)
{
    double sum = 0;
    int members = 0;
    for (int i = 0; i < count; i++)
        if (classes[i] == wanted) {
            sum += size[i];
            members++;
        }
    for (int i = 0; i < count; i++)
        if (classes[i] == wanted) size[i] /= sum / members;
}

/* Surfaces, rods and particles: their nodes' sizes are areas, lengths and 1, so each class has a mean of its own. */
enum { SURFACE, LINE, POINT, INSIDE, CLASSES };

static int class_of(const cipc_model *m, int node)
{
    static const int classes[] = {SURFACE, LINE, POINT, SURFACE};
    return m->interior[node] ? INSIDE : classes[m->bodies[m->node_body[node]].kind];
}

cipc_status cipc_model_weights(cipc_model *m, cipc_error *error)
{
    int *classes = cipc_alloc((size_t)m->node_count + (size_t)m->edge_count, sizeof *classes);
    if (!classes) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "model", "no memory for %d nodes", m->node_count);
    int *edge_classes = classes + m->node_count;
    for (int i = 0; i < m->node_count; i++) {
        classes[i] = class_of(m, i);
        m->node_weight[i] = classes[i] == POINT ? 1 : m->node_area[i];
    }
    for (int e = 0; e < m->edge_count; e++) {
        const int *v = m->edges[e];
        edge_classes[e] = e < m->first_segment ? SURFACE : LINE;
        m->edge_weight[e] = m->edge_area[e];
        if (e < m->first_segment) continue;
        m->edge_weight[e] = cipc_segment_length(m->rest + 3 * v[0], m->rest + 3 * v[1]);
        for (int k = 0; k < 2; k++) m->node_weight[v[k]] += 0.5 * m->edge_weight[e];
    }
    for (int c = 0; c < INSIDE; c++) {
        divide_by_mean(m->node_weight, classes, c, m->node_count);
        divide_by_mean(m->edge_weight, edge_classes, c, m->edge_count);
    }
    cipc_free(classes);
    return CIPC_OK;
}
