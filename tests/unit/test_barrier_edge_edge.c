/* Edge-edge barrier: crossing edges by hand, every closest-feature case against the reduced stencils, the mollifier (SPEC D.3). */
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

/* Some twenty operations; d^2 - xi^2 of the distances here loses less than one digit. */
static const double ROUNDINGS = 256 * DBL_EPSILON;

static const cipc_feature line_line = {CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}};

/* Two edges that cross at right angles at distance 1, a quarter and a half of the way. */
static const double crossing[SIZE] = {-1, 0, 1, 3, 0, 1, 0, -2, 0, 0, 2, 0};

static void assert_relative(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance * fabs(want))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static cipc_contact_barrier thick(cipc_feature feature, double mollifier_eps)
{
    return (cipc_contact_barrier){
        .stiffness = 100, .weight = 3, .offset = 0.5, .dhat = 1, .mollifier_eps = mollifier_eps, .feature = feature};
}

static void test_crossing_edges(void **state)
{
    (void)state;
    cipc_contact_barrier p = thick(line_line, 0);
    double g[SIZE], b[3];
    cipc_barrier(0.75, 2, b);
    assert_relative(cipc_barrier_edge_edge_value(crossing, &p), 300 * b[0], ROUNDINGS);
    cipc_barrier_edge_edge_gradient(crossing, &p, g);
    const double share[4] = {0.75, 0.25, -0.5, -0.5};
    for (int i = 0; i < 4; i++) assert_relative(g[3 * i + 2], share[i] * 300 * b[1] * 2, ROUNDINGS);
}

/* A stencil on reduced features has the energy of the reduced stencil, and nothing on the other nodes. */
static void assert_reduces(cipc_feature feature, double (*value)(const double *, const void *),
                           void (*gradient)(const double *, const void *, double *),
                           void (*hessian)(const double *, const void *, double *))
{
    const double x[SIZE] = {0, 0, 1, 0.6, 0.1, 1.1, -0.1, 0.05, 0, 0.5, 0.2, 0.1}; /* every distance between 0.5 and 1.5 */
    cipc_contact_barrier p = thick(feature, 0);
    int n = 3 * feature.count;
    double part[SIZE] = {0}, part_g[SIZE], part_H[SIZE * SIZE], g[SIZE], H[SIZE * SIZE], total = 0, part_total = 0;
    for (int i = 0; i < n; i++) part[i] = x[3 * feature.local[i / 3] + i % 3];
    gradient(part, &p, part_g);
    hessian(part, &p, part_H);
    cipc_barrier_edge_edge_gradient(x, &p, g);
    cipc_barrier_edge_edge_hessian(x, &p, H);
    assert_true(cipc_barrier_edge_edge_value(x, &p) == value(part, &p) && value(part, &p) > 0);
    for (int i = 0; i < n; i++) {
        int row = 3 * feature.local[i / 3] + i % 3;
        assert_true(g[row] == part_g[i]);
        for (int j = 0; j < n; j++) {
            assert_true(H[SIZE * row + 3 * feature.local[j / 3] + j % 3] == part_H[n * i + j]);
            part_total += fabs(part_H[n * i + j]);
        }
    }
    for (int i = 0; i < SIZE * SIZE; i++) total += fabs(H[i]);
    assert_relative(total, part_total, ROUNDINGS);
}

static void test_reduced_features(void **state)
{
    (void)state;
    const cipc_energy *point = cipc_energy_entry(CIPC_ENERGY_BARRIER_POINT_POINT),
                      *edge = cipc_energy_entry(CIPC_ENERGY_BARRIER_POINT_EDGE);
    for (int a = 0; a < 2; a++) {
        for (int b = 2; b < 4; b++)
            assert_reduces((cipc_feature){CIPC_POINT_POINT, 2, {a, b, 0, 0}}, point->value, point->gradient, point->hessian);
        assert_reduces((cipc_feature){CIPC_POINT_EDGE, 3, {a, 2, 3, 0}}, edge->value, edge->gradient, edge->hessian);
        assert_reduces((cipc_feature){CIPC_POINT_EDGE, 3, {2 + a, 0, 1, 0}}, edge->value, edge->gradient, edge->hessian);
    }
}

static void test_mollifier_scales_near_parallel_edges(void **state)
{
    (void)state;
    /* c = |a x b|^2 = 256 for the crossing edges; eps of twice that gives e = 3/4, eps of c or less gives 1. */
    cipc_contact_barrier plain = thick(line_line, 0), half = thick(line_line, 512), idle = thick(line_line, 256);
    double full = cipc_barrier_edge_edge_value(crossing, &plain);
    assert_relative(cipc_barrier_edge_edge_value(crossing, &half), 0.75 * full, ROUNDINGS);
    assert_true(cipc_barrier_edge_edge_value(crossing, &idle) == full);
}

static void test_mollifier_adds_its_own_force(void **state)
{
    (void)state;
    /* g = e b' grad d^2 + b grad e: in the plane of the edges only the second is there, and it shortens edge a: de/da1 = e' 2 c/|a| along
     * a. */
    cipc_contact_barrier half = thick(line_line, 512);
    double g[SIZE], b[3];
    cipc_barrier(0.75, 2, b);
    cipc_barrier_edge_edge_gradient(crossing, &half, g);
    double slope = 2.0 / 512 * (1 - 0.5), dc = 2 * 256 / 4.0;
    assert_relative(g[3], 300 * b[0] * slope * dc, ROUNDINGS);
    assert_relative(g[0], -300 * b[0] * slope * dc, ROUNDINGS);
    assert_relative(g[5], 0.75 * 0.25 * 300 * b[1] * 2, ROUNDINGS);
}

static void test_parallel_edges_are_finite(void **state)
{
    (void)state;
    /* c = 0: energy and gradient vanish with the mollifier, and nothing is divided by zero. */
    const double parallel[SIZE] = {0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0};
    cipc_contact_barrier p = thick((cipc_feature){CIPC_POINT_POINT, 2, {0, 2, 0, 0}}, 1e-3);
    double g[SIZE], H[SIZE * SIZE];
    assert_true(cipc_barrier_edge_edge_value(parallel, &p) == 0);
    cipc_barrier_edge_edge_gradient(parallel, &p, g);
    cipc_barrier_edge_edge_hessian(parallel, &p, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(isfinite(H[i]));
}

static void test_contact_is_infeasible_even_where_the_mollifier_vanishes(void **state)
{
    (void)state;
    const double touching[SIZE] = {0, 0, 0.25, 1, 0, 0.25, 0, 0, 0, 1, 0, 0};
    cipc_contact_barrier p = thick((cipc_feature){CIPC_POINT_POINT, 2, {0, 2, 0, 0}}, 1e-3);
    assert_true(cipc_barrier_edge_edge_value(touching, &p) == INFINITY);
}

static void test_no_force_beyond_the_support(void **state)
{
    (void)state;
    double x[SIZE], g[SIZE], H[SIZE * SIZE];
    memcpy(x, crossing, sizeof crossing);
    x[2] = x[5] = 1.5;
    cipc_contact_barrier p = thick(line_line, 512);
    assert_true(cipc_barrier_edge_edge_value(x, &p) == 0);
    cipc_barrier_edge_edge_gradient(x, &p, g);
    cipc_barrier_edge_edge_hessian(x, &p, H);
    for (int i = 0; i < SIZE; i++) assert_true(g[i] == 0);
    for (int i = 0; i < SIZE * SIZE; i++) assert_true(H[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crossing_edges),
        cmocka_unit_test(test_reduced_features),
        cmocka_unit_test(test_mollifier_scales_near_parallel_edges),
        cmocka_unit_test(test_mollifier_adds_its_own_force),
        cmocka_unit_test(test_parallel_edges_are_finite),
        cmocka_unit_test(test_contact_is_infeasible_even_where_the_mollifier_vanishes),
        cmocka_unit_test(test_no_force_beyond_the_support),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
