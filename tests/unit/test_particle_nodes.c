/* Which nodes are particles: those of bodies of particles, and only those. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "output/particle_nodes.h"
#include "support/every_kind.h"
#include "support/failing_memory.h"

static void test_bodies_between_others(void **state)
{
    (void)state;
    const cipc_body_kind kinds[] = {CIPC_BODY_PARTICLES, CIPC_BODY_RODS, CIPC_BODY_PARTICLES, CIPC_BODY_VOLUME};
    sample_run run = every_kind_create(kinds, 4, true);
    assert_int_equal(cipc_particle_count(run.model), 2 * GRAIN_COUNT);
    int *nodes = cipc_particle_nodes(run.model);
    const int wanted[] = {0, 1, 2, 7, 8, 9};
    assert_memory_equal(nodes, wanted, sizeof wanted);
    cipc_free(nodes);
    fail_allocation(1);
    assert_null(cipc_particle_nodes(run.model));
    fail_allocation(0);
    sample_run_destroy(&run);
}

static void test_no_particles(void **state)
{
    (void)state;
    sample_run run = sample_run_create();
    assert_int_equal(cipc_particle_count(run.model), 0);
    int *nodes = cipc_particle_nodes(run.model);
    assert_non_null(nodes); /* NULL always means failure */
    cipc_free(nodes);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bodies_between_others),
        cmocka_unit_test(test_no_particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
