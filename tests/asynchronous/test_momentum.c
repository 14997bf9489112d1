/* Momentum (SPEC A.2, T-A5): sheets that fly into each other, crumple and part, without anything from outside. Every tick gives its nodes impulses that add up to nothing, so that rounding alone
 * changes the sum: linear momentum with friction, restitution and damping; angular momentum without friction, which acts at two points some way apart (A.8). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "asynchronous/integrator.h"
#include "base/vector.h"
#include "support/asynchronous_scene.h"
#include "support/claim.h"

enum { CELLS = 6 };

typedef struct momenta { long double linear[3], angular[3], linear_size, angular_size; } momenta;

static momenta find_momenta(const asynchronous_scene *s)
{
    momenta p = {{0}, {0}, 0, 0};
    for (int i = 0; i < s->sheet.model->node_count; i++) {
        const double *x = s->sheet.state->position + 3 * i, *v = s->sheet.state->velocity + 3 * i, m = s->sheet.model->mass[i];
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            p.linear[k] += (long double)m * v[k];
            p.angular[k] += (long double)m * ((long double)x[a] * v[b] - (long double)x[b] * v[a]);
        }
        p.linear_size += (long double)m * v3_norm(v);
        p.angular_size += (long double)m * v3_norm(x) * v3_norm(v);
    }
    return p;
}

static double distance(const long double *a, const long double *b)
{
    long double sum = 0;
    for (int k = 0; k < 3; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return (double)sqrtl(sum);
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------------------------------ */

/* One sheet edge-on into the middle of another that lies askew; of springs or of neo-Hookean triangles. */
static void add_sheets(asynchronous_scene *s, cipc_membrane_model membrane)
{
    const double a[3] = {-0.2, 0, -0.2}, au[3] = {0.4, 0.02, 0}, av[3] = {0.03, 0, 0.4}, b[3] = {-0.13, 0.03, 0.05}, bu[3] = {0.3, 0.01, 0.02}, bv[3] = {0.02, 0.3, 0.01};
    cipc_body_description *bodies[2] = {sheet_add_grid(&s->sheet, "lying", a, au, av, CELLS, CELLS), sheet_add_grid(&s->sheet, "edge-on", b, bu, bv, CELLS, CELLS)};
    for (int i = 0; i < 2; i++) {
        bodies[i]->material.membrane = membrane;
        bodies[i]->material.membrane_young = 2e4;
        bodies[i]->material.bending_young = 2e4;
        bodies[i]->material.damping_stiffness = 1e-3;
    }
    sheet_set_velocity(bodies[0], (const double[3]){0.1, 1, 0});
    sheet_set_velocity(bodies[1], (const double[3]){0.3, -3, -0.5});
}

/* A strand and a block that fly at each other through a row of particles, some of which meet head-on. */
static void add_strand_block_and_particles(asynchronous_scene *s)
{
    enum { JOINTS = 9, BALLS = 4 };
    static const int segments[JOINTS - 1][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 8}}, tetrahedron[1][4] = {{0, 1, 2, 3}};
    double strand[3 * JOINTS], left[3 * BALLS], right[3 * BALLS];
    const double block[12] = {-0.05, 0.1, -0.06, 0, 0.1, 0.08, 0.07, 0.1, -0.04, 0.01, 0.2, 0.01};
    for (int i = 0; i < JOINTS; i++) v3_copy(strand + 3 * i, (const double[3]){-0.2 + 0.05 * i, -0.03 - 0.002 * (i % 2), 0.01 * (i % 3)});
    for (int i = 0; i < BALLS; i++) {
        v3_copy(left + 3 * i, (const double[3]){-0.3, 0.02 * i, 0.003 * i});
        v3_copy(right + 3 * i, (const double[3]){0.3, 0.02 * i + 0.001, 0.003 * i + 0.001});
    }
    asynchronous_add_particles(s, "left", BALLS, left, (const double[3]){2, 0, 0}, 0.01);
    asynchronous_add_particles(s, "right", BALLS, right, (const double[3]){-2, 0, 0}, 0.015);
    const cipc_material soft = {.density = 800, .thickness = 5e-3, .young = 1e5, .poisson = 0.3, .bending_young = 1e6, .damping_stiffness = 1e-4};
    cipc_body_description rods = {.name = "strand", .kind = CIPC_BODY_RODS, .node_count = JOINTS, .rest = strand, .position = strand, .segment_count = JOINTS - 1, .segments = segments, .material = soft};
    cipc_body_description volume = {.name = "block", .kind = CIPC_BODY_VOLUME, .node_count = 4, .rest = block, .position = block, .tetrahedron_count = 1, .tetrahedra = tetrahedron, .material = soft};
    sheet_set_velocity(sheet_add(&s->sheet, &rods), (const double[3]){0, 0.6, 0});
    sheet_set_velocity(sheet_add(&s->sheet, &volume), (const double[3]){0, -0.4, 0.02});
}

static void start(asynchronous_scene *s, double friction, double restitution, double frame)
{
    for (int b = 0; b < s->sheet.body_count; b++) s->sheet.bodies[b].friction = friction;
    s->options.frame = frame;
    s->options.thickness = 5e-3;
    s->options.restitution = restitution;
    asynchronous_scene_build(s);
}

/* ---- Runs -------------------------------------------------------------------------------------------------------------------------------- */

/* Largest change at any frame, over the sum of all momenta's sizes; events until the end; which kinds of pairs were in contact. */
typedef struct change { double linear, angular; long events; bool met[4]; } change;

static void note_contacts(const asynchronous_scene *s, bool *met)
{
    const asynchronous_pairs *pairs = &s->integrator->pairs;
    for (int i = 0; i < pairs->live_count; i++) met[pairs->pair[pairs->live[i]].kind] = met[pairs->pair[pairs->live[i]].kind] || pairs->pair[pairs->live[i]].layers > 0;
}

static change run(asynchronous_scene *s, int frames, const char *what)
{
    change most = {0};
    const momenta before = find_momenta(s);
    for (int n = 0; n < frames; n++) {
        asynchronous_steps(s, 1);
        const momenta now = find_momenta(s);
        most.events += s->report.total_events;
        most.linear = fmax(most.linear, distance(now.linear, before.linear) / (double)now.linear_size);
        most.angular = fmax(most.angular, distance(now.angular, before.angular) / (double)now.angular_size);
        note_contacts(s, most.met);
    }
    print_message("%s: %ld events, %ld ticks of layers, %d layers deep; linear momentum changed by %.2g, angular by %.2g\n", what, most.events, s->events[CIPC_EVENT_PENALTY], s->layers, most.linear,
                  most.angular);
    asynchronous_scene_free(s);
    return most;
}

/* Every event rounds the momentum of its nodes; were all roundings of one sign and of the whole momentum, they would come to events * 2^-53 (SPEC T-A5). They are of either sign, and of a node's
 * momentum each: a walk of sqrt(events) such steps is still more than there can be. */
static double counted(const change *c, double part) { return part / ((double)c->events * 0x1p-53); }
static double walked(const change *c, double part) { return part / (sqrt((double)c->events) * 0x1p-53); }

static change crumple(cipc_membrane_model membrane, double friction, double restitution, const char *what)
{
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    add_sheets(&s, membrane);
    start(&s, friction, restitution, 0.01);
    return run(&s, 40, what);
}

static void test_crumpling(void **state)
{
    (void)state;
    const change springs = crumple(CIPC_MEMBRANE_SPRINGS, 0.3, 0.5, "springs, friction"), triangles = crumple(CIPC_MEMBRANE_NEO_HOOKEAN, 0.3, 0.5, "triangles, friction");
    const change smooth = crumple(CIPC_MEMBRANE_SPRINGS, 0, 0.5, "springs"), elastic = crumple(CIPC_MEMBRANE_NEO_HOOKEAN, 0, 1, "triangles, elastic impacts");
    const change *all[4] = {&springs, &triangles, &smooth, &elastic};
    double linear = 0, linear_walked = 0, angular = 0, angular_walked = 0, events = INFINITY;
    for (int i = 0; i < 4; i++) {
        assert_true(all[i]->met[CIPC_POINT_TRIANGLE] && all[i]->met[CIPC_EDGE_EDGE]);
        events = fmin(events, (double)all[i]->events);
        linear = fmax(linear, counted(all[i], all[i]->linear));
        linear_walked = fmax(linear_walked, walked(all[i], all[i]->linear));
        if (i >= 2) angular = fmax(angular, counted(all[i], all[i]->angular));
        if (i >= 2) angular_walked = fmax(angular_walked, walked(all[i], all[i]->angular));
    }
    /* With friction angular momentum is not kept, which also shows that the measure sees what it should. */
    assert_true(walked(&springs, springs.angular) > 1e6 && walked(&triangles, triangles.angular) > 1e6);
    claim_figure("A2", "crumpling sheets, four runs: events in each, least", events, "1", CLAIM_MORE, 1e5);
    claim_figure("A2", "change of linear momentum over events * 2^-53 of the sum of m |v|, largest", linear, "1", CLAIM_AT_MOST, 1);
    claim_figure("A2", "the same over sqrt(events) * 2^-53", linear_walked, "1", CLAIM_AT_MOST, 1);
    claim_figure("A2", "without friction: change of angular momentum over events * 2^-53 of the sum of m |x| |v|, largest", angular, "1", CLAIM_AT_MOST, 1);
    claim_figure("A2", "without friction: the same over sqrt(events) * 2^-53", angular_walked, "1", CLAIM_AT_MOST, 1);
}

static void test_every_kind_of_pair(void **state)
{
    (void)state;
    for (int rough = 0; rough < 2; rough++) {
        asynchronous_scene s;
        asynchronous_scene_init(&s);
        add_strand_block_and_particles(&s);
        start(&s, rough ? 0.3 : 0, rough ? 0.5 : 1, 5e-4); /* short frames, at whose ends short contacts are seen */
        const change c = run(&s, 600, rough ? "strand, block and particles, friction" : "strand, block and particles");
        for (int kind = 0; kind < 4; kind++) assert_true(c.met[kind]);
        assert_true(walked(&c, c.linear) <= 1);
        assert_true(rough ? walked(&c, c.angular) > 1e3 : walked(&c, c.angular) <= 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crumpling),
        cmocka_unit_test(test_every_kind_of_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
