/* The section of a solid of revolution: rows of points across its wall, each cell divided into smaller ones. */
#include "scene/solid_revolution.h"

#include "scene/lists.h"
#include "scene/mesh.h"

/* The rows of a section, equally long: rows * columns points, row by row (cipc_free); NULL if rejected. */
static double *read_section(scene_reader *r, const scene_cursor *revolution, int *rows, int *columns)
{
    scene_cursor section = scene_member(revolution, "section");
    double *points = NULL;
    *rows = *columns = 0;
    if (section.value == NULL) scene_reject(r, &section, CIPC_E_MISSING_KEY, "required, but missing: rows of points [radius, height]");
    if (!scene_is_array(r, &section, 2, SCENE_NODES_MAX)) return NULL;
    *rows = (int)json_array_size(section.value);
    for (int i = 0; i < *rows && r->status == CIPC_OK; i++) {
        scene_cursor element = scene_element(&section, (size_t)i);
        int count = 0;
        double *row = scene_points_at(r, &element, 2, 2, SCENE_NODES_MAX / (size_t)*rows, &count);
        if (i == 0) {
            *columns = count;
            points = cipc_alloc(2 * (size_t)*rows * (size_t)count + 1, sizeof *points);
            if (points == NULL) scene_reject_memory(r, &section);
        }
        if (count != *columns) scene_reject(r, &element, CIPC_E_OUT_OF_RANGE, "has %d points, but the first row has %d", count, *columns);
        for (int k = 0; r->status == CIPC_OK && k < 2 * count; k++) points[2 * i * *columns + k] = row[k];
        cipc_free(row);
    }
    if (r->status == CIPC_OK) return points;
    cipc_free(points);
    return NULL;
}

/* Point (i, j) of the section divided: bilinear in the cell that it lies in. */
static void divided_point(const double *points, int columns, const int divide[2], int i, int j, const int last[2], double x[2])
{
    const int row = i / divide[0] < last[0] ? i / divide[0] : last[0], column = j / divide[1] < last[1] ? j / divide[1] : last[1];
    const double u = (double)(i - row * divide[0]) / divide[0], v = (double)(j - column * divide[1]) / divide[1];
    const double *a = points + 2 * (row * columns + column), *b = a + 2 * columns;
    for (int k = 0; k < 2; k++) x[k] = (1 - u) * ((1 - v) * a[k] + v * a[k + 2]) + u * ((1 - v) * b[k] + v * b[k + 2]);
}

static void make_revolution(scene_reader *r, const scene_cursor *cursor, const double *points, int rows, int columns, const int divide[2], int sectors,
                            cipc_mesh *mesh)
{
    cipc_error error;
    const long long across = 1 + scene_mesh_product(rows - 1, divide[0]), along = 1 + scene_mesh_product(columns - 1, divide[1]);
    const int last[2] = {rows - 2, columns - 2};
    if (scene_mesh_product(across, along) > SCENE_NODES_MAX) {
        scene_reject(r, cursor, CIPC_E_OUT_OF_RANGE, "has a section of %lld by %lld points; at most %d nodes are allowed", across, along, SCENE_NODES_MAX);
        return;
    }
    double(*divided)[2] = cipc_alloc((size_t)(across * along), sizeof *divided);
    if (divided == NULL) {
        scene_reject_memory(r, cursor);
        return;
    }
    for (int i = 0; i < across; i++) {
        for (int j = 0; j < along; j++) divided_point(points, columns, divide, i, j, last, divided[i * along + j]);
    }
    scene_adopt(r, cursor, cipc_mesh_solid_revolution(mesh, (int)across, (int)along, (const double(*)[2])divided, sectors, &error), &error);
    cipc_free(divided);
}

void scene_read_solid_revolution(scene_reader *r, const scene_cursor *revolution, cipc_mesh *mesh)
{
    static const char *const keys[] = {"section", "divide", "sectors", NULL};
    int rows, columns, divide[2] = {1, 1};
    if (!scene_is_object(r, revolution, keys)) return;
    int sectors = scene_integer(r, revolution, "sectors", SCENE_REQUIRED, 3, SCENE_NODES_MAX);
    scene_cursor member = scene_member(revolution, "divide");
    if (member.value != NULL)
        scene_integers(r, revolution, "divide", 2, 1, SCENE_NODES_MAX, divide);
    else
        scene_set(r, revolution, "divide", json_pack("[ii]", 1, 1));
    double *points = read_section(r, revolution, &rows, &columns);
    if (points != NULL) make_revolution(r, revolution, points, rows, columns, divide, sectors, mesh);
    cipc_free(points);
}
