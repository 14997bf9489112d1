/* Scenes for tests of asynchronous contact mechanics. */
#include "support/asynchronous_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

void asynchronous_scene_init(asynchronous_scene *s)
{
    *s = (asynchronous_scene){.options = cipc_asynchronous_options_default(), .min_gap = INFINITY, .seen_gap = INFINITY};
    sheet_scene_init(&s->sheet);
}

void asynchronous_scene_free(asynchronous_scene *s)
{
    cipc_asynchronous_destroy(s->integrator);
    sheet_scene_free(&s->sheet);
}

void asynchronous_add_particles(asynchronous_scene *s, const char *name, int count, const double *position, const double velocity[3], double mass)
{
    const double diameter = 1e-2, volume = acos(-1) / 6 * diameter * diameter * diameter;
    double *velocities = cipc_alloc(3 * (size_t)count, sizeof *velocities);
    assert_non_null(velocities);
    for (int i = 0; i < 3 * count; i++) velocities[i] = velocity[i % 3];
    cipc_body_description body = {.kind = CIPC_BODY_PARTICLES, .node_count = count, .rest = position, .position = position, .velocity = velocities};
    body.material.density = mass / volume;
    body.material.thickness = diameter;
    for (int i = 0; name[i] && i < CIPC_NAME_SIZE - 1; i++) body.name[i] = name[i];
    sheet_add(&s->sheet, &body);
    cipc_free(velocities);
}

void asynchronous_add_floor(asynchronous_scene *s, double height, double half)
{
    const double corner[3] = {-half, height, -half}, u[3] = {0, 0, 2 * half}, v[3] = {2 * half, 0, 0};
    sheet_add_grid(&s->sheet, "floor", corner, u, v, 1, 1)->fixed = true;
}

void asynchronous_scene_model(asynchronous_scene *s) { sheet_scene_model(&s->sheet); }

void asynchronous_scene_start(asynchronous_scene *s)
{
    cipc_asynchronous_destroy(s->integrator);
    assert_int_equal(cipc_asynchronous_create(&s->integrator, s->sheet.model, &s->options, &s->error), CIPC_OK);
}

void asynchronous_scene_build(asynchronous_scene *s)
{
    asynchronous_scene_model(s);
    asynchronous_scene_start(s);
}

/* Finite, no intersection, no gap lost: whether the step ended well or stalled. */
static cipc_status look_at_frame(asynchronous_scene *s)
{
    const double *x = s->sheet.state->position;
    cipc_invariant_report seen;
    cipc_invariant_report_init(&seen);
    cipc_status status = cipc_monitor_finite(s->sheet.model, x, &s->error);
    if (!status) status = cipc_monitor_finite(s->sheet.model, s->sheet.state->velocity, &s->error);
    if (!status) status = cipc_monitor_intersection(s->sheet.monitor, x, &seen, &s->error);
    if (!status) status = cipc_monitor_gap(s->sheet.monitor, x, &seen, &s->error);
    s->seen_gap = fmin(s->seen_gap, seen.min_gap);
    return status;
}

static cipc_status look_at_paths(void *context, const cipc_paths *paths, cipc_error *error)
{
    asynchronous_scene *s = context;
    cipc_invariant_report seen;
    cipc_invariant_report_init(&seen);
    const cipc_status status = cipc_monitor_paths(s->sheet.monitor, paths, &seen, error);
    s->paths_checked += seen.paths_checked;
    return status;
}

void asynchronous_watch(asynchronous_scene *s)
{
    cipc_invariant_options options = cipc_invariant_options_default();
    options.reach = s->options.thickness;
    cipc_monitor_destroy(s->sheet.monitor);
    s->sheet.monitor = NULL;
    assert_int_equal(cipc_monitor_create(&s->sheet.monitor, s->sheet.model, &options, &s->error), CIPC_OK);
    assert_int_equal(look_at_frame(s), CIPC_OK);
    cipc_asynchronous_set_monitor(s->integrator, look_at_paths, s);
}

cipc_status asynchronous_try_step(asynchronous_scene *s)
{
    cipc_status status = cipc_asynchronous_step(s->integrator, s->sheet.state, &s->report, &s->error);
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) s->events[k] += s->report.events[k];
    if (s->report.layers > s->layers) s->layers = s->report.layers;
    s->min_gap = fmin(s->min_gap, s->report.min_gap);
    if (s->sheet.monitor && (!status || status == CIPC_E_NO_PROGRESS)) {
        const cipc_error stall = s->error;
        const cipc_status seen = look_at_frame(s);
        if (seen) status = seen;
        else s->error = stall;
    }
    return status;
}

void asynchronous_steps(asynchronous_scene *s, int count)
{
    for (int i = 0; i < count; i++) {
        const cipc_status status = asynchronous_try_step(s);
        if (status != CIPC_OK) print_error("%s: %s\n", s->error.place, s->error.what);
        assert_int_equal(status, CIPC_OK);
    }
}
