/* What the monitors leave out, held against the function that the solver asks: on a model with stitches and bodies apart they must agree on every pair of nodes. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>

#include "invariant/exemptions.h"
#include "support/failing_memory.h"

enum { BODIES = 3, NODES = 3 };
static const double gravity[3] = {0, 0, 0};

/* Three bodies of three particles. */
static cipc_model *make(void)
{
    static const double x[3 * NODES] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    cipc_body_description d[BODIES] = {{.name = ""}};
    cipc_model *m;
    for (int b = 0; b < BODIES; b++) {
        d[b] = (cipc_body_description){.kind = CIPC_BODY_PARTICLES, .material = {.density = 1, .thickness = 1}, .node_count = NODES, .rest = x, .position = x};
        (void)snprintf(d[b].name, sizeof d[b].name, "body %d", b);
    }
    assert_int_equal(cipc_model_create(&m, d, BODIES, gravity, NULL), CIPC_OK);
    return m;
}

static int count_exempt(const cipc_model *m)
{
    invariant_exemptions e;
    int count = 0;
    assert_true(invariant_exemptions_init(&e, m));
    for (int a = 0; a < m->node_count; a++)
        for (int b = 0; b < m->node_count; b++) {
            bool exempt = invariant_exempt(&e, &a, 1, &b, 1);
            assert_true(a == b || exempt == !cipc_model_meet(m, &a, 1, &b, 1));
            count += exempt;
        }
    invariant_exemptions_free(&e);
    return count;
}

static void test_agrees_with_the_solver(void **state)
{
    (void)state;
    cipc_model *m = make();
    assert_int_equal(count_exempt(m), 0);
    const cipc_stitching stitches[2] = {{.nodes = {8, 0, 4}, .ratio = 0.5, .stiffness = 1}, {.nodes = {1, 7, 6}, .stiffness = 1}};
    assert_int_equal(cipc_model_add_stitches(m, stitches, 2, NULL), CIPC_OK);
    assert_int_equal(count_exempt(m), 2 * 4);
    cipc_model_set_apart(m, 0, 1);
    assert_int_equal(count_exempt(m), 2 * 4 + 2 * NODES * NODES);
    cipc_model_set_apart(m, 2, 2);
    assert_int_equal(count_exempt(m), 2 * 4 + 3 * NODES * NODES);
    const int pair[2] = {2, 8}, node = 4; /* 8 is sewn to 4 */
    invariant_exemptions e;
    assert_true(invariant_exemptions_init(&e, m));
    assert_true(invariant_exempt(&e, pair, 2, &node, 1) && invariant_exempt(&e, &node, 1, pair, 2));
    invariant_exemptions_free(&e);
    cipc_model_destroy(m);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_model *m = make();
    invariant_exemptions e;
    fail_allocation(1);
    assert_false(invariant_exemptions_init(&e, m));
    fail_allocation(0);
    invariant_exemptions_free(&e);
    cipc_model_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_agrees_with_the_solver), cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
