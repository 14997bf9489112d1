/* Shadows: where something is in the light's way, and nowhere else. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "output/round_look.h"
#include "output/shadow.h"
#include "output/surface_look.h"
#include "support/failing_memory.h"
#include "support/every_kind.h"

enum { SIZE = 60, SAMPLES = SIZE * CIPC_RASTER_SAMPLES };

/* The sample run from obliquely above, lit from straight above: the ground (2 x 2, at y = 0) and the cloth (1 x 1, at y = 0.2). */
typedef struct view {
    sample_run run;
    cipc_bounds bounds;
    cipc_camera camera;
    cipc_raster raster;
} view;

static view look_at(sample_run run)
{
    view v = {.run = run, .bounds = cipc_bounds_empty()};
    const int nodes = v.run.model->node_count;
    for (int i = 0; i < nodes; i++) {
        cipc_bounds_add(&v.bounds, v.run.state->position + 3 * i, 0);
    }
    v.camera = cipc_camera_look(&v.bounds, 0.3, 0.5, 1);
    for (int i = 0; i < nodes; i++) {
        cipc_camera_fit(&v.camera, v.run.state->position + 3 * i, 0);
    }
    cipc_camera_settle(&v.camera, &v.bounds, 1);
    assert_true(cipc_raster_init(&v.raster, SIZE, SIZE));
    cipc_raster_clear(&v.raster, (cipc_colour){0, 0, 0}, (cipc_colour){0, 0, 0});
    double *normals = calloc(3 * (size_t)nodes, sizeof *normals);
    const cipc_lighting lighting = cipc_lighting_of(&v.camera);
    const cipc_round_view round = cipc_round_view_of(&v.camera);
    cipc_surface_draw(&v.raster, v.run.model, v.run.state->position, &v.camera, &lighting, normals);
    free(normals);
    cipc_round_draw(&v.raster, v.run.model, v.run.state->position, &round, &lighting);
    return v;
}

static view look(void)
{
    return look_at(sample_run_create());
}

static void forget(view *v)
{
    sample_run_destroy(&v->run);
    cipc_raster_free(&v->raster);
}

/* Light at the sample that shows a point; the point must be visible there. */
static double light_at(const view *v, double x, double y, double z)
{
    double seen[3];
    cipc_camera_see(&v->camera, (const double[3]){x, y, z}, seen);
    const int column = (int)(SAMPLES * (0.5 + 0.5 * seen[0] / seen[2] / v->camera.slope_x));
    const int row = (int)(SAMPLES * (0.5 - 0.5 * seen[1] / seen[2] / v->camera.slope_y));
    const size_t i = (size_t)(row * SAMPLES + column);
    const double one_sample = 0.05; /* relative: how much the depth may change over a sample */
    assert_true(fabs(v->raster.depth[i] * seen[2] - 1) < one_sample);
    return v->raster.light[i][0];
}

static void test_light_from_above(void **state)
{
    (void)state;
    const double above[3] = {0, 1, 0};
    const struct { double x, y, z; int in_shadow; } points[] = {
        {0, 0.2, 0, 0}, {-0.4, 0.2, -0.4, 0}, {0.4, 0.2, 0.4, 0}, /* on the cloth: it does not shade itself */
        {0.8, 0, 0.8, 0}, {-0.8, 0, 0.6, 0}, {0, 0, 0.9, 0},      /* on the ground, outside */
        {0, 0, 0.48, 1}, {0.3, 0, 0.47, 1}, {-0.3, 0, 0.47, 1},   /* on the ground, below the cloth's front edge */
    };
    enum { POINTS = sizeof points / sizeof points[0] };
    view v = look();
    double before[POINTS];
    for (int i = 0; i < POINTS; i++) {
        before[i] = light_at(&v, points[i].x, points[i].y, points[i].z);
    }
    assert_true(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &v.bounds, above));
    for (int i = 0; i < POINTS; i++) {
        const double after = light_at(&v, points[i].x, points[i].y, points[i].z);
        if (points[i].in_shadow == 1 ? after >= before[i] : after != before[i]) {
            fail_msg("point %d: light %g, then %g", i, before[i], after);
        }
    }
    forget(&v);
}

/* A rod and a ball over a cloth: they shade the cloth below them and nothing beside, and not the sides of themselves that the light meets. */
static void test_rods_and_particles_cast_shadows(void **state)
{
    (void)state;
    const double above[3] = {0, 1, 0}, slant = 0.025 * sqrt(0.5);
    const struct { double x, y, z; int in_shadow; } points[] = {
        {0.42, 0, 0.21, 1}, {0.6, 0, 0.21, 1}, {0.42, 0, 0.26, 0}, {0.42, 0, 0.14, 0}, /* below the rod, and beside its shadow */
        {0.5, 0, 0.71, 1}, {0.5, 0, 0.76, 0}, {0.57, 0, 0.7, 0},                       /* below the ball */
        {0.42, 0.2 + slant, 0.2 + slant, 0}, {0.5, 0.2 + slant, 0.7 + slant, 0},       /* on them, above and in front */
    };
    enum { POINTS = sizeof points / sizeof points[0] };
    const cipc_body_kind kinds[] = {CIPC_BODY_SHELL, CIPC_BODY_RODS, CIPC_BODY_PARTICLES};
    sample_run run = every_kind_create(kinds, 3, false);
    for (int i = 4; i < run.model->node_count; i++) { /* the cloth is the square from (0, 0) to (1, 1) at y = 0 */
        const bool in_rod = i < 4 + STRAND_NODES;
        double *p = run.state->position + 3 * i;
        p[0] = in_rod ? 0.1 + 0.8 * (i - 4) / (STRAND_NODES - 1) : 0.5;
        p[1] = 0.2;
        p[2] = in_rod ? 0.2 : 0.7;
    }
    view v = look_at(run);
    double before[POINTS];
    for (int i = 0; i < POINTS; i++) {
        before[i] = light_at(&v, points[i].x, points[i].y, points[i].z);
    }
    assert_true(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &v.bounds, above));
    for (int i = 0; i < POINTS; i++) {
        const double after = light_at(&v, points[i].x, points[i].y, points[i].z);
        if (points[i].in_shadow == 1 ? after >= before[i] : after != before[i]) {
            fail_msg("point %d: light %g, then %g", i, before[i], after);
        }
    }
    forget(&v);
}

/* What owes nothing to the light loses nothing by its absence. */
static void test_only_key_light_is_taken(void **state)
{
    (void)state;
    const double above[3] = {0, 1, 0};
    view v = look();
    const double before = light_at(&v, 0, 0, 0.48);
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        v.raster.key[i] = 0;
    }
    assert_true(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &v.bounds, above));
    assert_true(light_at(&v, 0, 0, 0.48) == before);
    forget(&v);
}

static void test_nothing_in_the_way(void **state)
{
    (void)state;
    view v = look();
    const cipc_bounds empty = cipc_bounds_empty();
    const double below[3] = {0, -1, 0}, before = light_at(&v, 0.8, 0, 0.8);
    assert_true(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &empty, below));
    assert_true(light_at(&v, 0.8, 0, 0.8) == before); /* no subject, no shadows */
    assert_true(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &v.bounds, below));
    assert_true(light_at(&v, 0.8, 0, 0.8) == before); /* of the ground, the light from below meets the ground first */
    fail_allocation(1);
    assert_false(cipc_shadow_cast(&v.raster, v.run.model, v.run.state->position, &v.camera, &v.bounds, below));
    fail_allocation(0);
    forget(&v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_light_from_above),
        cmocka_unit_test(test_rods_and_particles_cast_shadows),
        cmocka_unit_test(test_only_key_light_is_taken),
        cmocka_unit_test(test_nothing_in_the_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
