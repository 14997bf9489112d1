/* Bundles and beds of straight rods. */
#include <math.h>

#include "scene/mesh.h"
#include "scene/random.h"

static const char place[] = "rods";

static cipc_status check(const int count[3], const double spacing[3], double length, int segments, cipc_error *error)
{
    if (!(length > 0 && isfinite(length))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "rods of %g m", length);
    if (segments < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d segments a rod", segments);
    for (int a = 0; a < 3; a++) {
        if (count[a] < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d by %d rods", count[0], count[1], count[2]);
        if (count[a] > 1 && !(spacing[a] > 0 && isfinite(spacing[a]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d rods with a spacing of %g m", count[a], spacing[a]);
        }
    }
    if (count[1] > 1 && spacing[1] <= length) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "layers %g m apart of rods of %g m would touch", spacing[1], length);
    }
    return CIPC_OK;
}

/* Steps from the middle of a row, doubled to stay whole. */
static long long doubled_offset(int index, int count)
{
    return 2LL * index - (count - 1);
}

/* The ellipse passes through the outermost axes of the middle rows: (x / (nx - 1))^2 + (z / (nz - 1))^2 <= 1 with x and z doubled offsets. Multiplied out, so that all is whole
 * and rods on the ellipse are in: a layer has at most SCENE_NODES_MAX rods, so the products are below 1e14, which a double holds exactly. */
static bool is_inside(const int count[3], int i, int k)
{
    double width = count[0] > 1 ? count[0] - 1 : 1, depth = count[2] > 1 ? count[2] - 1 : 1;
    double x = (double)doubled_offset(i, count[0]), z = (double)doubled_offset(k, count[2]);
    return x * x * (depth * depth) + z * z * (width * width) <= width * width * (depth * depth);
}

static long long rods_of_layer(const int count[3], bool round)
{
    if (!round) return scene_mesh_product(count[0], count[2]);
    long long inside = 0;
    for (int k = 0; k < count[2]; k++) {
        for (int i = 0; i < count[0]; i++) inside += is_inside(count, i, k);
    }
    return inside;
}

static void add_rod(cipc_mesh *mesh, int rod, const double middle[3], double length, int segments)
{
    int first = rod * (segments + 1);
    for (int s = 0; s <= segments; s++) {
        double *x = mesh->nodes + 3 * (first + s);
        x[0] = middle[0];
        x[1] = middle[1] + length * ((double)s / segments - 0.5);
        x[2] = middle[2];
    }
    for (int s = 0; s < segments; s++) {
        int *segment = mesh->segments[rod * segments + s];
        segment[0] = first + s;
        segment[1] = first + s + 1;
    }
}

static void add_rods(cipc_mesh *mesh, const int count[3], const double spacing[3], double length, int segments, bool round)
{
    int rod = 0;
    for (int j = 0; j < count[1]; j++) {
        for (int k = 0; k < count[2]; k++) {
            for (int i = 0; i < count[0]; i++) {
                if (round && !is_inside(count, i, k)) continue;
                const int index[3] = {i, j, k};
                double middle[3];
                for (int a = 0; a < 3; a++) middle[a] = count[a] > 1 ? 0.5 * spacing[a] * (double)doubled_offset(index[a], count[a]) : 0;
                add_rod(mesh, rod++, middle, length, segments);
            }
        }
    }
}

cipc_status cipc_mesh_rods(cipc_mesh *mesh, const int count[3], const double spacing[3], double length, int segments, bool round, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(count, spacing, length, segments, error);
    if (status != CIPC_OK) return status;
    if (scene_mesh_product(count[0], count[2]) > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "layers of %d by %d rods; at most %d nodes are allowed", count[0], count[2], SCENE_NODES_MAX);
    }
    long long rods = scene_mesh_product(rods_of_layer(count, round), count[1]);
    if (rods == 0) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "no rods of %d by %d lie within the ellipse", count[0], count[2]);
    scene_mesh_sizes sizes = {.nodes = scene_mesh_product(rods, segments + 1LL), .segments = scene_mesh_product(rods, segments)};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    if (status == CIPC_OK) add_rods(mesh, count, spacing, length, segments, round);
    return status;
}

cipc_status cipc_mesh_shorten_rods(cipc_mesh *mesh, double length, int segments, double shorten, unsigned long seed, cipc_error *error)
{
    if (!(shorten >= 0 && shorten < length)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "rods of %g m that lose up to %g m", length, shorten);
    }
    uint64_t random = seed;
    for (int first = 0; first < mesh->node_count; first += segments + 1) {
        const double kept = 1 - shorten * scene_random(&random) / length, top = mesh->nodes[3 * (first + segments) + 1];
        for (int s = 0; s < segments; s++) {
            double *y = &mesh->nodes[3 * (first + s) + 1];
            *y = top - kept * (top - *y);
        }
    }
    return CIPC_OK;
}
