/* Loads in a model: copied, sorted, and what is refused. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/model.h"
#include "support/failing_memory.h"

enum { NODES = 6 };

static void free_loads(cipc_model *m)
{
    for (int i = 0; i < m->load_count; i++) cipc_free(m->loads[i].nodes);
    cipc_free(m->loads);
}

static void test_nodes_are_copied_sorted_and_unique(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    int nodes[] = {5, 0, 3, 5};
    const cipc_load load = {.node_count = 4, .nodes = nodes, .force = {1, -2, 3}, .begin = -1, .end = INFINITY};
    assert_int_equal(cipc_model_add_load(&m, &load, NULL), CIPC_OK);
    const cipc_load second = {.node_count = 1, .nodes = nodes, .force = {0, 0, 0}, .begin = 1, .end = 2};
    assert_int_equal(cipc_model_add_load(&m, &second, NULL), CIPC_OK);
    memset(nodes, 0, sizeof nodes);
    assert_int_equal(m.load_count, 2);
    assert_int_equal(m.loads[0].node_count, 3);
    assert_true(m.loads[0].nodes[0] == 0 && m.loads[0].nodes[1] == 3 && m.loads[0].nodes[2] == 5);
    assert_true(m.loads[0].force[0] == 1 && m.loads[0].force[1] == -2 && m.loads[0].force[2] == 3); /* on each node */
    assert_true(m.loads[0].begin == -1 && isinf(m.loads[0].end));
    assert_true(m.loads[1].nodes[0] == 5 && m.loads[1].begin == 1 && m.loads[1].end == 2);
    free_loads(&m);
}

static void test_refused(void **state)
{
    (void)state;
    int nodes[] = {0, 1}, negative[] = {0, -1}, beyond[] = {NODES, 1};
    const cipc_load good = {.node_count = 2, .nodes = nodes, .force = {1, 2, 3}, .begin = 0, .end = 1};
    const struct { cipc_load load; const char *what; } cases[] = {
        {{0, nodes, {1, 2, 3}, 0, 1}, "no nodes"},
        {{2, negative, {1, 2, 3}, 0, 1}, "node -1"},
        {{2, beyond, {1, 2, 3}, 0, 1}, "node 6 does not exist; the model has 6"},
        {{2, nodes, {NAN, 2, 3}, 0, 1}, "not finite"},
        {{2, nodes, {1, 2, -INFINITY}, 0, 1}, "not finite"},
        {{2, nodes, {1, 2, 3}, 1, 1}, "not after its begin"},
        {{2, nodes, {1, 2, 3}, 0, NAN}, "not after its begin"},
        {{2, nodes, {1, 2, 3}, -INFINITY, 1}, "not after its begin"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_model m = {.node_count = NODES};
        cipc_error error;
        assert_int_equal(cipc_model_add_load(&m, &cases[i].load, &error), CIPC_E_OUT_OF_RANGE);
        if (strstr(error.what, cases[i].what) == NULL) fail_msg("no '%s' in '%s'", cases[i].what, error.what);
        assert_int_equal(m.load_count, 0);
        assert_int_equal(cipc_model_add_load(&m, &good, &error), CIPC_OK); /* nothing of it is left */
        free_loads(&m);
    }
}

static void test_no_memory(void **state)
{
    (void)state;
    int nodes[] = {0, 1};
    const cipc_load load = {.node_count = 2, .nodes = nodes, .force = {1, 2, 3}, .begin = 0, .end = 1};
    long n = 1;
    for (;; n++) {
        cipc_model m = {.node_count = NODES};
        cipc_error error;
        fail_allocation(n);
        const cipc_status status = cipc_model_add_load(&m, &load, &error);
        const bool failed = allocation_failed();
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_int_equal(m.load_count, failed ? 0 : 1);
        free_loads(&m);
        if (!failed) break;
    }
    fail_allocation(0);
    assert_int_equal(n, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes_are_copied_sorted_and_unique),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
