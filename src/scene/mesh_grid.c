/* Regular triangulation of a rectangle. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "grid";

static cipc_status check(double size_x, double size_z, int cells_x, int cells_z, cipc_error *error)
{
    if (!(size_x > 0 && size_z > 0 && isfinite(size_x) && isfinite(size_z))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a grid of %g by %g m", size_x, size_z);
    }
    if (cells_x < 1 || cells_z < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a grid of %d by %d cells", cells_x, cells_z);
    return CIPC_OK;
}

/* Nodes row by row: x fastest, z from the most negative. The far edge is exact: -s/2 + s * n/n. */
static void place_nodes(cipc_mesh *mesh, double size_x, double size_z, int cells_x, int cells_z)
{
    double *x = mesh->nodes;
    for (int j = 0; j <= cells_z; j++) {
        for (int i = 0; i <= cells_x; i++, x += 3) {
            x[0] = -0.5 * size_x + size_x * ((double)i / cells_x);
            x[1] = 0;
            x[2] = -0.5 * size_z + size_z * ((double)j / cells_z);
        }
    }
}

static void add_triangle(cipc_mesh *mesh, int *count, int a, int b, int c)
{
    int *triangle = mesh->triangles[(*count)++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Corner 00 has the smaller x and z. With normal +y a triangle runs from z towards x: (00, 01, 10) where 01 is one step along z. */
static void split_cells(cipc_mesh *mesh, int cells_x, int cells_z, bool alternate)
{
    int count = 0;
    for (int j = 0; j < cells_z; j++) {
        for (int i = 0; i < cells_x; i++) {
            int n00 = j * (cells_x + 1) + i, n10 = n00 + 1, n01 = n00 + cells_x + 1, n11 = n01 + 1;
            if (alternate && (i + j) % 2 != 0) {
                add_triangle(mesh, &count, n00, n01, n10);
                add_triangle(mesh, &count, n10, n01, n11);
            } else {
                add_triangle(mesh, &count, n00, n11, n10);
                add_triangle(mesh, &count, n00, n01, n11);
            }
        }
    }
}

cipc_status cipc_mesh_grid(cipc_mesh *mesh, double size_x, double size_z, int cells_x, int cells_z, bool alternate, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(size_x, size_z, cells_x, cells_z, error);
    if (status != CIPC_OK) return status;
    status = scene_mesh_allocate(mesh, (cells_x + 1LL) * (cells_z + 1LL), 2LL * cells_x * cells_z, place, error);
    if (status != CIPC_OK) return status;
    place_nodes(mesh, size_x, size_z, cells_x, cells_z);
    split_cells(mesh, cells_x, cells_z, alternate);
    return CIPC_OK;
}
