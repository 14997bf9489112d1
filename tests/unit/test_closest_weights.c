/* Weights of the closest vector: against rational ones, and by what they must do. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* docs/theory/distance.md, 4 and 5: a weight of a plane or line-line pair is off by at most 4 u / sin (W + S Q), one of a point-edge pair
 * by 4 u (1 + |u|/|e|). */
#define WEIGHT_TOLERANCE (4.0 * UNIT_ROUNDOFF)
#define SAMPLES 1000

static const int nodes[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4};

/* Exact weights from exact plane coordinates. */
static void exact_frame_weights(cipc_pair_kind kind, const double *x, double w[4])
{
    mpq_t y[12], u[3], a[3], b[3], beta, gamma;
    q_init(y, 12), q_init(u, 3), q_init(a, 3), q_init(b, 3), mpq_inits(beta, gamma, NULL);
    q_set(y, x, 12);
    exact_frame_edges(kind, y, u, a, b);
    assert_true(exact_plane_coordinates(beta, gamma, u, a, b));
    double s = mpq_get_d(beta), t = mpq_get_d(gamma);
    w[0] = kind == CIPC_POINT_TRIANGLE ? 1.0 : 1.0 + s;
    w[1] = kind == CIPC_POINT_TRIANGLE ? s + t - 1.0 : -s;
    w[2] = kind == CIPC_POINT_TRIANGLE ? -s : t - 1.0;
    w[3] = -t;
    q_clear(y, 12), q_clear(u, 3), q_clear(a, 3), q_clear(b, 3), mpq_clears(beta, gamma, NULL);
}

static void check_frame_weights(cipc_pair_kind kind)
{
    uint64_t seed = 61 + (uint64_t)kind;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], w[4], want[4], scale = pow(10.0, random_uniform(&seed, -9.0, 9.0));
        random_fill(&seed, x, 12, scale);
        cipc_closest_weights(kind, x, w);
        exact_frame_weights(kind, x, want);
        stencil_shape s = shape_of(kind, x);
        double tolerance = WEIGHT_TOLERANCE / s.sine * (s.weight + s.size * s.slope);
        for (int i = 0; i < 4; i++) assert_true(fabs(w[i] - want[i]) <= tolerance);
    }
}

static void test_plane_and_line_line(void **state)
{
    (void)state;
    check_frame_weights(CIPC_POINT_TRIANGLE);
    check_frame_weights(CIPC_EDGE_EDGE);
}

/* The weighted sum of the nodes is the closest vector: its length is the distance, and the weights sum to 0. */
static void test_weighted_sum_is_the_closest_vector(void **state)
{
    (void)state;
    uint64_t seed = 62;
    for (int sample = 0; sample < SAMPLES; sample++) {
        for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
            double x[12], w[4], sum = 0.0, d[3] = {0.0}, size = 0.0;
            random_fill(&seed, x, 12, 1.0);
            cipc_closest_weights((cipc_pair_kind)kind, x, w);
            for (int i = 0; i < 4; i++) {
                if (i >= nodes[kind]) assert_true(w[i] == 0.0);
                sum += w[i];
                size += fabs(w[i]);
                for (int k = 0; k < 3 && i < nodes[kind]; k++) d[k] += w[i] * x[3 * i + k];
            }
            double sine = kind < CIPC_POINT_TRIANGLE ? 1.0 : shape_of((cipc_pair_kind)kind, x).sine;
            double distance = sqrt(cipc_distance2_value((cipc_pair_kind)kind, x)), tolerance = 8.0 * UNIT_ROUNDOFF * size / sine;
            assert_true(fabs(sum) <= 4.0 * UNIT_ROUNDOFF * size);
            assert_true(fabs(norm3(d) - distance) <= tolerance * stencil_size(x, 3 * nodes[kind]) + tolerance);
        }
    }
}

static void test_by_hand(void **state)
{
    (void)state;
    const double edge[9] = {1, 5, 2, 0, 0, 0, 4, 0, 0}, face[12] = {0.25, 0.5, 7, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    const double lines[12] = {0, 0, 0, 4, 0, 0, 1, -1, 1, 1, 3, 1};
    double w[4];
    cipc_closest_weights(CIPC_POINT_POINT, edge, w);
    assert_true(w[0] == 1.0 && w[1] == -1.0 && w[2] == 0.0 && w[3] == 0.0);
    cipc_closest_weights(CIPC_POINT_EDGE, edge, w);
    assert_true(w[0] == 1.0 && w[1] == -0.75 && w[2] == -0.25 && w[3] == 0.0);
    cipc_closest_weights(CIPC_POINT_TRIANGLE, face, w);
    assert_true(w[0] == 1.0 && w[1] == -0.25 && w[2] == -0.25 && w[3] == -0.5);
    cipc_closest_weights(CIPC_EDGE_EDGE, lines, w);
    assert_true(w[0] == 0.75 && w[1] == 0.25 && w[2] == -0.75 && w[3] == -0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plane_and_line_line),
        cmocka_unit_test(test_weighted_sum_is_the_closest_vector),
        cmocka_unit_test(test_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
