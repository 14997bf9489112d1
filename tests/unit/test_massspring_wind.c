/* Wind on a triangle. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "cipc/massspring.h"

static const double FLAT[9] = {0, 0, 0, 0, 0, 2, 3, 0, 0}; /* area 3, normal +y */

static void assert_force(const double f[3], double x, double y, double z)
{
    const double want[3] = {x, y, z};
    for (int k = 0; k < 3; k++)
        if (!(fabs(f[k] - want[k]) <= 16 * DBL_EPSILON * (1 + fabs(want[k])))) fail_msg("component %d: %.17g, wanted %.17g", k, f[k], want[k]);
}

/* Only what blows across the triangle counts; a third of q A w_n on each corner. */
static void test_across_and_along(void **state)
{
    (void)state;
    const double rest[9] = {0}, up[3] = {5, 4, -2}, along[3] = {5, 0, -2};
    double f[3];
    cipc_wind_force(0.5, up, FLAT, rest, f);
    assert_force(f, 0, 0.5 * 3 * 4 / 3, 0);
    cipc_wind_force(0.5, along, FLAT, rest, f);
    assert_force(f, 0, 0, 0);
}

/* Turned over it feels the same; on a slope the force is along the normal. */
static void test_both_sides_and_slopes(void **state)
{
    (void)state;
    const double rest[9] = {0}, wind[3] = {1, 2, 3}, over[9] = {0, 0, 0, 3, 0, 0, 0, 0, 2};
    const double slope[9] = {0, 0, 0, 0, 0, 1, 1, 1, 0}; /* twice the area sqrt(2), normal (-1, 1, 0)/sqrt(2) */
    double f[3], g[3];
    cipc_wind_force(0.5, wind, FLAT, rest, f);
    cipc_wind_force(0.5, wind, over, rest, g);
    assert_force(g, f[0], f[1], f[2]);
    cipc_wind_force(6, wind, slope, rest, f);
    assert_force(f, -1 / sqrt(2), 1 / sqrt(2), 0); /* q/3 A (n.w) n, n.w = 1/sqrt(2) */
}

/* What moves with the wind feels none of it; in still air motion is resisted. The mean of the corners' velocities counts. */
static void test_relative_velocity(void **state)
{
    (void)state;
    const double wind[3] = {0, 4, 0}, still[3] = {0}, with[9] = {0, 3, 0, 0, 6, 0, 0, 3, 0};
    double f[3];
    cipc_wind_force(0.5, wind, FLAT, with, f);
    assert_force(f, 0, 0, 0);
    cipc_wind_force(0.5, still, FLAT, with, f);
    assert_force(f, 0, -2, 0);
}

static void test_no_area(void **state)
{
    (void)state;
    const double rest[9] = {0}, wind[3] = {1, 2, 3}, line[9] = {0, 0, 0, 1, 1, 1, 2, 2, 2};
    double f[3] = {1, 1, 1};
    cipc_wind_force(0.5, wind, line, rest, f);
    for (int k = 0; k < 3; k++) assert_true(f[k] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_across_and_along),
        cmocka_unit_test(test_both_sides_and_slopes),
        cmocka_unit_test(test_relative_velocity),
        cmocka_unit_test(test_no_area),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
