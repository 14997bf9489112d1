/* Irregular sheets. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

static const double degree = 3.14159265358979323846 / 180;
/* Areas: a few thousand terms of one sign, each with an error of a few 2^-53, and no cancellation. */
static const double sum_tolerance = 1e-12;

static mesh_properties check_sheet(double size_x, double size_z, int nodes, unsigned long seed)
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_irregular(&mesh, size_x, size_z, nodes, seed, NULL), CIPC_OK);
    mesh_properties p = measure_mesh(&mesh);
    assert_int_equal(p.euler, 1);
    assert_int_equal(p.bad_edges, 0);
    assert_int_equal(p.unused_nodes, 0);
    assert_true(p.smallest_up == 1);
    assert_true(fabs(p.area / (size_x * size_z) - 1) < sum_tolerance);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < 3 * mesh.node_count; i++) {
        low[i % 3] = fmin(low[i % 3], mesh.nodes[i]);
        high[i % 3] = fmax(high[i % 3], mesh.nodes[i]);
    }
    assert_true(low[0] == -0.5 * size_x && high[0] == 0.5 * size_x && low[1] == 0 && high[1] == 0);
    assert_true(low[2] == -0.5 * size_z && high[2] == 0.5 * size_z);
    p.edges = mesh.node_count; /* reported in place of the edges: the callers count nodes */
    cipc_mesh_free(&mesh);
    return p;
}

static void test_sheets_have_the_nodes_asked_for_and_good_triangles(void **state)
{
    (void)state;
    const int sizes[] = {100, 400, 841, 2000};
    for (int i = 0; i < 4; i++) {
        for (unsigned long seed = 0; seed < 5; seed++) {
            mesh_properties p = check_sheet(1, 1, sizes[i], seed);
            assert_int_equal(p.edges, sizes[i]);
            assert_true(p.smallest_angle > 20 * degree);
        }
    }
}

static void test_oblong_sheets(void **state)
{
    (void)state;
    assert_int_equal(check_sheet(10, 1, 1000, 3).edges, 1000);
    mesh_properties p = check_sheet(0.01, 1, 1000, 3);
    assert_int_equal(p.edges, 1000);
    assert_true(p.smallest_angle > 15 * degree);
}

static void test_tiny_and_thin_sheets(void **state)
{
    (void)state;
    for (int nodes = 4; nodes < 40; nodes++) check_sheet(1, 1, nodes, 7);
    check_sheet(1, 1000, 50, 7); /* too thin for the number: all nodes on the boundary */
    check_sheet(1e-3, 2e-3, 100, 7);
    check_sheet(1e3, 2e3, 100, 7);
}

/* Not a grid in disguise: inner nodes of 5 and of 7 triangles abound. */
static void test_it_is_irregular(void **state)
{
    (void)state;
    enum { N = 500 };
    cipc_mesh mesh;
    int degrees[N] = {0}, odd = 0;
    assert_int_equal(cipc_mesh_irregular(&mesh, 1, 1, N, 1, NULL), CIPC_OK);
    for (int t = 0; t < mesh.triangle_count; t++) {
        for (int k = 0; k < 3; k++) degrees[mesh.triangles[t][k]]++;
    }
    for (int i = 0; i < N; i++) odd += degrees[i] == 5 || degrees[i] == 7;
    assert_true(odd > N / 10);
    cipc_mesh_free(&mesh);
}

static void test_the_seed_decides_the_bits(void **state)
{
    (void)state;
    cipc_mesh a, b, c;
    assert_int_equal(cipc_mesh_irregular(&a, 1, 1, 300, 5, NULL), CIPC_OK);
    assert_int_equal(cipc_mesh_irregular(&b, 1, 1, 300, 5, NULL), CIPC_OK);
    assert_int_equal(cipc_mesh_irregular(&c, 1, 1, 300, 6, NULL), CIPC_OK);
    size_t nodes = 3 * (size_t)a.node_count * sizeof *a.nodes, triangles = (size_t)a.triangle_count * sizeof *a.triangles;
    assert_int_equal(a.triangle_count, b.triangle_count);
    assert_memory_equal(a.nodes, b.nodes, nodes);
    assert_memory_equal(a.triangles, b.triangles, triangles);
    assert_int_not_equal(memcmp(a.nodes, c.nodes, nodes), 0);
    cipc_mesh_free(&a);
    cipc_mesh_free(&b);
    cipc_mesh_free(&c);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_irregular(&mesh, 0, 1, 100, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_irregular(&mesh, 1, (double)NAN, 100, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_irregular(&mesh, 1, 1, 3, 0, NULL), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_mesh_irregular(&mesh, 1, 1, 2000000000, 0, NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_irregular(&mesh, 1, 1, 30, 0, NULL);
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
        cmocka_unit_test(test_sheets_have_the_nodes_asked_for_and_good_triangles),
        cmocka_unit_test(test_oblong_sheets),
        cmocka_unit_test(test_tiny_and_thin_sheets),
        cmocka_unit_test(test_it_is_irregular),
        cmocka_unit_test(test_the_seed_decides_the_bits),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
