/* Lower strain limit: the mirror image of the upper one, the ends of its range, equal stretches (SPEC C.2). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

enum { SIZE = 9 };

/* Some ten operations on stretches of size one; b, b', b'' are rational of degree at most 3 in differences that are a quarter or more. */
static const double ROUNDINGS = 32 * DBL_EPSILON;

static const double rest[SIZE] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static cipc_strain_limit limit_of(double limit, double activation)
{
    cipc_strain_limit params;
    assert_true(cipc_strain_limit_lower_init(&params, rest, 0.1, limit, activation, 1000));
    return params;
}

static const double *stretched(double a, double b, double x[SIZE])
{
    const double made[SIZE] = {0, 0, 0, a, 0, 0, 0, b, 0};
    for (int i = 0; i < SIZE; i++) x[i] = made[i];
    return x;
}

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* b at shat - d below equals b at shat + d above, and so do its derivatives but for the sign of the odd one. Binary fractions: nothing is rounded before. */
static void test_mirror_image(void **state)
{
    (void)state;
    const double places[] = {0.03125, 0.125, 0.25, 0.375, 0.4375, 0.4990234375};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        double below[3], above[3];
        cipc_strain_limit_barrier(1 - places[i], 0.5, 1, below);
        cipc_strain_limit_barrier(1 + places[i], 1.5, 1, above);
        assert_true(below[0] == above[0] && below[1] == -above[1] && below[2] == above[2]);
        assert_true(below[0] > 0 && below[1] < 0 && below[2] > 0);
    }
}

/* Half way: t = 1/2, q = 1/2. */
static void test_closed_form(void **state)
{
    (void)state;
    double b[3];
    cipc_strain_limit_barrier(0.75, 0.5, 1, b);
    assert_relative(b[0], 0.25 * log(2), ROUNDINGS);
    assert_relative(b[1], -(log(2) + 0.5) / 0.5, ROUNDINGS);
    assert_relative(b[2], (2 * log(2) + 5) / 0.25, ROUNDINGS);
}

static void test_order_of_the_numbers(void **state)
{
    (void)state;
    cipc_strain_limit p;
    const double line[SIZE] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    assert_true(cipc_strain_limit_lower_init(&p, rest, 0.1, 0.7, 0.9, 1000));
    assert_true(p.limit == 0.7 && p.activation == 0.9 && p.stiffness == 1000);
    assert_relative(p.volume, 0.05, ROUNDINGS);
    assert_true(cipc_strain_limit_lower_init(&p, rest, 0.1, 0.7, 1, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, rest, 0.1, 0.9, 0.7, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, rest, 0.1, 0.9, 0.9, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, rest, 0.1, 0, 0.9, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, rest, 0.1, 0.9, 1.01, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, rest, 0.1, NAN, 0.9, 1000));
    assert_false(cipc_strain_limit_lower_init(&p, line, 0.1, 0.7, 0.9, 1000));
}

static void test_value_sums_the_stretches_and_ends_at_the_limit(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 1);
    double x[SIZE], sum = -0.25 * log(0.5) - 0.0625 * log(0.75); /* t = 1/2 and 1/4 */
    assert_relative(cipc_strain_limit_lower_value(stretched(0.75, 0.875, x), &p), 1000 * 0.05 * sum, ROUNDINGS);
    assert_relative(cipc_strain_limit_lower_value(stretched(0.75, 3, x), &p), -50 * 0.25 * log(0.5), ROUNDINGS);
    assert_true(cipc_strain_limit_lower_value(stretched(0.5, 1, x), &p) == INFINITY);
    assert_true(cipc_strain_limit_lower_value(stretched(1, 0.25, x), &p) == INFINITY);
    assert_true(cipc_strain_limit_lower_value(stretched(1, 0, x), &p) == INFINITY);
    assert_true(cipc_strain_limit_lower_value(stretched(NAN, 1, x), &p) == INFINITY);
    assert_true(cipc_strain_limit_lower_value(rest, &p) == 0);
    assert_true(cipc_strain_limit_lower_value(stretched(5, 1, x), &p) == 0);
}

/* Equal stretches, where singular vectors are arbitrary: dE/dF = kappa_s V b' times the identity, and b' < 0 pushes outwards. */
static void test_gradient_of_a_dilation(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 1);
    double x[SIZE], g[SIZE], b[3];
    cipc_strain_limit_lower_gradient(stretched(0.75, 0.75, x), &p, g);
    cipc_strain_limit_barrier(0.75, 0.5, 1, b);
    double stress = 1000 * 0.05 * b[1];
    const double want[SIZE] = {-stress, -stress, 0, stress, 0, 0, 0, stress, 0};
    assert_true(stress < 0);
    for (int i = 0; i < SIZE; i++) assert_true(fabs(g[i] - want[i]) <= ROUNDINGS * fabs(stress));
}

/* Shear 1/2 (A + A'), coupling 1/2 (A - A') with A = b'' and A' = b'/sigma at equal stretches, out of plane b'/sigma; no jump when they part, in either order. */
static void test_hessian_of_a_dilation(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 1);
    double x[SIZE], H[SIZE * SIZE], K[SIZE * SIZE], b[3], scale = 1000 * 0.05;
    cipc_strain_limit_lower_hessian(stretched(0.75, 0.75, x), &p, H);
    cipc_strain_limit_barrier(0.75, 0.5, 1, b);
    assert_relative(H[3 * SIZE + 3], scale * b[2], ROUNDINGS);                       /* along */
    assert_relative(H[4 * SIZE + 4], scale * 0.5 * (b[2] + b[1] / 0.75), ROUNDINGS); /* shear */
    assert_relative(H[4 * SIZE + 6], scale * 0.5 * (b[2] - b[1] / 0.75), ROUNDINGS); /* coupling */
    assert_relative(H[5 * SIZE + 5], scale * b[1] / 0.75, ROUNDINGS);                /* out of plane: buckling */
    for (int order = 0; order < 2; order++) {
        double apart = 1e-12;
        cipc_strain_limit_lower_hessian(order ? stretched(0.75 + apart, 0.75, x) : stretched(0.75, 0.75 + apart, x), &p, K);
        /* b''' / b'' is about 10 here. */
        for (int i = 0; i < SIZE * SIZE; i++) assert_true(fabs(H[i] - K[i]) <= 100 * apart * scale * b[2]);
    }
}

/* Both active and unequal: A = (b_1' - b_2')/(sigma_1 - sigma_2). */
static void test_hessian_with_both_stretches_active(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 1);
    double x[SIZE], H[SIZE * SIZE], b[2][3], scale = 1000 * 0.05, large = 0.875, small = 0.625;
    cipc_strain_limit_lower_hessian(stretched(large, small, x), &p, H);
    cipc_strain_limit_barrier(large, 0.5, 1, b[0]);
    cipc_strain_limit_barrier(small, 0.5, 1, b[1]);
    double A = (b[0][1] - b[1][1]) / (large - small), mean = (b[0][1] + b[1][1]) / (large + small);
    assert_relative(H[4 * SIZE + 4], scale * 0.5 * (A + mean), ROUNDINGS);
    assert_relative(H[4 * SIZE + 6], scale * 0.5 * (A - mean), ROUNDINGS);
    assert_relative(H[3 * SIZE + 3], scale * b[0][2], ROUNDINGS);
    assert_relative(H[7 * SIZE + 7], scale * b[1][2], ROUNDINGS);
}

/* One stretch active: A = b'/(sigma - other), A' = b'/(sigma + other). */
static void test_hessian_with_one_stretch_active(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 1);
    double x[SIZE], H[SIZE * SIZE], b[3], scale = 1000 * 0.05;
    cipc_strain_limit_lower_hessian(stretched(1.25, 0.75, x), &p, H);
    cipc_strain_limit_barrier(0.75, 0.5, 1, b);
    assert_relative(H[7 * SIZE + 7], scale * b[2], ROUNDINGS);
    assert_relative(H[4 * SIZE + 4], scale * 0.5 * b[1] * (1 / -0.5 + 1 / 2.0), ROUNDINGS);
    assert_relative(H[4 * SIZE + 6], scale * 0.5 * b[1] * (1 / -0.5 - 1 / 2.0), ROUNDINGS);
    assert_relative(H[8 * SIZE + 8], scale * b[1] / 0.75, ROUNDINGS);
    assert_true(fabs(H[3 * SIZE + 3]) <= ROUNDINGS * scale * b[2] && fabs(H[5 * SIZE + 5]) <= ROUNDINGS * scale * b[2]); /* the other stretch is free */
}

static void test_inactive_triangles_are_zero(void **state)
{
    (void)state;
    cipc_strain_limit p = limit_of(0.5, 0.75);
    double x[SIZE], g[SIZE], H[SIZE * SIZE];
    cipc_strain_limit_lower_gradient(stretched(0.75, 0.875, x), &p, g);
    cipc_strain_limit_lower_hessian(x, &p, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(H[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror_image),
        cmocka_unit_test(test_closed_form),
        cmocka_unit_test(test_order_of_the_numbers),
        cmocka_unit_test(test_value_sums_the_stretches_and_ends_at_the_limit),
        cmocka_unit_test(test_gradient_of_a_dilation),
        cmocka_unit_test(test_hessian_of_a_dilation),
        cmocka_unit_test(test_hessian_with_both_stretches_active),
        cmocka_unit_test(test_hessian_with_one_stretch_active),
        cmocka_unit_test(test_inactive_triangles_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
