/* The table of all energies. The functions are reached through thunks with the table's own types, so that none is ever called through a
 * pointer of another type. */
#include "energy/fields.h"
#include "energy/samplers.h"

#include <string.h>

#define THUNKS(energy, params_type)                                                                                                        \
    static double energy##_value(const double *x, const void *params)                                                                      \
    {                                                                                                                                      \
        return cipc_##energy##_value(x, (const params_type *)params);                                                                      \
    }                                                                                                                                      \
    static void energy##_gradient(const double *x, const void *params, double *g)                                                          \
    {                                                                                                                                      \
        cipc_##energy##_gradient(x, (const params_type *)params, g);                                                                       \
    }                                                                                                                                      \
    static void energy##_hessian(const double *x, const void *params, double *H)                                                           \
    {                                                                                                                                      \
        cipc_##energy##_hessian(x, (const params_type *)params, H);                                                                        \
    }

THUNKS(inertia, cipc_inertia)
THUNKS(gravity, cipc_gravity)
THUNKS(dirichlet_penalty, cipc_dirichlet_penalty)
THUNKS(membrane_neo_hookean, cipc_membrane)
THUNKS(membrane_stvk, cipc_membrane)
THUNKS(strain_limit, cipc_strain_limit)
THUNKS(strain_limit_lower, cipc_strain_limit)
THUNKS(membrane_orthotropic, cipc_orthotropic)
THUNKS(hinge_bending, cipc_hinge_bending)
THUNKS(volume_corotational, cipc_volume)
THUNKS(volume_neo_hookean, cipc_volume)
THUNKS(rod_stretching, cipc_rod_stretching)
THUNKS(rod_bending, cipc_rod_bending)
THUNKS(stitch, cipc_stitch)
THUNKS(damping, cipc_damping)
THUNKS(barrier_point_point, cipc_contact_barrier)
THUNKS(barrier_point_edge, cipc_contact_barrier)
THUNKS(barrier_point_triangle, cipc_contact_barrier)
THUNKS(barrier_edge_edge, cipc_contact_barrier)
THUNKS(friction, cipc_friction)

/* An entry; sampler and branch names may be shared by several energies. */
#define ENTRY(energy, params_type, node_count, invariance, sampler, branch_total, names, field_total, field_list)                          \
    {                                                                                                                                      \
        .name = #energy, .nodes = (node_count), .params_size = sizeof(params_type), .value = energy##_value,                               \
        .gradient = energy##_gradient, .hessian = energy##_hessian, .invariances = (invariance), .branch_count = (branch_total),           \
        .branch_names = (names), .sample = energy_sample_##sampler, .branch = energy_branch_##sampler, .field_count = (field_total),       \
        .fields = (field_list),                                                                                                            \
    }

enum { NONE = 0, TRANSLATION = CIPC_INVARIANT_TRANSLATION, RIGID = CIPC_INVARIANT_TRANSLATION | CIPC_INVARIANT_ROTATION };

static const cipc_energy table[CIPC_ENERGY_COUNT] = {
    [CIPC_ENERGY_INERTIA] = ENTRY(inertia, cipc_inertia, 1, NONE, inertia, ENERGY_NODAL_BRANCHES, energy_nodal_branch_names, 2, energy_fields_inertia),
    [CIPC_ENERGY_GRAVITY] = ENTRY(gravity, cipc_gravity, 1, NONE, gravity, ENERGY_GRAVITY_BRANCHES, energy_gravity_branch_names, 2, energy_fields_gravity),
    [CIPC_ENERGY_DIRICHLET_PENALTY] =
        ENTRY(dirichlet_penalty, cipc_dirichlet_penalty, 1, NONE, dirichlet_penalty, ENERGY_NODAL_BRANCHES, energy_nodal_branch_names, 3, energy_fields_dirichlet_penalty),
    [CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN] =
        ENTRY(membrane_neo_hookean, cipc_membrane, 3, RIGID, membrane, ENERGY_MEMBRANE_BRANCHES, energy_membrane_branch_names, 5, energy_fields_membrane),
    [CIPC_ENERGY_MEMBRANE_STVK] =
        ENTRY(membrane_stvk, cipc_membrane, 3, RIGID, membrane, ENERGY_MEMBRANE_BRANCHES, energy_membrane_branch_names, 5, energy_fields_membrane),
    [CIPC_ENERGY_STRAIN_LIMIT] =
        ENTRY(strain_limit, cipc_strain_limit, 3, RIGID, strain_limit, ENERGY_STRAIN_LIMIT_BRANCHES, energy_strain_limit_branch_names, 5, energy_fields_strain_limit),
    [CIPC_ENERGY_STRAIN_LIMIT_LOWER] = ENTRY(strain_limit_lower, cipc_strain_limit, 3, RIGID, strain_limit_lower, ENERGY_STRAIN_LIMIT_LOWER_BRANCHES,
                                             energy_strain_limit_lower_branch_names, 5, energy_fields_strain_limit),
    [CIPC_ENERGY_MEMBRANE_ORTHOTROPIC] = ENTRY(membrane_orthotropic, cipc_orthotropic, 3, RIGID, membrane_orthotropic, ENERGY_ORTHOTROPIC_BRANCHES,
                                               energy_orthotropic_branch_names, 11, energy_fields_orthotropic),
    [CIPC_ENERGY_HINGE_BENDING] =
        ENTRY(hinge_bending, cipc_hinge_bending, 4, RIGID, hinge_bending, ENERGY_HINGE_BRANCHES, energy_hinge_branch_names, 2, energy_fields_hinge_bending),
    [CIPC_ENERGY_VOLUME_COROTATIONAL] =
        ENTRY(volume_corotational, cipc_volume, 4, RIGID, volume, ENERGY_VOLUME_BRANCHES, energy_volume_branch_names, 4, energy_fields_volume),
    [CIPC_ENERGY_VOLUME_NEO_HOOKEAN] =
        ENTRY(volume_neo_hookean, cipc_volume, 4, RIGID, volume, ENERGY_VOLUME_BRANCHES, energy_volume_branch_names, 4, energy_fields_volume),
    [CIPC_ENERGY_ROD_STRETCHING] = ENTRY(rod_stretching, cipc_rod_stretching, 2, RIGID, rod_stretching, ENERGY_ROD_STRETCHING_BRANCHES,
                                         energy_rod_stretching_branch_names, 2, energy_fields_rod_stretching),
    [CIPC_ENERGY_ROD_BENDING] =
        ENTRY(rod_bending, cipc_rod_bending, 3, RIGID, rod_bending, ENERGY_ROD_BENDING_BRANCHES, energy_rod_bending_branch_names, 2, energy_fields_rod_bending),
    [CIPC_ENERGY_STITCH] = ENTRY(stitch, cipc_stitch, 3, RIGID, stitch, ENERGY_STITCH_BRANCHES, energy_stitch_branch_names, 2, energy_fields_stitch),
    /* K may be any element's, one that holds nodes to places among them: no invariance is promised, though most K have one. */
    [CIPC_ENERGY_DAMPING] = ENTRY(damping, cipc_damping, 4, NONE, damping, ENERGY_DAMPING_BRANCHES, energy_damping_branch_names, 3, energy_fields_damping),
    [CIPC_ENERGY_BARRIER_POINT_POINT] = ENTRY(barrier_point_point, cipc_contact_barrier, 2, RIGID, barrier_point_point,
                                              ENERGY_CONTACT_BRANCHES, energy_contact_branch_names, ENERGY_BARRIER_PLAIN_FIELDS, energy_fields_barrier),
    [CIPC_ENERGY_BARRIER_POINT_EDGE] = ENTRY(barrier_point_edge, cipc_contact_barrier, 3, RIGID, barrier_point_edge,
                                             ENERGY_POINT_EDGE_BRANCHES, energy_point_edge_branch_names, ENERGY_BARRIER_PLAIN_FIELDS, energy_fields_barrier),
    [CIPC_ENERGY_BARRIER_POINT_TRIANGLE] = ENTRY(barrier_point_triangle, cipc_contact_barrier, 4, RIGID, barrier_point_triangle,
                                                 ENERGY_POINT_TRIANGLE_BRANCHES, energy_point_triangle_branch_names, ENERGY_BARRIER_PLAIN_FIELDS, energy_fields_barrier),
    [CIPC_ENERGY_BARRIER_EDGE_EDGE] = ENTRY(barrier_edge_edge, cipc_contact_barrier, 4, RIGID, barrier_edge_edge, ENERGY_EDGE_EDGE_BRANCHES,
                                            energy_edge_edge_branch_names, ENERGY_BARRIER_FIELDS, energy_fields_barrier),
    /* The weights of a contact sum to zero, so a common translation of x alone leaves the sliding as it is; a rotation does not, because
     * start and basis are lagged. */
    [CIPC_ENERGY_FRICTION] =
        ENTRY(friction, cipc_friction, 4, TRANSLATION, friction, ENERGY_FRICTION_BRANCHES, energy_friction_branch_names, 5, energy_fields_friction),
};

const cipc_energy *cipc_energy_entry(cipc_energy_id id)
{
    return &table[id];
}

const cipc_energy *cipc_energy_find(const char *name)
{
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        if (strcmp(table[i].name, name) == 0) return &table[i];
    }
    return NULL;
}
