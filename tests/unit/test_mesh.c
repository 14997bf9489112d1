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

static void test_too_large_is_refused_before_memory_is_asked_for(void **state)
{
    (void)state;
    cipc_mesh mesh;
    cipc_error error;
    fail_allocation(0);
    assert_int_equal(scene_mesh_allocate(&mesh, SCENE_NODES_MAX + 1LL, 1, "here", &error), CIPC_E_OUT_OF_RANGE);
    assert_string_equal(error.place, "here");
    assert_int_equal(scene_mesh_allocate(&mesh, 1, SCENE_TRIANGLES_MAX + 1LL, "here", &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(allocation_count(), 0);
}

static void test_no_memory(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        cipc_mesh mesh;
        fail_allocation(n);
        cipc_status status = scene_mesh_allocate(&mesh, 4, 2, "here", NULL);
        if (!allocation_failed()) {
            assert_int_equal(n, 3); /* two arrays: two ways to fail */
            cipc_mesh_free(&mesh);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_null(mesh.nodes);
        assert_null(mesh.triangles);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_too_large_is_refused_before_memory_is_asked_for),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
