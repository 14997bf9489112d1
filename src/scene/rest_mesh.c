/* The same elements at other places. */
#include "scene/rest_mesh.h"

#include <string.h>

#include "scene/mesh_file.h"

/* Elements of one kind: how many, of how many nodes, and these. */
typedef struct elements {
    const char *name;
    int count, size;
    const void *nodes;
} elements;

static elements elements_of(const cipc_mesh *m, cipc_mesh_kind kind)
{
    switch (kind) {
    case CIPC_MESH_TRIANGLES:
        return (elements){"triangles", m->triangle_count, 3, m->triangles};
    case CIPC_MESH_SEGMENTS:
        return (elements){"segments", m->segment_count, 2, m->segments};
    case CIPC_MESH_TETRAHEDRA:
        return (elements){"tetrahedra", m->tetrahedron_count, 4, m->tetrahedra};
    default:
        return (elements){"nodes", 0, 1, NULL};
    }
}

static void compare(scene_reader *r, const scene_cursor *cursor, cipc_mesh_kind kind, const cipc_mesh *rest, const cipc_mesh *mesh)
{
    elements a = elements_of(rest, kind), b = elements_of(mesh, kind);
    if (rest->node_count != mesh->node_count || a.count != b.count) {
        scene_reject(r, cursor, CIPC_E_BAD_MESH, "has %d nodes and %d %s, but the body has %d and %d", rest->node_count, a.count, a.name,
                     mesh->node_count, b.count);
    } else if (a.count > 0 && memcmp(a.nodes, b.nodes, (size_t)a.count * (size_t)a.size * sizeof(int)) != 0) {
        scene_reject(r, cursor, CIPC_E_BAD_MESH, "has not the %s of the body, which must be the same nodes in the same order", a.name);
    }
}

static double *copy_pattern(scene_reader *r, const scene_cursor *rest, const cipc_mesh *mesh)
{
    if (mesh->pattern == NULL) {
        scene_reject(r, rest, CIPC_E_OUT_OF_RANGE, "is \"flat\", but this mesh has no flat pattern: only gores, pleats and ribbons have one");
        return NULL;
    }
    size_t numbers = 3 * (size_t)mesh->node_count;
    double *nodes = cipc_alloc(numbers, sizeof *nodes);
    if (nodes == NULL)
        scene_reject_memory(r, rest);
    else
        memcpy(nodes, mesh->pattern, numbers * sizeof *nodes);
    return nodes;
}

double *scene_read_rest_mesh(scene_reader *r, const scene_cursor *body, cipc_mesh_kind kind, const cipc_mesh *mesh)
{
    scene_cursor rest = scene_member(body, "rest"), file = scene_member(&rest, "mesh");
    cipc_mesh read;
    if (r->status != CIPC_OK) return NULL;
    if (json_is_string(rest.value) && strcmp(json_string_value(rest.value), "flat") == 0) return copy_pattern(r, &rest, mesh);
    if (file.value == NULL) return NULL;
    scene_read_mesh_file(r, &rest, kind, &read);
    if (r->status == CIPC_OK) compare(r, &file, kind, &read, mesh);
    double *nodes = NULL;
    if (r->status == CIPC_OK) {
        nodes = read.nodes;
        read.nodes = NULL;
    }
    cipc_mesh_free(&read);
    return nodes;
}
