/* VTK's legacy files, ASCII: UNSTRUCTURED_GRID and POLYDATA; cells as rows "count points..." up to version 5.0, as offsets and points from 5.1 on. Numbers may be broken into
 * lines anywhere. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "scene/mesh.h"
#include "scene/mesh_formats.h"

static const long long cells_max = 8LL * SCENE_TETRAHEDRA_MAX; /* of all types, and of the numbers that describe them */

/* The cells of one section; cell c has the points ids[starts[c]] to ids[starts[c + 1] - 1]. */
typedef struct cell_list {
    long long count, start_capacity;
    long long *starts;
    long long id_count, id_capacity, line_capacity;
    long long *ids;
    int *lines; /* of each id */
} cell_list;

typedef struct vtk_reader {
    scene_scan *scan;
    scene_parts *parts;
    bool offsets;   /* cells as of version 5.1 */
    bool grid;      /* UNSTRUCTURED_GRID */
    bool has_points, has_cells, has_types;
    cell_list cells; /* of the grid, until their types are known */
} vtk_reader;

static void free_cells(cell_list *cells)
{
    cipc_free(cells->starts);
    cipc_free(cells->ids);
    cipc_free(cells->lines);
    *cells = (cell_list){0};
}

static bool is_keyword(const scene_word *word, const char *keyword)
{
    return strlen(keyword) == (size_t)word->length && strncasecmp(word->text, keyword, strlen(keyword)) == 0;
}

/* "# vtk DataFile Version 4.2" */
static cipc_status read_version(vtk_reader *r)
{
    static const char *const words[] = {"#", "vtk", "DataFile", "Version"};
    scene_word word;
    for (int i = 0; i < 4; i++) {
        bool fits = scene_next_word(r->scan, i == 0 ? SCENE_ANYWHERE : SCENE_SAME_LINE, &word) && is_keyword(&word, words[i]);
        if (!fits) return scene_scan_reject(r->scan, "not a legacy VTK file: it does not begin with '# vtk DataFile Version'");
    }
    cipc_status status = scene_expect_word(r->scan, SCENE_SAME_LINE, "a version", &word);
    if (status != CIPC_OK) return status;
    bool is_version = word.length == 3 && word.text[1] == '.' && word.text[2] >= '0' && word.text[2] <= '9';
    bool is_known = is_version && ((word.text[0] >= '1' && word.text[0] <= '4') || (word.text[0] == '5' && word.text[2] <= '1'));
    if (!is_known) return scene_scan_reject(r->scan, "version %.*s is not read; 1.0 to 5.1 are", scene_shown(&word), word.text);
    r->offsets = word.text[0] == '5' && word.text[2] == '1';
    return scene_expect_line_end(r->scan, "the version");
}

/* The title is a line of any text. */
static void skip_title(vtk_reader *r)
{
    for (int i = 0; i < 2; i++) {
        scene_skip_line(r->scan);
        if (*r->scan->at != '\n') return;
        r->scan->at++;
        r->scan->line++;
    }
}

static cipc_status read_encoding_and_dataset(vtk_reader *r)
{
    scene_word word;
    cipc_status status = scene_expect_word(r->scan, SCENE_ANYWHERE, "ASCII", &word);
    if (status != CIPC_OK) return status;
    if (is_keyword(&word, "BINARY")) return scene_scan_reject(r->scan, "binary VTK is not read: save as ASCII");
    if (!is_keyword(&word, "ASCII")) return scene_scan_reject(r->scan, "'%.*s' where ASCII is expected", scene_shown(&word), word.text);
    status = scene_expect_word(r->scan, SCENE_ANYWHERE, "DATASET", &word);
    if (status != CIPC_OK) return status;
    if (!is_keyword(&word, "DATASET")) return scene_scan_reject(r->scan, "'%.*s' where DATASET is expected", scene_shown(&word), word.text);
    status = scene_expect_word(r->scan, SCENE_SAME_LINE, "the kind of the dataset", &word);
    if (status != CIPC_OK) return status;
    r->grid = is_keyword(&word, "UNSTRUCTURED_GRID");
    if (r->grid || is_keyword(&word, "POLYDATA")) return CIPC_OK;
    return scene_scan_reject(r->scan, "DATASET %.*s is not read; UNSTRUCTURED_GRID and POLYDATA are", scene_shown(&word), word.text);
}

/* POINTS n type, 3 n numbers */
static cipc_status read_points(vtk_reader *r)
{
    if (r->has_points) return scene_scan_reject(r->scan, "a second POINTS");
    r->has_points = true;
    long long count;
    scene_word type;
    double x[3];
    cipc_status status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of points", SCENE_NODES_MAX, &count);
    if (status == CIPC_OK) status = scene_expect_word(r->scan, SCENE_SAME_LINE, "the type of the coordinates", &type);
    for (long long i = 0; status == CIPC_OK && i < count; i++) {
        for (int k = 0; k < 3 && status == CIPC_OK; k++) {
            status = scene_expect_entry(r->scan, "coordinates", 3 * i + k, 3 * count);
            if (status == CIPC_OK) status = scene_expect_number(r->scan, SCENE_ANYWHERE, "a coordinate", &x[k]);
        }
        if (status == CIPC_OK) status = scene_parts_add_node(r->parts, r->scan, x);
    }
    return status;
}

static cipc_status add_start(scene_scan *scan, cell_list *cells, long long index, long long start)
{
    cipc_status status = scene_grow(scan, &cells->starts, index, &cells->start_capacity, sizeof *cells->starts);
    if (status == CIPC_OK) cells->starts[index] = start;
    return status;
}

static cipc_status read_id(scene_scan *scan, cell_list *cells)
{
    long long id;
    cipc_status status = scene_expect_integer(scan, SCENE_ANYWHERE, "a point of a cell", &id);
    if (status == CIPC_OK) status = scene_grow(scan, &cells->ids, cells->id_count, &cells->id_capacity, sizeof *cells->ids);
    if (status == CIPC_OK) status = scene_grow(scan, &cells->lines, cells->id_count, &cells->line_capacity, sizeof *cells->lines);
    if (status != CIPC_OK) return status;
    cells->ids[cells->id_count] = id;
    cells->lines[cells->id_count++] = scan->line;
    return CIPC_OK;
}

/* n cells as "k id ... id"; `size` numbers in all. */
static cipc_status read_rows(scene_scan *scan, cell_list *cells, long long count, long long size)
{
    cipc_status status = add_start(scan, cells, 0, 0);
    for (long long c = 0; status == CIPC_OK && c < count; c++) {
        long long points;
        status = scene_expect_entry(scan, "cells", c, count);
        if (status == CIPC_OK) status = scene_expect_integer(scan, SCENE_ANYWHERE, "the number of points of a cell", &points);
        if (status != CIPC_OK) return status;
        long long left = size - cells->id_count - c - 1;
        if (points < 1 || points > left) return scene_scan_reject(scan, "a cell of %lld points, but %lld numbers are left of the %lld announced", points, left, size);
        for (long long k = 0; k < points && status == CIPC_OK; k++) {
            status = scene_expect_entry(scan, "points of a cell", k, points);
            if (status == CIPC_OK) status = read_id(scan, cells);
        }
        if (status == CIPC_OK) status = add_start(scan, cells, c + 1, cells->id_count);
    }
    if (status == CIPC_OK && cells->id_count + count != size) {
        return scene_scan_reject(scan, "%lld cells of %lld numbers, but %lld are announced", count, cells->id_count + count, size);
    }
    cells->count = count;
    return status;
}

static cipc_status expect_array(scene_scan *scan, const char *name)
{
    scene_word word;
    cipc_status status = scene_expect_word(scan, SCENE_ANYWHERE, name, &word);
    if (status != CIPC_OK) return status;
    if (!is_keyword(&word, name)) return scene_scan_reject(scan, "'%.*s' where %s is expected", scene_shown(&word), word.text, name);
    return scene_expect_word(scan, SCENE_SAME_LINE, "the type of the numbers", &word);
}

/* OFFSETS type, n numbers from 0 up to `size`, the first point of each cell and the end of the last; CONNECTIVITY type, `size` points. */
static cipc_status read_offsets(scene_scan *scan, cell_list *cells, long long count, long long size)
{
    cipc_status status = expect_array(scan, "OFFSETS");
    for (long long c = 0; status == CIPC_OK && c < count; c++) {
        long long start;
        status = scene_expect_entry(scan, "offsets", c, count);
        if (status == CIPC_OK) status = scene_expect_integer(scan, SCENE_ANYWHERE, "an offset", &start);
        if (status != CIPC_OK) return status;
        bool fits = c == 0 ? start == 0 : start > cells->starts[c - 1] && start <= size;
        if (!fits) return scene_scan_reject(scan, "offset %lld is %lld; offsets must rise from 0 to %lld", c + 1, start, size);
        status = add_start(scan, cells, c, start);
    }
    if (status == CIPC_OK && (count > 0 ? cells->starts[count - 1] : 0) != size) {
        return scene_scan_reject(scan, "the offsets end at %lld, but %lld points are announced", count > 0 ? cells->starts[count - 1] : 0, size);
    }
    if (status == CIPC_OK) status = expect_array(scan, "CONNECTIVITY");
    for (long long i = 0; status == CIPC_OK && i < size; i++) {
        status = scene_expect_entry(scan, "points of CONNECTIVITY", i, size);
        if (status == CIPC_OK) status = read_id(scan, cells);
    }
    cells->count = count > 0 ? count - 1 : 0;
    return status;
}

static cipc_status read_cells(vtk_reader *r, cell_list *cells)
{
    long long count, size;
    cipc_status status = scene_expect_count(r->scan, SCENE_SAME_LINE, r->offsets ? "the number of offsets" : "the number of cells", cells_max, &count);
    if (status == CIPC_OK) status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of numbers", cells_max, &size);
    if (status != CIPC_OK) return status;
    return r->offsets ? read_offsets(r->scan, cells, count, size) : read_rows(r->scan, cells, count, size);
}

/* What a cell is: polygons and polylines may have any number of points from the least one on. */
typedef struct cell_type {
    int number;
    cipc_mesh_kind kind;
    int least;
    bool any_more;
} cell_type;

static const cell_type vertices = {2, CIPC_MESH_NODES, 1, true}, polyline = {4, CIPC_MESH_SEGMENTS, 2, true}, polygon = {7, CIPC_MESH_TRIANGLES, 3, true};

static const cell_type *find_type(long long number)
{
    static const cell_type types[] = {{1, CIPC_MESH_NODES, 1, false},     {3, CIPC_MESH_SEGMENTS, 2, false},  {5, CIPC_MESH_TRIANGLES, 3, false},
                                      {9, CIPC_MESH_TRIANGLES, 4, false}, {10, CIPC_MESH_TETRAHEDRA, 4, false}};
    if (number == vertices.number) return &vertices;
    if (number == polyline.number) return &polyline;
    if (number == polygon.number) return &polygon;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (types[i].number == number) return &types[i];
    }
    return NULL;
}

static cipc_status add_cell(vtk_reader *r, const cell_list *cells, long long cell, const cell_type *type)
{
    long long start = cells->starts[cell], points = cells->starts[cell + 1] - start;
    int line = cells->lines[start];
    if (points < type->least || (points > type->least && !type->any_more)) {
        return scene_scan_reject_at(r->scan, line, CIPC_E_BAD_MESH, "a cell of type %d with %lld points; %d are needed", type->number, points, type->least);
    }
    const long long *ids = cells->ids + start;
    if (type->kind == CIPC_MESH_TRIANGLES) return scene_parts_add_polygon(r->parts, r->scan, line, ids, points);
    if (type->kind == CIPC_MESH_SEGMENTS) return scene_parts_add_polyline(r->parts, r->scan, line, ids, points);
    return scene_parts_add(r->parts, r->scan, line, type->kind, ids);
}

/* CELL_TYPES n, n numbers */
static cipc_status read_types(vtk_reader *r)
{
    if (!r->has_cells || r->has_types) return scene_scan_reject(r->scan, r->has_types ? "a second CELL_TYPES" : "CELL_TYPES before CELLS");
    r->has_types = true;
    long long count;
    cipc_status status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of cell types", cells_max, &count);
    if (status != CIPC_OK) return status;
    if (count != r->cells.count) return scene_scan_reject(r->scan, "%lld cell types for %lld cells", count, r->cells.count);
    for (long long c = 0; status == CIPC_OK && c < count; c++) {
        long long number;
        status = scene_expect_entry(r->scan, "cell types", c, count);
        if (status == CIPC_OK) status = scene_expect_integer(r->scan, SCENE_ANYWHERE, "a cell type", &number);
        if (status != CIPC_OK) return status;
        const cell_type *type = find_type(number);
        char what[32];
        snprintf(what, sizeof what, "type %lld", number);
        if (type != NULL)
            status = add_cell(r, &r->cells, c, type);
        else
            scene_parts_skip(r->parts, what, 1);
    }
    return status;
}

static cipc_status read_grid_cells(vtk_reader *r)
{
    if (r->has_cells) return scene_scan_reject(r->scan, "a second CELLS");
    r->has_cells = true;
    return read_cells(r, &r->cells);
}

/* A section of polydata; all its cells are of one type, or of none that is read. */
static cipc_status read_poly_cells(vtk_reader *r, const cell_type *type, const char *name)
{
    cell_list cells = {0};
    cipc_status status = read_cells(r, &cells);
    for (long long c = 0; type != NULL && status == CIPC_OK && c < cells.count; c++) status = add_cell(r, &cells, c, type);
    if (type == NULL && status == CIPC_OK) scene_parts_skip(r->parts, name, cells.count);
    free_cells(&cells);
    return status;
}

/* FIELD name n, then n times: name components tuples type, numbers */
static cipc_status skip_field(vtk_reader *r)
{
    scene_word word;
    long long arrays, components, tuples;
    cipc_status status = scene_expect_word(r->scan, SCENE_SAME_LINE, "a field's name", &word);
    if (status == CIPC_OK) status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of arrays", cells_max, &arrays);
    for (long long a = 0; status == CIPC_OK && a < arrays; a++) {
        status = scene_expect_word(r->scan, SCENE_ANYWHERE, "an array's name", &word);
        if (status == CIPC_OK) status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of components", cells_max, &components);
        if (status == CIPC_OK) status = scene_expect_count(r->scan, SCENE_SAME_LINE, "the number of tuples", cells_max, &tuples);
        if (status == CIPC_OK) status = scene_expect_word(r->scan, SCENE_SAME_LINE, "the type of an array", &word);
        if (status != CIPC_OK) return status;
        long long count = scene_mesh_product(components, tuples);
        for (long long i = 0; status == CIPC_OK && i < count; i++) status = scene_expect_word(r->scan, SCENE_ANYWHERE, "an array's entry", &word);
    }
    return status;
}

/* METADATA ends with an empty line. */
static void skip_metadata(vtk_reader *r)
{
    scene_word word;
    do {
        scene_skip_line(r->scan);
        if (*r->scan->at == '\0') return;
        r->scan->at++;
        r->scan->line++;
    } while (scene_peek_word(r->scan, SCENE_SAME_LINE, &word));
}

static cipc_status read_section(vtk_reader *r, const scene_word *name)
{
    if (is_keyword(name, "POINTS")) return read_points(r);
    if (r->grid && is_keyword(name, "CELLS")) return read_grid_cells(r);
    if (r->grid && is_keyword(name, "CELL_TYPES")) return read_types(r);
    if (!r->grid && is_keyword(name, "VERTICES")) return read_poly_cells(r, &vertices, "VERTICES");
    if (!r->grid && is_keyword(name, "LINES")) return read_poly_cells(r, &polyline, "LINES");
    if (!r->grid && is_keyword(name, "POLYGONS")) return read_poly_cells(r, &polygon, "POLYGONS");
    if (!r->grid && is_keyword(name, "TRIANGLE_STRIPS")) return read_poly_cells(r, NULL, "TRIANGLE_STRIPS");
    if (is_keyword(name, "FIELD")) return skip_field(r);
    if (is_keyword(name, "METADATA")) {
        skip_metadata(r);
        return CIPC_OK;
    }
    return scene_scan_reject(r->scan, "'%.*s' where a section should begin", scene_shown(name), name->text);
}

/* What belongs to points or cells comes last and is not used. */
static cipc_status read_sections(vtk_reader *r)
{
    cipc_status status = CIPC_OK;
    for (scene_word name; status == CIPC_OK && scene_next_word(r->scan, SCENE_ANYWHERE, &name);) {
        if (is_keyword(&name, "POINT_DATA") || is_keyword(&name, "CELL_DATA")) break;
        status = read_section(r, &name);
    }
    if (status == CIPC_OK && !r->has_points) status = scene_scan_reject_at(r->scan, 0, CIPC_E_BAD_MESH, "it has no POINTS");
    if (status == CIPC_OK && r->has_cells && !r->has_types) status = scene_scan_reject_at(r->scan, 0, CIPC_E_BAD_MESH, "it has CELLS, but no CELL_TYPES");
    return status;
}

cipc_status scene_read_vtk(scene_scan *scan, scene_parts *parts)
{
    vtk_reader r = {.scan = scan, .parts = parts};
    parts->one = "point";
    parts->many = "points";
    cipc_status status = read_version(&r);
    if (status == CIPC_OK) {
        skip_title(&r);
        status = read_encoding_and_dataset(&r);
    }
    if (status == CIPC_OK) status = read_sections(&r);
    free_cells(&r.cells);
    return status;
}
