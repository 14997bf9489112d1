/* Surfaces as the camera sees them: what is in front hides what is behind, both sides are lit, what passes the eye is cut off. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>

#include "output/surface_look.h"
#include "support/sample_run.h"

enum { SIZE = 40, SAMPLES = SIZE * CIPC_RASTER_SAMPLES };

/* The sample run seen from azimuth 0 and the elevation given. */
static cipc_raster seen_from(const sample_run *run, double elevation, double zoom)
{
    cipc_raster r;
    cipc_bounds bounds = cipc_bounds_empty();
    for (int i = 0; i < run->model->node_count; i++) {
        cipc_bounds_add(&bounds, run->state->position + 3 * i, 0);
    }
    cipc_camera camera = cipc_camera_look(&bounds, 0, elevation, 1);
    for (int i = 0; i < run->model->node_count; i++) {
        cipc_camera_fit(&camera, run->state->position + 3 * i, 0);
    }
    cipc_camera_settle(&camera, &bounds, zoom);
    double *normals = calloc(3 * (size_t)run->model->node_count, sizeof *normals);
    assert_true(cipc_raster_init(&r, SIZE, SIZE));
    cipc_raster_clear(&r, (cipc_colour){0, 0, 0}, (cipc_colour){0, 0, 0});
    const cipc_lighting lighting = cipc_lighting_of(&camera);
    cipc_surface_draw(&r, run->model, run->state->position, &camera, &lighting, normals);
    free(normals);
    return r;
}

/* The body whose colour the sample has (its components' ratios; shading multiplies all three alike), or -1. */
static int body_at(const cipc_raster *r, const cipc_model *model, int x, int y)
{
    const float *light = r->light[y * r->width + x];
    for (int b = 0; b < model->body_count; b++) {
        const cipc_colour c = cipc_body_colour(model, b);
        const double red = cipc_srgb_to_linear(c.r), green = cipc_srgb_to_linear(c.g), tolerance = 1e-4;
        const double difference = light[0] * green - light[1] * red;
        if (light[0] > 0 && difference < tolerance && difference > -tolerance) {
            return b;
        }
    }
    return -1;
}

static int count_of(const cipc_raster *r, const cipc_model *model, int body)
{
    int count = 0;
    for (int y = 0; y < r->height; y++) {
        for (int x = 0; x < r->width; x++) {
            count += body_at(r, model, x, y) == body;
        }
    }
    return count;
}

static void test_the_nearer_body_hides_the_other(void **state)
{
    (void)state;
    sample_run run = sample_run_create();
    cipc_raster above = seen_from(&run, 1.4, 1), below = seen_from(&run, -1.4, 1);
    assert_int_equal(body_at(&above, run.model, SAMPLES / 2, SAMPLES / 2), 0); /* the cloth is above the ground */
    assert_int_equal(body_at(&below, run.model, SAMPLES / 2, SAMPLES / 2), 1);
    assert_int_equal(count_of(&below, run.model, 0), 0);
    assert_true(count_of(&above, run.model, 0) > 100 && count_of(&above, run.model, 1) > 100);
    cipc_raster_free(&above);
    cipc_raster_free(&below);
    sample_run_destroy(&run);
}

static void test_both_sides_are_lit(void **state)
{
    (void)state;
    sample_run run = sample_run_create();
    const double dimmest = 0.1; /* of the colour: what a lit surface must reach */
    const double elevations[] = {1.4, -1.4};
    for (int i = 0; i < 2; i++) {
        cipc_raster r = seen_from(&run, elevations[i], 1);
        const int body = i == 0 ? 0 : 1;
        const float *light = r.light[SAMPLES / 2 * r.width + SAMPLES / 2];
        assert_true(light[0] > dimmest * cipc_srgb_to_linear(cipc_body_colour(run.model, body).r));
        cipc_raster_free(&r);
    }
    sample_run_destroy(&run);
}

/* With the eye inside the scene, parts of the ground are behind it: they must not appear, upside down, in front. */
static void test_what_is_behind_the_eye_is_cut_off(void **state)
{
    (void)state;
    sample_run run = sample_run_create();
    cipc_raster r = seen_from(&run, 0.15, 4);
    for (int x = 0; x < r.width; x++) {
        assert_int_equal(body_at(&r, run.model, x, 0), -1); /* above the horizon there is nothing */
    }
    assert_true(count_of(&r, run.model, 1) > 0);
    cipc_raster_free(&r);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_nearer_body_hides_the_other),
        cmocka_unit_test(test_both_sides_are_lit),
        cmocka_unit_test(test_what_is_behind_the_eye_is_cut_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
