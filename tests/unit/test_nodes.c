/* Drift and kick of nodes, what is noted of them for certificates, energies and the report; the first failure is the one that is told. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/exact_geometry.h"
#include "support/two_primitives.h"

static void start(two_primitives *two)
{
    const cipc_asynchronous_options options = cipc_asynchronous_options_default();
    const double x[12] = {1, 2, 3, 4, 5, 6}, v[12] = {0.5, 0.25, -2, 0, 1, 0};
    two_primitives_init(two, CIPC_POINT_POINT, &options, 0, 0);
    two_primitives_place(two, x, v, 10);
}

static void assert_vector(const double got[3], double x, double y, double z)
{
    const double want[3] = {x, y, z};
    assert_memory_equal(got, want, sizeof want);
}

/* q + (t - t_i) v, from the last kick on and not from the last time that somebody looked: looking leaves no trace. */
static void test_drift(void **state)
{
    (void)state;
    two_primitives two;
    double x[12];
    start(&two);
    two_primitives_at(&two, 12, x);
    assert_vector(x, 2, 2.5, -1);
    two.a->now = 11;
    asynchronous_gather(two.a, two.nodes, 2, x);
    assert_vector(x, 1.5, 2.25, 1);
    assert_vector(x + 3, 4, 6, 6);
    assert_vector(two.a->nodes[0].q, 1, 2, 3);
    assert_true(two.a->nodes[0].t == 10);
    two_primitives_free(&two);
}

static void test_kick(void **state)
{
    (void)state;
    const double dv[3] = {1, 1, 1}, again[3] = {0, -1, 0};
    two_primitives two;
    double x[3];
    start(&two);
    cipc_asynchronous *a = two.a;
    a->now = 11;
    asynchronous_position(&a->nodes[0], 11, x);
    asynchronous_kick(a, 0, x, dv);
    asynchronous_kick(a, 0, x, again);
    assert_vector(a->nodes[0].q, 1.5, 2.25, 1);
    assert_vector(a->nodes[0].v, 1.5, 0.25, -1);
    assert_true(a->nodes[0].t == 11);
    assert_vector(a->before, 0.5, 0.25, -2); /* before the instant, not before its last kick */
    assert_int_equal(a->kicks[0], 1);
    assert_int_equal(a->dirty_count, 1);
    assert_int_equal(a->dirty_nodes[0], 0);
    a->now = 12;
    asynchronous_position(&a->nodes[0], 12, x);
    asynchronous_kick(a, 0, x, again);
    assert_vector(a->before, 1.5, 0.25, -1);
    assert_int_equal(a->kicks[0], 2);
    assert_int_equal(a->dirty_count, 1); /* once on the list, until it has been looked at */
    two_primitives_free(&two);
}

static void test_steer(void **state)
{
    (void)state;
    const double v[3] = {7, 0, 0};
    two_primitives two;
    double x[3];
    start(&two);
    two.a->now = 11;
    asynchronous_position(&two.a->nodes[1], 11, x);
    asynchronous_steer(two.a, 1, x, v);
    assert_vector(two.a->nodes[1].v, 7, 0, 0);
    assert_vector(two.a->nodes[1].q, 4, 6, 6);
    assert_true(two.a->dirty[1]);
    two_primitives_free(&two);
}

static void test_synchronise(void **state)
{
    (void)state;
    two_primitives two;
    start(&two);
    asynchronous_synchronise(two.a, 12);
    assert_vector(two.a->nodes[0].q, 2, 2.5, -1);
    assert_vector(two.a->nodes[1].q, 4, 7, 6);
    assert_true(two.a->nodes[0].t == 12 && two.a->nodes[1].t == 12);
    assert_vector(two.a->nodes[0].v, 0.5, 0.25, -2);
    assert_int_equal(two.a->dirty_count, 0); /* nobody's path has changed */
    two_primitives_free(&two);
}

static void test_first_failure_is_told(void **state)
{
    (void)state;
    two_primitives two;
    start(&two);
    two.a->now = 0.125;
    asynchronous_fail(two.a, CIPC_E_NO_PROGRESS, "number %d", 7);
    asynchronous_fail(two.a, CIPC_E_OUT_OF_MEMORY, "another");
    assert_int_equal(two.a->status, CIPC_E_NO_PROGRESS);
    assert_string_equal(two.a->error.what, "number 7");
    assert_string_equal(two.a->error.place, "t = 0.125 s");
    two_primitives_free(&two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drift), cmocka_unit_test(test_kick), cmocka_unit_test(test_steer), cmocka_unit_test(test_synchronise), cmocka_unit_test(test_first_failure_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
