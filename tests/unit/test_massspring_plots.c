/* Plots of the method mass-spring: every panel has what it is to show, whatever the statistics. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <cairo.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/failing_memory.h"
#include "support/sample_run.h"

enum { CURVE = 0x2f7fb5, LEVEL = 0xc8443f };

static void write_stats(const path *file, int steps, long hits)
{
    const cipc_massspring_times times = {.frame = 0.01, .step = 0.02};
    sample_run run = sample_run_create();
    FILE *out = fopen(file->text, "w");
    assert_non_null(out);
    for (int i = 1; i <= steps; i++) {
        const cipc_massspring_report report = {.contacts = 5 + i % 3, .hits = 2 * hits, .arrivals = hits, .iterations = 3 * hits, .deformation = 0.04 + 0.001 * (i % 5), .kinetic = 0.1 * i, .gravitational = 3 - 0.1 * i};
        sample_run_advance(&run);
        assert_int_equal(cipc_massspring_stats_write(out, run.state, &report, &times, NULL, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

/* Lines between pixels are paler than their colour: then it is the hue that counts. */
static bool is_of(uint32_t p, uint32_t colour)
{
    const int red = p >> 16 & 0xff, green = p >> 8 & 0xff, blue = p & 0xff;
    return colour == LEVEL ? red > green + 0x30 && red > blue + 0x30 : p == colour;
}

/* Number of pixels of a colour inside the box of panel 0..3. */
static int pixels_of(const path *png, int panel, uint32_t colour)
{
    cairo_surface_t *surface = cairo_image_surface_create_from_png(png->text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(surface), 1200);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface), left = panel % 2 * 600 + 82, top = panel / 2 * 392 + 48;
    int count = 0;
    for (int y = top; y < top + 280; y++) {
        for (int x = left; x < left + 490; x++) count += is_of(*(const uint32_t *)(const void *)(data + y * stride + 4 * x) & 0xffffff, colour);
    }
    cairo_surface_destroy(surface);
    return count;
}

static void test_every_panel_has_its_curve(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    const int steps[] = {1, 2, 600};
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        write_stats(&stats, steps[i], 4);
        assert_int_equal(cipc_massspring_plots_png(png.text, stats.text, 0.1, &error), CIPC_OK);
        for (int panel = 0; panel < 4; panel++) assert_true(pixels_of(&png, panel, CURVE) > 3);
    }
    folder_remove(&folder);
}

/* Without a bound there is no level; without a hit nothing to divide by. */
static void test_bound_and_hits(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    write_stats(&stats, 8, 0);
    assert_int_equal(cipc_massspring_plots_png(png.text, stats.text, 0.1, &error), CIPC_OK);
    assert_true(pixels_of(&png, 0, LEVEL) > 20);
    assert_int_equal(pixels_of(&png, 3, CURVE), 0);
    assert_int_equal(cipc_massspring_plots_png(png.text, stats.text, 0, &error), CIPC_OK);
    assert_int_equal(pixels_of(&png, 0, LEVEL), 0);
    folder_remove(&folder);
}

static void test_odd_statistics(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "not json", "[1,2]\n{}\n", "{\"time\":0.1,\"deformation\":null,\"arrivals\":\"nan\",\"contacts\":{}}\n", "{\"time\":0.1,\"deformation\":1e308,\"arrivals\":-1}\n{\"time\":1e308}\n"};
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        file_write(&stats, texts[i], strlen(texts[i]));
        assert_int_equal(cipc_massspring_plots_png(png.text, stats.text, 0.1, &error), CIPC_OK);
        assert_true(pixels_of(&png, 0, 0xffffff) > 1000);
    }
    folder_remove(&folder);
}

static void test_errors(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), stats = path_in(&folder, "stats.jsonl"), png = path_in(&folder, "plots.png");
    assert_int_equal(cipc_massspring_plots_png(png.text, stats.text, 0.1, &error), CIPC_E_MISSING_FILE);
    write_stats(&stats, 5, 1);
    assert_int_equal(cipc_massspring_plots_png("/no/such/folder/p.png", stats.text, 0.1, &error), CIPC_E_IO);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_massspring_plots_png(png.text, stats.text, 0.1, &error);
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
        cmocka_unit_test(test_every_panel_has_its_curve), cmocka_unit_test(test_bound_and_hits), cmocka_unit_test(test_odd_statistics), cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
