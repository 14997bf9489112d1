/* The springs of a shell: which, how many, how long. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/scene.h"
#include "massspring/topology.h"
#include "support/failing_memory.h"

enum { COLUMNS = 5, ROWS = 4 };

/* Two sheets, the second of longer edges and behind the first among the nodes, a rope between them: each body has its own springs. */
static cipc_model *two_sheets(cipc_mesh mesh[2])
{
    static const double rope[6] = {0, 9, 0, 1, 9, 0};
    static const int segment[1][2] = {{0, 1}};
    cipc_body_description bodies[3] = {{.name = "a", .kind = CIPC_BODY_SHELL}, {.name = "rope", .kind = CIPC_BODY_RODS}, {.name = "b", .kind = CIPC_BODY_SHELL}};
    for (int i = 0; i < 3; i++) bodies[i].material = (cipc_material){.density = 1, .thickness = 1e-3, .young = 1};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(cipc_mesh_equilateral(&mesh[i], i + 1, COLUMNS, ROWS, NULL), CIPC_OK);
        cipc_body_description *b = &bodies[2 * i];
        b->node_count = mesh[i].node_count;
        b->rest = b->position = mesh[i].nodes;
        b->triangle_count = mesh[i].triangle_count;
        b->triangles = (const int(*)[3])mesh[i].triangles;
    }
    bodies[1].node_count = 2;
    bodies[1].rest = bodies[1].position = rope;
    bodies[1].segment_count = 1;
    bodies[1].segments = segment;
    cipc_model *model;
    cipc_error error;
    if (cipc_model_create(&model, bodies, 3, (const double[3]){0, 0, 0}, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    return model;
}

static double distance(const cipc_model *m, const int ends[2])
{
    const double *a = m->rest + 3 * ends[0], *b = m->rest + 3 * ends[1];
    return hypot(b[0] - a[0], b[2] - a[2]);
}

/* Euler: edges = nodes + triangles - 1; inner ones are those that are not of the boundary. Bending springs pass over an edge at a right angle. */
static void test_sheets(void **state)
{
    (void)state;
    const int edges = (COLUMNS + 1) * (ROWS + 1) + 2 * COLUMNS * ROWS - 1, inner = edges - 2 * (COLUMNS + ROWS);
    cipc_mesh mesh[2];
    cipc_model *m = two_sheets(mesh);
    for (int body = 0; body < 3; body += 2) {
        const double d = body / 2 + 1;
        massspring_topology t;
        assert_int_equal(massspring_topology_create(&t, m, body, NULL), CIPC_OK);
        assert_int_equal(t.structural_count, edges);
        assert_int_equal(t.count, edges + inner);
        for (int i = 0; i < t.count; i++) {
            const double want = i < edges ? d : sqrt(3.0) * d;
            assert_int_equal(m->node_body[t.ends[i][0]], body);
            assert_int_equal(m->node_body[t.ends[i][1]], body);
            assert_true(fabs(t.lengths[i] / want - 1) < 16 * DBL_EPSILON);
            assert_true(fabs(distance(m, t.ends[i]) / want - 1) < 16 * DBL_EPSILON);
            for (int j = 0; j < i; j++) assert_false(t.ends[i][0] == t.ends[j][0] && t.ends[i][1] == t.ends[j][1]);
        }
        massspring_topology_free(&t);
    }
    massspring_topology rope;
    assert_int_equal(massspring_topology_create(&rope, m, 1, NULL), CIPC_OK);
    assert_int_equal(rope.count, 0);
    massspring_topology_free(&rope);
    cipc_model_destroy(m);
    for (int i = 0; i < 2; i++) cipc_mesh_free(&mesh[i]);
}

static void test_no_memory(void **state)
{
    (void)state;
    cipc_mesh mesh[2];
    cipc_model *m = two_sheets(mesh);
    massspring_topology t;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = massspring_topology_create(&t, m, 0, NULL);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_true(t.ends == NULL && t.lengths == NULL && t.count == 0);
    }
    fail_allocation(0);
    massspring_topology_free(&t);
    cipc_model_destroy(m);
    for (int i = 0; i < 2; i++) cipc_mesh_free(&mesh[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sheets),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
