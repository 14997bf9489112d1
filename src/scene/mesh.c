/* The arrays of a mesh. */
#include "scene/mesh.h"

#include "base/vector.h"

void cipc_mesh_free(cipc_mesh *mesh)
{
    if (mesh == NULL) return;
    cipc_free(mesh->nodes);
    cipc_free(mesh->triangles);
    cipc_free(mesh->segments);
    cipc_free(mesh->tetrahedra);
    *mesh = (cipc_mesh){0};
}

cipc_status scene_mesh_allocate_kind(cipc_mesh *mesh, cipc_mesh_kind kind, long long nodes, long long elements, const char *place, cipc_error *error)
{
    static const char *const names[] = {"triangles", "segments", "elements", "tetrahedra"};
    *mesh = (cipc_mesh){0};
    if (nodes < 0 || elements < 0 || nodes > SCENE_NODES_MAX || elements > SCENE_TRIANGLES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a mesh of %lld nodes and %lld %s; at most %d and %d are allowed", nodes, elements, names[kind],
                         SCENE_NODES_MAX, SCENE_TRIANGLES_MAX);
    }
    size_t count = (size_t)elements;
    mesh->nodes = cipc_alloc(3 * (size_t)nodes, sizeof *mesh->nodes);
    bool good = mesh->nodes != NULL;
    if (kind == CIPC_MESH_TRIANGLES) good = (mesh->triangles = cipc_alloc(count, sizeof *mesh->triangles)) != NULL && good;
    if (kind == CIPC_MESH_SEGMENTS) good = (mesh->segments = cipc_alloc(count, sizeof *mesh->segments)) != NULL && good;
    if (kind == CIPC_MESH_TETRAHEDRA) good = (mesh->tetrahedra = cipc_alloc(count, sizeof *mesh->tetrahedra)) != NULL && good;
    if (!good) {
        cipc_mesh_free(mesh);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a mesh of %lld nodes and %lld %s", nodes, elements, names[kind]);
    }
    int *counts[] = {&mesh->triangle_count, &mesh->segment_count, NULL, &mesh->tetrahedron_count};
    mesh->node_count = (int)nodes;
    if (counts[kind] != NULL) *counts[kind] = (int)elements;
    return CIPC_OK;
}

cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error)
{
    return scene_mesh_allocate_kind(mesh, CIPC_MESH_TRIANGLES, nodes, triangles, place, error);
}

static void sort3(int v[3])
{
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++) {
            if (v[k] <= v[k + 1]) continue;
            int swap = v[k];
            v[k] = v[k + 1];
            v[k + 1] = swap;
        }
    }
}

/* With a < b < c the corners below and A, B, C those above: (a b c C), (a b B C), (a A B C). */
void scene_mesh_add_prisms(cipc_mesh *mesh, int first, const int (*triangles)[3], int count, int below, int above)
{
    for (int i = 0; i < count; i++) {
        int v[3] = {triangles[i][0], triangles[i][1], triangles[i][2]};
        sort3(v);
        int a = v[0], b = v[1], c = v[2];
        const int made[3][4] = {{a + below, b + below, c + below, c + above}, {a + below, b + below, b + above, c + above}, {a + below, a + above, b + above, c + above}};
        for (int t = 0; t < 3; t++) {
            for (int k = 0; k < 4; k++) mesh->tetrahedra[first + 3 * i + t][k] = made[t][k];
        }
    }
}

void scene_mesh_orient(cipc_mesh *mesh)
{
    for (int t = 0; t < mesh->tetrahedron_count; t++) {
        int *v = mesh->tetrahedra[t];
        const double *p[4];
        double e[3][3], n[3];
        for (int k = 0; k < 4; k++) p[k] = mesh->nodes + 3 * (size_t)v[k];
        for (int k = 0; k < 3; k++) v3_sub(e[k], p[k + 1], p[0]);
        v3_cross(n, e[0], e[1]);
        if (v3_dot(n, e[2]) >= 0) continue;
        int swap = v[2];
        v[2] = v[3];
        v[3] = swap;
    }
}
