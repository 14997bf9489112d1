#include "support/mesh_properties.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "model/mesh_topology.h"

typedef struct half_edge {
    int low, high, forward;
} half_edge;

static int compare(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    return p->low != q->low ? p->low - q->low : p->high - q->high;
}

static void count_edges(const cipc_mesh *mesh, mesh_properties *found)
{
    int count = 3 * mesh->triangle_count;
    half_edge *sides = malloc((size_t)count * sizeof *sides);
    for (int i = 0; i < count; i++) {
        int a = mesh->triangles[i / 3][i % 3], b = mesh->triangles[i / 3][(i + 1) % 3];
        sides[i] = (half_edge){a < b ? a : b, a < b ? b : a, a < b};
    }
    qsort(sides, (size_t)count, sizeof *sides, compare);
    for (int first = 0, next; first < count; first = next) {
        for (next = first + 1; next < count && compare(&sides[first], &sides[next]) == 0;) next++;
        found->edges++;
        found->boundary_edges += next - first == 1;
        found->bad_edges += next - first > 2 || (next - first == 2 && sides[first].forward == sides[first + 1].forward);
    }
    free(sides);
}

static double angle_at(const double *a, const double *b, const double *c)
{
    double u[3], v[3], n[3];
    v3_sub(u, b, a);
    v3_sub(v, c, a);
    v3_cross(n, u, v);
    return atan2(v3_norm(n), v3_dot(u, v));
}

static void measure_triangle(const double *a, const double *b, const double *c, mesh_properties *found)
{
    double u[3], v[3], n[3];
    v3_sub(u, b, a);
    v3_sub(v, c, a);
    v3_cross(n, u, v);
    found->area += 0.5 * v3_norm(n);
    found->volume += v3_dot(a, n) / 6;
    found->smallest_up = fmin(found->smallest_up, n[1] / v3_norm(n));
    found->smallest_angle = fmin(found->smallest_angle, fmin(angle_at(a, b, c), fmin(angle_at(b, c, a), angle_at(c, a, b))));
}

mesh_properties measure_mesh(const cipc_mesh *mesh)
{
    mesh_properties found = {.smallest_angle = INFINITY, .smallest_up = INFINITY};
    char *used = calloc((size_t)mesh->node_count, 1);
    count_edges(mesh, &found);
    for (int t = 0; t < mesh->triangle_count; t++) {
        const int *v = mesh->triangles[t];
        for (int k = 0; k < 3; k++) used[v[k]] = 1;
        measure_triangle(mesh->nodes + 3 * v[0], mesh->nodes + 3 * v[1], mesh->nodes + 3 * v[2], &found);
    }
    for (int i = 0; i < mesh->node_count; i++) found.unused_nodes += !used[i];
    found.euler = mesh->node_count - found.edges + mesh->triangle_count;
    free(used);
    return found;
}

/* Dihedral angle at edge a b, between the faces a b c and a b d. */
static double dihedral(const double *a, const double *b, const double *c, const double *d)
{
    double e[3], u[3], v[3], m[3], n[3], r[3];
    v3_sub(e, b, a);
    v3_sub(u, c, a);
    v3_sub(v, d, a);
    v3_cross(m, e, u);
    v3_cross(n, e, v);
    v3_cross(r, m, n);
    return atan2(v3_norm(r), v3_dot(m, n));
}

static void measure_tetrahedron(const double *const x[4], volume_properties *found)
{
    static const int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
    double u[3], v[3], w[3], n[3];
    v3_sub(u, x[1], x[0]);
    v3_sub(v, x[2], x[0]);
    v3_sub(w, x[3], x[0]);
    v3_cross(n, u, v);
    double volume = v3_dot(n, w) / 6;
    found->volume += volume;
    found->smallest = fmin(found->smallest, volume);
    found->largest = fmax(found->largest, volume);
    for (int k = 0; k < 6; k++) {
        double angle = dihedral(x[edges[k][0]], x[edges[k][1]], x[edges[k][2]], x[edges[k][3]]);
        found->smallest_dihedral = fmin(found->smallest_dihedral, angle);
    }
}

volume_properties measure_volume(const cipc_mesh *mesh)
{
    volume_properties found = {.smallest = INFINITY, .largest = -INFINITY, .smallest_dihedral = INFINITY};
    char *used = calloc((size_t)mesh->node_count, 1);
    for (int t = 0; t < mesh->tetrahedron_count; t++) {
        const double *x[4];
        for (int k = 0; k < 4; k++) {
            x[k] = mesh->nodes + 3 * mesh->tetrahedra[t][k];
            used[mesh->tetrahedra[t][k]] = 1;
        }
        measure_tetrahedron(x, &found);
    }
    for (int i = 0; i < mesh->node_count; i++) found.nodes_unused += !used[i];
    free(used);
    cipc_mesh surface = {.node_count = mesh->node_count, .nodes = mesh->nodes};
    if (cipc_volume_surface((const int(*)[4])mesh->tetrahedra, mesh->tetrahedron_count, "test", &surface.triangles, &surface.triangle_count, NULL) != CIPC_OK) abort();
    found.surface = measure_mesh(&surface);
    found.surface.euler -= found.surface.unused_nodes;
    found.surface_triangles = surface.triangle_count;
    cipc_free(surface.triangles);
    return found;
}

static int compare_nodes(const void *a, const void *b)
{
    const double *p = a, *q = b;
    for (int k = 0; k < 3; k++) {
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    }
    return 0;
}

int count_duplicate_nodes(const cipc_mesh *mesh)
{
    size_t size = 3 * (size_t)mesh->node_count * sizeof(double);
    double *sorted = malloc(size);
    memcpy(sorted, mesh->nodes, size);
    qsort(sorted, (size_t)mesh->node_count, 3 * sizeof(double), compare_nodes);
    int count = 0;
    for (int i = 1; i < mesh->node_count; i++) count += compare_nodes(sorted + 3 * (i - 1), sorted + 3 * i) == 0;
    free(sorted);
    return count;
}

double total_length(const cipc_mesh *mesh)
{
    double sum = 0;
    for (int s = 0; s < mesh->segment_count; s++) {
        double u[3];
        v3_sub(u, mesh->nodes + 3 * mesh->segments[s][1], mesh->nodes + 3 * mesh->segments[s][0]);
        sum += v3_norm(u);
    }
    return sum;
}

static bool are_same(const void *a, const void *b, int a_count, int b_count, size_t size)
{
    return a_count == b_count && (a_count == 0 || memcmp(a, b, (size_t)a_count * size) == 0);
}

bool are_same_meshes(const cipc_mesh *a, const cipc_mesh *b)
{
    return are_same(a->nodes, b->nodes, a->node_count, b->node_count, 3 * sizeof(double)) &&
           are_same(a->triangles, b->triangles, a->triangle_count, b->triangle_count, sizeof *a->triangles) &&
           are_same(a->segments, b->segments, a->segment_count, b->segment_count, sizeof *a->segments) &&
           are_same(a->tetrahedra, b->tetrahedra, a->tetrahedron_count, b->tetrahedron_count, sizeof *a->tetrahedra);
}
