/* The camera: a right-handed frame, and everything fitted is in the picture. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "base/vector.h"
#include "output/camera.h"

/* A handful of rounded products and sines of numbers of order 1. */
static const double rounding = 1e-14;

static void test_bounds(void **state)
{
    (void)state;
    cipc_bounds b = cipc_bounds_empty();
    assert_true(cipc_bounds_are_empty(&b));
    assert_true(cipc_bounds_diagonal(&b) == 0);
    cipc_bounds_add(&b, (const double[3]){NAN, 0, 0}, 0);
    cipc_bounds_add(&b, (const double[3]){0, INFINITY, 0}, 0);
    assert_true(cipc_bounds_are_empty(&b));
    cipc_bounds_add(&b, (const double[3]){1, 2, 3}, 0);
    assert_false(cipc_bounds_are_empty(&b));
    cipc_bounds_add(&b, (const double[3]){-2, 2, 7}, 0);
    assert_true(b.lo[0] == -2 && b.hi[0] == 1 && b.lo[2] == 3 && b.hi[2] == 7);
    assert_true(cipc_bounds_diagonal(&b) == 5);
    cipc_bounds_add(&b, (const double[3]){0, 2, 4}, 1.5); /* a ball */
    assert_true(b.lo[0] == -2 && b.hi[0] == 1.5 && b.lo[1] == 0.5 && b.hi[1] == 3.5 && b.lo[2] == 2.5 && b.hi[2] == 7);
}

static void test_frame(void **state)
{
    (void)state;
    const cipc_bounds b = {{0, 0, 0}, {2, 4, 6}};
    for (double azimuth = -4; azimuth < 4; azimuth += 0.7) {
        for (double elevation = -1.5; elevation < 1.6; elevation += 0.5) {
            const cipc_camera c = cipc_camera_look(&b, azimuth, elevation, 1.5);
            double cross[3];
            v3_cross(cross, c.right, c.up);
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(cross[k] - c.back[k]) < rounding);
            }
            assert_true(fabs(v3_norm(c.up) - 1) < rounding && fabs(v3_norm(c.right) - 1) < rounding);
            assert_true(c.up[1] > 0 && c.right[1] == 0); /* the world's up is up, the horizon level */
            assert_true(c.target[0] == 1 && c.target[1] == 2 && c.target[2] == 3);
        }
    }
    const cipc_camera front = cipc_camera_look(&b, 0, 0, 1);
    assert_true(front.back[2] == 1 && front.right[0] == 1); /* azimuth 0 looks along -z, x to the right */
}

static void test_everything_fitted_is_in_the_picture(void **state)
{
    (void)state;
    const cipc_bounds b = {{-1, -0.2, -3}, {1, 0.2, 3}};
    const double aspects[] = {0.5, 1, 4.0 / 3, 3};
    for (int a = 0; a < 4; a++) {
        cipc_camera c = cipc_camera_look(&b, 0.6, 0.4, aspects[a]);
        for (int corner = 0; corner < 8; corner++) {
            cipc_camera_fit(&c, (const double[3]){corner & 1 ? 1 : -1, corner & 2 ? 0.2 : -0.2, corner & 4 ? 3 : -3}, 0);
        }
        cipc_camera_fit(&c, (const double[3]){NAN, 0, 0}, 0);
        cipc_camera_settle(&c, &b, 1);
        double closest = 0;
        for (int corner = 0; corner < 8; corner++) {
            const double p[3] = {corner & 1 ? 1 : -1, corner & 2 ? 0.2 : -0.2, corner & 4 ? 3 : -3};
            double seen[3];
            cipc_camera_see(&c, p, seen);
            assert_true(seen[2] > 0);
            const double across = fabs(seen[0] / seen[2] / c.slope_x), upward = fabs(seen[1] / seen[2] / c.slope_y);
            assert_true(across < 1 && upward < 1);
            closest = fmax(closest, fmax(across, upward));
        }
        const double most_air = 0.75; /* of the half picture that the nearest corner must reach: the fit is not idle */
        assert_true(closest > most_air);
    }
}

/* Its rim included: the point of the ball that is farthest to a side, seen from the eye, is inside; and without the air it would touch. */
static void test_a_ball_fitted_is_in_the_picture(void **state)
{
    (void)state;
    const double center[3] = {0.3, 0.1, -0.2}, radius = 0.7;
    cipc_bounds b = cipc_bounds_empty();
    cipc_bounds_add(&b, (const double[3]){0, 0, 0}, 0.1);
    cipc_camera c = cipc_camera_look(&b, 0.6, 0.4, 1.5);
    cipc_camera_fit(&c, center, radius);
    const double fitted = c.distance;
    cipc_camera_settle(&c, &b, 1);
    const double air = c.distance / fitted;
    double seen[3];
    cipc_camera_see(&c, center, seen);
    for (int with_air = 0; with_air < 2; with_air++) {
        const double depth = seen[2] - (with_air ? 0 : (air - 1) * fitted);
        double inside = INFINITY; /* of the four side planes, each through the eye */
        for (int side = 0; side < 4; side++) {
            const double slope = side < 2 ? c.slope_x : c.slope_y, across = (side % 2 ? 1 : -1) * seen[side / 2];
            inside = fmin(inside, (slope * depth - across) / sqrt(1 + slope * slope) - radius);
        }
        assert_true(with_air ? inside > 0.01 : fabs(inside) < rounding);
    }
}

static void test_target_is_seen_in_the_middle_and_zoom_goes_nearer(void **state)
{
    (void)state;
    const cipc_bounds b = {{0, 0, 0}, {1, 1, 1}};
    cipc_camera near = cipc_camera_look(&b, 1, 0.5, 1), far = near;
    cipc_camera_fit(&near, b.hi, 0);
    cipc_camera_fit(&far, b.hi, 0);
    cipc_camera_settle(&near, &b, 2);
    cipc_camera_settle(&far, &b, 1);
    assert_true(near.distance == far.distance / 2);
    double seen[3];
    cipc_camera_see(&far, far.target, seen);
    assert_true(fabs(seen[0]) < rounding && fabs(seen[1]) < rounding && fabs(seen[2] - far.distance) < rounding * far.distance * 10);
}

static void test_nothing_to_look_at(void **state)
{
    (void)state;
    const cipc_bounds empty = cipc_bounds_empty();
    cipc_camera c = cipc_camera_look(&empty, 0, 0, 1);
    cipc_camera_settle(&c, &empty, 1);
    assert_true(c.distance > 0 && isfinite(c.eye[0]) && isfinite(c.eye[2]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_frame),
        cmocka_unit_test(test_everything_fitted_is_in_the_picture),
        cmocka_unit_test(test_a_ball_fitted_is_in_the_picture),
        cmocka_unit_test(test_target_is_seen_in_the_middle_and_zoom_goes_nearer),
        cmocka_unit_test(test_nothing_to_look_at),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
