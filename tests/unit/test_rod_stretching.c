/* Rod stretching: the constant of a round section, Hooke's law of a segment and of a chain, digits near rest, a segment of no length. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

enum { SIZE = 6 };
static const double PI = 3.14159265358979323846;

/* Some twenty operations on numbers of size one. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_initial_constants(void **state)
{
    (void)state;
    const double rest[SIZE] = {1, 1, 1, 1.003, 1.004, 1};
    cipc_rod_stretching rod;
    assert_true(cipc_rod_stretching_init(&rod, rest, 8e-5, 4e8));
    assert_relative(rod.stiffness, 4e8 * PI * 4e-5 * 4e-5, ROUNDINGS);
    assert_relative(rod.length, 0.005, 200 * ROUNDINGS); /* a difference of numbers 200 times as large */
    const double none[SIZE] = {1, 2, 3, 1, 2, 3}, broken[SIZE] = {0, 0, 0, INFINITY, 0, 0};
    rod.length = 7;
    assert_false(cipc_rod_stretching_init(&rod, none, 8e-5, 4e8));
    assert_false(cipc_rod_stretching_init(&rod, broken, 8e-5, 4e8));
    assert_true(rod.length == 7);
}

/* A strip of area A under the strain s: energy E A l0 s^2/2, tension E A s. Stretched, compressed, through its own other end. */
static void test_hooke(void **state)
{
    (void)state;
    const cipc_rod_stretching rod = {.stiffness = 3, .length = 2};
    const double strains[] = {-0.75, -0.25, 0.125, 2};
    for (int k = 0; k < 4; k++) {
        double s = strains[k], x[SIZE] = {1, 1, 1, 1, 1, 1 + 2 * (1 + s)}, g[SIZE], H[SIZE * SIZE];
        assert_relative(cipc_rod_stretching_value(x, &rod), 3 * 2 * s * s / 2, ROUNDINGS);
        cipc_rod_stretching_gradient(x, &rod, g);
        assert_relative(g[5], 3 * s, ROUNDINGS);
        assert_relative(g[2], -3 * s, ROUNDINGS);
        assert_true(g[0] == 0 && g[1] == 0 && g[3] == 0 && g[4] == 0);
        cipc_rod_stretching_hessian(x, &rod, H);
        assert_relative(H[SIZE * 5 + 5], 1.5, ROUNDINGS);                /* E A / l0 along */
        assert_relative(H[SIZE * 3 + 3], 3 * s / (2 * (1 + s)), ROUNDINGS); /* tension / l across */
        assert_relative(H[SIZE * 5 + 2], -1.5, ROUNDINGS);
        assert_true(H[SIZE * 3 + 4] == 0);
    }
}

/* Cut into n pieces, the rod under the same strain has the same energy and the same tension. */
static void test_a_chain_is_the_rod(void **state)
{
    (void)state;
    enum { PIECES = 10 };
    const double whole_rest[SIZE] = {0, 0, 0, 3, 4, 0}, whole[SIZE] = {0, 0, 0, 3.3, 4.4, 0};
    cipc_rod_stretching rod, piece;
    double g[SIZE], tension[SIZE], sum = 0;
    assert_true(cipc_rod_stretching_init(&rod, whole_rest, 0.01, 1e6));
    cipc_rod_stretching_gradient(whole, &rod, g);
    for (int i = 0; i < PIECES; i++) {
        double rest[SIZE], x[SIZE];
        for (int k = 0; k < SIZE; k++) {
            rest[k] = whole_rest[3 + k % 3] * (i + k / 3) / PIECES;
            x[k] = whole[3 + k % 3] * (i + k / 3) / PIECES;
        }
        assert_true(cipc_rod_stretching_init(&piece, rest, 0.01, 1e6));
        sum += cipc_rod_stretching_value(x, &piece);
        cipc_rod_stretching_gradient(x, &piece, tension);
        for (int k = 0; k < 2; k++) assert_relative(tension[3 + k], g[3 + k], 100 * ROUNDINGS); /* strain 0.1; nodes up to ten pieces away */
    }
    assert_relative(sum, cipc_rod_stretching_value(whole, &rod), 100 * ROUNDINGS);
}

/* The last bit of l counts: l - l0 is not drowned in the rounding of a quotient. */
static void test_digits_near_rest(void **state)
{
    (void)state;
    const cipc_rod_stretching rod = {.stiffness = 3, .length = 3};
    double x[SIZE] = {0, 0, 0, 3 + 0x1p-51, 0, 0}, g[SIZE];
    assert_true(cipc_rod_stretching_value(x, &rod) == 0.5 * 0x1p-102);
    cipc_rod_stretching_gradient(x, &rod, g);
    assert_true(g[3] == 0x1p-51);
    x[3] = 3;
    assert_true(cipc_rod_stretching_value(x, &rod) == 0);
    cipc_rod_stretching_gradient(x, &rod, g);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
}

static void test_no_length_has_an_energy(void **state)
{
    (void)state;
    const cipc_rod_stretching rod = {.stiffness = 3, .length = 2};
    const double x[SIZE] = {1, 2, 3, 1, 2, 3};
    assert_true(cipc_rod_stretching_value(x, &rod) == 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_initial_constants),
        cmocka_unit_test(test_hooke),
        cmocka_unit_test(test_a_chain_is_the_rod),
        cmocka_unit_test(test_digits_near_rest),
        cmocka_unit_test(test_no_length_has_an_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
