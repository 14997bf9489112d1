/* The arrays of a mesh. */
#include "scene/mesh.h"

void cipc_mesh_free(cipc_mesh *mesh)
{
    if (mesh == NULL) return;
    cipc_free(mesh->nodes);
    cipc_free(mesh->triangles);
    *mesh = (cipc_mesh){0};
}

cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    if (nodes > SCENE_NODES_MAX || triangles > SCENE_TRIANGLES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a mesh of %lld nodes and %lld triangles; at most %d and %d are allowed", nodes,
                         triangles, SCENE_NODES_MAX, SCENE_TRIANGLES_MAX);
    }
    mesh->nodes = cipc_alloc(3 * (size_t)nodes, sizeof *mesh->nodes);
    mesh->triangles = cipc_alloc((size_t)triangles, sizeof *mesh->triangles);
    if (mesh->nodes == NULL || mesh->triangles == NULL) {
        cipc_mesh_free(mesh);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a mesh of %lld nodes and %lld triangles", nodes, triangles);
    }
    mesh->node_count = (int)nodes;
    mesh->triangle_count = (int)triangles;
    return CIPC_OK;
}
