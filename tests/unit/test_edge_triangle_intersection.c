/* Edge-triangle intersection: cases built by hand, and an independent rational reference on small grids, where all degeneracies occur. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/exact_geometry.h"

#define SAMPLES 6000
#define LEAST_PER_BRANCH 100

typedef struct hand_case {
    double edge[6], triangle[9];
    bool meets;
} hand_case;

/* The triangle (0,0,0) (4,0,0) (0,4,0). */
#define T4 {0, 0, 0, 4, 0, 0, 0, 4, 0}

static const hand_case cases[] = {
    /* piercing, and missing beside or short of it */
    {{1, 1, -1, 1, 1, 1}, T4, true},
    {{3, 3, -1, 3, 3, 1}, T4, false},
    {{1, 1, 1, 1, 1, 2}, T4, false},
    /* through a vertex, through an edge; past each by an ulp */
    {{0, 0, -1, 0, 0, 1}, T4, true},
    {{2, 2, -1, 2, 2, 1}, T4, true},
    {{2, 2 + 0x1p-51, -1, 2, 2 + 0x1p-51, 1}, T4, false},
    {{0, -0x1p-1074, -1, 0, -0x1p-1074, 1}, T4, false},
    /* an end on the interior, an edge, a vertex; an ulp short */
    {{1, 1, 0, 1, 1, 1}, T4, true},
    {{2, 0, 0, 2, 0, 1}, T4, true},
    {{4, 0, 0, 5, 0, 1}, T4, true},
    {{1, 1, 0x1p-1074, 1, 1, 1}, T4, false},
    {{5, 0, 0, 5, 0, 1}, T4, false},
    /* coplanar: inside, across, along an edge, at a vertex, overlapping from outside, disjoint */
    {{1, 1, 0, 1.5, 1, 0}, T4, true},
    {{-1, 1, 0, 5, 1, 0}, T4, true},
    {{1, 0, 0, 3, 0, 0}, T4, true},
    {{4, 0, 0, 6, 1, 0}, T4, true},
    {{-1, 5, 0, 1, 3, 0}, T4, true},
    {{3, 3, 0, 5, 1, 0}, T4, false},
    {{5, 0, 0, 7, 0, 0}, T4, false},
    {{3, 1 + 0x1p-52, 0, 4, 1, 0}, T4, false},
    /* coplanar in the planes that other projections have to see */
    {{0, 1, 1, 0, 9, 9}, {0, 0, 0, 0, 4, 0, 0, 0, 4}, true},
    {{1, 0, 1, 9, 0, 9}, {0, 0, 0, 4, 0, 0, 0, 0, 4}, true},
    {{1, 9, 1, 9, 9, 9}, {0, 0, 0, 4, 0, 0, 0, 0, 4}, false},
    /* the edge is a point: on, beside, above */
    {{1, 1, 0, 1, 1, 0}, T4, true},
    {{3, 3, 0, 3, 3, 0}, T4, false},
    {{1, 1, 1, 1, 1, 1}, T4, false},
    /* the triangle is a segment: crossed, touched, missed in space, missed in plane, overlapped on its line, apart on its line */
    {{2, -1, 0, 2, 1, 0}, {0, 0, 0, 4, 0, 0, 1, 0, 0}, true},
    {{4, 0, 0, 4, 1, 1}, {0, 0, 0, 1, 0, 0, 4, 0, 0}, true},
    {{2, -1, 1, 2, 1, 1}, {0, 0, 0, 4, 0, 0, 1, 0, 0}, false},
    {{5, -1, 0, 5, 1, 0}, {0, 0, 0, 4, 0, 0, 1, 0, 0}, false},
    {{3, 0, 0, 9, 0, 0}, {0, 0, 0, 4, 0, 0, 1, 0, 0}, true},
    {{5, 0, 0, 9, 0, 0}, {0, 0, 0, 4, 0, 0, 1, 0, 0}, false},
    {{3, 3, 3, 9, 9, 9}, {0, 0, 0, 4, 4, 4, 1, 1, 1}, true},
    /* the triangle is a point: on the edge, beside it; both are points */
    {{0, 0, 0, 2, 2, 2}, {1, 1, 1, 1, 1, 1, 1, 1, 1}, true},
    {{0, 0, 0, 2, 2, 2}, {1, 1, 2, 1, 1, 2, 1, 1, 2}, false},
    {{1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1, 1, 1, 1}, true},
    {{1, 1, 1, 1, 1, 1}, {1, 1, 2, 1, 1, 2, 1, 1, 2}, false},
};

/* All the names that the same two sets have must get the same answer. */
static void assert_all_orders(const double edge[6], const double triangle[9], bool meets)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < 12; i++) {
        double e[6], t[9];
        for (int k = 0; k < 6; k++) e[k] = edge[i % 2 ? (k + 3) % 6 : k];
        for (int k = 0; k < 9; k++) t[k] = triangle[3 * orders[i / 2][k / 3] + k % 3];
        assert_true(cipc_edge_triangle_intersect(e, t) == meets);
    }
}

static void test_by_hand(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) assert_all_orders(cases[i].edge, cases[i].triangle, cases[i].meets);
}

/* Is the point of the edge in the triangle's plane, if there is just one, on the triangle? */
static bool pierces(mpq_t *x)
{
    mpq_t a[3], b[3], n[3], d[3], y[12], height, fall, distance2;
    q_init(a, 3), q_init(b, 3), q_init(n, 3), q_init(d, 3), q_init(y, 12), mpq_inits(height, fall, distance2, NULL);
    q_sub(a, x + 9, x + 6), q_sub(b, x + 12, x + 6), q_sub(d, x + 6, x);
    q_cross(n, a, b);
    q_dot(height, d, n);
    q_sub(d, x + 3, x);
    q_dot(fall, d, n);
    bool result = false;
    if (mpq_sgn(fall) != 0) {
        mpq_div(height, height, fall);
        if (mpq_sgn(height) >= 0 && mpq_cmp_ui(height, 1, 1) <= 0) {
            for (int k = 0; k < 3; k++) mpq_set(y[k], x[k]);
            for (int k = 0; k < 9; k++) mpq_set(y[3 + k], x[6 + k]);
            q_axpy(y, height, d);
            exact_minimum(distance2, CIPC_POINT_TRIANGLE, y);
            result = mpq_sgn(distance2) == 0;
        }
    }
    q_clear(a, 3), q_clear(b, 3), q_clear(n, 3), q_clear(d, 3), q_clear(y, 12), mpq_clears(height, fall, distance2, NULL);
    return result;
}

/* Is one of the distances of the parts zero: ends to triangle, edge to edges? (Or does the edge pierce the interior.) */
static bool reference(const double edge[6], const double triangle[9])
{
    static const int sides[3][2] = {{2, 3}, {3, 4}, {4, 2}};
    mpq_t x[15], y[12], distance2;
    q_init(x, 15), q_init(y, 12), mpq_init(distance2);
    q_set(x, edge, 6), q_set(x + 6, triangle, 9);
    bool result = pierces(x);
    for (int end = 0; end < 2 && !result; end++) {
        q_set(y, edge + 3 * end, 3), q_set(y + 3, triangle, 9);
        exact_minimum(distance2, CIPC_POINT_TRIANGLE, y);
        result = mpq_sgn(distance2) == 0;
    }
    for (int side = 0; side < 3 && !result; side++) {
        for (int k = 0; k < 12; k++) mpq_set(y[k], k < 6 ? x[k] : x[3 * sides[side][k / 3 - 2] + k % 3]);
        exact_minimum(distance2, CIPC_EDGE_EDGE, y);
        result = mpq_sgn(distance2) == 0;
    }
    q_clear(x, 15), q_clear(y, 12), mpq_clear(distance2);
    return result;
}

/* Grids of 2 to 4 values (all degeneracies), the same tilted off the axes and rounded, general position, and a grid in one plane. */
enum { GRID, TILTED, GENERAL, COPLANAR, FAMILIES };
static int draw(uint64_t *seed, double edge[6], double triangle[9])
{
    int family = random_below(seed, FAMILIES);
    double x[15], values = 2.0 + random_below(seed, 3);
    for (int i = 0; i < 15; i++) x[i] = floor(random_uniform(seed, 0.0, values));
    if (family == TILTED)
        for (int i = 0; i < 15; i += 3) x[i] += 0.1 * x[i + 1], x[i + 1] += 0.3 * x[i + 2], x[i + 2] += 0.7 * x[i];
    if (family == GENERAL) random_fill(seed, x, 15, 1.0);
    if (family == COPLANAR)
        for (int i = 0; i < 15; i += 3) x[i + 2] = 0.5 * x[i] + x[i + 1];
    memcpy(edge, x, sizeof(double[6]));
    memcpy(triangle, x + 6, sizeof(double[9]));
    return family;
}

static void test_against_reference(void **state)
{
    (void)state;
    uint64_t seed = 91;
    int hits[FAMILIES][2] = {{0}}, coplanar[2] = {0}, flat[2] = {0};
    for (int sample = 0; sample < SAMPLES; sample++) {
        double edge[6], t[9];
        int family = draw(&seed, edge, t);
        bool meets = reference(edge, t);
        assert_true(cipc_edge_triangle_intersect(edge, t) == meets);
        hits[family][meets]++;
        bool is_flat = !cipc_orient2d(t, t + 3, t + 6, 0) && !cipc_orient2d(t, t + 3, t + 6, 1) && !cipc_orient2d(t, t + 3, t + 6, 2);
        bool in_plane = !cipc_orient3d(t, t + 3, t + 6, edge) && !cipc_orient3d(t, t + 3, t + 6, edge + 3);
        flat[meets] += is_flat;
        coplanar[meets] += in_plane && !is_flat;
    }
    for (int meets = 0; meets < 2; meets++) {
        for (int family = 0; family < FAMILIES; family++) assert_true(hits[family][meets] >= LEAST_PER_BRANCH);
        assert_true(coplanar[meets] >= LEAST_PER_BRANCH && flat[meets] >= LEAST_PER_BRANCH);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_against_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
