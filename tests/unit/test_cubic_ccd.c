/* The baseline of floating-point roots: right on plain cases, and shown to fail where the literature says it does. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"

static cipc_ccd_result solve(const cipc_stencil_path *path, double xi, double t_max)
{
    cipc_ccd_options options = cipc_ccd_options_default();
    options.method = CIPC_CCD_CUBIC;
    return cipc_ccd(path, xi, t_max, &options);
}

/* A point falls on a triangle, an edge on an edge, at t = 1/2: the step ends a tenth short of it. */
static void test_plain_cases(void **state)
{
    (void)state;
    cipc_stencil_path point = {.kind = CIPC_POINT_TRIANGLE, .x = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, .p = {0, 0, -2}};
    cipc_stencil_path edge = {.kind = CIPC_EDGE_EDGE, .x = {-1, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 0}, .p = {0, 0, -2, 0, 0, -2}};
    cipc_ccd_result a = solve(&point, 0, 1), b = solve(&edge, 0, 1);
    assert_true(a.hit && fabs(a.toi - 0.45) < 1e-12 && b.hit && fabs(b.toi - 0.45) < 1e-12);
    assert_true(!solve(&point, 0, 0.4).hit && solve(&point, 0, 0.4).toi == 0.4);
    point.x[0] = 2; /* beside the triangle */
    assert_false(solve(&point, 0, 1).hit);
    point.p[2] = 0; /* no motion, no cubic */
    assert_false(solve(&point, 0, 1).hit);
    edge.to_end = true;
    memcpy(edge.p, edge.x, sizeof edge.p);
    edge.p[2] = edge.p[5] = -1;
    b = solve(&edge, 0, 1);
    assert_true(b.hit && fabs(b.toi - 0.45) < 1e-12);
}

/* Turning edges: the determinant is a true cubic. */
static void test_a_true_cubic(void **state)
{
    (void)state;
    cipc_stencil_path edge = {.kind = CIPC_EDGE_EDGE, .x = {-1, 0.1, 1, 1, -0.1, 1, 0.1, -1, 0, -0.1, 1, 0}, .p = {0.3, 0.2, -2, -0.2, 0.4, -1.6, 0.1, 0, 0.3, 0.2, -0.3, 0.1}};
    cipc_exact_impact impact = cipc_exact_toi(&edge, 0, 1);
    cipc_ccd_result r = solve(&edge, 0, 1);
    assert_int_equal(impact.verdict, CIPC_YES);
    assert_true(r.hit && fabs(r.toi - 0.9 * impact.lo) < 1e-9);
}

/* What it cannot do: thickness, motion within one plane, pairs without four nodes. */
static void test_its_failures(void **state)
{
    (void)state;
    cipc_stencil_path thick = {.kind = CIPC_POINT_TRIANGLE, .x = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, .p = {0, 0, -0.9}};
    assert_int_equal(cipc_exact_toi(&thick, 0.5, 1).verdict, CIPC_YES);
    assert_false(solve(&thick, 0.5, 1).hit);
    cipc_stencil_path flat = {.kind = CIPC_EDGE_EDGE, .x = {0, 1, 0, 1, 1, 0, 0.5, 0, 0, 1.5, 0, 0}, .p = {0, -2, 0, 0, -2, 0}};
    assert_int_equal(cipc_exact_toi(&flat, 0, 1).verdict, CIPC_YES);
    assert_false(solve(&flat, 0, 1).hit);
    cipc_stencil_path points = {.kind = CIPC_POINT_POINT, .x = {0, 0, 1, 0, 0, 0}, .p = {0, 0, -2}};
    assert_int_equal(cipc_exact_toi(&points, 0, 1).verdict, CIPC_YES);
    assert_false(solve(&points, 0, 1).hit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_plain_cases), cmocka_unit_test(test_a_true_cubic), cmocka_unit_test(test_its_failures)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
