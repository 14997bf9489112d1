/* Lattices of particles. */
#include <gsl/gsl_rng.h>
#include <math.h>

#include "scene/mesh.h"

cipc_status cipc_mesh_lattice(cipc_mesh *mesh, const int count[3], const double spacing[3], double jitter, unsigned long seed, cipc_error *error)
{
    static const char place[] = "lattice";
    *mesh = (cipc_mesh){0};
    bool good = jitter >= 0 && isfinite(jitter);
    double nodes = 1;
    for (int k = 0; k < 3; k++) {
        good = good && count[k] >= 1 && spacing[k] > 0 && isfinite(spacing[k]);
        nodes *= count[k];
    }
    if (!good || nodes > SCENE_NODES_MAX) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "%d by %d by %d particles, %g by %g by %g m apart, moved by up to %g m; at most %d particles", count[0], count[1], count[2],
                         spacing[0], spacing[1], spacing[2], jitter, SCENE_NODES_MAX);
    }
    cipc_status status = scene_mesh_allocate_kind(mesh, CIPC_MESH_NODES, (long long)nodes, 0, place, error);
    if (status != CIPC_OK) return status;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (rng == NULL) {
        cipc_mesh_free(mesh);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for random numbers");
    }
    gsl_rng_set(rng, seed);
    /* x fastest, then y, then z. */
    for (int i = 0; i < mesh->node_count; i++) {
        const int at[3] = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        for (int k = 0; k < 3; k++) {
            double shift = jitter > 0 ? jitter * (2 * gsl_rng_uniform(rng) - 1) : 0;
            mesh->nodes[3 * (size_t)i + (size_t)k] = (at[k] - 0.5 * (count[k] - 1)) * spacing[k] + shift;
        }
    }
    gsl_rng_free(rng);
    return CIPC_OK;
}
