/* Lattices of particles. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const int count[3] = {4, 3, 5};
static const double spacing[3] = {0.1, 0.2, 0.3};

static cipc_mesh lattice(double jitter, unsigned long seed)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_lattice(&mesh, count, spacing, jitter, seed, NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, 60);
    assert_int_equal(mesh.triangle_count + mesh.segment_count + mesh.tetrahedron_count, 0);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    return mesh;
}

static void test_places_without_jitter(void **state)
{
    (void)state;
    cipc_mesh mesh = lattice(0, 1);
    int node = 0;
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k < 5; k++) {
            for (int i = 0; i < 4; i++, node++) {
                const double *x = mesh.nodes + 3 * node;
                assert_true(fabs(x[0] - 0.1 * (i - 1.5)) < 1e-16 && fabs(x[1] - 0.2 * (j - 1)) < 1e-16 && fabs(x[2] - 0.3 * (k - 2)) < 1e-16);
            }
        }
    }
    cipc_mesh_free(&mesh);
}

/* All moves are below the jitter, some nearly as large, in both directions of every coordinate. */
static void test_jitter(void **state)
{
    (void)state;
    const double jitter = 0.04;
    cipc_mesh still = lattice(0, 7), moved = lattice(jitter, 7);
    double least[3] = {0}, most[3] = {0};
    for (int i = 0; i < 180; i++) {
        double move = moved.nodes[i] - still.nodes[i];
        least[i % 3] = fmin(least[i % 3], move);
        most[i % 3] = fmax(most[i % 3], move);
    }
    for (int a = 0; a < 3; a++) {
        assert_true(least[a] >= -jitter * (1 + 1e-14) && least[a] < -0.9 * jitter);
        assert_true(most[a] <= jitter * (1 + 1e-14) && most[a] > 0.9 * jitter);
    }
    cipc_mesh_free(&still);
    cipc_mesh_free(&moved);
}

static void test_the_seed_decides_the_bits(void **state)
{
    (void)state;
    cipc_mesh a = lattice(0.01, 3), b = lattice(0.01, 3), c = lattice(0.01, 4);
    assert_true(are_same_meshes(&a, &b));
    assert_false(are_same_meshes(&a, &c));
    cipc_mesh_free(&a);
    cipc_mesh_free(&b);
    cipc_mesh_free(&c);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    const int none[3] = {1, 0, 1}, huge[3] = {2147483647, 2147483647, 2147483647}, one[3] = {1, 1, 1};
    const double bad[3] = {0.1, (double)NAN, 0.3};
    assert_int_equal(cipc_mesh_lattice(&mesh, none, spacing, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&mesh, huge, spacing, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&mesh, count, bad, 0, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&mesh, count, spacing, -1e-9, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&mesh, count, spacing, (double)INFINITY, 1, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_lattice(&mesh, count, spacing, 0.05, 1, NULL), CIPC_E_OUT_OF_RANGE); /* half the spacing: neighbours could meet */
    assert_int_equal(cipc_mesh_lattice(&mesh, one, bad, 5, 1, NULL), CIPC_OK);                      /* no neighbours */
    cipc_mesh_free(&mesh);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_lattice(&mesh, count, spacing, 0.01, 1, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
    }
    fail_allocation(0);
    cipc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places_without_jitter),
        cmocka_unit_test(test_jitter),
        cmocka_unit_test(test_the_seed_decides_the_bits),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
