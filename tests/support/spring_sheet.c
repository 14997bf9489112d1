#include "support/spring_sheet.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_rng.h>

static double *numbers(int count)
{
    double *p = calloc((size_t)count, sizeof *p);
    assert_non_null(p);
    return p;
}

static void make_model(spring_sheet *s, double surface_density)
{
    cipc_body_description body = {.name = "sheet", .kind = CIPC_BODY_SHELL};
    body.material.density = surface_density / 1e-3;
    body.material.thickness = 1e-3;
    body.material.membrane = CIPC_MEMBRANE_SPRINGS;
    body.material.membrane_young = 1;
    body.node_count = s->node_count;
    body.rest = body.position = s->mesh.nodes;
    body.triangle_count = s->mesh.triangle_count;
    body.triangles = (const int(*)[3])s->mesh.triangles;
    cipc_error error;
    if (cipc_model_create(&s->model, &body, 1, (const double[3]){0, 0, 0}, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
}

void spring_sheet_init(spring_sheet *s, double d, int columns, int rows, double surface_density, const cipc_spring *spring, double bending)
{
    *s = (spring_sheet){0};
    assert_int_equal(cipc_mesh_equilateral(&s->mesh, d, columns, rows, NULL), CIPC_OK);
    s->node_count = s->mesh.node_count;
    make_model(s, surface_density);
    assert_int_equal(massspring_topology_create(&s->topology, s->model, 0, NULL), CIPC_OK);
    s->springs = calloc((size_t)s->topology.count, sizeof *s->springs);
    assert_non_null(s->springs);
    for (int i = 0; i < s->topology.count; i++) {
        s->springs[i] = *spring;
        s->springs[i].length = s->topology.lengths[i];
        if (i >= s->topology.structural_count) s->springs[i].stiffness *= bending;
        if (i >= s->topology.structural_count) s->springs[i].damping *= bending;
    }
    s->x = numbers(3 * s->node_count);
    s->v = numbers(3 * s->node_count);
    s->force = numbers(3 * s->node_count);
    s->mass = numbers(s->node_count);
    s->inverse_mass = numbers(s->node_count);
    memcpy(s->x, s->mesh.nodes, 3 * (size_t)s->node_count * sizeof *s->x);
    for (int i = 0; i < s->node_count; i++) {
        s->mass[i] = s->model->mass[i];
        s->inverse_mass[i] = 1 / s->mass[i];
    }
}

void spring_sheet_free(spring_sheet *s)
{
    cipc_mesh_free(&s->mesh);
    cipc_model_destroy(s->model);
    massspring_topology_free(&s->topology);
    free(s->springs);
    free(s->x);
    free(s->v);
    free(s->force);
    free(s->mass);
    free(s->inverse_mass);
}

static void pick(double six[6], const int ends[2], const double *values)
{
    memcpy(six, values + 3 * ends[0], 3 * sizeof *six);
    memcpy(six + 3, values + 3 * ends[1], 3 * sizeof *six);
}

void spring_sheet_crumple(spring_sheet *s, unsigned long seed, double by)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    gsl_rng_set(rng, seed);
    for (int i = 0; i < 3 * s->node_count; i++) {
        s->x[i] += by * (2 * gsl_rng_uniform(rng) - 1);
        s->v[i] = 2 * gsl_rng_uniform(rng) - 1;
    }
    for (int i = 0; i < s->node_count; i++) {
        s->mass[i] *= 0.5 + gsl_rng_uniform(rng);
        s->inverse_mass[i] = 1 / s->mass[i];
    }
    gsl_rng_free(rng);
}

void spring_sheet_forces(spring_sheet *s)
{
    for (int i = 0; i < 3 * s->node_count; i++) s->force[i] = s->mass[i / 3] * s->gravity[i % 3];
    for (int i = 0; i < s->topology.count; i++) {
        const int *ends = s->topology.ends[i];
        double x[6], v[6], f[3];
        pick(x, ends, s->x);
        pick(v, ends, s->v);
        cipc_spring_force(&s->springs[i], x, v, f);
        for (int k = 0; k < 3; k++) {
            s->force[3 * ends[0] + k] += f[k];
            s->force[3 * ends[1] + k] -= f[k];
        }
    }
}

void spring_sheet_step(spring_sheet *s)
{
    spring_sheet_forces(s);
    for (int i = 0; i < 3 * s->node_count; i++) {
        if (!(s->inverse_mass[i / 3] > 0)) continue;
        s->v[i] = (s->v[i] + s->step * s->inverse_mass[i / 3] * s->force[i]) / (1 + s->step * s->drag);
        s->x[i] += s->step * s->v[i];
    }
}

double spring_sheet_residual(const spring_sheet *s)
{
    double most = 0;
    for (int i = 0; i < 3 * s->node_count; i++)
        if (s->inverse_mass[i / 3] > 0) most = fmax(most, fabs(s->force[i]));
    return most;
}

int spring_sheet_settle(spring_sheet *s, double residual, int steps_max)
{
    for (int n = 1; n <= steps_max; n++) {
        spring_sheet_step(s);
        if (spring_sheet_residual(s) <= residual) return n;
    }
    fail_msg("not at rest after %d steps: %g N", steps_max, spring_sheet_residual(s));
    return steps_max;
}
