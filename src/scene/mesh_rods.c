/* Rods: polylines, arcs, lattices of straight rods, woven nets. */
#include <math.h>

#include "base/vector.h"
#include "scene/mesh.h"

static const double two_pi = 6.28318530717958647692;

static bool all_positive(const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        if (!(values[i] > 0 && isfinite(values[i]))) return false;
    }
    return true;
}

static void add_segment(cipc_mesh *mesh, int index, int a, int b)
{
    mesh->segments[index][0] = a;
    mesh->segments[index][1] = b;
}

cipc_status cipc_mesh_polyline(cipc_mesh *mesh, int count, const double (*points)[3], int segments, bool closed, cipc_error *error)
{
    static const char place[] = "polyline";
    *mesh = (cipc_mesh){0};
    if (count < 2 || segments < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d points with %d segments from one to the next; at least 2 and 1 are needed", count, segments);
    if (closed && count < 3) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a closed line of %d points; at least 3 are needed", count);
    long long stretches = closed ? count : count - 1, elements = stretches * segments, nodes = closed ? elements : elements + 1;
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_SEGMENTS, nodes, elements, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0; i < mesh->node_count; i++) {
        int stretch = i / segments, part = i % segments;
        const double *a = points[stretch % count], *b = points[(stretch + 1) % count], t = (double)part / segments;
        for (int k = 0; k < 3; k++) mesh->nodes[3 * (size_t)i + (size_t)k] = part == 0 ? a[k] : a[k] + t * (b[k] - a[k]);
    }
    for (int i = 0; i < mesh->segment_count; i++) add_segment(mesh, i, i, (i + 1) % mesh->node_count);
    return CIPC_OK;
}

cipc_status cipc_mesh_arc(cipc_mesh *mesh, double radius, double angle, int segments, cipc_error *error)
{
    static const char place[] = "arc";
    const double numbers[2] = {radius, angle};
    *mesh = (cipc_mesh){0};
    bool closed = fabs(angle - two_pi) < 1e-9;
    if (!all_positive(numbers, 2) || segments < (closed ? 3 : 1) || (angle > two_pi && !closed)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "an arc of radius %g m over %g rad with %d segments; at most a full turn, of 3 segments or more", radius, angle, segments);
    }
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_SEGMENTS, closed ? segments : segments + 1LL, segments, place, error);
    if (status != CIPC_OK) return status;
    for (int i = 0; i < mesh->node_count; i++) {
        double turn = (closed ? two_pi : angle) * ((double)i / segments);
        mesh->nodes[3 * (size_t)i] = radius * cos(turn);
        mesh->nodes[3 * (size_t)i + 1] = radius * sin(turn);
    }
    for (int i = 0; i < segments; i++) add_segment(mesh, i, i, (i + 1) % mesh->node_count);
    return CIPC_OK;
}

/* Place of the i-th of n along a row that is centred on 0. */
static double centred(int i, int n, double spacing) { return (i - 0.5 * (n - 1)) * spacing; }

/* Is the rod at column i, row j inside the ellipse that its layer's outermost rods touch? */
static bool is_kept(int i, int j, const int count[3], bool round)
{
    if (!round) return true;
    double x = count[0] > 1 ? centred(i, count[0], 2.0 / (count[0] - 1)) : 0, z = count[2] > 1 ? centred(j, count[2], 2.0 / (count[2] - 1)) : 0;
    return x * x + z * z <= 1 + 1e-12;
}

static long long rods_in_layer(const int count[3], bool round)
{
    long long rods = 0;
    for (int j = 0; j < count[2]; j++) {
        for (int i = 0; i < count[0]; i++) rods += is_kept(i, j, count, round);
    }
    return rods;
}

static void place_rod(cipc_mesh *mesh, long long rod, const double middle[3], double length, int segments)
{
    for (int s = 0; s <= segments; s++) {
        double *x = mesh->nodes + 3 * (size_t)(rod * (segments + 1) + s);
        v3_copy(x, middle);
        x[1] += length * ((double)s / segments - 0.5);
        if (s > 0) add_segment(mesh, (int)(rod * segments + s - 1), (int)(rod * (segments + 1) + s - 1), (int)(rod * (segments + 1) + s));
    }
}

cipc_status cipc_mesh_rods(cipc_mesh *mesh, const int count[3], const double spacing[3], double length, int segments, bool round, cipc_error *error)
{
    static const char place[] = "rods";
    *mesh = (cipc_mesh){0};
    bool good = segments >= 1 && all_positive(&length, 1) && all_positive(spacing, 3);
    for (int k = 0; k < 3; k++) good = good && count[k] >= 1 && count[k] <= SCENE_NODES_MAX;
    if (!good || (double)count[0] * count[2] > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d by %d rods of %g m and %d segments, %g by %g by %g m apart", count[0], count[1], count[2], length, segments,
                         spacing[0], spacing[1], spacing[2]);
    }
    long long rods = rods_in_layer(count, round) * count[1];
    if (rods > SCENE_NODES_MAX) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%lld rods; at most %d are allowed", rods, SCENE_NODES_MAX);
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_SEGMENTS, rods * (segments + 1LL), rods * segments, place, error);
    if (status != CIPC_OK) return status;
    long long rod = 0;
    for (int layer = 0; layer < count[1]; layer++) {
        for (int j = 0; j < count[2]; j++) {
            for (int i = 0; i < count[0]; i++) {
                const double middle[3] = {centred(i, count[0], spacing[0]), centred(layer, count[1], spacing[1]), centred(j, count[2], spacing[2])};
                if (is_kept(i, j, count, round)) place_rod(mesh, rod++, middle, length, segments);
            }
        }
    }
    return CIPC_OK;
}

/* Height of rod `own` where it crosses the others: up and down in turn, straight between two crossings. */
static double woven(double along, int own, int n, double pitch, double lift)
{
    double place = along / pitch + 0.5 * (n - 1), lower = floor(place), part = place - lower;
    double first = fmin(fmax(lower, 0), n - 1), second = fmin(fmax(lower + 1, 0), n - 1);
    double sign[2] = {fmod(first + own, 2) == 0 ? 1 : -1, fmod(second + own, 2) == 0 ? 1 : -1};
    return lift * ((1 - part) * sign[0] + part * sign[1]);
}

cipc_status cipc_mesh_net(cipc_mesh *mesh, double size, int n, int segments, double lift, cipc_error *error)
{
    static const char place[] = "net";
    const double numbers[2] = {size, lift};
    *mesh = (cipc_mesh){0};
    if (!all_positive(numbers, 2) || n < 1 || segments < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a net of %g m with %d rods each way, %d segments and a lift of %g m", size, n, segments, lift);
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_SEGMENTS, 2LL * n * (segments + 1LL), 2LL * n * segments, place, error);
    if (status != CIPC_OK) return status;
    double pitch = size / n;
    for (int rod = 0; rod < 2 * n; rod++) {
        int own = rod % n, along_z = rod / n;
        for (int s = 0; s <= segments; s++) {
            double along = size * ((double)s / segments - 0.5), height = woven(along, own, n, pitch, lift);
            int node = rod * (segments + 1) + s;
            double *x = mesh->nodes + 3 * (size_t)node;
            x[along_z ? 2 : 0] = along;
            x[along_z ? 0 : 2] = centred(own, n, pitch);
            x[1] = along_z ? -height : height;
            if (s > 0) add_segment(mesh, rod * segments + s - 1, node - 1, node);
        }
    }
    return CIPC_OK;
}
