/* The exact distance oracle: cases with answers known by hand, its slow twin in rationals, and rounding to nearest. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "support/exact_geometry.h"

/* A stencil and its squared distance, exact by hand. */
typedef struct known_case {
    const char *name;
    bool edge_edge;
    double x[12];
    double distance2;
} known_case;

static const known_case known[] = {
    {"point over the inside", false, {0.25, 0.25, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 9},
    {"point over a side", false, {0.5, -2, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 5},
    {"point beyond a corner", false, {-1, -2, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 9},
    {"point beyond the slanted side", false, {1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 0.5},
    {"point on the inside", false, {0.25, 0.25, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 0},
    {"point on a side", false, {0.5, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 0},
    {"point on a corner", false, {1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 0},
    {"collinear triangle, point beside", false, {1, 2, 0, 0, 0, 0, 3, 0, 0, 1, 0, 0}, 4},
    {"collinear triangle, point beyond", false, {5, 0, 0, 0, 0, 0, 3, 0, 0, 1, 0, 0}, 4},
    {"triangle of one point", false, {1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 9},
    {"crossed edges", true, {-1, 0, 0, 1, 0, 0, 0, -1, 2, 0, 1, 2}, 4},
    {"edges that meet", true, {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0}, 0},
    {"end over inside", true, {-1, 0, 0, 1, 0, 0, 0, 2, 1, 0, 3, 1}, 5},
    {"end to end", true, {0, 0, 0, 1, 0, 0, 3, 1, 2, 4, 5, 6}, 9},
    {"parallel edges side by side", true, {0, 0, 0, 4, 0, 0, 1, 3, 0, 2, 3, 0}, 9},
    {"parallel edges apart", true, {0, 0, 0, 1, 0, 0, 2, 1, 0, 5, 1, 0}, 2},
    {"collinear edges", true, {0, 0, 0, 1, 0, 0, 3, 0, 0, 5, 0, 0}, 4},
    {"collinear edges that overlap", true, {0, 0, 0, 2, 0, 0, 1, 0, 0, 5, 0, 0}, 0},
    {"point and edge", true, {1, 2, 0, 1, 2, 0, 0, 0, 0, 5, 0, 0}, 4},
    {"two points", true, {1, 2, 2, 1, 2, 2, 0, 0, 0, 0, 0, 0}, 9},
};

static void test_known_cases(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double distance2 = -1, xi = sqrt(known[i].distance2);
        distance2 = cipc_exact_distance2(cipc_mesh_pair(known[i].edge_edge), known[i].x, NULL);
        int sign = cipc_exact_distance_sign(cipc_mesh_pair(known[i].edge_edge), known[i].x, 0);
        if (distance2 != known[i].distance2 || sign != (distance2 > 0)) {
            fail_msg("%s: %g, expected %g", known[i].name, distance2, known[i].distance2);
        }
        if (xi * xi == known[i].distance2) {
            assert_int_equal(cipc_exact_distance_sign(cipc_mesh_pair(known[i].edge_edge), known[i].x, xi), 0);
            assert_true(cipc_exact_distance_gap(cipc_mesh_pair(known[i].edge_edge), known[i].x, xi) == 0);
        }
        assert_int_equal(cipc_exact_distance_sign(cipc_mesh_pair(known[i].edge_edge), known[i].x, nextafter(xi, INFINITY)), -1);
    }
}

/* Coordinates of random stencils: a few digits (so that ties, zero lengths and parallels abound) or many. */
static void draw_stencil(uint64_t *seed, double x[12])
{
    int kind = random_below(seed, 4);
    for (int i = 0; i < 12; i++) {
        x[i] = kind == 0 ? random_below(seed, 3) : kind == 1 ? random_below(seed, 9) * 0.125 : random_uniform(seed, -1, 1);
    }
    if (kind == 3) { /* nearly parallel, nearly flat */
        for (int i = 0; i < 3; i++) { x[9 + i] = x[6 + i] + (x[3 + i] - x[i]) * (1 + random_uniform(seed, -1, 1) * 0x1p-30); }
    }
}

static void test_against_the_slow_twin(void **state)
{
    (void)state;
    enum { SAMPLES = 3000 };
    uint64_t seed = 21;
    mpq_t x[12], best, square;
    q_init(x, 12);
    mpq_inits(best, square, NULL);
    long signs[3] = {0, 0, 0};
    for (int i = 0; i < SAMPLES; i++) {
        double stencil[12], distance2;
        draw_stencil(&seed, stencil);
        bool edge_edge = random_below(&seed, 2) == 1;
        q_set(x, stencil, 12);
        exact_minimum(best, cipc_mesh_pair(edge_edge), x);
        double xi = random_below(&seed, 3) == 0 ? 0.125 * random_below(&seed, 9) : sqrt(mpq_get_d(best));
        mpq_set_d(square, xi);
        mpq_mul(square, square, square);
        int expected = mpq_cmp(best, square);
        distance2 = cipc_exact_distance2(cipc_mesh_pair(edge_edge), stencil, NULL);
        int sign = cipc_exact_distance_sign(cipc_mesh_pair(edge_edge), stencil, xi);
        assert_int_equal(sign, (expected > 0) - (expected < 0));
        signs[sign + 1]++;
        /* mpq_get_d truncates: the nearest double is that or the next. */
        assert_true(distance2 == mpq_get_d(best) || distance2 == nextafter(mpq_get_d(best), INFINITY));
    }
    for (int i = 0; i < 3; i++) { assert_true(signs[i] > SAMPLES / 50); }
    q_clear(x, 12);
    mpq_clears(best, square, NULL);
}

/* A correct rounding is no further from the truth than half of the way to either neighbour: compare d with xi + (g + g')/2, all exact. */
static void assert_gap_is_nearest(bool edge_edge, const double stencil[12], double xi)
{
    mpq_t x[12], best, bound, half;
    q_init(x, 12);
    mpq_inits(best, bound, half, NULL);
    q_set(x, stencil, 12);
    exact_minimum(best, cipc_mesh_pair(edge_edge), x);
    double gap = cipc_exact_distance_gap(cipc_mesh_pair(edge_edge), stencil, xi);
    for (int side = -1; side <= 1; side += 2) {
        mpq_set_d(bound, gap);
        mpq_set_d(half, nextafter(gap, side < 0 ? -INFINITY : INFINITY));
        mpq_add(bound, bound, half);
        mpq_div_2exp(bound, bound, 1);
        mpq_set_d(half, xi);
        mpq_add(bound, bound, half); /* xi + midpoint: d must be on the inner side of it, or on it */
        int sign = mpq_sgn(bound);
        mpq_mul(bound, bound, bound);
        int order = sign < 0 ? 1 : mpq_cmp(best, bound);
        assert_true(side < 0 ? order >= 0 : order <= 0);
    }
    q_clear(x, 12);
    mpq_clears(best, bound, half, NULL);
}

static void test_gap_is_rounded_to_nearest(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (int i = 0; i < 1000; i++) {
        double stencil[12];
        draw_stencil(&seed, stencil);
        bool edge_edge = random_below(&seed, 2) == 1;
        double distance2;
        distance2 = cipc_exact_distance2(cipc_mesh_pair(edge_edge), stencil, NULL);
        /* xi within a few ulp of d: the gap is what plain subtraction would lose altogether. */
        double xi = sqrt(distance2) * (1 + (random_below(&seed, 9) - 4) * DBL_EPSILON);
        assert_gap_is_nearest(edge_edge, stencil, i % 2 == 0 ? xi : 0.5 * xi);
    }
}

static void test_gap_beyond_double(void **state)
{
    (void)state;
    /* A plane tilted by less than 2^-300. */
    const double x[12] = {0.25, 0.25, 1, -8, -8, -0x1p-300, 8, -8, 0, 0, 8, 0};
    double gap = cipc_exact_distance_gap(CIPC_POINT_TRIANGLE, x, 1);
    assert_true(gap > 0 && gap < 0x1p-290);
    assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, x, 1), 1);
    /* d = sqrt(1 + 2^-200), xi = 1: the gap is 2^-201 less a little; d^2 - xi^2 in doubles is 0. */
    const double y[12] = {3, 0, 0x1p-100, 3, 0, 0x1p-100, 2, 0, 0, 2, 0, 0};
    assert_true(cipc_exact_distance_gap(CIPC_EDGE_EDGE, y, 1) == 0x1p-201);
    assert_true(cipc_exact_distance_gap(CIPC_EDGE_EDGE, y, 2) == -1);
}

static void test_scales(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        for (int e = -300; e <= 300; e += 300) {
            double x[12], distance2, xi = sqrt(known[i].distance2);
            for (int k = 0; k < 12; k++) { x[k] = ldexp(known[i].x[k], e); }
            distance2 = cipc_exact_distance2(cipc_mesh_pair(known[i].edge_edge), x, NULL);
            assert_true(distance2 == ldexp(known[i].distance2, 2 * e));
            if (xi * xi == known[i].distance2) {
                assert_int_equal(cipc_exact_distance_sign(cipc_mesh_pair(known[i].edge_edge), x, ldexp(xi, e)), 0);
            }
        }
    }
    /* Both scales in one stencil, and numbers whose square underflows or overflows. */
    const double mixed[12] = {0, 0, 0x1p-300, -0x1p300, -0x1p300, 0, 0x1p300, -0x1p300, 0, 0, 0x1p300, 0};
    double distance2;
    distance2 = cipc_exact_distance2(CIPC_POINT_TRIANGLE, mixed, NULL);
    assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, mixed, 0x1p-300), 0);
    assert_true(distance2 == 0x1p-600);
    const double tiny[12] = {0, 0, 0x1p-1074}, huge[12] = {DBL_MAX};
    distance2 = cipc_exact_distance2(CIPC_POINT_TRIANGLE, tiny, NULL);
    assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, tiny, 0), 1);
    assert_true(distance2 == 0);
    assert_true(cipc_exact_distance_gap(CIPC_POINT_TRIANGLE, tiny, 0) == 0x1p-1074);
    distance2 = cipc_exact_distance2(CIPC_POINT_TRIANGLE, huge, NULL);
    assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, huge, 1), 1);
    assert_true(isinf(distance2));
    assert_true(cipc_exact_distance_gap(CIPC_POINT_TRIANGLE, huge, 0) == DBL_MAX);
}

static void test_non_finite_proves_nothing(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        double x[12];
        memcpy(x, known[0].x, sizeof x);
        assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, x, bad[i]), -1);
        x[7] = bad[i];
        assert_int_equal(cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, x, 0), -1);
        assert_int_equal(cipc_exact_distance_sign(CIPC_EDGE_EDGE, x, 0), -1);
        assert_true(isnan(cipc_exact_distance2(CIPC_POINT_TRIANGLE, x, NULL)));
        assert_true(isnan(cipc_exact_distance_gap(CIPC_POINT_TRIANGLE, x, 0)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_cases),
        cmocka_unit_test(test_against_the_slow_twin),
        cmocka_unit_test(test_gap_is_rounded_to_nearest),
        cmocka_unit_test(test_gap_beyond_double),
        cmocka_unit_test(test_scales),
        cmocka_unit_test(test_non_finite_proves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
