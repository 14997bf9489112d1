/* A net of rods that pass over and under one another. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "net";

static cipc_status check(double size, int n, int segments, double lift, cipc_error *error)
{
    if (!(size > 0 && lift > 0 && isfinite(size) && isfinite(lift))) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a net of %g m with a lift of %g m", size, lift);
    }
    if (n < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d rods each way", n);
    if (segments < 2LL * n) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d segments a rod; %lld are needed, two for each crossing", segments, 2LL * n);
    }
    return CIPC_OK;
}

/* Height over the lift at a node, `segments` from end to end, of a rod that crosses n others in the middles of n equal stretches, above the even ones. Within one segment of
 * a crossing the height is +-1, so that the straight segments there pass it at exactly that height wherever the nodes lie; between, half a wave. */
static double height(int node, int segments, int n)
{
    double at = (double)node * n / segments, segment = (double)n / segments; /* in stretches */
    double stretch = fmin(floor(at), n - 1), sign = fmod(stretch, 2) == 0 ? 1 : -1;
    double distance = fabs(at - stretch - 0.5);
    if (distance < segment) return sign;
    return sign * cos(1.57079632679489661923 * (segment < 0.5 ? (distance - segment) / (0.5 - segment) : 1));
}

static void add_rod(cipc_mesh *mesh, int rod, double size, int n, int segments, double lift)
{
    int along = rod < n ? 0 : 2, line = rod % n, first = rod * (segments + 1);
    double sign = (rod < n) == (line % 2 == 0) ? 1 : -1; /* at crossing (i, j) the rod along x is above if i + j is even */
    for (int s = 0; s <= segments; s++) {
        double *x = mesh->nodes + 3 * (first + s);
        x[along] = -0.5 * size + size * ((double)s / segments);
        x[1] = sign * lift * height(s, segments, n);
        x[2 - along] = -0.5 * size + size * ((line + 0.5) / n);
    }
    for (int s = 0; s < segments; s++) {
        int *segment = mesh->segments[rod * segments + s];
        segment[0] = first + s;
        segment[1] = first + s + 1;
    }
}

cipc_status cipc_mesh_net(cipc_mesh *mesh, double size, int n, int segments, double lift, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(size, n, segments, lift, error);
    if (status != CIPC_OK) return status;
    scene_mesh_sizes sizes = {.nodes = scene_mesh_product(2LL * n, segments + 1LL), .segments = scene_mesh_product(2LL * n, segments)};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status != CIPC_OK) return status;
    for (int rod = 0; rod < 2 * n; rod++) add_rod(mesh, rod, size, n, segments, lift);
    return CIPC_OK;
}
