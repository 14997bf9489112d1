/* Damping: the packed triangle, absent nodes, what a spring and a grounded node lose, and free flight, which loses nothing. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"

enum { N = 12 };

/* A symmetric matrix of small whole numbers, all different enough to be told apart, with a dominant diagonal: entry (i, j). All results below are exact. */
static double entry(int i, int j) { return (i == j ? 400 : 0) + (i < j ? 12 * i + j : 12 * j + i) % 37; }

static void dense(int nodes, double *H)
{
    int n = 3 * nodes;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) H[n * i + j] = entry(i, j);
}

/* Start and displacement of coordinate i. */
static double start_of(int i) { return i - 5; }
static double moved_of(int i) { return (i * 5) % 7 - 3; }

static void make(int nodes, cipc_damping *p, double x[N])
{
    double H[N * N], start[N];
    dense(nodes, H);
    for (int i = 0; i < N; i++) {
        start[i] = start_of(i);
        x[i] = start[i] + moved_of(i);
    }
    cipc_damping_init(p, 0.5, nodes, start, H);
}

static void test_packing(void **state)
{
    (void)state;
    for (int nodes = 1; nodes <= 4; nodes++) {
        cipc_damping p;
        double x[N], H[N * N];
        make(nodes, &p, x);
        cipc_damping_hessian(x, &p, H);
        for (int i = 0; i < N; i++) {
            assert_true(p.start[i] == (i < 3 * nodes ? start_of(i) : 0));
            for (int j = 0; j < N; j++) assert_true(H[N * i + j] == (i < 3 * nodes && j < 3 * nodes ? 0.5 * entry(i, j) : 0));
        }
        int k = 0;
        for (int i = 0; i < N; i++)
            for (int j = i; j < N; j++) assert_true(p.stiffness[k++] == (j < 3 * nodes ? entry(i, j) : 0));
        assert_int_equal(k, 78);
    }
}

/* c/2 d^T K d and c K d, by plain sums; absent nodes may be anywhere. */
static void test_quadratic_form(void **state)
{
    (void)state;
    for (int nodes = 1; nodes <= 4; nodes++) {
        cipc_damping p;
        double x[N], g[N], sum = 0;
        int n = 3 * nodes;
        make(nodes, &p, x);
        cipc_damping_gradient(x, &p, g);
        for (int i = 0; i < N; i++) {
            double row = 0;
            for (int j = 0; j < n; j++) row += entry(i, j) * moved_of(j);
            assert_true(g[i] == (i < n ? 0.5 * row : 0));
            if (i < n) sum += moved_of(i) * row;
        }
        assert_true(cipc_damping_value(x, &p) == 0.25 * sum);
    }
}

static void test_at_start_there_is_nothing(void **state)
{
    (void)state;
    cipc_damping p;
    double x[N], g[N];
    make(4, &p, x);
    for (int i = 0; i < N; i++) x[i] = p.start[i];
    assert_true(cipc_damping_value(x, &p) == 0);
    cipc_damping_gradient(x, &p, g);
    for (int i = 0; i < N; i++) assert_true(g[i] == 0);
}

/* A rod at rest as the element: lengthened by 2 it loses c k 2^2/2, moved sideways nothing. */
static void test_damped_rod(void **state)
{
    (void)state;
    const cipc_rod_stretching rod = {.stiffness = 12, .length = 4}; /* 3 N/m */
    const double start[6] = {0, 1, 0, 4, 1, 0}, longer[N] = {-1, 1, 0, 5, 1, 0}, aside[N] = {0, 3, 0, 4, -2, 7};
    double H[36], g[N];
    cipc_damping p;
    cipc_rod_stretching_hessian(start, &rod, H);
    cipc_damping_init(&p, 0.5, 2, start, H);
    assert_true(cipc_damping_value(longer, &p) == 0.5 * 3 * 4 / 2);
    cipc_damping_gradient(longer, &p, g);
    assert_true(g[0] == -3 && g[3] == 3 && g[1] == 0);
    assert_true(cipc_damping_value(aside, &p) == 0);
}

/* In free flight over a million times the element's size, a lengthening of 1 still has the force and energy that it has at home. K is a spring along (3,4,0)/5,
 * whose doubles are rounded; its rows sum to zero exactly, as opposite numbers do. */
static void test_free_flight(void **state)
{
    (void)state;
    const cipc_rod_stretching rod = {.stiffness = 5, .length = 5};
    const double start[6] = {0, 0, 0, 3, 4, 0}, flight[3] = {0x1p20, -0x1p19, 0x1p21};
    double H[36], x[N] = {0}, g[N];
    cipc_damping p;
    cipc_rod_stretching_hessian(start, &rod, H);
    cipc_damping_init(&p, 2, 2, start, H);
    for (int i = 0; i < 6; i++) x[i] = start[i] + flight[i % 3] + (i == 3 ? 0.75 : i == 4 ? 1 : 0); /* 1.25 along the rod */
    cipc_damping_gradient(x, &p, g);
    assert_true(fabs(g[3] - 2 * 1.25 * 0.6) <= 16 * DBL_EPSILON && fabs(g[4] - 2 * 1.25 * 0.8) <= 16 * DBL_EPSILON);
    assert_true(fabs(cipc_damping_value(x, &p) - 1.25 * 1.25) <= 16 * DBL_EPSILON);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_packing),
        cmocka_unit_test(test_quadratic_form),
        cmocka_unit_test(test_at_start_there_is_nothing),
        cmocka_unit_test(test_damped_rod),
        cmocka_unit_test(test_free_flight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
