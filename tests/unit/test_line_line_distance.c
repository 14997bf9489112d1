/* Squared line-line distance: value, gradient and Hessian against rational differences, component by component, down to
 * edges at an angle of 1e-12. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* Derivation (docs/theory/distance.md, 5), with S = |u| + |a| + |b|, sin the sine between a and b, W = max |w_i|, Q = max |q_i|.
 * An entry of a x b carries 4 roundings (two differences, product, difference), so the unit normal is off by 4 u / sin. Then
 *   the distance along the corrected normal is off by at most 4 u S W + d (4 u / sin)^2,
 *   a weight by 4 u / sin (W + S Q), the gradient's w d and the Hessian's w^2, w d q, d^2 q^2 by twice that and more:
 *   8 u / sin S (W + S Q) and 8 u / sin (W + S Q)^2. The worst of the samples reach a sixth of these. */
#define DISTANCE_TOLERANCE (4.0 * UNIT_ROUNDOFF)
#define TILT_TOLERANCE (4.0 * UNIT_ROUNDOFF)
#define DERIVATIVE_TOLERANCE (8.0 * UNIT_ROUNDOFF)
#define SAMPLES 240

static const cipc_pair_kind kind = CIPC_EDGE_EDGE;

/* Sizes over 24 decades; a and b at angles from 90 degrees down to 1e-12; near contact; with a common translation. */
static void draw(uint64_t *seed, int sample, double x[12])
{
    static const int a_from = 0, a_to = 3, b_from = 6, b_to = 9;
    random_fill(seed, x, 12, 1.0);
    double angle = sample % 2 ? pow(10.0, random_uniform(seed, -12.0, 0.0)) : 1.0;
    for (int k = 0; sample % 2 && k < 3; k++)
        x[b_to + k] = x[b_from + k] + 0.7 * (x[a_to + k] - x[a_from + k]) + angle * random_uniform(seed, -1.0, 1.0);
    if (sample % 3 == 1) /* near contact: the second edge moves until the lines all but cross */
        for (int k = 0; k < 3; k++) {
            double shift = x[k] + 0.3 * (x[3 + k] - x[k]) - x[6 + k] - 0.6 * (x[9 + k] - x[6 + k]) + random_uniform(seed, -1e-9, 1e-9);
            x[6 + k] += shift, x[9 + k] += shift;
        }
    if (sample % 5 == 1)
        for (int i = 0; i < 12; i++) x[i] += 1e3;
    double scale = pow(10.0, random_uniform(seed, -12.0, 12.0));
    for (int i = 0; i < 12; i++) x[i] *= scale;
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 15;
    int near_parallel = 0;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], g[12], H[144];
        draw(&seed, sample, x);
        stencil_shape s = shape_of(kind, x);
        if (s.sine < 1e-12) continue;
        if (s.sine < 1e-6) near_parallel++;
        double value = cipc_line_line_distance2_value(x), reach = s.weight + s.size * s.slope;
        double step = DISTANCE_TOLERANCE * s.size * s.weight + sqrt(value) * pow(TILT_TOLERANCE / s.sine, 2.0);
        cipc_line_line_distance2_gradient(x, g);
        cipc_line_line_distance2_hessian(x, H);
        assert_true(value_error(exact_distance2, &kind, x, 12, value) <= 2.0 * sqrt(value) * step + step * step);
        assert_true(gradient_error(exact_distance2, &kind, x, 12, g) <= DERIVATIVE_TOLERANCE / s.sine * s.size * reach);
        assert_true(hessian_error(exact_distance2, &kind, x, 12, H) <= DERIVATIVE_TOLERANCE / s.sine * reach * reach);
    }
    assert_true(near_parallel > SAMPLES / 8);
}

static void test_hessian_is_symmetric_to_the_bit(void **state)
{
    (void)state;
    uint64_t seed = 15 + 100;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[12], H[144];
        draw(&seed, sample, x);
        cipc_line_line_distance2_hessian(x, H);
        for (int i = 0; i < 12; i++)
            for (int j = 0; j < i; j++) assert_true(H[12 * i + j] == H[12 * j + i]);
    }
}

/* The checker itself: wrong signs, and a value that a plain normal (without eq. 9) would give, must show. */
static void test_checker_rejects(void **state)
{
    (void)state;
    double x[12] = {0.25, 0.5, 1.0, 0.0, 0.0, 0.0, 1.0, 0.125, 0.0, 0.25, 1.0, 0.5}, g[12], H[144];
    stencil_shape s = shape_of(kind, x);
    double reach = s.weight + s.size * s.slope;
    cipc_line_line_distance2_gradient(x, g);
    cipc_line_line_distance2_hessian(x, H);
    g[7] = -g[7];
    H[12 * 4 + 9] = -H[12 * 4 + 9];
    assert_true(gradient_error(exact_distance2, &kind, x, 12, g) > DERIVATIVE_TOLERANCE / s.sine * s.size * reach);
    assert_true(hessian_error(exact_distance2, &kind, x, 12, H) > DERIVATIVE_TOLERANCE / s.sine * reach * reach);
    double value = cipc_line_line_distance2_value(x), step = DISTANCE_TOLERANCE * s.size * s.weight;
    assert_true(value_error(exact_distance2, &kind, x, 12, value * (1.0 + 1e-12)) > 2.0 * sqrt(value) * step + step * step);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_exact),
        cmocka_unit_test(test_hessian_is_symmetric_to_the_bit),
        cmocka_unit_test(test_checker_rejects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
