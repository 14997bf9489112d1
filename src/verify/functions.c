/* The names of the functions that queries can ask (docs/conformance.md). */
#include <string.h>

#include "verify/query.h"

/* In the order of their level: scalars' and predicates' own numbers, then stencils, energies, times of impact. */
static const char *const names[] = {
    "orient3d",
    "intersect_edge_triangle",
    "distance2_point_point",
    "distance2_point_edge",
    "distance2_point_triangle",
    "distance2_edge_edge",
    "energy/inertia",
    "energy/gravity",
    "energy/dirichlet_penalty",
    "energy/membrane_neo_hookean",
    "energy/membrane_stvk",
    "energy/strain_limit",
    "energy/hinge_bending",
    "energy/barrier_point_point",
    "energy/barrier_point_edge",
    "energy/barrier_point_triangle",
    "energy/barrier_edge_edge",
    "energy/friction",
    "toi_point_point",
    "toi_point_edge",
    "toi_point_triangle",
    "toi_edge_edge",
};

int verify_function_count(void) { return (int)(sizeof names / sizeof names[0]); }

const char *verify_function_at(int index) { return names[index]; }

const char *verify_function_name(const char *name)
{
    for (int i = 0; i < verify_function_count(); i++)
        if (strcmp(names[i], name) == 0) return names[i];
    return NULL;
}

int verify_query_numbers(const char *fn)
{
    cipc_pair_kind kind;
    if (verify_query_kind(fn, "distance2_", &kind)) return 3 * cipc_pair_nodes(kind);
    return strcmp(fn, "orient3d") == 0 ? 12 : 15; /* four points; edge and triangle */
}
