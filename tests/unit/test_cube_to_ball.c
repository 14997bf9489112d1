/* The map from cubes to balls. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "scene/cube_to_ball.h"

static const double rounding = 1e-15; /* tangent, root and products: a few halves of an ulp */
static const double pi = 3.14159265358979323846;

static double norm(int n, const double *x)
{
    double sum = 0;
    for (int a = 0; a < n; a++) sum += x[a] * x[a];
    return sqrt(sum);
}

static void test_surfaces_of_cubes_become_spheres(void **state)
{
    (void)state;
    for (int n = 2; n <= 3; n++) {
        for (int i = -10; i <= 10; i++) {
            for (int j = -10; j <= 10; j++) {
                double s = 0.7, x[3] = {s, s * i / 10, s * j / 10};
                scene_cube_to_ball(n, x);
                assert_true(fabs(norm(n, x) / s - 1) < rounding);
            }
        }
    }
}

static void test_steps_on_an_edge_are_equal_angles(void **state)
{
    (void)state;
    for (int i = -10; i <= 10; i++) {
        double x[2] = {1, i / 10.0};
        scene_cube_to_ball(2, x);
        assert_true(fabs(atan2(x[1], x[0]) - pi / 4 * i / 10) < rounding);
    }
}

static void test_axes_and_centre_stay(void **state)
{
    (void)state;
    for (int a = 0; a < 3; a++) {
        double x[3] = {0}, y[3] = {0};
        x[a] = y[a] = -0.3;
        scene_cube_to_ball(3, x);
        for (int b = 0; b < 3; b++) assert_true(fabs(x[b] - y[b]) < rounding);
    }
    double zero[3] = {0};
    scene_cube_to_ball(3, zero);
    assert_true(zero[0] == 0 && zero[1] == 0 && zero[2] == 0);
}

static void test_signs_and_order_of_axes_do_not_matter(void **state)
{
    (void)state;
    double x[3] = {0.2, -0.5, 0.9}, y[3] = {0.9, 0.2, 0.5};
    scene_cube_to_ball(3, x);
    scene_cube_to_ball(3, y);
    assert_true(fabs(x[0] - y[1]) < rounding && fabs(x[1] + y[2]) < rounding && fabs(x[2] - y[0]) < rounding);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surfaces_of_cubes_become_spheres),
        cmocka_unit_test(test_steps_on_an_edge_are_equal_angles),
        cmocka_unit_test(test_axes_and_centre_stay),
        cmocka_unit_test(test_signs_and_order_of_axes_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
