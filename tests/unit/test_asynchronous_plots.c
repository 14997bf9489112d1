/* Plots of the method asynchronous: every panel has what it is to show, whatever the statistics. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <cairo.h>
#include <math.h>
#include <stdbool.h>
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
        cipc_asynchronous_report report = {.total_events = 1000 + 50 * (i % 7), .layers = 1 + i % 5, .smallest_step = 1e-7 * (1 + i % 3), .kinetic = 0.1 * i, .gravitational = 3 - 0.1 * i,
                                           .elastic = 0.01};
        for (int q = 0; q < CIPC_QUANTILES; q++) report.vertex_steps[q] = 1e-6 * pow(10, 0.5 * q) * (1 + 0.3 * (i % 4));
        cipc_step_invariants seen = cipc_step_invariants_none();
        const cipc_invariant_report point = {.min_gap = 1e-3 / i, .max_stretch = 1 + 0.001 * i};
        cipc_step_invariants_add(&seen, &point);
        sample_run_advance(&run);
        assert_int_equal(cipc_asynchronous_stats_write(out, run.state, &report, &seen, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

/* To the rounding of paler colours. */
static bool is_near(uint32_t a, uint32_t b)
{
    for (int shift = 0; shift < 24; shift += 8) {
        if (labs((long)(a >> shift & 0xff) - (long)(b >> shift & 0xff)) > 1) return false;
    }
    return true;
}

/* Number of pixels of a colour inside the box of panel 0..5. */
static int pixels_of(const path *png, int panel, uint32_t colour)
{
    cairo_surface_t *surface = cairo_image_surface_create_from_png(png->text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(surface), 1800);
    assert_int_equal(cairo_image_surface_get_height(surface), 800);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface), left = panel % 3 * 600 + 82, top = panel / 3 * 392 + 48;
    int count = 0;
    for (int y = top; y < top + 280; y++) {
        for (int x = left; x < left + 490; x++) {
            const uint32_t p = *(const uint32_t *)(const void *)(data + y * stride + 4 * x);
            count += is_near(p & 0xffffff, colour);
        }
    }
    cairo_surface_destroy(surface);
    return count;
}

enum { CURVE = 0x2f7fb5, SECOND = 0xc8443f, OUTERMOST = 0xe0ecf4, OUTER = 0xb6d2e5, INNER = 0x82b2d3 };

static void test_every_panel_has_its_curve(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    const int steps[] = {1, 2, 600}; /* 600: more than the table's first size */
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        write_stats(&stats, steps[i]);
        assert_int_equal(cipc_asynchronous_plots_png(png.text, stats.text, 1e-3, &error), CIPC_OK);
        for (int panel = 0; panel < 6; panel++) {
            assert_true(pixels_of(&png, panel, CURVE) > 3);
        }
    }
    folder_remove(&folder);
}

/* Bands, median and the least clock: all are to be seen, the outer ones outside. */
static void test_bands_of_vertex_steps(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    write_stats(&stats, 8);
    assert_int_equal(cipc_asynchronous_plots_png(png.text, stats.text, 1e-3, &error), CIPC_OK);
    const int colours[] = {CURVE, SECOND, OUTERMOST, OUTER, INNER};
    for (int c = 0; c < 5; c++) {
        const int there = pixels_of(&png, 3, (uint32_t)colours[c]);
        if (there < (c < 2 ? 100 : 3000)) fail_msg("colour %06x: %d pixels", (unsigned)colours[c], there);
    }
    folder_remove(&folder);
}

static void test_odd_statistics(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",
        "not json",
        "[1,2]\n{}\n",
        "{\"time\":0.1,\"vertex_steps\":null,\"layers\":\"nan\",\"total_events\":{}}\n",
        "{\"time\":0.1,\"vertex_steps\":{\"min\":0,\"max\":1e308,\"median\":-1},\"smallest_step\":\"inf\"}\n{\"time\":1e308,\"vertex_steps\":{\"min\":5e-324,\"max\":5e-324}}\n",
    };
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    const double levels[] = {1e-3, NAN};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        for (size_t k = 0; k < 2; k++) {
            file_write(&stats, texts[i], strlen(texts[i]));
            assert_int_equal(cipc_asynchronous_plots_png(png.text, stats.text, levels[k], &error), CIPC_OK);
            assert_true(pixels_of(&png, 0, 0xffffff) > 1000);
        }
    }
    folder_remove(&folder);
}

static void test_errors(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    assert_int_equal(cipc_asynchronous_plots_png(png.text, stats.text, 1e-3, &error), CIPC_E_MISSING_FILE);
    write_stats(&stats, 5);
    assert_int_equal(cipc_asynchronous_plots_png("/no/such/folder/p.png", stats.text, 1e-3, &error), CIPC_E_IO);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_asynchronous_plots_png(png.text, stats.text, 1e-3, &error);
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
        cmocka_unit_test(test_bands_of_vertex_steps),
        cmocka_unit_test(test_odd_statistics),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
