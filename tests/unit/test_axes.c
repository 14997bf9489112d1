/* Axes: ranges that suit the data, curves where they belong, no crash on odd data. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "output/axes.h"

enum { SIZE = 200 };

static void test_linear_range(void **state)
{
    (void)state;
    cipc_axes a = cipc_axes_new(50, 20, 100, 100, false);
    assert_true(a.empty);
    cipc_axes_include(&a, 0, 2);
    cipc_axes_include(&a, 4, 3);
    cipc_axes_include(&a, 9, NAN);
    cipc_axes_include(&a, INFINITY, 3);
    cipc_axes_settle(&a);
    assert_false(a.empty);
    assert_true(a.x_lo == 0 && a.x_hi == 4);
    assert_true(a.y_lo < 2 && a.y_lo > 1.8 && a.y_hi > 3 && a.y_hi < 3.2);
}

static void test_constant_and_empty_ranges_are_widened(void **state)
{
    (void)state;
    const double values[] = {0, 5, -7e-12, 1e300};
    for (int i = 0; i < 4; i++) {
        cipc_axes a = cipc_axes_new(0, 0, 100, 100, false);
        cipc_axes_include(&a, 1, values[i]);
        cipc_axes_settle(&a);
        assert_true(a.x_hi > a.x_lo && a.y_lo < values[i] && a.y_hi > values[i]);
    }
    for (int log_y = 0; log_y < 2; log_y++) {
        cipc_axes a = cipc_axes_new(0, 0, 100, 100, log_y);
        cipc_axes_settle(&a);
        assert_true(a.empty && a.x_hi > a.x_lo && a.y_hi > a.y_lo);
    }
}

static void test_logarithmic_range(void **state)
{
    (void)state;
    cipc_axes a = cipc_axes_new(0, 0, 100, 100, true);
    cipc_axes_include(&a, 0, 0);
    cipc_axes_include(&a, 1, -3);
    assert_true(a.empty); /* no logarithm, no point */
    cipc_axes_include(&a, 2, 3e-5);
    cipc_axes_include(&a, 3, 2e-3);
    cipc_axes_settle(&a);
    const double rounding_of_pow = 1e-14;
    assert_true(fabs(a.y_lo / 1e-5 - 1) < rounding_of_pow && a.y_hi >= 1e-2 * (1 - rounding_of_pow));
}

static uint32_t pixel(cairo_surface_t *surface, int x, int y)
{
    cairo_surface_flush(surface);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    return *(const uint32_t *)(const void *)(data + y * cairo_image_surface_get_stride(surface) + 4 * x) & 0xffffff;
}

static const cipc_colour red = {1, 0, 0};

/* Number of rows of a column of pixels in which pure red is found, and the last such row. */
static int red_rows(cairo_surface_t *surface, int x, int *last)
{
    int count = 0;
    for (int y = 0; y < SIZE; y++) {
        const uint32_t p = pixel(surface, x, y);
        if ((p >> 16) > 200 && (p & 0xff) < 60) {
            count++;
            *last = y;
        }
    }
    return count;
}

static void test_curve_passes_where_it_should_and_breaks_at_gaps(void **state)
{
    (void)state;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIZE, SIZE);
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    const double x[] = {0, 1, 2, 3, 4}, y[] = {0, 0.5, NAN, 0.5, 1};
    cipc_axes a = cipc_axes_new(50, 50, 100, 100, false);
    a.x_lo = 0;
    a.x_hi = 4;
    a.y_lo = 0;
    a.y_hi = 1;
    a.empty = false;
    cipc_axes_curve(&a, cr, x, y, 5, red, NULL);
    int row = 0;
    assert_true(red_rows(surface, 62, &row) > 0);
    assert_in_range(row, 120, 142); /* a quarter up at a half of the first quarter: 150 - 25 = 137 - 12.5 */
    assert_true(red_rows(surface, 137, &row) > 0);
    assert_int_equal(red_rows(surface, 100, &row), 0); /* the gap */
    assert_int_equal(red_rows(surface, 88, &row), 0);
    assert_int_equal(red_rows(surface, 112, &row), 0);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

static void test_bars_and_level(void **state)
{
    (void)state;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIZE, SIZE);
    cairo_t *cr = cairo_create(surface);
    const double x[] = {1, 2, 3}, y[] = {4, NAN, 8};
    cipc_axes a = cipc_axes_new(50, 50, 100, 100, false);
    a.x_lo = 0;
    a.x_hi = 4;
    a.y_lo = 0;
    a.y_hi = 10;
    a.empty = false;
    cipc_axes_bars(&a, cr, x, y, 3, 0.8, red);
    int row = 0;
    assert_in_range(red_rows(surface, 75, &row), 39, 41);
    assert_in_range(red_rows(surface, 125, &row), 79, 81);
    assert_int_equal(red_rows(surface, 100, &row), 0);
    assert_in_range(row, 148, 150); /* they stand on the axis */
    cipc_axes_level(&a, cr, 9.5, red, "limit");
    assert_true(pixel(surface, 52, 55) >> 16 > 100); /* 5 % below the top */
    cipc_axes_level(&a, cr, NAN, red, "nothing");
    assert_int_equal(cairo_status(cr), CAIRO_STATUS_SUCCESS);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

/* Between the curves and nowhere else; a point alone is seen too. */
static void test_band(void **state)
{
    (void)state;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIZE, SIZE);
    cairo_t *cr = cairo_create(surface);
    const double x[] = {0, 1, 2, 3, 4}, lower[] = {0.2, 0.2, 0.3, 0.4, 0.2}, upper[] = {0.6, 0.6, NAN, 0.8, NAN};
    cipc_axes a = cipc_axes_new(50, 50, 100, 100, false);
    a.x_lo = 0;
    a.x_hi = 4;
    a.y_lo = 0;
    a.y_hi = 1;
    a.empty = false;
    cipc_axes_band(&a, cr, x, lower, upper, 5, red, "band");
    int row = 0;
    assert_in_range(red_rows(surface, 62, &row), 39, 41); /* from 0.2 to 0.6 of 100 */
    assert_in_range(row, 128, 131);
    assert_int_equal(red_rows(surface, 90, &row), 0); /* broken there */
    assert_in_range(red_rows(surface, 125, &row), 39, 42); /* the point alone */
    assert_in_range(row, 108, 111);
    assert_int_equal(red_rows(surface, 140, &row), 0);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

/* Ticks come to an end on any range. */
static void test_drawing_extreme_ranges(void **state)
{
    (void)state;
    const double ranges[][2] = {{0, 1e-300}, {-1e300, 1e300}, {1e15, 1e15 + 1}, {5e-324, 1e300}, {1, 1}};
    for (int log_y = 0; log_y < 2; log_y++) {
        for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
            cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, SIZE, SIZE);
            cairo_t *cr = cairo_create(surface);
            cipc_axes a = cipc_axes_new(50, 50, 100, 100, log_y);
            cipc_axes_include(&a, 0, ranges[i][0]);
            cipc_axes_include(&a, 1e-9, ranges[i][1]);
            cipc_axes_settle(&a);
            cipc_axes_draw(&a, cr, "title", "x", "y");
            assert_int_equal(cairo_status(cr), CAIRO_STATUS_SUCCESS);
            cairo_destroy(cr);
            cairo_surface_destroy(surface);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_range),
        cmocka_unit_test(test_constant_and_empty_ranges_are_widened),
        cmocka_unit_test(test_logarithmic_range),
        cmocka_unit_test(test_curve_passes_where_it_should_and_breaks_at_gaps),
        cmocka_unit_test(test_bars_and_level),
        cmocka_unit_test(test_band),
        cmocka_unit_test(test_drawing_extreme_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
