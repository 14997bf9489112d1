/* PNG files: what was drawn is what is read, and failures are reported. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <unistd.h>

#include "output/png.h"
#include "support/sample_run.h"

static cairo_surface_t *drawing(int width, int height)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cr = cairo_create(surface);
    cairo_set_source_rgb(cr, 1, 0, 0.2);
    cairo_paint(cr);
    cairo_destroy(cr);
    return surface;
}

static void test_round_trip(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.png");
    cairo_surface_t *surface = drawing(7, 5);
    assert_int_equal(cipc_png_write(file.text, surface, &error), CIPC_OK);
    cairo_surface_destroy(surface);
    surface = cairo_image_surface_create_from_png(file.text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(surface), 7);
    assert_int_equal(cairo_image_surface_get_height(surface), 5);
    const uint32_t *row = (const uint32_t *)(const void *)cairo_image_surface_get_data(surface);
    assert_int_equal(row[3] & 0xffffff, 0xff0033);
    cairo_surface_destroy(surface);
    folder_remove(&folder);
}

static void test_failures(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.png"), partial = path_in(&folder, "a.png.partial");
    cairo_surface_t *surface = drawing(300, 300);
    assert_int_equal(cipc_png_write("/no/such/folder/a.png", surface, &error), CIPC_E_IO);
    assert_int_equal(symlink("/dev/full", partial.text), 0);
    assert_int_equal(cipc_png_write(file.text, surface, &error), CIPC_E_IO);
    assert_false(file_exists(&file));
    cairo_surface_destroy(surface);
    surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, -1, 5); /* a surface in error */
    assert_int_not_equal(cipc_png_write(file.text, surface, &error), CIPC_OK);
    assert_false(file_exists(&file));
    cairo_surface_destroy(surface);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
