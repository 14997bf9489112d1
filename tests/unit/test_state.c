/* The state at time 0: positions and velocities of all bodies in the model's numbering. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "cipc/model.h"
#include "support/failing_memory.h"

static const double positions[2][6] = {{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}};
static const double velocity[6] = {-1, -2, -3, -4, -5, -6};

static void describe(cipc_body_description d[2])
{
    for (int b = 0; b < 2; b++) d[b] = (cipc_body_description){.node_count = 2, .position = positions[b], .velocity = b ? velocity : NULL};
}

static void test_start(void **state)
{
    (void)state;
    cipc_body_description d[2];
    describe(d);
    cipc_state *s;
    assert_int_equal(cipc_state_create(&s, d, 2, NULL), CIPC_OK);
    assert_int_equal(s->node_count, 4);
    assert_int_equal(s->step, 0);
    assert_true(s->time == 0 && s->barrier_stiffness == 0 && s->strain_stiffness_factor == 1);
    const double at_rest[6] = {0};
    assert_memory_equal(s->position, positions, sizeof positions);
    assert_memory_equal(s->velocity, at_rest, sizeof at_rest);
    assert_memory_equal(s->velocity + 6, velocity, sizeof velocity);
    cipc_state_destroy(s);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_body_description d[2];
    describe(d);
    cipc_state *s;
    cipc_error error;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_state_create(&s, d, 2, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_null(s);
    }
    fail_allocation(0);
    assert_int_equal(n, 4); /* three allocations */
    cipc_state_destroy(s);
    cipc_state_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_start), cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
