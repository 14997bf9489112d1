/* Rods and particles as the camera sees them: as wide as they are, but never too thin to be seen; round; cut off before the eye. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "output/round_look.h"
#include "support/every_kind.h"

enum { SIZE = 60, SAMPLES = SIZE * CIPC_RASTER_SAMPLES };
static const cipc_colour black = {0, 0, 0};

/* From z = `distance`, along -z, at a square 2 m wide around the origin. */
static cipc_camera camera_at(double distance)
{
    const cipc_bounds bounds = {{-1, -1, -1}, {1, 1, 1}};
    cipc_camera camera = cipc_camera_look(&bounds, 0, 0, 1);
    camera.distance = distance;
    camera.eye[2] = distance;
    camera.slope_x = camera.slope_y = 1 / distance;
    return camera;
}

/* What the camera sees of a model whose nodes are put at x. */
static cipc_raster picture_of(const cipc_model *model, const double *x, const cipc_camera *camera)
{
    cipc_raster r;
    const cipc_round_view view = cipc_round_view_of(camera);
    const cipc_lighting lighting = cipc_lighting_of(camera);
    assert_true(cipc_raster_init(&r, SIZE, SIZE));
    cipc_raster_clear(&r, black, black);
    cipc_round_draw(&r, model, x, &view, &lighting);
    return r;
}

static float depth_at(const cipc_raster *r, int x, int y)
{
    return r->depth[y * r->width + x];
}

/* Samples that show something, in a row or in a column. */
static int count_row(const cipc_raster *r, int y)
{
    int count = 0;
    for (int x = 0; x < r->width; x++) {
        count += depth_at(r, x, y) > 0;
    }
    return count;
}

static int count_column(const cipc_raster *r, int x)
{
    int count = 0;
    for (int y = 0; y < r->height; y++) {
        count += depth_at(r, x, y) > 0;
    }
    return count;
}

static int count_all(const cipc_raster *r)
{
    int count = 0;
    for (int y = 0; y < r->height; y++) {
        count += count_row(r, y);
    }
    return count;
}

/* Three grains, all in one place, of the diameter given. */
static cipc_raster one_grain(const double center[3], double diameter, const cipc_camera *camera)
{
    const cipc_body_kind kind = CIPC_BODY_PARTICLES;
    sample_run run = every_kind_create(&kind, 1, false);
    run.model->bodies[0].material.thickness = diameter;
    for (int i = 0; i < 3 * GRAIN_COUNT; i++) {
        run.state->position[i] = center[i % 3];
    }
    cipc_raster r = picture_of(run.model, run.state->position, camera);
    sample_run_destroy(&run);
    return r;
}

/* A strand from a to b, straight. */
static cipc_raster one_strand(const double a[3], const double b[3], double diameter, const cipc_camera *camera)
{
    const cipc_body_kind kind = CIPC_BODY_RODS;
    sample_run run = every_kind_create(&kind, 1, false);
    run.model->bodies[0].material.thickness = diameter;
    for (int i = 0; i < STRAND_NODES; i++) {
        for (int k = 0; k < 3; k++) {
            run.state->position[3 * i + k] = a[k] + (b[k] - a[k]) * i / (STRAND_NODES - 1);
        }
    }
    cipc_raster r = picture_of(run.model, run.state->position, camera);
    sample_run_destroy(&run);
    return r;
}

static void assert_about(int got, double wanted)
{
    const double one_sample_each_side = 2;
    if (fabs(got - wanted) > one_sample_each_side) {
        fail_msg("got %d, wanted about %g", got, wanted);
    }
}

/* From far away (10 m) a metre is SAMPLES / 2 samples wide, within some percent. */
static void test_a_ball_is_a_disc_of_its_diameter(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(10);
    const double pi = 3.14159265358979;
    cipc_raster r = one_grain((const double[3]){0, 0, 0}, 1, &camera);
    assert_about(count_row(&r, SAMPLES / 2), SAMPLES / 2.0);
    assert_about(count_column(&r, SAMPLES / 2), SAMPLES / 2.0);
    const double area = pi / 4 * (SAMPLES / 2.0) * (SAMPLES / 2.0), tolerance = 0.02;
    assert_true(fabs(count_all(&r) / area - 1) < tolerance);
    const double front = 1 / (double)depth_at(&r, SAMPLES / 2, SAMPLES / 2), rounding_of_float = 1e-5;
    assert_true(fabs(front - 9.5) < 1e-3 + rounding_of_float); /* half a metre nearer than its centre; the sample is not quite the middle */
    cipc_raster_free(&r);
}

/* Brighter towards the key light (upper left) than away from it. */
static void test_a_ball_is_round(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(10);
    cipc_raster r = one_grain((const double[3]){0, 0, 0}, 1, &camera);
    const int middle = SAMPLES / 2, off = SAMPLES / 7;
    const float *lit = r.light[(middle - off) * SAMPLES + middle - off], *unlit = r.light[(middle + off) * SAMPLES + middle + off];
    assert_true(lit[0] > 1.5F * unlit[0] && unlit[0] > 0);
    assert_true(r.key[(middle - off) * SAMPLES + middle - off] > 0.5F && r.key[(middle + off) * SAMPLES + middle + off] < 0.1F);
    cipc_raster_free(&r);
}

static void test_a_rod_is_a_tube_of_its_diameter(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(10);
    cipc_raster level = one_strand((const double[3]){-0.5, 0, 0}, (const double[3]){0.5, 0, 0}, 0.2, &camera);
    cipc_raster upright = one_strand((const double[3]){0, -0.5, 0}, (const double[3]){0, 0.5, 0}, 0.2, &camera);
    cipc_raster oblique = one_strand((const double[3]){-0.5, -0.5, 0}, (const double[3]){0.5, 0.5, 0}, 0.2, &camera);
    for (int x = SAMPLES / 3; x < 2 * SAMPLES / 3; x++) { /* joints of segments leave no trace */
        assert_about(count_column(&level, x), SAMPLES / 10.0);
        assert_about(count_row(&upright, x), SAMPLES / 10.0);
        assert_about(count_row(&oblique, x), SAMPLES / 10.0 * sqrt(2));
    }
    assert_about(count_row(&level, SAMPLES / 2), SAMPLES * 0.6); /* with both caps */
    cipc_raster_free(&level);
    cipc_raster_free(&upright);
    cipc_raster_free(&oblique);
}

static void test_a_hair_is_seen(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(10);
    cipc_raster hair = one_strand((const double[3]){-0.5, 0.01, 0}, (const double[3]){0.5, 0.02, 0}, 1e-6, &camera);
    cipc_raster dust = one_grain((const double[3]){0.3, 0, 0}, 1e-6, &camera);
    for (int x = SAMPLES / 3; x < 2 * SAMPLES / 3; x++) {
        assert_in_range(count_column(&hair, x), CIPC_RASTER_SAMPLES, 2 * CIPC_RASTER_SAMPLES); /* 1 to 2 pixels */
    }
    assert_in_range(count_all(&dust), CIPC_RASTER_SAMPLES * CIPC_RASTER_SAMPLES, 4 * CIPC_RASTER_SAMPLES * CIPC_RASTER_SAMPLES);
    cipc_raster_free(&hair);
    cipc_raster_free(&dust);
}

/* A rod towards the eye: its nearest end is a ball's front; the rest gets narrower with depth. */
static void test_perspective(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(4);
    cipc_raster away = one_strand((const double[3]){0, 0, 1}, (const double[3]){0, 0, -50}, 0.2, &camera);
    assert_true(fabs(1 / (double)depth_at(&away, SAMPLES / 2, SAMPLES / 2) - 2.9) < 1e-3);
    assert_about(count_row(&away, SAMPLES / 2), 0.2 / 3 * 4 / 2 * SAMPLES); /* as wide as the near end, 3 m from the eye */
    cipc_raster fleeing = one_strand((const double[3]){-0.5, 0, 1}, (const double[3]){3, 0, -10}, 0.2, &camera);
    const int near_end = count_column(&fleeing, SAMPLES * 2 / 5), far_end = count_column(&fleeing, SAMPLES * 4 / 5);
    assert_true(near_end > far_end + 3 && far_end > 0);
    cipc_raster_free(&away);
    cipc_raster_free(&fleeing);
}

/* Through the eye, behind it, around it, far away, not a number: at most a part is drawn, and nothing breaks. */
static void test_what_the_eye_cannot_see(void **state)
{
    (void)state;
    const cipc_camera camera = camera_at(4);
    const double nan = (double)NAN, infinity = (double)INFINITY;
    const double unseen[][6] = {{0, 0, 5, 0, 0, 9},        {0, 100, 0, 1, 100, 0},     {-1e9, 0, 0, -1e9, 1, 0},     {nan, 0, 0, 1, 0, 0},
                                {0, 0, 0, nan, nan, nan}, {infinity, 0, 0, 0, 0, 0}, {0, 0, -infinity, 0, 0, 0}};
    for (size_t i = 0; i < sizeof unseen / sizeof unseen[0]; i++) {
        cipc_raster r = one_strand(unseen[i], unseen[i] + 3, 0.2, &camera);
        const bool a_part_is_finite = i >= 4; /* nodes in between may be */
        assert_true(a_part_is_finite || count_all(&r) == 0);
        cipc_raster_free(&r);
    }
    cipc_raster around = one_grain((const double[3]){0, 0, 4}, 1, &camera); /* the eye is inside: nothing is nearer than it is allowed */
    assert_int_equal(count_all(&around), 0);
    cipc_raster past = one_strand((const double[3]){-0.5, -0.5, 2}, (const double[3]){0.5, 0.5, 8}, 0.2, &camera);
    assert_true(count_all(&past) > 0);
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        assert_true((double)past.depth[i] <= 1 / (0.999 * cipc_camera_nearest(&camera)));
    }
    cipc_raster_free(&around);
    cipc_raster_free(&past);
}

/* Every rod and particle of a model is drawn in its body's colour; the shells and volumes are not. */
static void test_bodies(void **state)
{
    (void)state;
    sample_run run = every_kind_create_all();
    cipc_camera camera = camera_at(10);
    camera.eye[0] = camera.target[0] = 3;
    camera.slope_x = camera.slope_y = 0.5;
    cipc_raster r = picture_of(run.model, run.state->position, &camera);
    int seen[5] = {0};
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        for (int b = 0; b < 5 && r.depth[i] > 0; b++) {
            const cipc_colour c = cipc_colour_to_linear(cipc_body_colour(run.model, b));
            const double tolerance = 1e-4;
            seen[b] += fabs((double)r.light[i][0] * c.g - (double)r.light[i][1] * c.r) < tolerance &&
                       fabs((double)r.light[i][0] * c.b - (double)r.light[i][2] * c.r) < tolerance;
        }
    }
    assert_int_equal(seen[0] + seen[3], 0);
    assert_true(seen[1] > 50 && seen[2] > 20 && seen[4] > 50);
    cipc_raster_free(&r);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_ball_is_a_disc_of_its_diameter),
        cmocka_unit_test(test_a_ball_is_round),
        cmocka_unit_test(test_a_rod_is_a_tube_of_its_diameter),
        cmocka_unit_test(test_a_hair_is_seen),
        cmocka_unit_test(test_perspective),
        cmocka_unit_test(test_what_the_eye_cannot_see),
        cmocka_unit_test(test_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
