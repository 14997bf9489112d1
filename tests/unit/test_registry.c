/* The table of energies: complete, findable, of one piece with the functions it names. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "cipc/energy.h"

enum { MAX_N = 12 };

/* What the header promises: name, nodes, params struct, invariances, by identifier. */
typedef struct promise {
    const char *name;
    int nodes;
    size_t params_size;
    unsigned invariances;
} promise;

enum { RIGID = CIPC_INVARIANT_TRANSLATION | CIPC_INVARIANT_ROTATION };

static const promise promises[CIPC_ENERGY_COUNT] = {
    [CIPC_ENERGY_INERTIA] = {"inertia", 1, sizeof(cipc_inertia), 0},
    [CIPC_ENERGY_GRAVITY] = {"gravity", 1, sizeof(cipc_gravity), 0},
    [CIPC_ENERGY_DIRICHLET_PENALTY] = {"dirichlet_penalty", 1, sizeof(cipc_dirichlet_penalty), 0},
    [CIPC_ENERGY_MEMBRANE_NEO_HOOKEAN] = {"membrane_neo_hookean", 3, sizeof(cipc_membrane), RIGID},
    [CIPC_ENERGY_MEMBRANE_STVK] = {"membrane_stvk", 3, sizeof(cipc_membrane), RIGID},
    [CIPC_ENERGY_STRAIN_LIMIT] = {"strain_limit", 3, sizeof(cipc_strain_limit), RIGID},
    [CIPC_ENERGY_STRAIN_LIMIT_LOWER] = {"strain_limit_lower", 3, sizeof(cipc_strain_limit), RIGID},
    [CIPC_ENERGY_MEMBRANE_ORTHOTROPIC] = {"membrane_orthotropic", 3, sizeof(cipc_orthotropic), RIGID},
    [CIPC_ENERGY_HINGE_BENDING] = {"hinge_bending", 4, sizeof(cipc_hinge_bending), RIGID},
    [CIPC_ENERGY_VOLUME_COROTATIONAL] = {"volume_corotational", 4, sizeof(cipc_volume), RIGID},
    [CIPC_ENERGY_VOLUME_NEO_HOOKEAN] = {"volume_neo_hookean", 4, sizeof(cipc_volume), RIGID},
    [CIPC_ENERGY_ROD_STRETCHING] = {"rod_stretching", 2, sizeof(cipc_rod_stretching), RIGID},
    [CIPC_ENERGY_ROD_BENDING] = {"rod_bending", 3, sizeof(cipc_rod_bending), RIGID},
    [CIPC_ENERGY_STITCH] = {"stitch", 3, sizeof(cipc_stitch), RIGID},
    [CIPC_ENERGY_DAMPING] = {"damping", 4, sizeof(cipc_damping), 0},
    [CIPC_ENERGY_BARRIER_POINT_POINT] = {"barrier_point_point", 2, sizeof(cipc_contact_barrier), RIGID},
    [CIPC_ENERGY_BARRIER_POINT_EDGE] = {"barrier_point_edge", 3, sizeof(cipc_contact_barrier), RIGID},
    [CIPC_ENERGY_BARRIER_POINT_TRIANGLE] = {"barrier_point_triangle", 4, sizeof(cipc_contact_barrier), RIGID},
    [CIPC_ENERGY_BARRIER_EDGE_EDGE] = {"barrier_edge_edge", 4, sizeof(cipc_contact_barrier), RIGID},
    [CIPC_ENERGY_FRICTION] = {"friction", 4, sizeof(cipc_friction), CIPC_INVARIANT_TRANSLATION},
};

static void test_entries_keep_their_promises(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        assert_string_equal(energy->name, promises[i].name);
        assert_int_equal(energy->nodes, promises[i].nodes);
        assert_int_equal(energy->params_size, promises[i].params_size);
        assert_int_equal(energy->invariances, promises[i].invariances);
    }
}

static void test_names_are_unique_and_found(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        assert_ptr_equal(cipc_energy_find(energy->name), energy);
        for (int j = 0; j < i; j++) assert_string_not_equal(energy->name, cipc_energy_entry((cipc_energy_id)j)->name);
    }
    assert_null(cipc_energy_find("no_such_energy"));
    assert_null(cipc_energy_find(""));
}

static void test_branch_names_are_complete_and_unique(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        assert_true(energy->branch_count > 0);
        for (int b = 0; b < energy->branch_count; b++) {
            assert_non_null(energy->branch_names[b]);
            assert_true(strlen(energy->branch_names[b]) > 0);
            for (int c = 0; c < b; c++) assert_string_not_equal(energy->branch_names[b], energy->branch_names[c]);
        }
    }
}

/* One entry against the functions it stands for, called with their own types: the same bits. */
#define CHECK_THUNKS(energy, params_type)                                                                                                  \
    do {                                                                                                                                   \
        const cipc_energy *entry = cipc_energy_find(#energy);                                                                              \
        double x[MAX_N] = {0}, g[MAX_N] = {0}, want_g[MAX_N] = {0}, H[MAX_N * MAX_N] = {0}, want_H[MAX_N * MAX_N] = {0};                   \
        params_type params;                                                                                                                \
        memset(&params, 0, sizeof params);                                                                                                 \
        entry->sample(rng, entry->branch_count - 1, x, &params);                                                                           \
        entry->gradient(x, &params, g);                                                                                                    \
        entry->hessian(x, &params, H);                                                                                                     \
        cipc_##energy##_gradient(x, &params, want_g);                                                                                      \
        cipc_##energy##_hessian(x, &params, want_H);                                                                                       \
        assert_true(entry->value(x, &params) == cipc_##energy##_value(x, &params));                                                        \
        assert_memory_equal(g, want_g, sizeof g);                                                                                          \
        assert_memory_equal(H, want_H, sizeof H);                                                                                          \
    } while (0)

static void test_entries_call_their_functions(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    CHECK_THUNKS(inertia, cipc_inertia);
    CHECK_THUNKS(gravity, cipc_gravity);
    CHECK_THUNKS(dirichlet_penalty, cipc_dirichlet_penalty);
    CHECK_THUNKS(membrane_neo_hookean, cipc_membrane);
    CHECK_THUNKS(membrane_stvk, cipc_membrane);
    CHECK_THUNKS(strain_limit, cipc_strain_limit);
    CHECK_THUNKS(strain_limit_lower, cipc_strain_limit);
    CHECK_THUNKS(membrane_orthotropic, cipc_orthotropic);
    CHECK_THUNKS(hinge_bending, cipc_hinge_bending);
    CHECK_THUNKS(volume_corotational, cipc_volume);
    CHECK_THUNKS(volume_neo_hookean, cipc_volume);
    CHECK_THUNKS(rod_stretching, cipc_rod_stretching);
    CHECK_THUNKS(rod_bending, cipc_rod_bending);
    CHECK_THUNKS(stitch, cipc_stitch);
    CHECK_THUNKS(damping, cipc_damping);
    CHECK_THUNKS(barrier_point_point, cipc_contact_barrier);
    CHECK_THUNKS(barrier_point_edge, cipc_contact_barrier);
    CHECK_THUNKS(barrier_point_triangle, cipc_contact_barrier);
    CHECK_THUNKS(barrier_edge_edge, cipc_contact_barrier);
    CHECK_THUNKS(friction, cipc_friction);
    gsl_rng_free(rng);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_entries_keep_their_promises),
        cmocka_unit_test(test_names_are_unique_and_found),
        cmocka_unit_test(test_branch_names_are_complete_and_unique),
        cmocka_unit_test(test_entries_call_their_functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
