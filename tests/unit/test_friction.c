/* Smoothed friction: f0, f1, f1' by hand, force directions, rest without division by zero, creep (SPEC D.6). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/energy.h"

enum { SIZE = 12 };

/* Some ten operations on numbers of size one. */
static const double ROUNDINGS = 16 * DBL_EPSILON;

static void assert_close(double got, double want)
{
    if (!(fabs(got - want) <= ROUNDINGS * fmax(1, fabs(want)))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* A point on a triangle in the plane z = 0, at the barycentric coordinates (1/4, 1/4, 1/2). */
static const cipc_friction contact = {
    .coefficient = 6,
    .eps = 0.5,
    .weights = {1, -0.25, -0.25, -0.5},
    .basis = {1, 0, 0, 0, 1, 0},
    .start = {1, 2, 0.125, 0, 0, 0, 4, 0, 0, 0, 4, 0},
};

static void moved(double dx, double dy, double dz, double x[SIZE])
{
    memcpy(x, contact.start, sizeof contact.start);
    x[0] += dx;
    x[1] += dy;
    x[2] += dz;
}

static void test_scalar_functions(void **state)
{
    (void)state;
    const double e = 0.5;
    /* y, f0, f1, f1' */
    const double rows[][4] = {
        {0, e / 3, 0, 2 / e},
        {e / 2, 13 * e / 24, 0.75, 1 / e},
        {e, e, 1, 0},
        {3, 3, 1, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double f[3];
        cipc_friction_mollifier(rows[i][0], e, f);
        for (int k = 0; k < 3; k++) assert_close(f[k], rows[i][k + 1]);
    }
}

/* Under a load below the Coulomb limit a contact creeps at eps_v (1 - sqrt(1 - load)), loads in units of mu lambda. */
static void test_creep(void **state)
{
    (void)state;
    static const double PRINTED_DIGITS = 2e-5; /* five digits of the creep; f1' is at most 2 */
    const double load[] = {0.1, 0.5, 0.9, 0.99}, creep[] = {0.05132, 0.29289, 0.68377, 0.9};
    for (int i = 0; i < 4; i++) {
        double f[3];
        cipc_friction_mollifier(creep[i], 1, f);
        assert_true(fabs(f[1] - load[i]) < PRINTED_DIGITS);
    }
}

static void test_sliding_force(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE];
    moved(3, 4, 7, x); /* u = (3, 4); the normal direction does not count */
    assert_close(cipc_friction_value(x, &contact), 6 * 5);
    cipc_friction_gradient(x, &contact, g);
    const double want[SIZE] = {3.6, 4.8, 0, -0.9, -1.2, 0, -0.9, -1.2, 0, -1.8, -2.4, 0};
    for (int i = 0; i < SIZE; i++) assert_close(g[i], want[i]);
}

static void test_sliding_stiffness_is_across_the_motion_only(void **state)
{
    (void)state;
    double x[SIZE], H[SIZE * SIZE];
    moved(2, 0, 0, x);
    cipc_friction_hessian(x, &contact, H);
    assert_close(H[0], 0);
    assert_close(H[SIZE + 1], 6.0 / 2); /* mu lambda / y */
    assert_close(H[1], 0);
    assert_close(H[SIZE + 4], -0.25 * 3);
    assert_close(H[2 * SIZE + 2], 0);
}

static void test_sticking(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE], H[SIZE * SIZE];
    moved(0, 0.25, 0, x); /* y = e/2 */
    cipc_friction_gradient(x, &contact, g);
    cipc_friction_hessian(x, &contact, H);
    assert_close(g[1], 6 * 0.75);
    assert_close(H[SIZE + 1], 6 * 2);    /* f1' = 1/e */
    assert_close(H[0], 6 * 0.75 / 0.25); /* f1/y */
}

static void test_rest(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE], H[SIZE * SIZE];
    moved(0, 0, 0, x);
    assert_close(cipc_friction_value(x, &contact), 6 * 0.5 / 3);
    cipc_friction_gradient(x, &contact, g);
    cipc_friction_hessian(x, &contact, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    assert_close(H[0], 6 * 2 / 0.5); /* f1/y -> 2/e */
    assert_close(H[SIZE + 1], 6 * 2 / 0.5);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(isfinite(H[i]));
}

/* (34): the majorizer's quadratic meets the friction at x and is nowhere below it; across the motion, and where nothing moves, it is the Hessian. */
static void test_majorizer(void **state)
{
    (void)state;
    static const double slides[][2] = {{0, 0}, {0.1, 0}, {-0.2, 0.3}, {0.5, 0}, {2, 0}, {-3, 4}};
    static const double moves[][2] = {{0.01, 0}, {-0.15, 0.05}, {-0.3, -0.4}, {1, 0}, {-2, 0}, {-4, 0}, {6, -8}, {0, 0.5}};
    double x[SIZE], there[SIZE], g[SIZE], M[SIZE * SIZE], H[SIZE * SIZE];
    for (size_t i = 0; i < sizeof slides / sizeof slides[0]; i++) {
        moved(slides[i][0], slides[i][1], 0, x);
        cipc_friction_gradient(x, &contact, g);
        cipc_friction_majorizer(x, &contact, M);
        cipc_friction_hessian(x, &contact, H);
        for (size_t j = 0; j < sizeof moves / sizeof moves[0]; j++) {
            const double v[3] = {moves[j][0], moves[j][1], 0};
            double above = cipc_friction_value(x, &contact);
            for (int a = 0; a < 3; a++) {
                above += g[a] * v[a];
                for (int b = 0; b < 3; b++) above += 0.5 * v[a] * M[SIZE * a + b] * v[b];
            }
            moved(slides[i][0] + v[0], slides[i][1] + v[1], 0, there);
            assert_true(cipc_friction_value(there, &contact) <= above * (1 + ROUNDINGS));
        }
        /* No more than is needed: turned round, the motion has the same friction, and the quadratic meets it there too. */
        moved(-slides[i][0], -slides[i][1], 0, there);
        double back = cipc_friction_value(x, &contact);
        for (int a = 0; a < 2; a++) back += -2 * g[a] * slides[i][a] + 2 * M[(SIZE + 1) * a] * slides[i][a] * slides[i][a];
        assert_close(back, cipc_friction_value(there, &contact));
        const double y2 = slides[i][0] * slides[i][0] + slides[i][1] * slides[i][1], across[2] = {-slides[i][1], slides[i][0]};
        for (int k = 0; k < SIZE; k++) {
            if (y2 > 0) assert_close(M[SIZE * k] * across[0] + M[SIZE * k + 1] * across[1], H[SIZE * k] * across[0] + H[SIZE * k + 1] * across[1]);
            else for (int l = 0; l < SIZE; l++) assert_close(M[SIZE * k + l], H[SIZE * k + l]);
        }
    }
}

static void test_common_motion_does_not_slide(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE];
    for (int i = 0; i < SIZE; i++) x[i] = contact.start[i] + 0.5;
    cipc_friction_gradient(x, &contact, g);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scalar_functions),
        cmocka_unit_test(test_creep),
        cmocka_unit_test(test_sliding_force),
        cmocka_unit_test(test_sliding_stiffness_is_across_the_motion_only),
        cmocka_unit_test(test_sticking),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_majorizer),
        cmocka_unit_test(test_common_motion_does_not_slide),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
