/* Curves through points, by length. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "scene/smooth_curve.h"
#include "support/failing_memory.h"

static const double pi = 3.14159265358979323846;

static scene_curve curve_through(int count, const double (*points)[3])
{
    scene_curve curve;
    assert_int_equal(scene_curve_init(&curve, count, points, "test", NULL), CIPC_OK);
    return curve;
}

static void test_straight(void **state)
{
    (void)state;
    static const double points[4][3] = {{1, 2, 3}, {1, 2, 4}, {1, 2, 4.5}, {1, 2, 8}};
    for (int count = 2; count <= 4; count++) {
        scene_curve curve = curve_through(count, points);
        double length = points[count - 1][2] - 3;
        assert_true(fabs(scene_curve_length(&curve) - length) < 1e-14 * length);
        for (int i = 0; i <= 10; i++) {
            double s = length * i / 10, x[3], d[3];
            scene_curve_at(&curve, scene_curve_parameter(&curve, s), x, d);
            assert_true(x[0] == 1 && x[1] == 2 && fabs(x[2] - 3 - s) < 1e-13);
            assert_true(fabs(d[0]) < 1e-14 && fabs(d[1]) < 1e-14 && fabs(d[2] - 1) < 1e-13);
        }
        scene_curve_free(&curve);
    }
}

/* A quarter of a circle between two straight stretches, as a ribbon's bend has: points on the circle are met, and the length differs from the truth as a high power of the
 * distance of the points. */
static double length_of_circle(int n)
{
    static double points[65][3];
    for (int i = 0; i <= n; i++) {
        points[i][0] = cos(2 * pi * i / n);
        points[i][2] = sin(2 * pi * i / n);
    }
    scene_curve curve = curve_through(n + 1, (const double(*)[3])points);
    double length = scene_curve_length(&curve);
    for (int i = 0; i <= n; i++) {
        double x[3], d[3];
        scene_curve_at(&curve, curve.knots[i], x, d);
        for (int a = 0; a < 3; a++) assert_true(fabs(x[a] - points[i][a]) < 1e-14);
    }
    scene_curve_free(&curve);
    return length;
}

static void test_lengths_converge(void **state)
{
    (void)state;
    double error[3];
    for (int k = 0; k < 3; k++) error[k] = fabs(length_of_circle(16 << k) - 2 * pi);
    /* The ends, straight as natural splines are there, cost the third power; the rest of the circle the fourth. */
    for (int k = 0; k < 2; k++) assert_true(error[k] / error[k + 1] > 6);
    assert_true(error[2] < 1e-4);
}

static const double bent[6][3] = {{0, 0, 0}, {0.1, 0, 0.02}, {0.2, 0.05, 0}, {0.2, 0.1, 0.1}, {0.1, 0.1, 0.15}, {0, 0.2, 0.1}};

/* Lengths against the chords of many points, and the inverse against its own definition. */
static void test_equal_lengths(void **state)
{
    (void)state;
    enum { STEPS = 20, CHORDS = 20000 };
    scene_curve curve = curve_through(6, bent);
    double length = scene_curve_length(&curve), want[3], derivative[3], sum = 0, before[3];
    v3_copy(before, bent[0]);
    for (int i = 1, passed = 1; i <= CHORDS; i++) {
        double x[3], step[3];
        scene_curve_at(&curve, fmin(curve.knots[5] * i / CHORDS, curve.knots[5]), x, derivative);
        v3_sub(step, x, before);
        v3_copy(before, x);
        sum += v3_norm(step);
        if (passed > STEPS || sum < length * passed / STEPS) continue;
        scene_curve_at(&curve, scene_curve_parameter(&curve, length * passed / STEPS), want, derivative);
        v3_sub(step, want, x);
        assert_true(v3_norm(step) < 1.5 * length / CHORDS); /* the crossing was within this chord */
        passed++;
    }
    assert_true(fabs(sum / length - 1) < 1e-7); /* chords are short by about (curvature * chord)^2 / 24 of their length, 20000 of them on bends of some 3 cm */
    assert_true(scene_curve_parameter(&curve, 0) == 0 && scene_curve_parameter(&curve, length) == curve.knots[5]);
    scene_curve_free(&curve);
}

static void refuse(int count, const double (*points)[3], const char *what)
{
    scene_curve curve;
    cipc_error error;
    assert_int_equal(scene_curve_init(&curve, count, points, "test", &error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(error.what, what));
    scene_curve_free(&curve);
}

static void test_rejections_and_no_memory(void **state)
{
    (void)state;
    refuse(1, (const double[1][3]){{0, 0, 0}}, "2 are needed");
    refuse(3, (const double[3][3]){{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, "points 1 and 2 are the same");
    refuse(2, (const double[2][3]){{0, 0, 0}, {1, (double)NAN, 0}}, "point 1 is (1, nan, 0)");
    refuse(3, (const double[3][3]){{0, 0, 0}, {1e9, 0, 0}, {1e9, 1e-12, 0}}, "points 1 and 2 are too close");
    for (long n = 1;; n++) {
        scene_curve curve;
        fail_allocation(n);
        cipc_status status = scene_curve_init(&curve, 6, bent, "test", NULL);
        scene_curve_free(&curve);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight),
        cmocka_unit_test(test_lengths_converge),
        cmocka_unit_test(test_equal_lengths),
        cmocka_unit_test(test_rejections_and_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
