/* A rod through given points. */
#include <math.h>

#include "scene/mesh.h"

static const char place[] = "polyline";

static cipc_status check(int count, const double (*points)[3], int segments, bool closed, cipc_error *error)
{
    int least = closed ? 3 : 2;
    if (count < least) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d points; %d are needed", count, least);
    if (segments < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d segments between two points", segments);
    for (int i = 0; i < count; i++) {
        const double *x = points[i], *next = points[(i + 1) % count];
        if (!(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "point %d is (%g, %g, %g)", i, x[0], x[1], x[2]);
        }
        if ((closed || i + 1 < count) && x[0] == next[0] && x[1] == next[1] && x[2] == next[2]) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "points %d and %d are the same", i, (i + 1) % count);
        }
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_polyline(cipc_mesh *mesh, int count, const double (*points)[3], int segments, bool closed, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(count, points, segments, closed, error);
    if (status != CIPC_OK) return status;
    long long total = (closed ? count : count - 1LL) * segments;
    scene_mesh_sizes sizes = {.nodes = closed ? total : total + 1, .segments = total};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0; i < mesh->node_count; i++) {
        const double *from = points[i / segments], *to = points[(i / segments + 1) % count];
        double t = (double)(i % segments) / segments;
        for (int a = 0; a < 3; a++) mesh->nodes[3 * i + a] = from[a] + t * (to[a] - from[a]);
    }
    for (int s = 0; s < mesh->segment_count; s++) {
        mesh->segments[s][0] = s;
        mesh->segments[s][1] = (s + 1) % mesh->node_count;
    }
    return CIPC_OK;
}
