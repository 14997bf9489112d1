/* Rest data of a membrane triangle: inverse rest matrix, area, plane-stress moduli, node weights. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/energy.h"
#include "energy/membrane.h"

/* A few roundings of numbers of size one. */
static const double ROUNDINGS = 8 * DBL_EPSILON;

/* Base 4 along (0, 1, 0), foot at 1, height 2 along (0, 0, 1): all of B is exact. */
static const double rest[9] = {5, 0, 0, 5, 4, 0, 5, 1, 2};

static void test_inverse_rest_matrix_and_area(void **state)
{
    (void)state;
    cipc_membrane params;
    assert_true(cipc_membrane_init(&params, rest, 0.5, 12, 0.5));
    /* B = [[4, 1], [0, 2]] */
    assert_true(params.inverse_rest[0] == 0.25 && params.inverse_rest[1] == -0.125 && params.inverse_rest[2] == 0.5);
    assert_true(params.area == 4 && params.volume == 2);
}

static void test_plane_stress_moduli(void **state)
{
    (void)state;
    cipc_membrane params;
    assert_true(cipc_membrane_init(&params, rest, 0.5, 12, 0.5));
    assert_true(fabs(params.mu - 4) < 4 * ROUNDINGS);     /* 12 / (2 * 1.5) */
    assert_true(fabs(params.lambda - 8) < 8 * ROUNDINGS); /* 12 * 0.5 / (1 - 0.25); in three dimensions it would be infinite */
}

static void test_triangles_without_area_are_refused(void **state)
{
    (void)state;
    cipc_membrane params;
    double area, inverse[3] = {7, 7, 7};
    const double line[9] = {0, 0, 0, 1, 2, 3, 2, 4, 6}, point[9] = {0}, not_finite[9] = {0, 0, 0, NAN, 0, 0, 0, 1, 0};
    assert_false(cipc_membrane_init(&params, line, 1, 1, 0));
    assert_false(cipc_membrane_init(&params, point, 1, 1, 0));
    assert_false(energy_rest_triangle(not_finite, inverse, &area));
    assert_true(inverse[0] == 7 && inverse[1] == 7 && inverse[2] == 7);
}

static void test_deformation_gradient_at_rest_is_an_isometry(void **state)
{
    (void)state;
    const double triangle[9] = {0.3, 0.1, -0.7, 1.1, 0.4, 0.2, -0.2, 0.9, 0.5};
    double inverse[3], area, f[2][3];
    assert_true(energy_rest_triangle(triangle, inverse, &area));
    deformation_gradient(triangle, inverse, f);
    metric_change change = metric_change_of(f);
    assert_true(fabs(change.e11) < ROUNDINGS && fabs(change.e22) < ROUNDINGS && fabs(change.c12) < ROUNDINGS);
}

static void test_node_weights_give_the_deformation_gradient(void **state)
{
    (void)state;
    const double x[9] = {0.3, 0.1, -0.7, 1.1, 0.4, 0.2, -0.2, 0.9, 0.5}, inverse[3] = {2, -0.5, 1.5};
    double f[2][3], w[3][2];
    deformation_gradient(x, inverse, f);
    node_weights(inverse, w);
    for (int a = 0; a < 2; a++) {
        assert_true(w[0][a] + w[1][a] + w[2][a] == 0);
        for (int k = 0; k < 3; k++) {
            double sum = w[0][a] * x[k] + w[1][a] * x[3 + k] + w[2][a] * x[6 + k];
            assert_true(fabs(f[a][k] - sum) < 4 * ROUNDINGS);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inverse_rest_matrix_and_area),
        cmocka_unit_test(test_plane_stress_moduli),
        cmocka_unit_test(test_triangles_without_area_are_refused),
        cmocka_unit_test(test_deformation_gradient_at_rest_is_an_isometry),
        cmocka_unit_test(test_node_weights_give_the_deformation_gradient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
