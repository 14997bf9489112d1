/* The stable step of semi-implicit Euler: the limit itself on two nodes, from both sides; bounds on more. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/massspring.h"
#include "support/failing_memory.h"

static const int ENDS[1][2] = {{0, 1}};

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

/* Two nodes on a line, started a little off rest: how much farther off they are after some steps. */
static double growth(const cipc_spring *s, const double inverse_mass[2], double h)
{
    enum { STEPS = 400 };
    const double start = 1e-9;
    double x[6] = {0, 0, 0, s->length + start, 0, 0}, v[6] = {0}, most = 0;
    for (int n = 0; n < STEPS; n++) {
        double f[3];
        cipc_spring_force(s, x, v, f);
        v[0] += h * inverse_mass[0] * f[0];
        v[3] -= h * inverse_mass[1] * f[0];
        for (int k = 0; k < 6; k += 3) x[k] += h * v[k];
        const double off = fabs(x[3] - x[0] - s->length);
        if (off > 1e6 * start) return 1e6; /* gone; farther away the ends would pass each other */
        if (n >= STEPS - 8) most = fmax(most, off);
    }
    return most / start;
}

/* From no damping to almost nothing but damping: just below the limit it stays where it is, 5 % above it is gone. */
static void test_both_sides_of_the_limit(void **state)
{
    (void)state;
    static const double zeta[] = {0, 0.05, 0.5, 1, 3}, masses[3][2] = {{20, 20}, {0, 20}, {20, 0}};
    for (int m = 0; m < 3; m++) {
        for (int i = 0; i < 5; i++) {
            const double k = 500, w = masses[m][0] + masses[m][1], omega = sqrt(k * w);
            const cipc_spring s = {.length = 1, .stiffness = k, .damping = 2 * zeta[i] * omega / w};
            const double h = cipc_spring_stable_step(&s, ENDS, 1, 0, 0, masses[m], 2);
            assert_relative(h, 2 / omega * (sqrt(1 + zeta[i] * zeta[i]) - zeta[i]), 64 * DBL_EPSILON);
            assert_true(growth(&s, masses[m], 0.999 * h) < 50);
            assert_true(growth(&s, masses[m], 1.05 * h) > 1e4);
        }
    }
}

/* Unequal masses: still stable; by Gershgorin at the lighter node, 2 k w. */
static void test_unequal_masses(void **state)
{
    (void)state;
    const double inverse_mass[2] = {1, 4};
    const cipc_spring s = {.length = 1, .stiffness = 2};
    const double h = cipc_spring_stable_step(&s, ENDS, 1, 0, 0, inverse_mass, 2);
    assert_relative(h, 2 / sqrt(2 * 2 * 4), 4 * DBL_EPSILON);
    assert_true(h < 2 / sqrt(2 * (1 + 4)));
}

/* A chain of three equal masses has omega^2 = 3 k/m, its middle node's bound is 4 k/m; held ends leave 2 k/m. Worst node of both kinds together. */
static void test_chains(void **state)
{
    (void)state;
    static const int ends[2][2] = {{0, 1}, {1, 2}};
    const double free[3] = {1, 1, 1}, held[3] = {0, 1, 0}, none[3] = {0, 0, 0};
    const cipc_spring s[2] = {{.length = 1, .stiffness = 2}, {.length = 1, .stiffness = 2}};
    assert_relative(cipc_spring_stable_step(s, ends, 2, 0, 0, free, 3), 2 / sqrt(8), 4 * DBL_EPSILON);
    assert_relative(cipc_spring_stable_step(s, ends, 2, 0, 0, held, 3), 2 / sqrt(4), 4 * DBL_EPSILON);
    assert_true(isinf(cipc_spring_stable_step(s, ends, 2, 0, 0, none, 3)));
    assert_true(isinf(cipc_spring_stable_step(s, ends, 0, 0, 0, free, 3)));
    assert_relative(cipc_spring_stable_step(s, ends, 2, 5, 0, free, 3), 2 / sqrt(8 + 5), 4 * DBL_EPSILON); /* pushed by what does not move: once */
    assert_relative(cipc_spring_stable_step(s, ends, 0, 5, 0, (const double[3]){1, 4, 0}, 3), 2 / sqrt(20), 4 * DBL_EPSILON);
    assert_relative(cipc_spring_stable_step(s, ends, 2, 0, 3, free, 3), 4 / (3 + sqrt(9 + 4 * 8)), 4 * DBL_EPSILON); /* and braked: over the mass already */
    assert_relative(cipc_spring_stable_step(s, ends, 0, 0, 3, held, 3), 2.0 / 3, 4 * DBL_EPSILON);
    const cipc_spring damped[2] = {{.length = 1, .stiffness = 2}, {.length = 1, .damping = 3}};
    const double c = 6, k = 4; /* the middle node's sums: h = 4/(c + sqrt(c^2 + 4 k)) */
    assert_relative(cipc_spring_stable_step(damped, ends, 2, 0, 0, free, 3), 4 / (c + sqrt(c * c + 4 * k)), 8 * DBL_EPSILON);
}

/* A buckled spring is never steeper than 12 pi^2 k_b/L^3, and nearly so when its ends meet. */
static void test_steepness_of_the_arc(void **state)
{
    (void)state;
    const double inverse_mass[2] = {0, 1};
    cipc_spring s = {.form = CIPC_SPRING_BUCKLING, .length = 1, .stiffness = 1e9, .bending = 0.25};
    const double bound = 12 * M_PI * M_PI * 0.25;
    double steepest = 0;
    for (int i = 0; i < 1000; i++) steepest = fmax(steepest, (cipc_spring_tension(&s, 1e-3 * (i + 0.99)) - cipc_spring_tension(&s, 1e-3 * i)) / 0.99e-3);
    assert_true(steepest < bound && steepest > 0.99 * bound);
    s.stiffness = 1;
    assert_relative(cipc_spring_stable_step(&s, ENDS, 1, 0, 0, inverse_mass, 2), 2 / sqrt(bound), 8 * DBL_EPSILON);
    s.stiffness = 100;
    assert_relative(cipc_spring_stable_step(&s, ENDS, 1, 0, 0, inverse_mass, 2), 0.2, 8 * DBL_EPSILON);
}

static void test_no_memory(void **state)
{
    (void)state;
    const double inverse_mass[2] = {1, 1};
    const cipc_spring s = {.length = 1, .stiffness = 2};
    fail_allocation(1);
    assert_true(isnan(cipc_spring_stable_step(&s, ENDS, 1, 0, 0, inverse_mass, 2)));
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_both_sides_of_the_limit),
        cmocka_unit_test(test_unequal_masses),
        cmocka_unit_test(test_chains),
        cmocka_unit_test(test_steepness_of_the_arc),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
