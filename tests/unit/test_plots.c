/* Plots: drawn from any statistics, whole, empty, broken or odd. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/failing_memory.h"
#include "support/sample_run.h"

static void write_stats(const path *file, int steps)
{
    sample_run run = sample_run_create();
    FILE *out = fopen(file->text, "w");
    assert_non_null(out);
    for (int i = 1; i <= steps; i++) {
        cipc_step_report report = {
            .converged = true, .newton_iterations = 5 + i % 7, .kinetic = 0.1 * i, .gravitational = 3 - 0.1 * i, .elastic = 0.01};
        cipc_step_invariants seen = cipc_step_invariants_none();
        const cipc_invariant_report point = {.min_gap = 1e-3 / i, .max_stretch = 1 + 0.001 * i};
        cipc_step_invariants_add(&seen, &point);
        sample_run_advance(&run);
        assert_int_equal(cipc_stats_write(out, run.state, &report, &seen, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

/* Number of pixels of a colour inside the box of panel 0..3. */
static int pixels_of(const path *png, int panel, uint32_t colour)
{
    cairo_surface_t *surface = cairo_image_surface_create_from_png(png->text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(surface), 1200);
    assert_int_equal(cairo_image_surface_get_height(surface), 800);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface), left = panel % 2 * 600 + 82, top = panel / 2 * 392 + 48;
    int count = 0;
    for (int y = top; y < top + 280; y++) {
        for (int x = left; x < left + 490; x++) {
            const uint32_t p = *(const uint32_t *)(const void *)(data + y * stride + 4 * x);
            count += (p & 0xffffff) == colour;
        }
    }
    cairo_surface_destroy(surface);
    return count;
}

enum { FIRST_CURVE = 0x2f7fb5, RODS_CURVE = 0x3f9b6c };

static int curve_pixels(const path *png, int panel)
{
    return pixels_of(png, panel, FIRST_CURVE);
}

static void test_every_panel_has_its_curve(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    const int steps[] = {1, 2, 600}; /* 600: more than the table's first size */
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        write_stats(&stats, steps[i]);
        assert_int_equal(cipc_plots_png(png.text, stats.text, 1.06, 1e-3, &error), CIPC_OK);
        for (int panel = 0; panel < 4; panel++) {
            assert_true(curve_pixels(&png, panel) > 3);
        }
    }
    folder_remove(&folder);
}

/* What the scene does not have is not plotted, least of all as 0; what it has is. */
static void test_stretch_of_triangles_and_rods(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    for (int has = 0; has < 4; has++) {
        const bool triangles = has & 1, rods = has & 2;
        FILE *out = fopen(stats.text, "w");
        for (int i = 1; i < 9; i++) {
            fprintf(out, "{\"time\":%d,\"max_stretch\":%g,\"max_segment_stretch\":%g}\n", i, triangles ? 1 + 0.01 * i : 0,
                    rods ? 1.1 - 0.01 * i : 0);
        }
        fclose(out);
        assert_int_equal(cipc_plots_png(png.text, stats.text, triangles ? 1.2 : 0, 1e-3, &error), CIPC_OK);
        const int blue = curve_pixels(&png, 1), green = pixels_of(&png, 1, RODS_CURVE);
        assert_true(triangles ? blue > 100 : blue == 0);
        assert_true(rods ? green > 100 : green == 0);
    }
    folder_remove(&folder);
}

static void test_odd_statistics(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",
        "\n\n",
        "not json",
        "[1,2]\n{}\n",
        "{\"time\":\"nan\",\"min_gap\":\"inf\",\"max_stretch\":null,\"energy\":{\"kinetic\":\"-inf\"},\"newton_iterations\":null}\n",
        "{\"time\":0.1,\"min_gap\":\"inf\",\"max_stretch\":\"nan\",\"energy\":null,\"newton_iterations\":3}\n{\"time\":0.2,\"min_gap\":-1}"
        "\n",
        "{\"time\":1,\"min_gap\":0,\"max_stretch\":1e308,\"energy\":{\"kinetic\":1e308,\"total\":-1e308},\"newton_iterations\":0}\n{"
        "\"time\":1e308,\"min_gap\":5e-324}",
    };
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    const double limits[] = {0, 1.06, NAN};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        for (size_t k = 0; k < sizeof limits / sizeof limits[0]; k++) {
            file_write(&stats, texts[i], strlen(texts[i]));
            assert_int_equal(cipc_plots_png(png.text, stats.text, limits[k], limits[k], &error), CIPC_OK);
            curve_pixels(&png, 0);
        }
    }
    folder_remove(&folder);
}

/* The half line of a killed run does not spoil the lines before it. */
static void test_broken_last_line(void **state)
{
    (void)state;
    cipc_error error;
    size_t size;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    write_stats(&stats, 5);
    char *text = file_read(&stats, &size);
    file_write(&stats, text, size - 30);
    free(text);
    assert_int_equal(cipc_plots_png(png.text, stats.text, 1.06, 1e-3, &error), CIPC_OK);
    assert_true(curve_pixels(&png, 0) > 3);
    folder_remove(&folder);
}

static void test_errors(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    assert_int_equal(cipc_plots_png(png.text, stats.text, 0, 1e-3, &error), CIPC_E_MISSING_FILE);
    write_stats(&stats, 5);
    assert_int_equal(cipc_plots_png("/no/such/folder/p.png", stats.text, 0, 1e-3, &error), CIPC_E_IO);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_plots_png(png.text, stats.text, 0, 1e-3, &error);
        if (!allocation_failed()) {
            assert_int_equal(status, CIPC_OK);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_false(file_exists(&png));
    }
    fail_allocation(0);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_panel_has_its_curve),
        cmocka_unit_test(test_stretch_of_triangles_and_rods),
        cmocka_unit_test(test_odd_statistics),
        cmocka_unit_test(test_broken_last_line),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
