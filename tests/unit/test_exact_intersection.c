/* Exact intersection: known cases one ulp either side, degenerate sets, and agreement with the solver's predicate, which shares no code with it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "cipc/geometry.h"
#include "cipc/oracle.h"

static const double unit[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static void expect(const double edge[6], const double triangle[9], cipc_verdict verdict)
{
    double turned[6];
    memcpy(turned, edge + 3, 3 * sizeof *edge);
    memcpy(turned + 3, edge, 3 * sizeof *edge);
    assert_int_equal(cipc_exact_edge_triangle(edge, triangle), verdict);
    assert_int_equal(cipc_exact_edge_triangle(turned, triangle), verdict);
}

static void test_edge_and_triangle(void **state)
{
    (void)state;
    double e = nextafter(1, 2) - 1;
    expect((double[]){0.25, 0.25, 1, 0.25, 0.25, -1}, unit, CIPC_YES);          /* through the inside */
    expect((double[]){0.25, 0.25, 1, 0.25, 0.25, 0}, unit, CIPC_YES);           /* ends in it */
    expect((double[]){0.25, 0.25, 1, 0.25, 0.25, 0x1p-1074}, unit, CIPC_NO);    /* ends above it */
    expect((double[]){0.5, 0.5, 1, 0.5, 0.5, -1}, unit, CIPC_YES);              /* through a side */
    expect((double[]){0.5, 0.5 + e, 1, 0.5, 0.5 + e, -1}, unit, CIPC_NO);       /* past it */
    expect((double[]){0, 0, 1, 0, 0, -1}, unit, CIPC_YES);                      /* through a corner */
    expect((double[]){-0x1p-1074, 0, 1, -0x1p-1074, 0, -1}, unit, CIPC_NO);     /* past it */
    expect((double[]){0.1, 0.1, 0, 0.2, 0.2, 0}, unit, CIPC_YES);               /* inside, in the plane */
    expect((double[]){-1, 0.5, 0, 2, 0.5, 0}, unit, CIPC_YES);                  /* across, in the plane */
    expect((double[]){1, 1, 0, 2, 2, 0}, unit, CIPC_NO);                        /* beside, in the plane */
    expect((double[]){-1, 2, 0, 2, -1, 0}, unit, CIPC_YES);                     /* along a side */
    expect((double[]){-1, 2 + 2 * e, 0, 2, -1 + 2 * e, 0}, unit, CIPC_NO);      /* beside it */
}

static void test_degenerate(void **state)
{
    (void)state;
    static const double line[9] = {0, 0, 0, 1, 0, 0, 3, 0, 0}, point[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    expect((double[]){2, 1, 0, 2, -1, 0}, line, CIPC_YES);
    expect((double[]){4, 1, 0, 4, -1, 0}, line, CIPC_NO);
    expect((double[]){2, 0, 0, 2, 0, 0}, line, CIPC_YES); /* a point on a segment */
    expect((double[]){0, 0, 0, 2, 2, 2}, point, CIPC_YES);
    expect((double[]){0, 0, 0, 2, 2, 3}, point, CIPC_NO);
    expect((double[]){1, 1, 1, 1, 1, 1}, point, CIPC_YES);
    expect((double[]){0, 0, NAN, 2, 2, 3}, point, CIPC_INDETERMINATE);
}

static void test_two_triangles(void **state)
{
    (void)state;
    static const double inner[9] = {0.1, 0.1, 0, 0.2, 0.1, 0, 0.1, 0.2, 0}, above[9] = {0.1, 0.1, 1, 0.2, 0.1, 1, 0.1, 0.2, 1};
    static const double through[9] = {0.25, 0.25, -1, 0.25, 0.25, 1, 5, 5, 0.5}, corner[9] = {1, 0, 0, 2, 0, 1, 2, 0, -1}, off[9] = {1.5, 0, 0, 2, 0, 1, 2, 0, -1};
    static const struct { const double *b; cipc_verdict verdict; } cases[] = {{inner, CIPC_YES}, {above, CIPC_NO}, {through, CIPC_YES}, {corner, CIPC_YES}, {off, CIPC_NO}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(cipc_exact_triangle_triangle(unit, cases[i].b), cases[i].verdict);
        assert_int_equal(cipc_exact_triangle_triangle(cases[i].b, unit), cases[i].verdict);
    }
}

/* Small integer coordinates make coplanar, touching and degenerate cases common; a last bit now and then breaks them. */
static void test_agrees_with_the_predicate(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 5);
    int met = 0, missed = 0;
    for (int i = 0; i < 40000; i++) {
        double x[15];
        for (int k = 0; k < 15; k++) {
            x[k] = (double)gsl_rng_uniform_int(rng, 4) - 1;
            if (gsl_rng_uniform_int(rng, 20) == 0) x[k] = nextafter(x[k], gsl_rng_uniform(rng) < 0.5 ? -2 : 2);
        }
        bool meet = cipc_edge_triangle_intersect(x, x + 6);
        assert_int_equal(cipc_exact_edge_triangle(x, x + 6), meet ? CIPC_YES : CIPC_NO);
        met += meet;
        missed += !meet;
    }
    assert_true(met > 5000 && missed > 5000);
    gsl_rng_free(rng);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edge_and_triangle),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_two_triangles),
        cmocka_unit_test(test_agrees_with_the_predicate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
