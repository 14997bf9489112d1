/* Squared point-line distance: value, gradient and Hessian against rational differences, component by component. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/exact_geometry.h"

/* Derivation (docs/theory/distance.md, 4): an entry of u x e carries 4 roundings, so the distance is off by at most 4 u |u|, and the
 * vector e x (u x e) / |e|^2 by 8 u |u|. With S = |u| + |e| and W = 1 + |u|/|e| >= |w_i|, 1 + d/|e|:
 *   value: 2 d 4 u S + (4 u S)^2;   gradient 2 w d: 16 u S W;   Hessian, whose terms are 2 w^2, 4 w d/|e|, 2 (d/|e|)^2: 32 u W^2. */
#define DISTANCE_TOLERANCE (4.0 * UNIT_ROUNDOFF)
#define GRADIENT_TOLERANCE (16.0 * UNIT_ROUNDOFF)
#define HESSIAN_TOLERANCE (32.0 * UNIT_ROUNDOFF)
#define SAMPLES 200

static const cipc_pair_kind kind = CIPC_POINT_EDGE;

/* Sizes over 24 decades; the point far from the edge, near the line, or exactly on it, and with a common translation. */
static void draw(uint64_t *seed, int sample, double x[9])
{
    random_fill(seed, x, 9, 1.0);
    if (sample % 4 == 1)
        for (int k = 0; k < 3; k++) x[k] = x[3 + k] + 0.3 * (x[6 + k] - x[3 + k]) + random_uniform(seed, -1e-9, 1e-9);
    if (sample % 4 == 2)
        for (int k = 0; k < 3; k++) x[k] = 2.0 * x[6 + k] - x[3 + k];
    if (sample % 4 == 3)
        for (int i = 0; i < 9; i++) x[i] += 1e3;
    double scale = pow(10.0, random_uniform(seed, -12.0, 12.0));
    for (int i = 0; i < 9; i++) x[i] *= scale;
}

static void lengths(const double x[9], double *size, double *reach)
{
    double u[3], e[3];
    for (int k = 0; k < 3; k++) u[k] = x[k] - x[3 + k], e[k] = x[6 + k] - x[3 + k];
    *size = norm3(u) + norm3(e);
    *reach = 1.0 + norm3(u) / norm3(e);
}

static void test_against_exact(void **state)
{
    (void)state;
    uint64_t seed = 12;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[9], g[9], H[81], size, reach;
        draw(&seed, sample, x);
        lengths(x, &size, &reach);
        double value = cipc_point_line_distance2_value(x), step = DISTANCE_TOLERANCE * size;
        cipc_point_line_distance2_gradient(x, g);
        cipc_point_line_distance2_hessian(x, H);
        assert_true(value_error(exact_distance2, &kind, x, 9, value) <= 2.0 * sqrt(value) * step + step * step);
        assert_true(gradient_error(exact_distance2, &kind, x, 9, g) <= GRADIENT_TOLERANCE * size * reach);
        assert_true(hessian_error(exact_distance2, &kind, x, 9, H) <= HESSIAN_TOLERANCE * reach * reach);
    }
}

static void test_hessian_is_symmetric_to_the_bit(void **state)
{
    (void)state;
    uint64_t seed = 13;
    for (int sample = 0; sample < SAMPLES; sample++) {
        double x[9], H[81];
        draw(&seed, sample, x);
        cipc_point_line_distance2_hessian(x, H);
        for (int i = 0; i < 9; i++)
            for (int j = 0; j < i; j++) assert_true(H[9 * i + j] == H[9 * j + i]);
    }
}

/* The checker itself: a wrong sign of one small entry must show. */
static void test_checker_rejects(void **state)
{
    (void)state;
    double x[9] = {0.5, 1.0, 0.25, 0.0, 0.0, 0.0, 1.0, 0.5, 0.75}, g[9], H[81], size, reach;
    lengths(x, &size, &reach);
    cipc_point_line_distance2_gradient(x, g);
    cipc_point_line_distance2_hessian(x, H);
    g[5] = -g[5];
    H[9 * 2 + 6] = -H[9 * 2 + 6];
    assert_true(gradient_error(exact_distance2, &kind, x, 9, g) > GRADIENT_TOLERANCE * size * reach);
    assert_true(hessian_error(exact_distance2, &kind, x, 9, H) > HESSIAN_TOLERANCE * reach * reach);
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
