/* A bed of nails: slender pyramids of four slivers each, standing on y = 0. */
#include <math.h>
#include <string.h>

#include "scene/mesh.h"

static const char place[] = "nails";

static cipc_status check(const cipc_nails *n, cipc_error *error)
{
    if (n->count[0] < 1 || n->count[1] < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d nails", n->count[0], n->count[1]);
    if (!(n->width > 0 && n->height > 0 && isfinite(n->width) && isfinite(n->height)))
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "nails %g m wide and %g m high", n->width, n->height);
    for (int k = 0; k < 2; k++)
        if (n->count[k] > 1 && !(n->spacing[k] > n->width && isfinite(n->spacing[k])))
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "nails %g m wide with a spacing of %g m would meet", n->width, n->spacing[k]);
    return CIPC_OK;
}

/* Four corners of the base, seen from above anticlockwise (x, -z), and the point; the sides face outward. */
static void put_nail(cipc_mesh *mesh, int number, const double middle[2], const cipc_nails *n)
{
    static const double corner[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    double *x = mesh->nodes + 15 * (size_t)number;
    for (int i = 0; i < 4; i++) {
        x[3 * i] = middle[0] + 0.5 * n->width * corner[i][0];
        x[3 * i + 1] = 0;
        x[3 * i + 2] = middle[1] + 0.5 * n->width * corner[i][1];
        const int triangle[3] = {5 * number + i, 5 * number + (i + 1) % 4, 5 * number + 4};
        memcpy(mesh->triangles[4 * (size_t)number + (size_t)i], triangle, sizeof triangle);
    }
    x[12] = middle[0];
    x[13] = n->height;
    x[14] = middle[1];
}

cipc_status cipc_mesh_nails(cipc_mesh *mesh, const cipc_nails *nails, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(nails, error);
    if (status != CIPC_OK) return status;
    const long long count = scene_mesh_product(nails->count[0], nails->count[1]);
    const scene_mesh_sizes sizes = {.nodes = scene_mesh_product(5, count), .triangles = scene_mesh_product(4, count)};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    for (int i = 0; status == CIPC_OK && i < (int)count; i++) {
        const int index[2] = {i % nails->count[0], i / nails->count[0]};
        double middle[2];
        for (int k = 0; k < 2; k++) middle[k] = nails->count[k] > 1 ? nails->spacing[k] * (index[k] - 0.5 * (nails->count[k] - 1)) : 0;
        put_nail(mesh, i, middle, nails);
    }
    return status;
}
