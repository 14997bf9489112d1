/* Inputs for ports: random and adversarial. */
#include <math.h>
#include <string.h>

#include "verify/conformance.h"
#include "verify/energies.h"
#include "verify/stencils.h"
#include "verify/two_triangles.h"

static void draw_scalar(const char *fn, gsl_rng *rng, cipc_query *q)
{
    if (strcmp(fn, "barrier") == 0) {
        q->x[1] = verify_log_uniform(rng, 1e-10, 1e-2);
        q->x[0] = q->x[1] * (verify_chance(rng, 0.2) ? verify_uniform(rng, 0.99, 1.1) : verify_log_uniform(rng, 1e-14, 1));
    } else if (strcmp(fn, "strain_limit_barrier") == 0) {
        q->x[2] = 1;
        q->x[1] = 1 + verify_log_uniform(rng, 1e-3, 0.3);
        q->x[0] = 1 + (q->x[1] - 1) * (verify_chance(rng, 0.2) ? -0.5 : 1 - verify_log_uniform(rng, 1e-6, 0.99));
    } else {
        q->x[1] = verify_log_uniform(rng, 1e-8, 1e-3);
        q->x[0] = q->x[1] * verify_log_uniform(rng, 1e-6, 10);
    }
}

/* A stencil of the kind as it lies, or moves. */
static void draw_path(gsl_rng *rng, cipc_pair_kind kind, cipc_stencil_path *path, double *xi)
{
    verify_shape s = verify_shape_default();
    s.thickness = verify_chance(rng, 0.5) ? 0 : verify_log_uniform(rng, 1e-4, 0.3);
    s.gap = verify_log_uniform(rng, verify_chance(rng, 0.3) ? 1e-12 : 1e-3, 0.5);
    s.angle = verify_chance(rng, 0.3) ? verify_log_uniform(rng, 1e-12, 1e-2) : verify_uniform(rng, 0.05, 1.5);
    s.foot = verify_chance(rng, 0.2) ? verify_log_uniform(rng, 1e-9, 1e-3) : 0;
    s.offset = verify_chance(rng, 0.2) ? verify_log_uniform(rng, 1, 1e4) : 0;
    s.approach = (s.gap + s.thickness) * verify_uniform(rng, 0.3, 3);
    s.slide = verify_chance(rng, 0.5) ? 0 : verify_uniform(rng, 0, 1);
    s.tumble = verify_chance(rng, 0.5) ? 0 : verify_uniform(rng, 0, 0.2);
    s.aligned = verify_chance(rng, 0.3);
    verify_place(rng, kind, &s, path);
    *xi = s.thickness;
    if (verify_chance(rng, 0.3)) { /* anything at all */
        for (int i = 0; i < 12; i++) {
            path->x[i] = verify_uniform(rng, -1, 1);
            path->p[i] = verify_uniform(rng, -2, 2);
        }
    }
}

static void draw_points(const char *fn, gsl_rng *rng, cipc_query *q)
{
    bool lattice = verify_chance(rng, 0.5);
    for (int i = 0; i < verify_query_numbers(fn); i++) q->x[i] = lattice ? verify_index(rng, 4) - 1 : verify_uniform(rng, -1, 1);
}

static void round_to_single(double *v, int n)
{
    for (int i = 0; i < n; i++) v[i] = (double)(float)v[i];
}

void verify_draw_query(const char *fn, gsl_rng *rng, long sample, bool single, cipc_query *q)
{
    cipc_pair_kind kind;
    cipc_stencil_path path;
    *q = (cipc_query){.fn = fn, .scale = 0.1};
    if (verify_query_kind(fn, "toi_", &kind)) {
        draw_path(rng, kind, &path, &q->thickness);
        memcpy(q->x, path.x, sizeof path.x);
        for (int i = 0; i < 12; i++) q->x1[i] = path.x[i] + path.p[i];
    } else if (verify_query_kind(fn, "distance2_", &kind)) {
        double none;
        draw_path(rng, kind, &path, &none);
        memcpy(q->x, path.x, sizeof path.x);
    } else if (verify_function_level(fn) == 2) {
        const cipc_energy *energy = cipc_energy_find(fn + 7);
        verify_params params;
        verify_row unused;
        verify_describe_branches(&unused, energy);
        verify_draw_energy(energy, rng, sample, &unused, q->x, &params, q);
    } else if (verify_function_level(fn) == 4) {
        verify_two_triangles_draw(rng, q);
    } else if (verify_function_level(fn) == 0) {
        draw_scalar(fn, rng, q);
    } else {
        draw_points(fn, rng, q);
    }
    if (!single) return;
    round_to_single(q->x, 18);
    round_to_single(q->rest, 18);
    round_to_single(q->x1, 12);
    round_to_single(q->params, CIPC_ENERGY_NUMBERS);
    round_to_single(&q->thickness, 1);
}
