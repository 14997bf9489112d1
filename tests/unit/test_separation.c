/* The filter of the monitors: its lower bounds are never above the exact distance, and good enough to be of use. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "invariant/separation.h"
#include "support/exact_geometry.h"

/* A good lower bound misses by rounding only: 12 sqrt(3) u S for the bound itself, a few u d for the quotient, and the tilt of the
 * direction, whose error is a few u times S / sin(angle), the angle being at least 1e-3 or the ends tried as well. 2^-38 S is far above
 * all of these and far below what matters. */
#define LOSS 0x1p-38

/* lower <= d, exactly. A bound that is not positive says nothing. */
static void assert_is_lower_bound(cipc_pair_kind kind, const double x[12], double lower)
{
    assert_true(lower == lower); /* not NaN */
    if (lower > 0 && cipc_exact_distance_sign(kind, x, lower) < 0) {
        fail_msg("%s: lower bound %.17g above the distance (gap %.3g)", cipc_pair_name(kind), lower,
                 cipc_exact_distance_gap(kind, x, lower));
    }
}

/* Shapes of random stencils: general, few digits, nearly flat, far from the origin, sliver or short edge, near contact, nearly parallel. */
enum { SHAPES = 7 };

static void draw(uint64_t *seed, int shape, double x[12])
{
    for (int i = 0; i < 12; i++) {
        x[i] = shape == 1 ? 0.25 * random_below(seed, 4) : random_uniform(seed, -1, 1);
        x[i] = shape == 2 && i % 3 == 2 ? x[i] * 0x1p-30 : x[i];
        x[i] = shape == 3 ? 1e6 + 1e-3 * x[i] : x[i];
    }
    for (int k = 0; k < 3; k++) {
        if (shape == 4) {
            x[9 + k] = x[6 + k] + 0x1p-40 * x[9 + k];
        } else if (shape == 5) { /* the last node close to the middle of the others */
            x[k] = (x[3 + k] + x[6 + k] + x[9 + k]) / 3 + 1e-12 * x[k];
        } else if (shape == 6) {
            x[9 + k] = x[6 + k] + (x[3 + k] - x[k]) * (1 + 1e-10 * x[9 + k]);
        }
    }
}

static void test_lower_bounds(void **state)
{
    (void)state;
    uint64_t seed = 41;
    long positive = 0;
    enum { SAMPLES = 30000 };
    for (int i = 0; i < SAMPLES; i++) {
        double x[12];
        draw(&seed, i % SHAPES, x);
        cipc_pair_kind kind = (cipc_pair_kind)random_below(&seed, CIPC_PAIR_KIND_COUNT);
        cipc_separation best = cipc_separate(kind, x, INFINITY), quick = cipc_separate(kind, x, 0);
        assert_is_lower_bound(kind, x, best.lower);
        assert_is_lower_bound(kind, x, quick.lower);
        positive += best.lower > 0 ? 1 : 0;
    }
    assert_true(positive > SAMPLES / 2);
}

static void test_bounds_are_tight(void **state)
{
    (void)state;
    uint64_t seed = 43;
    long tight = 0, checked = 0;
    for (int i = 0; i < 30000; i++) {
        double x[12], distance2;
        int shape = i % 3 == 0 ? 3 : i % 3 == 1 ? 0 : 6;
        draw(&seed, shape, x);
        cipc_pair_kind kind = (cipc_pair_kind)random_below(&seed, CIPC_PAIR_KIND_COUNT);
        distance2 = cipc_exact_distance2(kind, x, NULL);
        double size = stencil_size(x, 3 * cipc_pair_nodes(kind)), distance = sqrt(distance2);
        cipc_separation s = cipc_separate(kind, x, INFINITY);
        if (distance >
            1e-3 * size) { /* closer, the direction a - b between end points tilts more; that pair then goes to exact arithmetic */
            checked++;
            assert_true(s.lower >= distance - LOSS * size);
            assert_true(s.upper <= distance + LOSS * size || shape == 6);
            tight += s.tight ? 1 : 0;
        }
    }
    assert_true(checked > 20000);
    assert_true(tight > 99 * checked / 100);
}

/* Layers close together, the usual case in contact: the bound must be good to rounding, so that exact arithmetic is rarely needed. */
static void test_close_layers(void **state)
{
    (void)state;
    uint64_t seed = 47;
    for (int i = 0; i < 3000; i++) {
        double gap = pow(10, random_uniform(&seed, -9, -2));
        double u = random_uniform(&seed, 0.1, 0.4), v = random_uniform(&seed, 0.1, 0.4), angle = random_uniform(&seed, 0.1, 3);
        const double point[12] = {5 + u, v, 7 + gap, 5, 0, 7, 6, 0, 7, 5, 1, 7};
        const double edges[12] = {5 - cos(angle), -sin(angle), 7 + gap, 5 + cos(angle), sin(angle), 7 + gap, 4,
                                  0.01 * u,       7,           6,       0.01 * v,       7};
        double true_gap = (7 + gap) - 7; /* Sterbenz: exact */
        cipc_separation s = cipc_separate_point_triangle(point, INFINITY), e = cipc_separate_edge_edge(edges, INFINITY);
        assert_true(s.tight && s.lower <= true_gap && s.lower > true_gap - 0x1p-46);
        assert_true(e.tight && e.lower <= true_gap && e.lower > true_gap - 0x1p-46);
    }
}

static void test_extreme_numbers_prove_nothing_false(void **state)
{
    (void)state;
    const int exponents[] = {-1074, -1000, -500, -400, -300, 300, 399, 500, 1000, 1023};
    uint64_t seed = 53;
    long proven = 0;
    for (int i = 0; i < 5000; i++) {
        double x[12];
        draw(&seed, i % SHAPES == 3 ? 0 : i % SHAPES, x);
        int first = exponents[random_below(&seed, 10)], second = exponents[random_below(&seed, 10)];
        for (int k = 0; k < 12; k++) { x[k] = ldexp(x[k], i % 2 == 0 || k < 6 ? first : second); }
        cipc_pair_kind kind = (cipc_pair_kind)random_below(&seed, CIPC_PAIR_KIND_COUNT);
        cipc_separation s = cipc_separate(kind, x, INFINITY);
        assert_is_lower_bound(kind, x, s.lower);
        proven += s.lower > 0 ? 1 : 0;
    }
    assert_true(proven > 500); /* 2^+-300 is within range */
}

/* Along any direction whatever, good or bad, of any length. */
static void test_along_any_direction(void **state)
{
    (void)state;
    uint64_t seed = 57;
    long positive[CIPC_PAIR_KIND_COUNT] = {0};
    for (int i = 0; i < 20000; i++) {
        double x[12], n[3];
        draw(&seed, i % SHAPES, x);
        cipc_pair_kind kind = (cipc_pair_kind)(i % CIPC_PAIR_KIND_COUNT);
        random_fill(&seed, n, 3, ldexp(1, random_below(&seed, 200) - 100));
        if (i % 3 == 0) { memcpy(n, cipc_separate(kind, x, INFINITY).n, sizeof n); }
        double bound = cipc_separation_along(kind, x, n);
        assert_is_lower_bound(kind, x, bound);
        positive[kind] += bound > 0 ? 1 : 0;
    }
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) { assert_true(positive[kind] > 1000); }
}

/* A point beside an edge, beyond its end, and two points: good to rounding at any gap. */
static void test_points_and_edges(void **state)
{
    (void)state;
    uint64_t seed = 61;
    for (int i = 0; i < 3000; i++) {
        double gap = pow(10, random_uniform(&seed, -6, -2)), u = random_uniform(&seed, 0.1, 0.9), true_gap = (7 + gap) - 7;
        const double beside[9] = {5 + u, 3, 7 + gap, 5, 3, 7, 6, 3, 7}, beyond[9] = {5, 3, 7 + gap, 5, 3, 7, 5, 3, 6};
        cipc_separation s = cipc_separate_point_edge(beside, INFINITY), e = cipc_separate_point_edge(beyond, INFINITY),
                        p = cipc_separate_point_point(beyond, INFINITY);
        assert_true(s.tight && s.lower <= true_gap && s.lower > true_gap - 0x1p-46);
        assert_true(e.tight && e.lower <= true_gap && e.lower > true_gap - 0x1p-46);
        assert_true(p.tight && p.lower <= true_gap && p.lower > true_gap * (1 - 0x1p-46));
    }
}

static void test_degenerate(void **state)
{
    (void)state;
    const double same[12] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, point_point[12] = {1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    assert_false(cipc_separate_point_triangle(same, INFINITY).lower > 0);
    assert_false(cipc_separate_edge_edge(same, INFINITY).lower > 0);
    assert_false(cipc_separate_point_edge(same, INFINITY).lower > 0);
    assert_false(cipc_separate_point_point(same, INFINITY).lower > 0);
    cipc_separation s = cipc_separate_point_triangle(point_point, INFINITY);
    assert_true(s.lower <= 3 && s.lower > 3 - 0x1p-40);
    s = cipc_separate_point_edge(point_point, INFINITY); /* an edge of no length */
    assert_true(s.lower <= 3 && s.lower > 3 - 0x1p-40);
    const double parallel[12] = {0, 0, 0, 4, 0, 0, 1, 3, 0, 2, 3, 0}, meeting[12] = {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0};
    s = cipc_separate_edge_edge(parallel, INFINITY);
    assert_true(s.tight && s.lower <= 3 && s.lower > 3 - 0x1p-40);
    assert_false(cipc_separate_edge_edge(meeting, INFINITY).lower > 0);
}

/* Exact comparison of the distance of edge and triangle, which do not meet, with a bound: the least of its five point-triangle and
 * edge-edge distances. */
static bool edge_triangle_exceeds(const double edge[6], const double triangle[9], double distance)
{
    double x[12];
    bool exceeds = true;
    for (int i = 0; i < 2; i++) {
        memcpy(x, &edge[3 * i], 3 * sizeof *x);
        memcpy(&x[3], triangle, 9 * sizeof *x);
        exceeds = exceeds && cipc_exact_distance_sign(CIPC_POINT_TRIANGLE, x, distance) > 0;
    }
    for (int i = 0; i < 3; i++) {
        memcpy(x, edge, 6 * sizeof *x);
        memcpy(&x[6], &triangle[3 * i], 3 * sizeof *x);
        memcpy(&x[9], &triangle[3 * ((i + 1) % 3)], 3 * sizeof *x);
        exceeds = exceeds && cipc_exact_distance_sign(CIPC_EDGE_EDGE, x, distance) > 0;
    }
    return exceeds;
}

static void test_edge_and_triangle(void **state)
{
    (void)state;
    uint64_t seed = 59;
    long apart = 0, meeting = 0, missed = 0, far = 0;
    for (int i = 0; i < 30000; i++) {
        double x[15];
        draw(&seed, i % SHAPES, x);
        for (int k = 12; k < 15; k++) {
            x[k] = i % SHAPES == 1 ? 0.25 * random_below(&seed, 4)
                                   : x[k - 12] + 0.5 * (x[k - 9] - x[k - 12]) + 0.3 * random_uniform(&seed, -1, 1) * stencil_size(x, 12);
        }
        bool meets = cipc_edge_triangle_intersect(x, &x[6]), proven = cipc_edge_triangle_apart(x, &x[6]);
        assert_false(meets && proven);
        apart += proven ? 1 : 0;
        meeting += meets ? 1 : 0;
        missed += !meets && !proven ? 1 : 0;
        double distance = random_uniform(&seed, 0, 0.5) * stencil_size(x, 15);
        if (cipc_edge_triangle_far(x, &x[6], distance)) {
            far++;
            assert_false(meets);
            assert_true(edge_triangle_exceeds(x, &x[6], distance));
        }
    }
    assert_true(apart > 10000 && meeting > 1000 && far > 1000);
    assert_true(missed < 1000); /* touching within rounding, few digits, slivers */
}

/* A flat mesh at rest is exactly flat: neighbours in the plane must be told apart without the exact predicate. */
static void test_edge_beside_triangle_in_its_plane(void **state)
{
    (void)state;
    const double triangle[9] = {0, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5};
    const double beside[6] = {1, 1, 0.5, 1, 0.125, 0.5}, through[6] = {-1, 0.25, 0.5, 2, 0.5, 0.5}, corner[6] = {-1, 1, 0.5, 1, -1, 0.5},
                 touching[6] = {1, 0, 0.5, 2, 0, 0.5}, skew[6] = {-1, 0.9, 0.5, 0.9, -1, 0.5};
    assert_true(cipc_edge_triangle_apart(beside, triangle));
    assert_true(cipc_edge_triangle_apart(skew, triangle));
    assert_false(cipc_edge_triangle_apart(through, triangle));
    assert_false(cipc_edge_triangle_apart(corner, triangle));
    assert_false(cipc_edge_triangle_apart(touching, triangle));
    assert_true(cipc_edge_triangle_far(beside, triangle, 0.08));
    assert_false(cipc_edge_triangle_far(beside, triangle, 0.089)); /* 0.125 / sqrt(2) = 0.0884 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lower_bounds),
        cmocka_unit_test(test_bounds_are_tight),
        cmocka_unit_test(test_close_layers),
        cmocka_unit_test(test_extreme_numbers_prove_nothing_false),
        cmocka_unit_test(test_along_any_direction),
        cmocka_unit_test(test_points_and_edges),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_edge_and_triangle),
        cmocka_unit_test(test_edge_beside_triangle_in_its_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
