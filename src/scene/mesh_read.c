/* Mesh files by their ending, and the nodes that their elements use. */
#include <string.h>
#include <strings.h>

#include "scene/mesh.h"

typedef cipc_status reader(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error);

static reader *reader_for(const char *path)
{
    static const struct {
        const char *ending;
        reader *read;
    } readers[] = {{".obj", scene_mesh_read_obj}, {".seg", scene_mesh_read_obj}, {".msh", scene_mesh_read_gmsh}, {".vtk", scene_mesh_read_vtk}};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < sizeof readers / sizeof *readers; i++) {
        if (strcasecmp(dot, readers[i].ending) == 0) return readers[i].read;
    }
    return NULL;
}

/* The elements of the mesh as one list of node numbers. */
static int *elements_of(cipc_mesh *mesh, cipc_mesh_kind kind, size_t *count)
{
    *count = 0;
    if (kind == CIPC_MESH_TRIANGLES) *count = 3 * (size_t)mesh->triangle_count;
    if (kind == CIPC_MESH_SEGMENTS) *count = 2 * (size_t)mesh->segment_count;
    if (kind == CIPC_MESH_TETRAHEDRA) *count = 4 * (size_t)mesh->tetrahedron_count;
    if (kind == CIPC_MESH_TRIANGLES) return mesh->triangles[0];
    return kind == CIPC_MESH_SEGMENTS ? mesh->segments[0] : mesh->tetrahedra[0];
}

/* Leave out nodes that no element uses; the others keep their order. */
static cipc_status drop_unused(cipc_mesh *mesh, cipc_mesh_kind kind, const char *path, cipc_error *error)
{
    size_t count;
    int *elements = elements_of(mesh, kind, &count), *number = cipc_alloc((size_t)mesh->node_count, sizeof *number), kept = 0;
    if (number == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for %d nodes", mesh->node_count);
    for (size_t i = 0; i < count; i++) number[elements[i]] = 1;
    for (int i = 0; i < mesh->node_count; i++) {
        if (number[i] == 0) continue;
        memmove(mesh->nodes + 3 * (size_t)kept, mesh->nodes + 3 * (size_t)i, 3 * sizeof *mesh->nodes);
        number[i] = kept++;
    }
    for (size_t i = 0; i < count; i++) elements[i] = number[elements[i]];
    mesh->node_count = kept;
    cipc_free(number);
    return CIPC_OK;
}

cipc_status cipc_mesh_read(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    reader *read = reader_for(path);
    if (read == NULL) return cipc_fail(error, CIPC_E_BAD_MESH, path, "the ending tells no format; .obj, .seg, .msh and .vtk are read");
    cipc_status status = read(mesh, path, kind, error);
    if (status == CIPC_OK && kind != CIPC_MESH_NODES) status = drop_unused(mesh, kind, path, error);
    if (status != CIPC_OK) {
        cipc_mesh_free(mesh);
        return status;
    }
    if (kind == CIPC_MESH_TETRAHEDRA) scene_mesh_orient(mesh);
    return CIPC_OK;
}
