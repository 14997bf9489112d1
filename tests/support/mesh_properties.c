#include "support/mesh_properties.h"

#include <math.h>
#include <stdlib.h>

#include "base/vector.h"

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
