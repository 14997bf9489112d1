/* From the nodes and elements of a file to a mesh. */
#include "scene/mesh_parts.h"

#include <stdio.h>
#include <string.h>

#include "cipc/geometry.h"
#include "scene/mesh.h"

enum { FIRST_CAPACITY = 64 };

int scene_corners(cipc_mesh_kind kind)
{
    static const int corners[] = {[CIPC_MESH_TRIANGLES] = 3, [CIPC_MESH_SEGMENTS] = 2, [CIPC_MESH_NODES] = 1, [CIPC_MESH_TETRAHEDRA] = 4};
    return corners[kind];
}

const char *scene_kind_name(cipc_mesh_kind kind)
{
    static const char *const names[] = {
        [CIPC_MESH_TRIANGLES] = "triangles", [CIPC_MESH_SEGMENTS] = "segments", [CIPC_MESH_NODES] = "nodes", [CIPC_MESH_TETRAHEDRA] = "tetrahedra"};
    return names[kind];
}

static const char *one_of(cipc_mesh_kind kind)
{
    return kind == CIPC_MESH_TRIANGLES ? "triangle" : kind == CIPC_MESH_SEGMENTS ? "segment" : "tetrahedron";
}

scene_parts scene_parts_of(cipc_mesh_kind kind)
{
    return (scene_parts){.kind = kind, .one = "node", .many = "nodes"};
}

void scene_parts_free(scene_parts *parts)
{
    cipc_free(parts->nodes);
    cipc_free(parts->corners);
    cipc_free(parts->lines);
    *parts = (scene_parts){0};
}

/* `array` is the address of a pointer of any object type; its bytes are copied, for a void ** may not alias it. */
cipc_status scene_grow(scene_scan *scan, void *array, long long count, long long *capacity, size_t size)
{
    if (count < *capacity) return CIPC_OK;
    long long larger = *capacity == 0 ? FIRST_CAPACITY : 2 * *capacity;
    void *block;
    memcpy(&block, array, sizeof block);
    block = cipc_realloc(block, (size_t)larger, size);
    if (block == NULL) return scene_scan_reject_at(scan, scan->line, CIPC_E_OUT_OF_MEMORY, "no memory for %lld entries", larger);
    memcpy(array, &block, sizeof block);
    *capacity = larger;
    return CIPC_OK;
}

cipc_status scene_parts_add_node(scene_parts *parts, scene_scan *scan, const double x[3])
{
    if (parts->node_count == SCENE_NODES_MAX) {
        return scene_scan_reject_at(scan, scan->line, CIPC_E_OUT_OF_RANGE, "more than %d %s", SCENE_NODES_MAX, parts->many);
    }
    cipc_status status = scene_grow(scan, &parts->nodes, parts->node_count, &parts->node_capacity, 3 * sizeof *parts->nodes);
    if (status == CIPC_OK) memcpy(parts->nodes + 3 * parts->node_count++, x, 3 * sizeof *x);
    return status;
}

cipc_status scene_parts_add(scene_parts *parts, scene_scan *scan, int line, cipc_mesh_kind kind, const long long *corners)
{
    parts->seen[kind]++;
    if (kind != parts->kind || kind == CIPC_MESH_NODES) return CIPC_OK;
    size_t size = (size_t)scene_corners(kind) * sizeof *corners;
    cipc_status status = scene_grow(scan, &parts->corners, parts->element_count, &parts->corner_capacity, size);
    if (status == CIPC_OK) status = scene_grow(scan, &parts->lines, parts->element_count, &parts->line_capacity, sizeof *parts->lines);
    if (status != CIPC_OK) return status;
    memcpy(parts->corners + scene_corners(kind) * parts->element_count, corners, size);
    parts->lines[parts->element_count++] = line;
    return CIPC_OK;
}

cipc_status scene_parts_add_polygon(scene_parts *parts, scene_scan *scan, int line, const long long *corners, long long count)
{
    cipc_status status = CIPC_OK;
    for (long long i = 2; i < count && status == CIPC_OK; i++) {
        const long long triangle[3] = {corners[0], corners[i - 1], corners[i]};
        status = scene_parts_add(parts, scan, line, CIPC_MESH_TRIANGLES, triangle);
    }
    return status;
}

cipc_status scene_parts_add_polyline(scene_parts *parts, scene_scan *scan, int line, const long long *corners, long long count)
{
    cipc_status status = CIPC_OK;
    for (long long i = 1; i < count && status == CIPC_OK; i++) status = scene_parts_add(parts, scan, line, CIPC_MESH_SEGMENTS, corners + i - 1);
    return status;
}

void scene_parts_skip(scene_parts *parts, const char *what, long long count)
{
    if (parts->unread_count == 0) snprintf(parts->unread, sizeof parts->unread, "%s", what);
    parts->unread_count += count;
}

/* "an empty mesh: 8 nodes and 0 tetrahedra, but 12 triangles and 1 element that is not read (type 5)": says what the file has instead. */
static cipc_status check_kind(const scene_parts *parts, scene_scan *scan)
{
    bool particles = parts->kind == CIPC_MESH_NODES;
    if (parts->node_count > 0 && (particles || parts->element_count > 0)) return CIPC_OK;
    if (particles) return scene_scan_reject_at(scan, 0, CIPC_E_BAD_MESH, "an empty mesh: no %s", parts->many);
    char instead[192] = "";
    for (int kind = 0; kind < 4; kind++) {
        if (parts->seen[kind] == 0 || kind == (int)parts->kind || kind == CIPC_MESH_NODES) continue;
        size_t used = strlen(instead);
        snprintf(instead + used, sizeof instead - used, "%s %lld %s", used == 0 ? ", but" : ",", parts->seen[kind], scene_kind_name((cipc_mesh_kind)kind));
    }
    if (parts->unread_count > 0) {
        size_t used = strlen(instead);
        snprintf(instead + used, sizeof instead - used, "%s %lld elements of types that are not read (first: %s)", used == 0 ? ", but" : ",", parts->unread_count,
                 parts->unread);
    }
    return scene_scan_reject_at(scan, 0, CIPC_E_BAD_MESH, "an empty mesh: %lld %s and %lld %s%s", parts->node_count, parts->many, parts->element_count,
                                scene_kind_name(parts->kind), instead);
}

static cipc_status check_element(const scene_parts *parts, scene_scan *scan, long long element)
{
    int count = scene_corners(parts->kind);
    const long long *v = parts->corners + count * element;
    for (int k = 0; k < count; k++) {
        if (v[k] < 0 || v[k] >= parts->node_count) {
            return scene_scan_reject_at(scan, parts->lines[element], CIPC_E_BAD_MESH, "%s index %lld, but the file has %lld %s, counted from %d", parts->one,
                                        v[k] + parts->first, parts->node_count, parts->many, parts->first);
        }
        for (int l = 0; l < k; l++) {
            if (v[k] == v[l]) {
                return scene_scan_reject_at(scan, parts->lines[element], CIPC_E_BAD_MESH, "a %s that names a %s twice", one_of(parts->kind), parts->one);
            }
        }
    }
    return CIPC_OK;
}

/* Formats and programs differ in the order of a tetrahedron's nodes; the exact sign of its volume decides. */
static cipc_status turn_tetrahedron(const scene_parts *parts, scene_scan *scan, long long element, const double *nodes, int v[4])
{
    int sign = cipc_orient3d(nodes + 3 * v[0], nodes + 3 * v[1], nodes + 3 * v[2], nodes + 3 * v[3]);
    if (sign == 0) {
        return scene_scan_reject_at(scan, parts->lines[element], CIPC_E_BAD_MESH, "a tetrahedron without volume: %s %lld, %lld, %lld and %lld lie in a plane", parts->many,
                                    parts->corners[4 * element] + parts->first, parts->corners[4 * element + 1] + parts->first,
                                    parts->corners[4 * element + 2] + parts->first, parts->corners[4 * element + 3] + parts->first);
    }
    if (sign < 0) {
        int last = v[3];
        v[3] = v[2];
        v[2] = last;
    }
    return CIPC_OK;
}

/* New number of each node, from 1, in the order of the file; 0: not used. Returns how many are used. */
static int number_nodes(const scene_parts *parts, bool keep_all, int *number)
{
    bool all = keep_all || parts->kind == CIPC_MESH_NODES;
    for (long long i = 0; i < parts->node_count; i++) number[i] = all;
    for (long long i = 0; i < scene_corners(parts->kind) * parts->element_count; i++) number[parts->corners[i]] = 1;
    int count = 0;
    for (long long i = 0; i < parts->node_count; i++) {
        if (number[i] != 0) number[i] = ++count;
    }
    return count;
}

static int *elements_of(cipc_mesh *mesh, cipc_mesh_kind kind)
{
    return kind == CIPC_MESH_TRIANGLES ? (int *)mesh->triangles : kind == CIPC_MESH_SEGMENTS ? (int *)mesh->segments : (int *)mesh->tetrahedra;
}

static cipc_status fill(const scene_parts *parts, scene_scan *scan, const int *number, cipc_mesh *mesh)
{
    for (long long i = 0; i < parts->node_count; i++) {
        if (number[i] != 0) memcpy(mesh->nodes + 3 * (number[i] - 1), parts->nodes + 3 * i, 3 * sizeof *mesh->nodes);
    }
    int count = scene_corners(parts->kind), *elements = elements_of(mesh, parts->kind);
    cipc_status status = CIPC_OK;
    for (long long e = 0; e < parts->element_count && status == CIPC_OK; e++) {
        for (int k = 0; k < count; k++) elements[count * e + k] = number[parts->corners[count * e + k]] - 1;
        if (parts->kind == CIPC_MESH_TETRAHEDRA) status = turn_tetrahedron(parts, scan, e, mesh->nodes, elements + 4 * e);
    }
    return status;
}

static scene_mesh_sizes sizes_of(const scene_parts *parts, int nodes)
{
    scene_mesh_sizes sizes = {.nodes = nodes};
    if (parts->kind == CIPC_MESH_TRIANGLES) sizes.triangles = parts->element_count;
    if (parts->kind == CIPC_MESH_SEGMENTS) sizes.segments = parts->element_count;
    if (parts->kind == CIPC_MESH_TETRAHEDRA) sizes.tetrahedra = parts->element_count;
    return sizes;
}

cipc_status scene_parts_finish(const scene_parts *parts, scene_scan *scan, bool keep_all, cipc_mesh *mesh)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check_kind(parts, scan);
    for (long long e = 0; e < parts->element_count && status == CIPC_OK; e++) status = check_element(parts, scan, e);
    if (status != CIPC_OK) return status;
    int *number = cipc_alloc((size_t)parts->node_count, sizeof *number);
    if (number == NULL) return scene_scan_reject_at(scan, 0, CIPC_E_OUT_OF_MEMORY, "no memory for %lld nodes", parts->node_count);
    scene_mesh_sizes sizes = sizes_of(parts, number_nodes(parts, keep_all, number));
    status = scene_mesh_allocate_sizes(mesh, &sizes, scan->path, scan->error);
    if (status == CIPC_OK) status = fill(parts, scan, number, mesh);
    cipc_free(number);
    if (status != CIPC_OK) cipc_mesh_free(mesh);
    return status;
}
