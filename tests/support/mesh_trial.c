#include "support/mesh_trial.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

static void assert_same_integers(const void *got, const void *want, int count)
{
    if (count > 0) assert_memory_equal(got, want, (size_t)count * sizeof(int));
}

void assert_same_mesh(cipc_mesh *got, cipc_mesh *want, cipc_status status)
{
    assert_int_equal(status, CIPC_OK);
    assert_true(want->node_count > 0);
    assert_int_equal(got->node_count, want->node_count);
    assert_int_equal(got->triangle_count, want->triangle_count);
    assert_int_equal(got->segment_count, want->segment_count);
    assert_int_equal(got->tetrahedron_count, want->tetrahedron_count);
    assert_memory_equal(got->nodes, want->nodes, 3 * (size_t)want->node_count * sizeof *want->nodes);
    assert_same_integers(got->triangles, want->triangles, 3 * want->triangle_count);
    assert_same_integers(got->segments, want->segments, 2 * want->segment_count);
    assert_same_integers(got->tetrahedra, want->tetrahedra, 4 * want->tetrahedron_count);
    cipc_mesh_free(got);
    cipc_mesh_free(want);
}
