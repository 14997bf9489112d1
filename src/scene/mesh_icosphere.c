/* A sphere by repeated splitting of an icosahedron. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "scene/mesh.h"

static const char place[] = "icosphere";

enum { SUBDIVISIONS_MAX = 8 };

/* The 12 corners are the cyclic permutations of (0, +-1, +-golden ratio). */
static void icosahedron(cipc_mesh *mesh)
{
    static const int faces[20][3] = {{0, 1, 4},   {0, 6, 1},   {0, 4, 8}, {0, 9, 6},  {0, 8, 9}, {1, 10, 4}, {1, 6, 11},
                                     {1, 11, 10}, {2, 5, 3},   {2, 3, 7}, {2, 8, 5},  {2, 7, 9}, {2, 9, 8},  {3, 5, 10},
                                     {3, 11, 7},  {3, 10, 11}, {4, 5, 8}, {4, 10, 5}, {6, 9, 7}, {6, 7, 11}};
    const double golden = 0.5 * (1 + sqrt(5.0));
    for (int i = 0; i < 12; i++) {
        double one = i % 2 == 0 ? 1 : -1, phi = i % 4 < 2 ? golden : -golden;
        int axis = i / 4;
        double *x = mesh->nodes + 3 * i;
        x[axis] = 0;
        x[(axis + 1) % 3] = one;
        x[(axis + 2) % 3] = phi;
    }
    mesh->node_count = 12;
    mesh->triangle_count = 20;
    memcpy(mesh->triangles, faces, sizeof faces);
}

/* Open-addressing table from an edge to the node in its middle. */
typedef struct middle_table {
    long long *keys; /* (low << 32 | high) + 1; 0: empty */
    int *nodes;
    size_t mask;
} middle_table;

static int middle_of(cipc_mesh *mesh, middle_table *table, int a, int b)
{
    long long low = a < b ? a : b, high = a < b ? b : a, key = (low << 32 | high) + 1;
    size_t slot = ((size_t)key * 0x9E3779B97F4A7C15u >> 20) & table->mask;
    while (table->keys[slot] != 0 && table->keys[slot] != key) slot = (slot + 1) & table->mask;
    if (table->keys[slot] == 0) {
        table->keys[slot] = key;
        table->nodes[slot] = mesh->node_count++;
        for (int k = 0; k < 3; k++) mesh->nodes[3 * table->nodes[slot] + k] = 0.5 * (mesh->nodes[3 * a + k] + mesh->nodes[3 * b + k]);
    }
    return table->nodes[slot];
}

/* Each triangle becomes four; the new ones are written from the end, so that the old ones are read before they are overwritten. */
static void split(cipc_mesh *mesh, middle_table *table)
{
    memset(table->keys, 0, (table->mask + 1) * sizeof *table->keys);
    for (int t = mesh->triangle_count - 1; t >= 0; t--) {
        int a = mesh->triangles[t][0], b = mesh->triangles[t][1], c = mesh->triangles[t][2];
        int ab = middle_of(mesh, table, a, b), bc = middle_of(mesh, table, b, c), ca = middle_of(mesh, table, c, a);
        const int parts[4][3] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
        memcpy(mesh->triangles[4 * t], parts, sizeof parts);
    }
    mesh->triangle_count *= 4;
}

static void project(cipc_mesh *mesh, double radius)
{
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->nodes + 3 * i;
        v3_scale(x, radius / v3_norm(x), x);
    }
}

static cipc_status build(cipc_mesh *mesh, double radius, int subdivisions, cipc_error *error)
{
    /* A power of two above twice the number of edges of the last splitting, 30 * 4^(s-1). */
    size_t slots = (size_t)64 << (2 * subdivisions);
    middle_table table = {cipc_alloc(slots, sizeof *table.keys), cipc_alloc(slots, sizeof *table.nodes), slots - 1};
    cipc_status status = CIPC_OK;
    if (table.keys == NULL || table.nodes == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for %d subdivisions", subdivisions);
    } else {
        icosahedron(mesh);
        project(mesh, radius);
        for (int s = 0; s < subdivisions; s++) {
            split(mesh, &table);
            project(mesh, radius);
        }
    }
    cipc_free(table.keys);
    cipc_free(table.nodes);
    return status;
}

cipc_status cipc_mesh_icosphere(cipc_mesh *mesh, double radius, int subdivisions, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (!(radius > 0 && isfinite(radius))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a radius of %g m", radius);
    if (subdivisions < 0 || subdivisions > SUBDIVISIONS_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d subdivisions; 0 to %d are allowed", subdivisions, SUBDIVISIONS_MAX);
    }
    long long faces = 20LL << (2 * subdivisions);
    cipc_status status = scene_mesh_allocate(mesh, faces / 2 + 2, faces, place, error);
    if (status == CIPC_OK) status = build(mesh, radius, subdivisions, error);
    if (status != CIPC_OK) cipc_mesh_free(mesh);
    return status;
}
