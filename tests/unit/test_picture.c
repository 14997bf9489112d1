/* The contact sheet: size, tiles, bodies in their colours, and the errors. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <cairo.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "cipc/output.h"
#include "output/palette.h"
#include "support/failing_memory.h"
#include "support/every_kind.h"

enum { TILE_WIDTH = 120, TILE_HEIGHT = 90, MARGIN = 6 };

static cipc_picture_options small_options(int columns, int rows)
{
    cipc_picture_options options = cipc_picture_options_default();
    options.columns = columns;
    options.rows = rows;
    options.tile_width = TILE_WIDTH;
    options.tile_height = TILE_HEIGHT;
    return options;
}

static void write_trajectory(const path *file, sample_run *run, int frames)
{
    cipc_error error;
    cipc_trajectory *t;
    assert_int_equal(cipc_trajectory_create(&t, file->text, run->model, run->state, "{}", frames, &error), CIPC_OK);
    for (int i = 1; i < frames; i++) {
        sample_run_advance(run);
        assert_int_equal(cipc_trajectory_append(t, run->state, &error), CIPC_OK);
    }
    assert_int_equal(cipc_trajectory_close(t, &error), CIPC_OK);
}

/* Number of pixels of a tile whose colour is the body's at some brightness: the components' ratios in linear light are the body's. */
static int pixels_of(cairo_surface_t *surface, int left, int top, cipc_colour colour)
{
    const double r = cipc_srgb_to_linear(colour.r), g = cipc_srgb_to_linear(colour.g), b = cipc_srgb_to_linear(colour.b);
    const double tolerance = 0.012; /* of full light: a step of 8-bit code is at most 0.009 of it */
    const unsigned char *pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    int count = 0;
    for (int y = top; y < top + TILE_HEIGHT; y++) {
        for (int x = left; x < left + TILE_WIDTH; x++) {
            const uint32_t pixel = *(const uint32_t *)(const void *)(pixels + y * stride + 4 * x);
            const double pr = cipc_srgb_to_linear((pixel >> 16 & 255) / 255.0), pg = cipc_srgb_to_linear((pixel >> 8 & 255) / 255.0),
                         pb = cipc_srgb_to_linear((pixel & 255) / 255.0);
            const double brightness = (pr + pg + pb) / (r + g + b);
            const bool lit = brightness > 0.2 && brightness < 1.6;
            count += lit && fabs(pr - brightness * r) < tolerance && fabs(pg - brightness * g) < tolerance &&
                     fabs(pb - brightness * b) < tolerance;
        }
    }
    return count;
}

static cairo_surface_t *sheet(const path *folder, const path *h5, const cipc_model *model, const cipc_picture_options *options)
{
    cipc_error error;
    const path png = path_in(folder, "frames.png");
    if (cipc_frames_png(png.text, h5->text, model, options, &error) != CIPC_OK) {
        fail_msg("%s: %s", error.place, error.what);
    }
    cairo_surface_t *surface = cairo_image_surface_create_from_png(png.text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    return surface;
}

static void test_every_tile_shows_every_body(void **state)
{
    (void)state;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
    sample_run run = sample_run_create();
    write_trajectory(&h5, &run, 9);
    const cipc_picture_options options = small_options(2, 2);
    cairo_surface_t *surface = sheet(&folder, &h5, run.model, &options);
    assert_int_equal(cairo_image_surface_get_width(surface), MARGIN + 2 * (TILE_WIDTH + MARGIN));
    assert_int_equal(cairo_image_surface_get_height(surface), MARGIN + 2 * (TILE_HEIGHT + MARGIN));
    for (int tile = 0; tile < 4; tile++) {
        for (int body = 0; body < run.model->body_count; body++) {
            const int some = TILE_WIDTH * TILE_HEIGHT / 50;
            const int left = MARGIN + tile % 2 * (TILE_WIDTH + MARGIN), top = MARGIN + tile / 2 * (TILE_HEIGHT + MARGIN);
            assert_true(pixels_of(surface, left, top, cipc_body_colour(run.model, body)) > some);
        }
    }
    cairo_surface_destroy(surface);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

/* Cloth, strand, grains, block and fixed needles, each in its colour. */
static void test_every_kind_is_shown(void **state)
{
    (void)state;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
    sample_run run = every_kind_create_all();
    for (int b = 0; b < run.model->body_count; b++) {
        run.model->bodies[b].material.thickness = 0.3;
    }
    write_trajectory(&h5, &run, 2);
    cipc_picture_options options = small_options(2, 1);
    options.azimuth = options.elevation = 0.2;
    cairo_surface_t *surface = sheet(&folder, &h5, run.model, &options);
    for (int tile = 0; tile < 2; tile++) {
        for (int body = 0; body < run.model->body_count; body++) {
            const int some = 20;
            assert_true(pixels_of(surface, MARGIN + tile * (TILE_WIDTH + MARGIN), MARGIN, cipc_body_colour(run.model, body)) > some);
        }
    }
    cairo_surface_destroy(surface);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

/* Grains in one place, far larger than the distance between them: the camera stands back for the ball, and the ball fills the picture. */
static void test_the_camera_leaves_room_for_diameters(void **state)
{
    (void)state;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
    const cipc_body_kind kind = CIPC_BODY_PARTICLES;
    sample_run run = every_kind_create(&kind, 1, false);
    run.model->bodies[0].material.thickness = 40;
    write_trajectory(&h5, &run, 1);
    const cipc_picture_options options = small_options(1, 1);
    cairo_surface_t *surface = sheet(&folder, &h5, run.model, &options);
    const double disc = 3.14159 / 4 * TILE_HEIGHT * TILE_HEIGHT;
    const int shown = pixels_of(surface, MARGIN, MARGIN, cipc_body_colour(run.model, 0));
    assert_true(shown > 0.7 * disc && shown < 1.02 * disc);
    cairo_surface_destroy(surface);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

/* A body chosen as the subject is drawn larger than among all that move. */
static void test_the_chosen_subject_fills_the_picture(void **state)
{
    (void)state;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
    sample_run run = every_kind_create_all();
    write_trajectory(&h5, &run, 1);
    bool subject[8] = {false};
    assert_true(run.model->body_count > 1 && run.model->body_count <= 8);
    subject[0] = true;
    cipc_picture_options options = small_options(1, 1);
    cairo_surface_t *all = sheet(&folder, &h5, run.model, &options);
    options.subject = subject;
    cairo_surface_t *one = sheet(&folder, &h5, run.model, &options);
    const int small = pixels_of(all, MARGIN, MARGIN, cipc_body_colour(run.model, 0)), large = pixels_of(one, MARGIN, MARGIN, cipc_body_colour(run.model, 0));
    assert_true(small > 0 && large > 2 * small);
    cairo_surface_destroy(all);
    cairo_surface_destroy(one);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

/* Fewer frames than tiles: no empty tiles. One frame: one tile. */
static void test_few_frames(void **state)
{
    (void)state;
    const struct { int frames, width_tiles, height_tiles; } cases[] = {{1, 1, 1}, {2, 2, 1}, {3, 3, 1}, {4, 3, 2}, {6, 3, 2}, {50, 3, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
        sample_run run = sample_run_create();
        write_trajectory(&h5, &run, cases[i].frames);
        const cipc_picture_options options = small_options(3, 2);
        cairo_surface_t *surface = sheet(&folder, &h5, run.model, &options);
        assert_int_equal(cairo_image_surface_get_width(surface), MARGIN + cases[i].width_tiles * (TILE_WIDTH + MARGIN));
        assert_int_equal(cairo_image_surface_get_height(surface), MARGIN + cases[i].height_tiles * (TILE_HEIGHT + MARGIN));
        cairo_surface_destroy(surface);
        sample_run_destroy(&run);
        folder_remove(&folder);
    }
}

/* Positions that are not numbers, or all in one point, make a poor picture, not a crash. */
static void test_poor_positions(void **state)
{
    (void)state;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5");
    for (int kind = 0; kind < 3; kind++) {
        sample_run run = sample_run_create();
        for (int i = 0; i < 3 * run.model->node_count; i++) {
            run.state->position[i] = kind == 0 ? 0.5 : kind == 1 ? (double)NAN : i % 5 == 0 ? (double)INFINITY : run.state->position[i];
        }
        write_trajectory(&h5, &run, 1);
        const cipc_picture_options options = small_options(1, 1);
        cairo_surface_destroy(sheet(&folder, &h5, run.model, &options));
        sample_run_destroy(&run);
    }
    folder_remove(&folder);
}

static void test_errors(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), h5 = path_in(&folder, "t.h5"), png = path_in(&folder, "frames.png");
    sample_run run = sample_run_create();
    cipc_picture_options options = small_options(2, 2);
    assert_int_equal(cipc_frames_png(png.text, h5.text, run.model, &options, &error), CIPC_E_MISSING_FILE);
    write_trajectory(&h5, &run, 2);
    assert_int_equal(cipc_frames_png("/no/such/folder/a.png", h5.text, run.model, &options, &error), CIPC_E_IO);
    run.model->node_count++;
    assert_int_equal(cipc_frames_png(png.text, h5.text, run.model, &options, &error), CIPC_E_IO);
    run.model->node_count--;
    options.columns = 0;
    assert_int_equal(cipc_frames_png(png.text, h5.text, run.model, &options, &error), CIPC_E_OUT_OF_RANGE);
    options = small_options(2, 1000000);
    assert_int_equal(cipc_frames_png(png.text, h5.text, run.model, &options, &error), CIPC_E_OUT_OF_RANGE);
    assert_false(file_exists(&png));
    options = small_options(1, 1);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_frames_png(png.text, h5.text, run.model, &options, &error);
        if (!allocation_failed()) {
            assert_int_equal(status, CIPC_OK);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_false(file_exists(&png));
    }
    fail_allocation(0);
    sample_run_destroy(&run);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_tile_shows_every_body),
        cmocka_unit_test(test_every_kind_is_shown),
        cmocka_unit_test(test_the_camera_leaves_room_for_diameters),
        cmocka_unit_test(test_the_chosen_subject_fills_the_picture),
        cmocka_unit_test(test_few_frames),
        cmocka_unit_test(test_poor_positions),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
