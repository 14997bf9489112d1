/* Cloth against itself: nodes push each other apart, with the momentum of both kept; what springs join does not; sliding is slowed by what is pushed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include <gsl/gsl_rng.h>

#include "cipc/scene.h"
#include "massspring/stepper.h"
#include "support/failing_memory.h"
#include "support/sheet_scene.h"

static const double edge = 0.05, apart = 0.02;

typedef struct pair {
    sheet_scene sheet;
    cipc_massspring_options options;
    cipc_massspring *integrator;
    cipc_massspring_report report;
    cipc_error error;
    int half; /* nodes of one sheet */
} pair;

static void add_sheet(pair *p, const char *name, double height, const double velocity[3])
{
    cipc_mesh mesh;
    assert_int_equal(cipc_mesh_equilateral(&mesh, edge, 4, 4, NULL), CIPC_OK);
    for (int i = 0; i < mesh.node_count; i++) mesh.nodes[3 * i + 1] += height;
    cipc_body_description *b = sheet_add_body(&p->sheet, name, mesh.node_count, mesh.nodes, mesh.triangle_count, (const int(*)[3])mesh.triangles);
    b->material.membrane = CIPC_MEMBRANE_SPRINGS;
    b->material.membrane_young = 2e4;
    b->material.membrane_poisson = 1.0 / 3;
    b->material.density = 300;
    b->material.thickness = 1e-3;
    b->material.bending_young = 0;
    sheet_set_velocity(b, velocity);
    p->half = mesh.node_count;
    cipc_mesh_free(&mesh);
}

/* The upper sheet comes down on the lower one, node on node. */
static void start(pair *p, double sideways)
{
    const double down[3] = {sideways, -1, 0}, rest[3] = {0, 0, 0};
    *p = (pair){.options = cipc_massspring_options_default()};
    p->options.deformation = 0;
    p->options.repulsion = 50;
    p->options.self_distance = apart;
    p->options.step = 1e-4;
    sheet_scene_init(&p->sheet);
    add_sheet(p, "lower", 0, rest);
    add_sheet(p, "upper", 0.03, down);
    sheet_scene_model(&p->sheet);
}

static void run(pair *p, int steps)
{
    assert_int_equal(cipc_massspring_create(&p->integrator, p->sheet.model, NULL, 0, &p->options, &p->error), CIPC_OK);
    for (int i = 0; i < steps; i++) assert_int_equal(cipc_massspring_step(p->integrator, p->sheet.state, &p->report, &p->error), CIPC_OK);
}

static void finish(pair *p)
{
    cipc_massspring_destroy(p->integrator);
    sheet_scene_free(&p->sheet);
}

static double momentum(const pair *p, int first, int last, int axis)
{
    double sum = 0;
    for (int i = first; i < last; i++) sum += p->sheet.model->mass[i] * p->sheet.state->velocity[3 * i + axis];
    return sum;
}

/* Equal sheets exchange their momenta, to the last bits but for rounding; half springs are elastic, the scheme is off by some parts in a thousand. */
static void test_sheets_bounce(void **state)
{
    (void)state;
    pair p;
    start(&p, 0);
    const double before = momentum(&p, p.half, 2 * p.half, 1), x_before = momentum(&p, 0, 2 * p.half, 0);
    run(&p, 6);
    const double lower = momentum(&p, 0, p.half, 1), upper = momentum(&p, p.half, 2 * p.half, 1);
    assert_true(fabs(lower + upper - before) < 1e5 * DBL_EPSILON * fabs(before));
    assert_true(fabs(momentum(&p, 0, 2 * p.half, 0) - x_before) < 1e5 * DBL_EPSILON * fabs(before));
    assert_true(fabs(lower / before - 1) < 0.01 && fabs(upper / before) < 0.01);
    assert_int_equal(p.report.self_contacts, 0); /* parted again; edges, longer than `apart`, are no contacts */
    finish(&p);
}

/* Without, one passes through the other. */
static void test_it_is_asked_for(void **state)
{
    (void)state;
    pair p;
    start(&p, 0);
    p.options.self_distance = 0;
    run(&p, 6);
    assert_true(momentum(&p, 0, p.half, 1) == 0 && p.sheet.state->position[3 * p.half + 1] < -0.05);
    finish(&p);
}

/* What a spring joins does not push, however near. */
static void test_neighbours_are_left_alone(void **state)
{
    (void)state;
    const double distances[] = {1.2, 2.5}; /* edges; the nearest that no edge joins are sqrt(3) away, which is the second distance's affair: at rest they do not push */
    for (size_t k = 0; k < 2; k++) {
        pair p;
        start(&p, 0);
        p.options.self_distance = distances[k] * edge;
        p.options.frame = p.options.step;
        for (int i = p.half; i < 2 * p.half; i++) p.sheet.state->position[3 * i + 1] = 10;
        run(&p, 20);
        for (int i = 0; i < 3 * p.half; i++) assert_true(i % 3 == 1 || fabs(p.sheet.state->velocity[i]) < 1e-9); /* rounding of distances at rest: 1e-17 m of 50 N/m on 1e-3 kg in 2 ms, and its neighbours */
        p.sheet.state->position[0] += 0.3 * edge; /* a corner comes nearer to what it is joined to, which does not push; then to what it is not, 2 edges away at rest */
        assert_int_equal(cipc_massspring_step(p.integrator, p.sheet.state, &p.report, &p.error), CIPC_OK);
        assert_true(k == 1 || p.report.self_contacts == 0);
        p.sheet.state->position[0] += 0.6 * edge;
        assert_int_equal(cipc_massspring_step(p.integrator, p.sheet.state, &p.report, &p.error), CIPC_OK);
        assert_true(p.report.self_contacts > 0);
        finish(&p);
    }
}

/* The list of pairs that are near serves for many substeps; that changes no bit, against one made anew whenever it can be from here. It does serve: the sheets move less than its slack in a frame. */
static void test_the_list_shows_in_no_bit(void **state)
{
    (void)state;
    pair kept, anew;
    start(&kept, 0.3);
    start(&anew, 0.3);
    anew.options.frame = kept.options.frame /= 64;
    kept.options.self_distance = anew.options.self_distance = 0.07; /* several pairs at every node */
    kept.options.self_friction = anew.options.self_friction = 0.3;
    run(&kept, 0);
    run(&anew, 0);
    int served = 0, contacts = 0;
    for (int k = 0; k < 640; k++) {
        const double made_at = kept.integrator->near.at[3 * kept.half + 1];
        anew.integrator->near.made = false;
        assert_int_equal(cipc_massspring_step(kept.integrator, kept.sheet.state, &kept.report, &kept.error), CIPC_OK);
        assert_int_equal(cipc_massspring_step(anew.integrator, anew.sheet.state, &anew.report, &anew.error), CIPC_OK);
        served += kept.integrator->near.at[3 * kept.half + 1] == made_at;
        contacts += kept.report.self_contacts > 0;
        const size_t size = 3 * (size_t)kept.sheet.model->node_count * sizeof(double);
        assert_memory_equal(kept.sheet.state->position, anew.sheet.state->position, size);
        assert_memory_equal(kept.sheet.state->velocity, anew.sheet.state->velocity, size);
    }
    assert_true(served > 500 && served < 640 && contacts > 20);
    finish(&kept);
    finish(&anew);
}

/* Edges no longer than r that cross have ends nearer to each other than r/sqrt(2): what cloth needs to be kept apart by, against its edges passing through each other. */
static void test_crossing_edges_have_near_ends(void **state)
{
    (void)state;
    double greatest = 0;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 3);
    for (int k = 0; k < 1000000; k++) { /* through the origin, at an angle, each by a part of its length 1 */
        const double part[2] = {gsl_rng_uniform(rng), gsl_rng_uniform(rng)}, cosine = cos(M_PI * gsl_rng_uniform(rng));
        double least = INFINITY;
        for (int i = 0; i < 4; i++) {
            const double a = part[0] - i % 2, b = part[1] - i / 2;
            least = fmin(least, sqrt(a * a + b * b - 2 * a * b * cosine));
        }
        greatest = fmax(greatest, least);
    }
    gsl_rng_free(rng);
    assert_true(greatest <= M_SQRT1_2 && greatest > 0.7);
}

/* Sideways momentum that the lower sheet has after the impact. */
static double dragged(double mu, double *pushed)
{
    pair p;
    start(&p, 0.3);
    p.options.self_friction = mu;
    run(&p, 6);
    const double sideways = momentum(&p, 0, p.half, 0);
    *pushed = fabs(momentum(&p, 0, p.half, 1));
    finish(&p);
    return sideways;
}

/* Sheets that keep sliding rub mu times what is pushed, across the line between the nodes, which turns by a tenth or so while they slide past each other; without friction that turning alone acts. */
static void test_rubbing(void **state)
{
    (void)state;
    const double mu = 0.1;
    double pushed, unused;
    const double by_friction = dragged(mu, &pushed) - dragged(0, &unused);
    assert_true(by_friction > 0.9 * mu * pushed && by_friction < 1.1 * mu * pushed);
}

static void test_no_memory(void **state)
{
    (void)state;
    pair p;
    start(&p, 0);
    run(&p, 1);
    for (long n = 1;; n++) {
        fail_allocation(n);
        const cipc_status status = cipc_massspring_step(p.integrator, p.sheet.state, &p.report, &p.error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        if (n > 8) break; /* every substep allocates alike */
    }
    fail_allocation(0);
    finish(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sheets_bounce), cmocka_unit_test(test_it_is_asked_for), cmocka_unit_test(test_neighbours_are_left_alone), cmocka_unit_test(test_the_list_shows_in_no_bit),
        cmocka_unit_test(test_crossing_edges_have_near_ends), cmocka_unit_test(test_rubbing), cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
