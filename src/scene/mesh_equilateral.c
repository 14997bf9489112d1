/* A sheet of equilateral triangles. */
#include <math.h>
#include <string.h>

#include "scene/mesh.h"

static const char place[] = "equilateral";

static cipc_status check(double edge, int columns, int rows, cipc_error *error)
{
    if (!(edge > 0 && isfinite(edge))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "triangles with edges of %g m", edge);
    if (columns < 1 || rows < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a sheet of %d by %d cells", columns, rows);
    return CIPC_OK;
}

/* Lines of columns + 1 nodes, shifted by a quarter of an edge to the left and to the right in turn. */
static void place_nodes(cipc_mesh *mesh, double edge, int columns, int rows)
{
    double *x = mesh->nodes;
    for (int j = 0; j <= rows; j++) {
        for (int i = 0; i <= columns; i++, x += 3) {
            x[0] = edge * (i - 0.5 * columns + (j % 2 == 0 ? -0.25 : 0.25));
            x[1] = 0;
            x[2] = 0.5 * sqrt(3.0) * edge * (j - 0.5 * rows);
        }
    }
}

/* Cell i, j lies between its corners i and i + 1 on line j and on line j + 1; its shorter diagonal cuts it. */
static void cut_cells(cipc_mesh *mesh, int columns, int rows)
{
    int(*triangle)[3] = mesh->triangles;
    for (int j = 0; j < rows; j++) {
        for (int i = 0; i < columns; i++, triangle += 2) {
            const int n00 = j * (columns + 1) + i, n10 = n00 + 1, n01 = n00 + columns + 1, n11 = n01 + 1;
            const int to_right[2][3] = {{n00, n01, n10}, {n10, n01, n11}}, to_left[2][3] = {{n00, n11, n10}, {n00, n01, n11}};
            memcpy(triangle, j % 2 == 0 ? to_right : to_left, sizeof to_right);
        }
    }
}

cipc_status cipc_mesh_equilateral(cipc_mesh *mesh, double edge, int columns, int rows, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(edge, columns, rows, error);
    if (status != CIPC_OK) return status;
    status = scene_mesh_allocate(mesh, scene_mesh_product(columns + 1LL, rows + 1LL), scene_mesh_product(2, scene_mesh_product(columns, rows)), place, error);
    if (status != CIPC_OK) return status;
    place_nodes(mesh, edge, columns, rows);
    cut_cells(mesh, columns, rows);
    return CIPC_OK;
}
