/* Cloth of any kind thrown at any bodies, in any wind, by any law: positions stay finite, no node is in a body after any frame, the bound on deformation holds or it is said that it does not. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_rng.h>

#include "cipc/massspring.h"
#include "cipc/scene.h"
#include "support/sheet_scene.h"

enum { TRIALS = 400, FRAMES = 20, BODIES = 4 };

typedef struct trial {
    gsl_rng *rng;
    sheet_scene sheet;
    cipc_collider bodies[BODIES];
    int body_count;
    cipc_massspring_options options;
} trial;

static double between(trial *t, double a, double b) { return a + (b - a) * gsl_rng_uniform(t->rng); }
static double of_any_size(trial *t, double a, double b) { return a * pow(b / a, gsl_rng_uniform(t->rng)); }
static bool sometimes(trial *t, double part) { return gsl_rng_uniform(t->rng) < part; }
static int one_of(trial *t, int count) { return (int)gsl_rng_uniform_int(t->rng, (unsigned long)count); }

/* 0.3 to 0.6 m above the bodies' middle, falling, mostly aslant. */
static void make_cloth(trial *t)
{
    cipc_mesh mesh;
    const double edge = of_any_size(t, 5e-3, 0.1), at[3] = {between(t, -0.1, 0.1), between(t, 0.3, 0.6), between(t, -0.1, 0.1)};
    const double velocity[3] = {between(t, -1, 1) * of_any_size(t, 0.1, 30), -of_any_size(t, 0.1, 30), between(t, -1, 1) * of_any_size(t, 0.1, 30)};
    const int cells = 1 + one_of(t, 7);
    sheet_scene_init(&t->sheet);
    t->sheet.gravity[1] = -9.81;
    assert_int_equal(cipc_mesh_equilateral(&mesh, edge, cells, cells, NULL), CIPC_OK);
    for (int i = 0; i < 3 * mesh.node_count; i++) mesh.nodes[i] += at[i % 3];
    cipc_body_description *b = sheet_add_body(&t->sheet, "cloth", mesh.node_count, mesh.nodes, mesh.triangle_count, (const int(*)[3])mesh.triangles);
    b->material.membrane = CIPC_MEMBRANE_SPRINGS;
    b->material.membrane_young = of_any_size(t, 1e3, 1e6);
    b->material.membrane_poisson = 1.0 / 3;
    b->material.density = of_any_size(t, 50, 2000);
    b->material.thickness = of_any_size(t, 1e-4, 3e-3);
    b->material.bending_young = 0;
    b->material.damping_stiffness = sometimes(t, 0.3) ? 0 : of_any_size(t, 1e-6, 1e-2);
    sheet_set_velocity(b, velocity);
    cipc_mesh_free(&mesh);
    sheet_scene_model(&t->sheet);
}

static cipc_collider any_body(trial *t)
{
    cipc_collider c = {.kind = (cipc_collider_kind)one_of(t, 5), .friction = sometimes(t, 0.2) ? 0 : of_any_size(t, 0.01, 2)};
    for (int k = 0; k < 3; k++) {
        c.center[k] = between(t, -0.15, 0.15);
        c.half[k] = of_any_size(t, 5e-3, 0.15);
        c.axis[k] = c.kind == CIPC_COLLIDER_CAPSULE ? between(t, -0.15, 0.15) : k == 1;
    }
    if (c.kind == CIPC_COLLIDER_PLANE) {
        const double angle = between(t, -0.4, 0.4);
        c.axis[0] = sin(angle), c.axis[1] = cos(angle);
        c.center[1] = between(t, -0.5, -0.2);
    }
    return c;
}

static void any_options(trial *t)
{
    cipc_massspring_options *o = &t->options;
    *o = cipc_massspring_options_default();
    o->law = (cipc_friction_law)one_of(t, 5);
    o->bisection = sometimes(t, 0.5) ? CIPC_BISECTION_PLAIN : CIPC_BISECTION_IMPROVED;
    o->threshold = of_any_size(t, 1e-6, 1e-2);
    o->repulsion = sometimes(t, 0.4) ? 0 : of_any_size(t, 0.1, 1e3);
    o->deformation = sometimes(t, 0.3) ? 0 : of_any_size(t, 5e-3, 0.9);
    o->reading = sometimes(t, 0.2) ? CIPC_DEFORMATION_REST_LENGTH : CIPC_DEFORMATION_PROJECT;
    o->sweeps = sometimes(t, 0.2) ? 5 : 500;
    o->structural = sometimes(t, 0.3) ? CIPC_SPRING_TENSION : CIPC_SPRING_LINEAR;
    o->bending_form = sometimes(t, 0.3) ? CIPC_SPRING_BUCKLING : CIPC_SPRING_LINEAR;
    o->bending_stiffness = sometimes(t, 0.4) ? 0 : of_any_size(t, 1e-3, 10);
    o->buckling = of_any_size(t, 1e-9, 1e-6);
    o->wind_pressure = sometimes(t, 0.5) ? 0 : of_any_size(t, 0.01, 5);
    for (int k = 0; k < 3; k++) o->wind[k] = between(t, -30, 30);
    o->presliding = of_any_size(t, 1e-6, 1e-2);
    o->breakaway = between(t, 1, 3);
    o->damping_ratio = between(t, 0, 2);
    o->band = of_any_size(t, 1e-5, 0.1);
    if (o->repulsion > 0 && sometimes(t, 0.4)) {
        o->self_distance = of_any_size(t, 1e-3, 0.1);
        o->self_friction = between(t, 0, 1);
    }
}

/* Of all nodes and bodies, m. */
static double deepest(const trial *t)
{
    double least = INFINITY;
    for (int i = 0; i < t->sheet.model->node_count; i++)
        for (int c = 0; c < t->body_count; c++) least = fmin(least, cipc_collider_distance(&t->bodies[c], t->sheet.state->position + 3 * i, NULL));
    return least;
}

static double length_of(const double *x, const int edge[2])
{
    const double *a = x + 3 * edge[0], *b = x + 3 * edge[1];
    return hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
}

/* B of the mesh itself: from its edges and its shape at rest, and nothing that the integrator has. */
static double deformation(const trial *t)
{
    const cipc_model *m = t->sheet.model;
    double greatest = 0;
    for (int e = 0; e < m->edge_count; e++) greatest = fmax(greatest, fabs(length_of(t->sheet.state->position, m->edges[e]) / length_of(m->rest, m->edges[e]) - 1));
    return greatest;
}

typedef struct tally {
    long frames, hits, self_contacts, sweeps, beyond;
    int ran;
} tally;

static void look(const trial *t, int number, const cipc_massspring_report *r)
{
    const cipc_massspring_options *o = &t->options;
    const bool lengths_stay = !(o->deformation > 0) || o->reading == CIPC_DEFORMATION_PROJECT, bounded = o->deformation > 0 && lengths_stay && r->beyond_bound == 0;
    double farthest = 0;
    for (int i = 0; i < 3 * t->sheet.model->node_count; i++) farthest = fmax(farthest, fabs(t->sheet.state->position[i]));
    /* Either B comes from differences of coordinates, at rest and now: each length is off by a few units in their last place, here 8, of the shortest edge. */
    const double rounding = 8 * DBL_EPSILON * (farthest + 1) / 5e-3 * (1 + r->deformation);
    if (lengths_stay && !(fabs(deformation(t) - r->deformation) <= rounding)) fail_msg("trial %d: B is %.17g, reported %.17g", number, deformation(t), r->deformation);
    if (bounded && !(deformation(t) <= o->deformation * (1 + 1e-3) + rounding)) fail_msg("trial %d: B of the mesh is %.17g, Bmax %g", number, deformation(t), o->deformation);
    if (r->inside != 0) fail_msg("trial %d: %d nodes are said to be inside", number, r->inside);
    if (!(deepest(t) >= 0)) fail_msg("trial %d: a node is %g m inside of a body", number, -deepest(t));
    if (bounded && !(r->deformation <= o->deformation * (1 + 1e-3))) fail_msg("trial %d: B is %.17g, Bmax %g", number, r->deformation, o->deformation);
    if (!(r->kinetic < 1e6)) fail_msg("trial %d: %g J", number, r->kinetic);
}

static void run(trial *t, int number, tally *all)
{
    cipc_massspring *integrator;
    cipc_error error;
    cipc_massspring_report r;
    if (!(deepest(t) >= 0)) return; /* it must not begin in a body */
    const cipc_status status = cipc_massspring_create(&integrator, t->sheet.model, t->bodies, t->body_count, &t->options, &error);
    if (status != CIPC_OK) {
        assert_int_equal(status, CIPC_E_OUT_OF_RANGE); /* more substeps than anybody waits for */
        return;
    }
    all->ran++;
    for (int k = 0; k < FRAMES; k++) {
        if (cipc_massspring_step(integrator, t->sheet.state, &r, &error) != CIPC_OK) fail_msg("trial %d: %s", number, error.what);
        look(t, number, &r);
        all->frames++;
        all->hits += r.hits, all->self_contacts += r.self_contacts, all->sweeps += r.sweeps, all->beyond += r.beyond_bound;
        if (r.substeps > 2000) break;
    }
    cipc_massspring_destroy(integrator);
}

static void test_anything(void **state)
{
    (void)state;
    tally all = {0};
    for (int number = 0; number < TRIALS; number++) {
        trial t = {.rng = gsl_rng_alloc(gsl_rng_mt19937)};
        gsl_rng_set(t.rng, 100 + (unsigned long)number);
        make_cloth(&t);
        t.body_count = 1 + one_of(&t, BODIES);
        for (int c = 0; c < t.body_count; c++) t.bodies[c] = any_body(&t);
        any_options(&t);
        run(&t, number, &all);
        sheet_scene_free(&t.sheet);
        gsl_rng_free(t.rng);
    }
    print_message("%d trials, %ld frames, %ld ways cut, %ld pairs of cloth, %ld sweeps, %ld substeps beyond the bound\n", all.ran, all.frames, all.hits, all.self_contacts, all.sweeps, all.beyond);
    assert_true(all.ran > TRIALS / 2 && all.hits > 100000 && all.self_contacts > 100 && all.sweeps > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_anything)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
