/* Closest points of two primitives as weights of their nodes: every kind of pair with every feature, against the exact distance. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "asynchronous/integrator.h"
#include "cipc/oracle.h"
#include "support/exact_geometry.h"

/* Distances of stencils of size S are good to some u S (docs/theory/distance.md 6.3: 7 u S); the weights add some. */
static const double DISTANCE_ROUNDING = 16 * UNIT_ROUNDOFF;
/* Weights are lengths along an edge by the edge's length. Of near-parallel edges they are good to u/sine. */
static const double WEIGHT_ROUNDING = 1e-9;

static void assert_closest(cipc_pair_kind kind, const double x[12], double weight_rounding)
{
    const asynchronous_closest closest = asynchronous_closest_points(kind, x);
    const int count = cipc_pair_nodes(kind), first = cipc_pair_first_nodes(kind);
    const double size = stencil_size(x, 3 * count), rounding = DISTANCE_ROUNDING * size;
    double sums[2] = {0, 0}, between[3] = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        const double c = i < first ? closest.c[i] : -closest.c[i];
        assert_true(c >= -weight_rounding && c <= 1 + weight_rounding); /* a point of its own primitive */
        sums[i >= first] += c;
        v3_axpy(between, closest.c[i], x + 3 * i);
    }
    for (int i = count; i < 4; i++) assert_true(closest.c[i] == 0);
    for (int side = 0; side < 2; side++) assert_true(fabs(sums[side] - 1) <= 1e-14 + weight_rounding); /* from the second to the first, which the sign of n stands on */
    assert_true(fabs(closest.distance - sqrt(cipc_exact_distance2(kind, x, NULL))) <= rounding);
    for (int k = 0; k < 3; k++) assert_true(fabs(closest.distance * closest.n[k] - between[k]) <= rounding);
    assert_true(fabs(v3_norm(closest.n) - 1) <= 1e-14);
}

/* Primitives of random size and place, so that all features turn up; with the node that is closest now and then drawn close to the other primitive. */
static void draw(uint64_t *seed, cipc_pair_kind kind, double x[12])
{
    const int first = cipc_pair_first_nodes(kind);
    const double sizes[2] = {exp(random_uniform(seed, -4, 1)), exp(random_uniform(seed, -4, 1))};
    double apart[3];
    random_fill(seed, apart, 3, random_below(seed, 2) ? 1 : 0.3);
    for (int i = 0; i < 12; i++) x[i] = (i / 3 < first ? apart[i % 3] : 0) + random_uniform(seed, -1, 1) * sizes[i / 3 < first ? 0 : 1];
}

static void test_every_feature(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        int seen[CIPC_FEATURE_LIMIT] = {0};
        for (int i = 0; i < 6000; i++) {
            double x[12];
            unsigned features = 0;
            draw(&seed, (cipc_pair_kind)kind, x);
            if (!(cipc_exact_distance2((cipc_pair_kind)kind, x, &features) > 1e-12)) continue;
            assert_closest((cipc_pair_kind)kind, x, WEIGHT_ROUNDING);
            for (int f = 0; f < CIPC_FEATURE_LIMIT; f++) seen[f] += features == 1u << f;
        }
        for (int f = 0; f < cipc_feature_count((cipc_pair_kind)kind); f++) assert_true(seen[f] >= 50);
    }
}

/* The point of the feature lies in the second edge: the vector still points from the second edge to the first. */
static void test_point_of_the_second_edge(void **state)
{
    (void)state;
    const double x[12] = {-1, 1, 0, 1, 1, 0, 0, 0, 0, 0, -3, 0};
    const asynchronous_closest closest = asynchronous_closest_points(CIPC_EDGE_EDGE, x);
    const double c[4] = {0.5, 0.5, -1, 0}, n[3] = {0, 1, 0};
    assert_true(closest.distance == 1);
    assert_memory_equal(closest.c, c, sizeof c);
    assert_memory_equal(closest.n, n, sizeof n);
}

/* Edges at angles down to rounding: the distance is as good as ever, and the points are points of the edges. */
static void test_near_parallel_edges(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 20000; i++) {
        const double angle = exp(random_uniform(&seed, -40, 0)), shift = random_uniform(&seed, -1.5, 1.5), gap = exp(random_uniform(&seed, -9, 0));
        double x[12], along[3], turned[3], across[3], up[3];
        random_fill(&seed, along, 3, 1);
        random_fill(&seed, across, 3, 1);
        v3_cross(up, along, across);
        v3_cross(across, up, along);
        if (v3_norm(across) < 0.1 || v3_norm(along) < 0.1) continue;
        v3_scale(up, gap / v3_norm(up), up);
        v3_scale(turned, 1, along);
        v3_axpy(turned, angle / v3_norm(across), across);
        for (int k = 0; k < 3; k++) {
            x[k] = 0;
            x[3 + k] = along[k];
            x[6 + k] = shift * along[k] + up[k] + angle * random_uniform(&seed, -1, 1) * across[k];
            x[9 + k] = x[6 + k] + turned[k];
        }
        assert_closest(CIPC_EDGE_EDGE, x, 1e-3);
    }
}

/* Triangles that are a line or a point, edges that are a point. */
static void test_degenerate_primitives(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
            const int first = cipc_pair_first_nodes((cipc_pair_kind)kind), count = cipc_pair_nodes((cipc_pair_kind)kind);
            double x[12];
            draw(&seed, (cipc_pair_kind)kind, x);
            for (int node = first + 1; node < count; node++) v3_copy(x + 3 * node, x + 3 * (random_below(&seed, 2) ? first : node - 1));
            if (cipc_exact_distance2((cipc_pair_kind)kind, x, NULL) > 1e-9) assert_closest((cipc_pair_kind)kind, x, WEIGHT_ROUNDING);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_feature),
        cmocka_unit_test(test_point_of_the_second_edge),
        cmocka_unit_test(test_near_parallel_edges),
        cmocka_unit_test(test_degenerate_primitives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
