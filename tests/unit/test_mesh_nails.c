/* Beds of nails. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"
#include "support/mesh_properties.h"

/* Four slivers a nail, of half the width times the slant height. */
static void test_a_bed(void **state)
{
    (void)state;
    const cipc_nails bed = {.count = {3, 2}, .spacing = {0.1, 0.2}, .width = 0.01, .height = 0.06};
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_nails(&mesh, &bed, NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, 30);
    assert_int_equal(mesh.triangle_count, 24);
    const mesh_properties p = measure_mesh(&mesh);
    const double area = 24 * 0.5 * 0.01 * hypot(0.06, 0.005), volume = 6 * 0.01 * 0.01 * 0.06 / 3;
    assert_true(fabs(p.area / area - 1) < 1e-14);
    assert_true(fabs(p.volume / volume - 1) < 1e-14); /* the open base is in a plane through the origin: of cones from there, outward */
    assert_int_equal(p.bad_edges + p.unused_nodes, 0);
    assert_int_equal(p.boundary_edges, 24);
    assert_int_equal(count_duplicate_nodes(&mesh), 0);
    for (int i = 0; i < 6; i++) {
        const double *tip = mesh.nodes + 15 * i + 12;
        assert_true(fabs(tip[0] - 0.1 * (i % 3 - 1)) < 1e-16);
        assert_true(tip[1] == 0.06 && fabs(tip[2] - 0.2 * (i / 3 - 0.5)) < 1e-16);
    }
    cipc_mesh_free(&mesh);
}

static void test_one_nail_needs_no_spacing(void **state)
{
    (void)state;
    const cipc_nails bed = {.count = {1, 1}, .width = 0.01, .height = 0.06};
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_nails(&mesh, &bed, NULL), CIPC_OK);
    assert_int_equal(mesh.triangle_count, 4);
    cipc_mesh_free(&mesh);
}

static void test_bad_arguments_and_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh;
    const cipc_nails good = {.count = {2, 2}, .spacing = {0.1, 0.1}, .width = 0.01, .height = 0.06};
    cipc_nails bad[6];
    for (int i = 0; i < 6; i++) bad[i] = good;
    bad[0].count[1] = 0;
    bad[1].spacing[0] = 0.01;
    bad[2].width = 0;
    bad[3].height = (double)NAN;
    bad[4].spacing[1] = (double)INFINITY;
    bad[5].count[0] = bad[5].count[1] = 2147483647;
    for (int i = 0; i < 6; i++) assert_int_equal(cipc_mesh_nails(&mesh, &bad[i], NULL), CIPC_E_OUT_OF_RANGE);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_mesh_nails(&mesh, &good, NULL);
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
        cmocka_unit_test(test_a_bed),
        cmocka_unit_test(test_one_nail_needs_no_spacing),
        cmocka_unit_test(test_bad_arguments_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
