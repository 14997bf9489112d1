/* Particles in a lattice, moved a little at random. */
#include <math.h>

#include "scene/mesh.h"
#include "scene/random.h"

static const char place[] = "lattice";

static cipc_status check(const int count[3], const double spacing[3], double jitter, cipc_error *error)
{
    if (!(jitter >= 0 && isfinite(jitter))) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a jitter of %g m", jitter);
    for (int a = 0; a < 3; a++) {
        if (count[a] < 1) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d by %d particles", count[0], count[1], count[2]);
        if (count[a] == 1) continue;
        if (!(spacing[a] > 0 && isfinite(spacing[a]))) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d particles with a spacing of %g m", count[a], spacing[a]);
        }
        if (!(jitter < 0.5 * spacing[a])) {
            return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "a jitter of %g m with a spacing of %g m: neighbours could meet", jitter, spacing[a]);
        }
    }
    return CIPC_OK;
}

cipc_status cipc_mesh_lattice(cipc_mesh *mesh, const int count[3], const double spacing[3], double jitter, unsigned long seed, cipc_error *error)
{
    *mesh = (cipc_mesh){0};
    cipc_status status = check(count, spacing, jitter, error);
    if (status != CIPC_OK) return status;
    scene_mesh_sizes sizes = {.nodes = scene_mesh_product(scene_mesh_product(count[0], count[1]), count[2])};
    status = scene_mesh_allocate_sizes(mesh, &sizes, place, error);
    uint64_t random = seed;
    for (int node = 0; node < mesh->node_count; node++) {
        const int index[3] = {node % count[0], node / count[0] / count[2], node / count[0] % count[2]};
        for (int a = 0; a < 3; a++) {
            double middle = count[a] > 1 ? spacing[a] * (index[a] - 0.5 * (count[a] - 1)) : 0;
            mesh->nodes[3 * node + a] = middle + jitter * (2 * scene_random(&random) - 1);
        }
    }
    return status;
}
