/* Point-point barrier: its value by hand, its force along the closest direction, support and contact (SPEC C.4, E4). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

enum { SIZE = 6 };

/* Some twenty operations; d^2 - xi^2 of the distances here loses less than one digit. */
static const double ROUNDINGS = 256 * DBL_EPSILON;

static const cipc_contact_barrier thick = {.stiffness = 100, .weight = 3, .offset = 0.5, .dhat = 1};

/* A point straight above another. */
static void at_distance(double d, double x[SIZE])
{
    const double placed[SIZE] = {0, 0, d, 0, 0, 0};
    for (int i = 0; i < SIZE; i++) x[i] = placed[i];
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_value(void **state)
{
    (void)state;
    double x[SIZE];
    at_distance(1, x);
    /* D = 1 - 1/4, Dhat = 2 * 1/2 * 1 + 1 = 2 */
    assert_relative(cipc_barrier_point_point_value(x, &thick), 300 * 1.25 * 1.25 * log(2 / 0.75), ROUNDINGS);
}

static void test_force_along_the_closest_direction(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE], b[3], rest = 0;
    at_distance(1, x);
    cipc_barrier_point_point_gradient(x, &thick, g);
    cipc_barrier(0.75, 2, b);
    assert_true(fabs(g[0]) <= ROUNDINGS && fabs(g[1]) <= ROUNDINGS);
    assert_relative(g[2], 300 * b[1] * 2, ROUNDINGS); /* lambda = -kappa b' 2 d pushes the point away */
    for (int i = 5; i < SIZE; i += 3) rest += g[i];
    assert_relative(rest, -g[2], ROUNDINGS);
}

static void test_stiffness_along_the_closest_direction(void **state)
{
    (void)state;
    double x[SIZE], H[SIZE * SIZE], b[3];
    at_distance(1, x);
    cipc_barrier_point_point_hessian(x, &thick, H);
    cipc_barrier(0.75, 2, b);
    assert_relative(H[2 * SIZE + 2], 300 * (4 * b[2] + 2 * b[1]), ROUNDINGS); /* b'' (2 d)^2 + b' 2 */
}

/* A weight of 1e-5 kg at g = 9.81 m/s^2 resting on the barrier of stiffness 25, time step 0.04 s: -kappa b' 2 d = h^2 m g (SPEC E4). */
static void test_resting_gap(void **state)
{
    (void)state;
    static const double PRINTED_DIGITS = 1e-5; /* seven digits of the gap, and the force changes some ten times faster */
    const double cases[3][2] = {{0, 3.847221e-4}, {1e-4, 4.315394e-4}, {1e-3, 6.854509e-4}}; /* xi, gap */
    for (int i = 0; i < 3; i++) {
        cipc_contact_barrier params = {.stiffness = 25, .weight = 1, .offset = cases[i][0], .dhat = 1e-3};
        double x[SIZE], g[SIZE];
        at_distance(cases[i][0] + cases[i][1], x);
        cipc_barrier_point_point_gradient(x, &params, g);
        assert_relative(-g[2], 0.04 * 0.04 * 1e-5 * 9.81, PRINTED_DIGITS);
    }
}

static void test_support_and_contact(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE], H[SIZE * SIZE];
    at_distance(1.5, x); /* xi + dhat */
    assert_true(cipc_barrier_point_point_value(x, &thick) == 0);
    cipc_barrier_point_point_gradient(x, &thick, g);
    cipc_barrier_point_point_hessian(x, &thick, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(H[i] == 0);
    at_distance(0.5, x); /* xi */
    assert_true(cipc_barrier_point_point_value(x, &thick) == INFINITY);
    at_distance(0.25, x);
    assert_true(cipc_barrier_point_point_value(x, &thick) == INFINITY);
    cipc_contact_barrier weightless = thick;
    weightless.weight = 0; /* infeasible whatever it weighs */
    assert_true(cipc_barrier_point_point_value(x, &weightless) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),
        cmocka_unit_test(test_force_along_the_closest_direction),
        cmocka_unit_test(test_stiffness_along_the_closest_direction),
        cmocka_unit_test(test_resting_gap),
        cmocka_unit_test(test_support_and_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
