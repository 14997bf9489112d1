/* VTK's legacy ASCII files: unstructured grids with cells in the old layout or in that of version 5.1, and polygonal data. Data of points and cells are passed over. */
#include <limits.h>
#include <string.h>
#include <strings.h>

#include "scene/mesh.h"
#include "scene/token_reader.h"

enum { VTK_LINE = 3, VTK_TRIANGLE = 5, VTK_TETRA = 10 };

/* Cells as two lists: where each begins among the node numbers. */
typedef struct vtk {
    token_reader r;
    cipc_mesh_kind kind;
    bool newer; /* offsets and connectivity */
    int node_count;
    double *nodes;
    int cell_count;
    int *offsets, *connectivity, *types; /* types NULL: polygonal data of the wanted kind */
} vtk;

static void no_memory(vtk *v)
{
    if (v->r.status == CIPC_OK) v->r.status = cipc_fail(v->r.error, CIPC_E_OUT_OF_MEMORY, v->r.path, "no memory for the mesh");
}

static bool word_is(const vtk *v, const char *word) { return (size_t)v->r.length == strlen(word) && strncasecmp(v->r.word, word, strlen(word)) == 0; }

/* A count that the rest of the file can hold: a number takes two bytes at least. */
static long long plausible(vtk *v, const char *what)
{
    long long count = scene_token_integer(&v->r, what, 0, INT_MAX / 4);
    if (v->r.status == CIPC_OK && count > (long long)strlen(v->r.at) / 2 + 1) scene_token_reject(&v->r, "%s is %lld, more than the file holds", what, count);
    return v->r.status == CIPC_OK ? count : 0;
}

static void read_points(vtk *v)
{
    long long count = plausible(v, "the number of points");
    if (!scene_token_next(&v->r)) scene_token_reject(&v->r, "the file ends where the points' type should be");
    if (v->nodes != NULL) scene_token_reject(&v->r, "a second list of points");
    if (v->r.status != CIPC_OK) return;
    v->nodes = cipc_alloc(3 * (size_t)count, sizeof *v->nodes);
    if (v->nodes == NULL) no_memory(v);
    for (long long i = 0; i < 3 * count && v->r.status == CIPC_OK; i++) v->nodes[i] = scene_token_number(&v->r, "a coordinate");
    v->node_count = (int)count;
}

static bool reserve_cells(vtk *v, long long cells, long long numbers)
{
    if (v->offsets != NULL) {
        scene_token_reject(&v->r, "a second list of cells");
        return false;
    }
    v->offsets = cipc_alloc((size_t)cells + 1, sizeof *v->offsets);
    v->connectivity = cipc_alloc((size_t)numbers, sizeof *v->connectivity);
    if (v->offsets == NULL || v->connectivity == NULL) no_memory(v);
    return v->r.status == CIPC_OK;
}

static int node_number(vtk *v) { return (int)scene_token_integer(&v->r, "a point's number", 0, v->node_count > 0 ? v->node_count - 1 : 0); }

/* Old layout: for each cell the number of its nodes, then these. */
static void read_counted_cells(vtk *v, long long cells, long long numbers)
{
    long long left = numbers - cells;
    if (left < 0) scene_token_reject(&v->r, "%lld cells of %lld numbers in all", cells, numbers);
    if (v->r.status != CIPC_OK || !reserve_cells(v, cells, numbers)) return;
    for (long long c = 0; c < cells && v->r.status == CIPC_OK; c++) {
        int nodes = (int)scene_token_integer(&v->r, "the number of a cell's points", 0, left), first = v->offsets[c];
        for (int k = 0; k < nodes && v->r.status == CIPC_OK; k++) v->connectivity[first + k] = node_number(v);
        v->offsets[c + 1] = first + nodes;
        left -= nodes;
    }
    v->cell_count = (int)cells;
}

static void expect(vtk *v, const char *word)
{
    if (!scene_token_next(&v->r) || !word_is(v, word)) scene_token_reject(&v->r, "%s should be here", word);
    if (!scene_token_next(&v->r)) scene_token_reject(&v->r, "the file ends where the type of %s should be", word);
}

/* Layout of version 5.1: one more offset than cells, then all node numbers. */
static void read_offset_cells(vtk *v, long long offsets, long long numbers)
{
    if (offsets < 1) scene_token_reject(&v->r, "no offsets");
    expect(v, "OFFSETS");
    if (v->r.status != CIPC_OK || !reserve_cells(v, offsets, numbers)) return;
    for (long long c = 0; c < offsets && v->r.status == CIPC_OK; c++) v->offsets[c] = (int)scene_token_integer(&v->r, "an offset", c > 0 ? v->offsets[c - 1] : 0, numbers);
    expect(v, "CONNECTIVITY");
    for (long long i = 0; i < numbers && v->r.status == CIPC_OK; i++) v->connectivity[i] = node_number(v);
    v->cell_count = (int)offsets - 1;
}

static void read_cells(vtk *v)
{
    long long cells = plausible(v, "the number of cells"), numbers = plausible(v, "the number of cells' numbers");
    if (v->r.status != CIPC_OK) return;
    if (v->newer) read_offset_cells(v, cells, numbers);
    else read_counted_cells(v, cells, numbers);
}

static void read_types(vtk *v)
{
    long long count = plausible(v, "the number of cell types");
    if (v->r.status == CIPC_OK && (count != v->cell_count || v->types != NULL)) scene_token_reject(&v->r, "%lld cell types for %d cells", count, v->cell_count);
    if (v->r.status != CIPC_OK) return;
    v->types = cipc_alloc((size_t)count, sizeof *v->types);
    if (v->types == NULL) no_memory(v);
    for (long long i = 0; i < count && v->r.status == CIPC_OK; i++) v->types[i] = (int)scene_token_integer(&v->r, "a cell type", 0, 255);
}

static void read_header(vtk *v)
{
    static const char first[] = "# vtk DataFile Version ";
    if (strncmp(v->r.text, first, sizeof first - 1) != 0) {
        scene_token_reject(&v->r, "not a VTK file: it does not begin with '%s'", first);
        return;
    }
    v->newer = v->r.text[sizeof first - 1] >= '5';
    scene_token_skip_line(&v->r);
    if (*v->r.at == '\n') { /* the title */
        v->r.at++;
        v->r.line++;
        scene_token_skip_line(&v->r);
    }
    if (!scene_token_next(&v->r) || !word_is(v, "ASCII")) scene_token_reject(&v->r, "a binary file is not read: save it as ASCII");
    if (!scene_token_next(&v->r) || !word_is(v, "DATASET")) scene_token_reject(&v->r, "DATASET should be here");
    if (!scene_token_next(&v->r) || !(word_is(v, "UNSTRUCTURED_GRID") || word_is(v, "POLYDATA"))) scene_token_reject(&v->r, "only UNSTRUCTURED_GRID and POLYDATA are read");
}

/* Does this section of polygonal data hold the wanted kind? */
static bool is_wanted_section(const vtk *v) { return v->kind == CIPC_MESH_TRIANGLES ? word_is(v, "POLYGONS") : v->kind == CIPC_MESH_SEGMENTS && word_is(v, "LINES"); }

static void read_sections(vtk *v)
{
    read_header(v);
    while (scene_token_next(&v->r)) {
        if (word_is(v, "POINT_DATA") || word_is(v, "CELL_DATA")) return;
        if (word_is(v, "POINTS")) read_points(v);
        else if (word_is(v, "CELLS") || is_wanted_section(v)) read_cells(v);
        else if (word_is(v, "CELL_TYPES")) read_types(v);
    }
}

/* How many elements of the kind a cell makes: polygons are fanned, lines run from node to node. */
static int elements_of(const vtk *v, int cell)
{
    static const int wanted[] = {VTK_TRIANGLE, VTK_LINE, -1, VTK_TETRA};
    int nodes = v->offsets[cell + 1] - v->offsets[cell];
    if (v->types != NULL && v->types[cell] != wanted[v->kind]) return 0;
    if (v->kind == CIPC_MESH_TRIANGLES) return nodes > 2 ? nodes - 2 : 0;
    if (v->kind == CIPC_MESH_SEGMENTS) return nodes > 1 ? nodes - 1 : 0;
    return nodes == 4 && v->types != NULL ? 1 : 0;
}

static void write_elements(const vtk *v, cipc_mesh *mesh)
{
    for (int c = 0, made = 0; c < v->cell_count; c++) {
        const int *n = v->connectivity + v->offsets[c];
        for (int i = 0, count = elements_of(v, c); i < count; i++, made++) {
            if (v->kind == CIPC_MESH_TRIANGLES) {
                const int triangle[3] = {n[0], n[i + 1], n[i + 2]};
                memcpy(mesh->triangles[made], triangle, sizeof triangle);
            } else {
                memcpy(v->kind == CIPC_MESH_SEGMENTS ? mesh->segments[made] : mesh->tetrahedra[made], n + i, (v->kind == CIPC_MESH_SEGMENTS ? 2 : 4) * sizeof *n);
            }
        }
    }
}

static cipc_status finish(vtk *v, cipc_mesh *mesh)
{
    static const char *const names[] = {"triangles", "lines", "points", "tetrahedra"};
    long long count = 0;
    if (v->r.status != CIPC_OK) return v->r.status;
    for (int c = 0; c < v->cell_count && v->kind != CIPC_MESH_NODES; c++) count += elements_of(v, c);
    if (v->node_count == 0) return scene_token_reject(&v->r, "the file ends without points");
    if (count == 0 && v->kind != CIPC_MESH_NODES) return scene_token_reject(&v->r, "the file has no %s", names[v->kind]);
    cipc_status status = scene_mesh_allocate_kind(mesh, v->kind, v->node_count, count, v->r.path, v->r.error);
    if (status != CIPC_OK) return status;
    memcpy(mesh->nodes, v->nodes, 3 * (size_t)v->node_count * sizeof *v->nodes);
    if (v->kind != CIPC_MESH_NODES) write_elements(v, mesh);
    return CIPC_OK;
}

cipc_status scene_mesh_read_vtk(cipc_mesh *mesh, const char *path, cipc_mesh_kind kind, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    vtk v = {.kind = kind};
    cipc_status status = scene_token_reader_open(&v.r, path, error);
    if (status == CIPC_OK) {
        read_sections(&v);
        status = finish(&v, mesh);
    }
    scene_token_reader_close(&v.r);
    cipc_free(v.nodes);
    cipc_free(v.offsets);
    cipc_free(v.connectivity);
    cipc_free(v.types);
    return status;
}
