/* The raster: nearest wins in any order, no cracks, no writes outside, colours as asked. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "output/raster.h"
#include "support/failing_memory.h"

enum { SIZE = 16, SAMPLES = SIZE * CIPC_RASTER_SAMPLES };
static const cipc_colour red = {1, 0, 0}, green = {0, 1, 0}, white = {1, 1, 1}, black = {0, 0, 0};

static cipc_raster fresh(void)
{
    cipc_raster r;
    fail_allocation(0);
    assert_true(cipc_raster_init(&r, SIZE, SIZE));
    cipc_raster_clear(&r, white, white);
    return r;
}

static void triangle(cipc_raster *r, const double xy[6], double inverse_depth, double brightness, cipc_colour colour, double ink)
{
    cipc_raster_corner c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = (cipc_raster_corner){xy[2 * i], xy[2 * i + 1], inverse_depth, {brightness, 0}};
    }
    cipc_raster_triangle(r, c, colour, ink);
}

static const float *light_at(const cipc_raster *r, int x, int y)
{
    return r->light[y * r->width + x];
}

/* Two triangles make a square that covers every sample once: no crack along the diagonal, whichever way they are wound. */
static void test_neighbours_leave_no_crack(void **state)
{
    (void)state;
    const double s = SAMPLES, lower[6] = {0, 0, s, s, 0, s}, upper[6] = {0, 0, s, 0, s, s}, upper_turned[6] = {0, 0, s, s, s, 0};
    for (int turned = 0; turned < 2; turned++) {
        cipc_raster r = fresh();
        triangle(&r, lower, 1, 1, red, 0);
        triangle(&r, turned ? upper_turned : upper, 1, 1, red, 0);
        for (int i = 0; i < SAMPLES * SAMPLES; i++) {
            assert_true(r.depth[i] == 1 && r.light[i][0] == 1 && r.light[i][1] == 0);
        }
        cipc_raster_free(&r);
    }
}

static void test_nearest_wins_in_any_order(void **state)
{
    (void)state;
    const double all[6] = {-100, -100, 300, -100, -100, 300};
    for (int order = 0; order < 2; order++) {
        cipc_raster r = fresh();
        triangle(&r, all, order == 0 ? 1 : 2, 1, order == 0 ? red : green, 0);
        triangle(&r, all, order == 0 ? 2 : 1, 1, order == 0 ? green : red, 0);
        assert_true(light_at(&r, SAMPLES / 2, SAMPLES / 2)[1] == 1 && light_at(&r, SAMPLES / 2, SAMPLES / 2)[0] == 0);
        cipc_raster_free(&r);
    }
}

/* Far outside, without area, not finite: nothing is drawn, and (under the sanitizers) nothing is touched. */
static void test_what_cannot_be_seen(void **state)
{
    (void)state;
    cipc_raster r = fresh();
    const double cases[][6] = {
        {-9, -9, -5, -9, -5, -5}, {1e9, 1e9, 2e9, 1e9, 1e9, 2e9}, {-1e18, 5, -1e17, 6, -1e18, 9}, {3, 3, 3, 3, 3, 3}, {0, 0, 5, 5, 10, 10},
        {NAN, 0, 5, 5, 0, 9},     {INFINITY, 0, 5, 5, 0, 9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        triangle(&r, cases[i], 1, 1, red, 0);
    }
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        assert_true(r.depth[i] == 0 && r.light[i][1] == 1);
    }
    cipc_raster_free(&r);
}

static void test_brightness_is_interpolated(void **state)
{
    (void)state;
    cipc_raster r = fresh();
    const cipc_raster_corner c[3] = {{0, 0, 1, {0, 0}}, {2 * SAMPLES, 0, 1, {1, 0.25}}, {0, 2 * SAMPLES, 1, {0, 0}}};
    cipc_raster_triangle(&r, c, white, 0);
    for (int x = 0; x < SAMPLES; x++) {
        const double rounding_of_float = 1e-6;
        assert_true(fabs(light_at(&r, x, 3)[0] - (x + 0.5) / (2 * SAMPLES)) < rounding_of_float);
        assert_true(fabs((double)r.key[3 * r.width + x] - 0.25) < rounding_of_float); /* the same share everywhere */
    }
    cipc_raster_free(&r);
}

static void test_ink_marks_edges_only(void **state)
{
    (void)state;
    cipc_raster r = fresh();
    const double big[6] = {0, 0, SAMPLES, 0, 0, SAMPLES};
    triangle(&r, big, 1, 1, white, 0.5);
    assert_true(light_at(&r, SAMPLES / 4, 0)[0] == 0.5F);
    assert_true(light_at(&r, 0, SAMPLES / 4)[0] == 0.5F);
    assert_true(light_at(&r, SAMPLES / 4, SAMPLES / 4)[0] == 1);
    cipc_raster_free(&r);
}

/* Ranges of samples: what the interval touches, within the raster; none at all where there is nothing. */
static void test_ranges(void **state)
{
    (void)state;
    const struct { double lowest, highest; int first, last; } cases[] = {{0.5, 2.5, 0, 2}, {-3, 1, 0, 1}, {7.9, 99, 7, 9}, {3.2, 3.3, 3, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int first, last;
        cipc_raster_range(cases[i].lowest, cases[i].highest, 10, &first, &last);
        assert_int_equal(first, cases[i].first);
        assert_int_equal(last, cases[i].last);
    }
    const double outside[][2] = {{-5, -1}, {10, 12}, {1e300, 2e300}, {-2e300, -1e300}};
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        int first, last;
        cipc_raster_range(outside[i][0], outside[i][1], 10, &first, &last);
        assert_true(first > last);
    }
}

/* Half the samples of a pixel black, half white: the average is of light, not of code values. */
static void test_resolve_averages_light(void **state)
{
    (void)state;
    cipc_raster r = fresh();
    for (int y = 0; y < SAMPLES; y++) {
        for (int x = 0; x < SAMPLES; x++) {
            for (int k = 0; k < 3; k++) {
                r.light[y * SAMPLES + x][k] = y % CIPC_RASTER_SAMPLES == 0 ? 3.0F : 0.0F; /* 3: over-exposed counts as white */
            }
        }
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIZE + 4, SIZE + 4);
    cipc_raster_resolve(&r, surface, 3, 2);
    const unsigned char *pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface),
              expected = (int)lround(255 * cipc_linear_to_srgb(1.0 / CIPC_RASTER_SAMPLES));
    assert_int_equal(pixels[2 * stride + 4 * 3], expected);
    assert_int_equal(pixels[(1 + SIZE) * stride + 4 * (2 + SIZE)], expected);
    assert_int_equal(pixels[1 * stride + 4 * 3], 0); /* outside stays as it was */
    assert_int_equal(pixels[2 * stride + 4 * 2], 0);
    assert_int_equal(pixels[2 * stride + 4 * (3 + SIZE)], 0);
    cairo_surface_destroy(surface);
    cipc_raster_free(&r);
}

static void test_gradient(void **state)
{
    (void)state;
    cipc_raster r = fresh();
    cipc_raster_clear(&r, white, black);
    assert_true(light_at(&r, 0, 0)[0] > 0.9F && light_at(&r, 0, SAMPLES - 1)[0] < 0.1F);
    for (int y = 1; y < SAMPLES; y++) {
        assert_true(light_at(&r, 5, y)[0] < light_at(&r, 5, y - 1)[0]);
    }
    cipc_raster_free(&r);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_raster r;
    for (long n = 1; n <= 3; n++) {
        fail_allocation(n);
        assert_false(cipc_raster_init(&r, SIZE, SIZE));
        assert_null(r.depth);
        assert_null(r.light);
        assert_null(r.key);
    }
    fail_allocation(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_neighbours_leave_no_crack),
        cmocka_unit_test(test_nearest_wins_in_any_order),
        cmocka_unit_test(test_what_cannot_be_seen),
        cmocka_unit_test(test_brightness_is_interpolated),
        cmocka_unit_test(test_ink_marks_edges_only),
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_resolve_averages_light),
        cmocka_unit_test(test_gradient),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
