/* The arrays of a mesh. */
#include "scene/mesh.h"

void cipc_mesh_free(cipc_mesh *mesh)
{
    if (mesh == NULL) return;
    cipc_free(mesh->nodes);
    cipc_free(mesh->triangles);
    cipc_free(mesh->segments);
    cipc_free(mesh->tetrahedra);
    cipc_free(mesh->pattern);
    *mesh = (cipc_mesh){0};
}

long long scene_mesh_product(long long a, long long b)
{
    const long long beyond = 1000LL * SCENE_NODES_MAX;
    return b > 0 && a > beyond / b ? beyond : a * b;
}

static cipc_status check_limit(long long count, int limit, const char *name, const char *place, cipc_error *error)
{
    if (count <= limit) return CIPC_OK;
    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a mesh of %lld %s; at most %d are allowed", count, name, limit);
}

cipc_status scene_mesh_allocate_sizes(cipc_mesh *mesh, const scene_mesh_sizes *sizes, const char *place, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check_limit(sizes->nodes, SCENE_NODES_MAX, "nodes", place, error);
    if (status == CIPC_OK) status = check_limit(sizes->triangles, SCENE_TRIANGLES_MAX, "triangles", place, error);
    if (status == CIPC_OK) status = check_limit(sizes->segments, SCENE_SEGMENTS_MAX, "segments", place, error);
    if (status == CIPC_OK) status = check_limit(sizes->tetrahedra, SCENE_TETRAHEDRA_MAX, "tetrahedra", place, error);
    if (status != CIPC_OK) return status;
    mesh->nodes = cipc_alloc(3 * (size_t)sizes->nodes, sizeof *mesh->nodes);
    if (sizes->triangles > 0) mesh->triangles = cipc_alloc((size_t)sizes->triangles, sizeof *mesh->triangles);
    if (sizes->segments > 0) mesh->segments = cipc_alloc((size_t)sizes->segments, sizeof *mesh->segments);
    if (sizes->tetrahedra > 0) mesh->tetrahedra = cipc_alloc((size_t)sizes->tetrahedra, sizeof *mesh->tetrahedra);
    if (mesh->nodes == NULL || (sizes->triangles > 0 && mesh->triangles == NULL) || (sizes->segments > 0 && mesh->segments == NULL) ||
        (sizes->tetrahedra > 0 && mesh->tetrahedra == NULL)) {
        cipc_mesh_free(mesh);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a mesh of %lld nodes and %lld elements", sizes->nodes,
                         sizes->triangles + sizes->segments + sizes->tetrahedra);
    }
    mesh->node_count = (int)sizes->nodes;
    mesh->triangle_count = (int)sizes->triangles;
    mesh->segment_count = (int)sizes->segments;
    mesh->tetrahedron_count = (int)sizes->tetrahedra;
    return CIPC_OK;
}

cipc_status scene_mesh_allocate(cipc_mesh *mesh, long long nodes, long long triangles, const char *place, cipc_error *error)
{
    scene_mesh_sizes sizes = {.nodes = nodes, .triangles = triangles};
    return scene_mesh_allocate_sizes(mesh, &sizes, place, error);
}
