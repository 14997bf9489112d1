#include "support/sheet_scene.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "implicit/stepper.h"

/* malloc, which the failing allocator of the tests does not see. */
static void *copy_of(const void *source, size_t bytes)
{
    void *block = malloc(bytes ? bytes : 1);
    assert_non_null(block);
    if (source)
        memcpy(block, source, bytes);
    else
        memset(block, 0, bytes);
    return block;
}

void sheet_scene_init(sheet_scene *scene)
{
    memset(scene, 0, sizeof *scene);
    scene->options = cipc_implicit_options_default();
}

void sheet_scene_free(sheet_scene *scene)
{
    cipc_monitor_destroy(scene->monitor);
    cipc_stepper_destroy(scene->stepper);
    cipc_state_destroy(scene->state);
    cipc_model_destroy(scene->model);
    for (int b = 0; b < scene->body_count; b++) {
        free((void *)(uintptr_t)scene->bodies[b].rest);
        free((void *)(uintptr_t)scene->bodies[b].position);
        free((void *)(uintptr_t)scene->bodies[b].velocity);
        free((void *)(uintptr_t)scene->bodies[b].triangles);
        free((void *)(uintptr_t)scene->bodies[b].segments);
        free((void *)(uintptr_t)scene->bodies[b].tetrahedra);
    }
    memset(scene, 0, sizeof *scene);
}

cipc_body_description *sheet_add(sheet_scene *scene, const cipc_body_description *body)
{
    assert_true(scene->body_count < SHEET_SCENE_BODIES);
    cipc_body_description *d = &scene->bodies[scene->body_count++];
    size_t numbers = 3 * (size_t)body->node_count * sizeof(double);
    *d = *body;
    d->rest = copy_of(body->rest, numbers);
    d->position = copy_of(body->position, numbers);
    d->velocity = copy_of(body->velocity, numbers);
    d->triangles = body->triangle_count ? copy_of(body->triangles, (size_t)body->triangle_count * sizeof *body->triangles) : NULL;
    d->segments = body->segment_count ? copy_of(body->segments, (size_t)body->segment_count * sizeof *body->segments) : NULL;
    d->tetrahedra = body->tetrahedron_count ? copy_of(body->tetrahedra, (size_t)body->tetrahedron_count * sizeof *body->tetrahedra) : NULL;
    return d;
}

cipc_body_description *sheet_add_body(sheet_scene *scene, const char *name, int nodes, const double *rest, int triangles,
                                      const int (*triangle)[3])
{
    assert_true(scene->body_count < SHEET_SCENE_BODIES);
    cipc_body_description *d = &scene->bodies[scene->body_count++];
    (void)snprintf(d->name, sizeof d->name, "%s", name);
    cipc_material material = {.density = 500,
                                    .thickness = 1e-3,
                                    .membrane = CIPC_MEMBRANE_NEO_HOOKEAN,
                                    .membrane_young = 1e5,
                                    .membrane_poisson = 0.3,
                                    .bending_young = 1e5,
                                    .bending_poisson = 0.3};
    d->material = material;
    d->node_count = nodes;
    d->triangle_count = triangles;
    d->rest = copy_of(rest, 3 * (size_t)nodes * sizeof *rest);
    d->position = copy_of(rest, 3 * (size_t)nodes * sizeof *rest);
    d->velocity = copy_of(NULL, 3 * (size_t)nodes * sizeof *rest);
    d->triangles = copy_of(triangle, (size_t)triangles * sizeof *triangle);
    return d;
}

cipc_body_description *sheet_add_grid(sheet_scene *scene, const char *name, const double corner[3], const double u[3], const double v[3],
                                      int nx, int ny)
{
    int nodes = (nx + 1) * (ny + 1), cells = 0;
    double *rest = malloc(3 * (size_t)nodes * sizeof *rest);
    int(*triangle)[3] = malloc(2 * (size_t)(nx * ny) * sizeof *triangle);
    assert_true(rest && triangle);
    for (int j = 0; j <= ny; j++)
        for (int i = 0; i <= nx; i++)
            for (int k = 0; k < 3; k++) rest[3 * (j * (nx + 1) + i) + k] = corner[k] + u[k] * i / nx + v[k] * j / ny;
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++, cells++) {
            int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
            const int two[2][3] = {{a, b, d}, {a, d, c}};
            memcpy(triangle[2 * (size_t)cells], two, sizeof two);
        }
    cipc_body_description *body = sheet_add_body(scene, name, nodes, rest, 2 * cells, (const int(*)[3])triangle);
    free(rest);
    free(triangle);
    return body;
}

cipc_body_description *sheet_add_triangle(sheet_scene *scene, const char *name, const double a[3], const double b[3], const double c[3])
{
    static const int triangle[1][3] = {{0, 1, 2}};
    double rest[9];
    v3_copy(rest, a);
    v3_copy(rest + 3, b);
    v3_copy(rest + 6, c);
    return sheet_add_body(scene, name, 3, rest, 1, triangle);
}

void sheet_set_velocity(cipc_body_description *body, const double velocity[3])
{
    double *v = (double *)(uintptr_t)body->velocity;
    for (int i = 0; i < body->node_count; i++) v3_copy(v + 3 * i, velocity);
}

void sheet_scene_model(sheet_scene *scene)
{
    if (cipc_model_create(&scene->model, scene->bodies, scene->body_count, scene->gravity, &scene->error))
        fail_msg("model: %s", scene->error.what);
    if (cipc_state_create(&scene->state, scene->bodies, scene->body_count, &scene->error)) fail_msg("state: %s", scene->error.what);
}

void sheet_scene_stepper(sheet_scene *scene)
{
    cipc_stepper_destroy(scene->stepper);
    if (cipc_stepper_create(&scene->stepper, scene->model, &scene->options, &scene->error)) fail_msg("stepper: %s", scene->error.what);
}

void sheet_scene_build(sheet_scene *scene)
{
    sheet_scene_model(scene);
    sheet_scene_stepper(scene);
}

void sheet_hold(sheet_scene *scene, const int *nodes, int count, const cipc_motion *motion, double release)
{
    cipc_motion copy = {.end = 0};
    if (motion) copy = *motion;
    cipc_dirichlet_set set = {
        .node_count = count, .nodes = (int *)(uintptr_t)nodes, .release = release, .motion_count = motion ? 1 : 0, .motions = &copy};
    if (cipc_model_add_dirichlet(scene->model, &set, &scene->error)) fail_msg("dirichlet: %s", scene->error.what);
}

cipc_status sheet_try_step(sheet_scene *scene)
{
    memset(&scene->error, 0, sizeof scene->error);
    return cipc_step(scene->stepper, scene->state, &scene->report, &scene->error);
}

void sheet_step(sheet_scene *scene)
{
    if (sheet_try_step(scene)) fail_msg("%s: %s", scene->error.place, scene->error.what);
    assert_true(scene->report.converged);
}

void sheet_steps(sheet_scene *scene, int count)
{
    for (int i = 0; i < count; i++) sheet_step(scene);
}

static cipc_status look(void *context, const cipc_accepted_point *point, cipc_error *error)
{
    sheet_scene *scene = context;
    cipc_invariant_report seen;
    cipc_status status = cipc_monitor_check(scene->monitor, point->x, &seen, error);
    if (!status && point->energy_valid)
        scene->energy_rises += cipc_monitor_energy(point->energy_before, point->energy_after, point->energy_noise, NULL) != CIPC_OK;
    scene->accepted++;
    scene->min_gap = fmin(scene->min_gap, seen.min_gap);
    scene->max_stretch_ratio = fmax(scene->max_stretch_ratio, seen.max_stretch_ratio);
    return status;
}

void sheet_watch(sheet_scene *scene)
{
    cipc_invariant_options options = cipc_invariant_options_default();
    cipc_monitor_destroy(scene->monitor);
    assert_int_equal(cipc_monitor_create(&scene->monitor, scene->model, &options, &scene->error), CIPC_OK);
    scene->accepted = 0;
    scene->energy_rises = 0;
    scene->min_gap = INFINITY;
    scene->max_stretch_ratio = 0;
    cipc_stepper_set_monitor(scene->stepper, look, scene);
}

void sheet_begin(sheet_scene *scene)
{
    cipc_stepper *s = scene->stepper;
    const cipc_state *state = scene->state;
    size_t bytes = 3 * (size_t)state->node_count * sizeof(double);
    memset(&scene->report, 0, sizeof scene->report);
    s->report = &scene->report;
    memcpy(s->x_start, state->position, bytes);
    memcpy(s->x, state->position, bytes);
    for (int i = 0; i < 3 * state->node_count; i++) s->x_hat[i] = s->x[i] + s->options.time_step * state->velocity[i];
    s->kappa = s->options.barrier_stiffness > 0 ? s->options.barrier_stiffness : 1;
    s->strain_factor = state->strain_stiffness_factor;
    cipc_dirichlet_targets(s->model, s->x, state->time, s->options.time_step, s->is_dirichlet, s->target, s->moves);
    memcpy(s->passive, s->is_dirichlet, (size_t)state->node_count * sizeof(bool));
    cipc_number_free_nodes(s);
    s->cache.slack = 0;
    assert_int_equal(cipc_cache_cover(s, s->x, NULL, &scene->error), CIPC_OK);
    assert_int_equal(cipc_contacts_at(s, s->x, &s->contacts, &scene->error), CIPC_OK);
}

int sheet_same_bits(const double *a, const double *b, int count)
{
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}
