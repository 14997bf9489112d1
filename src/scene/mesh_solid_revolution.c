/* Solids of revolution: plates, glasses, bottles, tables. The section is a lattice of points (radius, height), the third axis of the lattice runs around; cells are cut as those of
 * a box are. On the axis the nodes of all sectors are one: tetrahedra that lose a corner there vanish, and the others still share whole faces, because cells are cut alike. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "revolution";

typedef struct section {
    int rows, columns;         /* points across the wall, points along it */
    const double (*points)[2]; /* rows * columns, row by row: radius, height */
    int sectors;
} section;

static bool on_axis(const section *s, int point)
{
    return s->points[point][0] == 0;
}

static cipc_status check(const section *s, cipc_error *error)
{
    if (s->rows < 2 || s->columns < 2) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a section of %d by %d points; at least 2 by 2 are needed", s->rows, s->columns);
    if (s->sectors < 3) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d sectors; at least 3 are needed", s->sectors);
    for (int p = 0; p < s->rows * s->columns; p++) {
        const double *point = s->points[p];
        if (!(point[0] >= 0 && isfinite(point[0]) && isfinite(point[1]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d of the section, (%g, %g), has no radius of 0 or more", p, point[0], point[1]);
        }
    }
    return CIPC_OK;
}

/* Twice the area of the triangle a b c in the plane of radius and height; anticlockwise is positive. */
static double doubled_area(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* All four corners of every cell turn the same way: then cells are convex, and none is inside out. *sign: which way. */
static cipc_status check_cells(const section *s, double *sign, cipc_error *error)
{
    *sign = 0;
    for (int i = 0; i + 1 < s->rows; i++) {
        for (int j = 0; j + 1 < s->columns; j++) {
            const int corner = i * s->columns + j, corners[4] = {corner, corner + 1, corner + s->columns + 1, corner + s->columns};
            for (int k = 0; k < 4; k++) {
                const double area = doubled_area(s->points[corners[k]], s->points[corners[(k + 1) % 4]], s->points[corners[(k + 2) % 4]]);
                if (*sign == 0) *sign = area;
                if (!(area * *sign > 0)) {
                    return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "the cell of the section at row %d, column %d is not convex, or is turned another way than the first", i, j);
                }
            }
        }
    }
    return CIPC_OK;
}

/* Node of each point of the section in sector 0: points on the axis have one node, others one for each sector. */
static int number_points(const section *s, int *first)
{
    int count = 0;
    for (int p = 0; p < s->rows * s->columns; p++) {
        first[p] = count;
        count += on_axis(s, p) ? 1 : s->sectors;
    }
    return count;
}

static void place_nodes(const section *s, const int *first, double *nodes)
{
    const double full = 2 * acos(-1.0);
    for (int p = 0; p < s->rows * s->columns; p++) {
        for (int k = 0; k < (on_axis(s, p) ? 1 : s->sectors); k++) {
            double *x = nodes + 3 * (first[p] + k);
            const double angle = full * k / s->sectors;
            x[0] = s->points[p][0] * cos(angle);
            x[1] = s->points[p][1];
            x[2] = -s->points[p][0] * sin(angle);
        }
    }
}

static bool repeats(const int t[4])
{
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

/* The six tetrahedra of a cell, less those that the axis flattens. Returns how many; out may be NULL: count only. */
static int cut_cell(const section *s, const int *first, const int at[3], bool turned, int (*out)[4])
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    int count = 0;
    for (int p = 0; p < 6; p++) {
        int walk[4], here[3] = {at[0], at[1], at[2]};
        for (int step = 0; step < 4; step++) {
            if (step > 0) here[orders[p][step - 1]]++;
            const int point = here[0] * s->columns + here[1];
            walk[step] = first[point] + (on_axis(s, point) ? 0 : here[2] % s->sectors);
        }
        if (repeats(walk)) continue;
        if (out != NULL) {
            const bool exchange = (p >= 3) != turned;
            const int t[4] = {walk[exchange], walk[!exchange], walk[2], walk[3]};
            for (int k = 0; k < 4; k++) out[count][k] = t[k];
        }
        count++;
    }
    return count;
}

static long long cut_all(const section *s, const int *first, bool turned, int (*out)[4])
{
    long long count = 0;
    for (int i = 0; i + 1 < s->rows; i++) {
        for (int j = 0; j + 1 < s->columns; j++) {
            for (int k = 0; k < s->sectors; k++) {
                const int at[3] = {i, j, k};
                count += cut_cell(s, first, at, turned, out != NULL ? out + count : NULL);
            }
        }
    }
    return count;
}

cipc_status cipc_mesh_solid_revolution(cipc_mesh *mesh, int rows, int columns, const double (*points)[2], int sectors, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    const section s = {rows, columns, points, sectors};
    double sign;
    cipc_status status = check(&s, error);
    if (status == CIPC_OK) status = check_cells(&s, &sign, error);
    if (status != CIPC_OK) return status;
    if (scene_mesh_product(scene_mesh_product(rows, columns), sectors) > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a section of %d by %d points in %d sectors; at most %d nodes are allowed", rows, columns, sectors, SCENE_NODES_MAX);
    }
    int *first = cipc_alloc((size_t)rows * (size_t)columns, sizeof *first);
    if (first == NULL) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for a section of %d by %d points", rows, columns);
    const int nodes = number_points(&s, first);
    const bool turned = sign < 0; /* rows, columns and sectors: a left-handed lattice */
    const scene_mesh_sizes sizes = {.nodes = nodes, .tetrahedra = cut_all(&s, first, turned, NULL)};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status == CIPC_OK) {
        place_nodes(&s, first, mesh->nodes);
        cut_all(&s, first, turned, mesh->tetrahedra);
    }
    cipc_free(first);
    return status;
}
