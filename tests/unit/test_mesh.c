/* Allocating and freeing a mesh. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "scene/mesh.h"
#include "support/failing_memory.h"

static void test_sizes(void **state)
{
    (void)state;
    cipc_mesh mesh;
    assert_int_equal(scene_mesh_allocate(&mesh, 5, 3, "here", NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, 5);
    assert_int_equal(mesh.triangle_count, 3);
    assert_true(mesh.nodes[14] == 0);
    assert_int_equal(mesh.triangles[2][2], 0);
    cipc_mesh_free(&mesh);
    assert_null(mesh.nodes);
    assert_int_equal(mesh.node_count, 0);
    cipc_mesh_free(&mesh);
    cipc_mesh_free(NULL);
}

static void test_sizes_of_every_kind(void **state)
{
    (void)state;
    cipc_mesh mesh;
    scene_mesh_sizes sizes = {.nodes = 5, .segments = 4, .tetrahedra = 2};
    assert_int_equal(scene_mesh_allocate_sizes(&mesh, &sizes, "here", NULL), CIPC_OK);
    assert_int_equal(mesh.node_count, 5);
    assert_int_equal(mesh.triangle_count, 0);
    assert_int_equal(mesh.segment_count, 4);
    assert_int_equal(mesh.tetrahedron_count, 2);
    assert_null(mesh.triangles);
    assert_int_equal(mesh.segments[3][1] + mesh.tetrahedra[1][3], 0);
    cipc_mesh_free(&mesh);
    assert_null(mesh.segments);
    assert_null(mesh.tetrahedra);
}

static void test_products_do_not_overflow(void **state)
{
    (void)state;
    assert_true(scene_mesh_product(3, 4) == 12);
    assert_true(scene_mesh_product(0, 4) == 0 && scene_mesh_product(4, 0) == 0);
    assert_true(scene_mesh_product(1000, SCENE_NODES_MAX) == 1000LL * SCENE_NODES_MAX);
    long long huge = scene_mesh_product(scene_mesh_product(2147483647, 2147483647), 2147483647);
    assert_true(huge > SCENE_TETRAHEDRA_MAX && 6 * huge > huge);
}

static void test_too_large_is_refused_before_memory_is_asked_for(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    fail_allocation(0);
    assert_int_equal(scene_mesh_allocate(&mesh, SCENE_NODES_MAX + 1LL, 1, "here", &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "here");
    assert_int_equal(scene_mesh_allocate(&mesh, 1, SCENE_TRIANGLES_MAX + 1LL, "here", &error), CIPC_E_OUT_OF_RANGE);
    scene_mesh_sizes segments = {.nodes = 1, .segments = SCENE_SEGMENTS_MAX + 1LL};
    assert_int_equal(scene_mesh_allocate_sizes(&mesh, &segments, "here", &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.what, "a mesh of 20000001 segments; at most 20000000 are allowed");
    scene_mesh_sizes tetrahedra = {.nodes = 1, .tetrahedra = SCENE_TETRAHEDRA_MAX + 1LL};
    assert_int_equal(scene_mesh_allocate_sizes(&mesh, &tetrahedra, "here", &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(allocation_count(), 0);
}

static void test_no_memory(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        cipc_mesh mesh;
        fail_allocation(n);
        scene_mesh_sizes sizes = {4, 2, 3, 1};
        cipc_status status = scene_mesh_allocate_sizes(&mesh, &sizes, "here", NULL);
        if (!allocation_failed()) {
            assert_int_equal(n, 5); /* four arrays: four ways to fail */
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
        assert_null(mesh.triangles);
        assert_null(mesh.tetrahedra);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_sizes_of_every_kind),
        cmocka_unit_test(test_products_do_not_overflow),
        cmocka_unit_test(test_too_large_is_refused_before_memory_is_asked_for),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
