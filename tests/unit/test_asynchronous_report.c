/* What a step reports: counts, the deepest contact, energies, quantiles of the steps of vertices; all of this step alone, and the same whether the state was left or taken up. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"

/* Two particles head on, with xi between them, in frames of a second. */
static void two_particles(asynchronous_scene *s, double speed)
{
    const double left[3] = {-1, 0, 0}, right[3] = {1, 0, 0}, to_the_right[3] = {speed, 0, 0}, to_the_left[3] = {-speed, 0, 0};
    asynchronous_scene_init(s);
    s->options.frame = 1;
    s->options.thickness = 0.1;
    s->options.stiffness = 1000;
    s->options.restitution = 1;
    asynchronous_add_particles(s, "left", 1, left, to_the_right, 2);
    asynchronous_add_particles(s, "right", 1, right, to_the_left, 2);
    for (int b = 0; b < 2; b++) s->sheet.bodies[b].offset = 0.2;
    asynchronous_scene_build(s);
}

static void test_contact(void **state)
{
    (void)state;
    asynchronous_scene s;
    two_particles(&s, 0.8);
    asynchronous_steps(&s, 1); /* 0.4 m apart: not yet */
    assert_int_equal(s.report.contacts + s.report.max_contacts + s.report.layers, 0);
    assert_int_equal(s.report.deepest.layers, 0);
    assert_int_equal(s.report.deepest.nodes[0], -1);
    assert_true(s.report.min_gap == INFINITY);
    assert_true(s.report.contact == 0 && fabs(s.report.kinetic - 2 * 0.5 * 2 * 0.64) < 1e-12);
    asynchronous_steps(&s, 1); /* there and back */
    assert_int_equal(s.report.contacts, 0);
    assert_int_equal(s.report.max_contacts, 1);
    assert_true(s.report.layers > 1 && s.report.activations == s.report.layers && s.report.deactivations == s.report.layers);
    assert_int_equal(s.report.deepest.layers, s.report.layers);
    assert_int_equal(s.report.deepest.kind, CIPC_POINT_POINT);
    const int nodes[4] = {0, 1, -1, -1};
    assert_memory_equal(s.report.deepest.nodes, nodes, sizeof nodes);
    assert_true(s.report.min_gap < cipc_layer_thickness(0.1, s.report.layers) && s.report.min_gap > cipc_layer_thickness(0.1, s.report.layers + 1));
    assert_true(fabs(s.report.deepest.gap - cipc_layer_thickness(0.1, s.report.layers)) < 1e-4);
    assert_true(fabs(s.report.deepest.step / cipc_layer_step(1000, 2, 0.025, s.report.layers) - 1) < 1e-12);
    assert_true(fabs(s.report.smallest_step / s.report.deepest.step - 1) < 1e-12);
    long sum = 0;
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) sum += s.report.events[k];
    assert_true(sum == s.report.total_events && s.report.events[CIPC_EVENT_PENALTY] > 50);
    asynchronous_steps(&s, 1); /* gone: nothing of it is left in the report */
    assert_int_equal(s.report.layers + s.report.max_contacts + s.report.deepest.layers, 0);
    assert_true(s.report.events[CIPC_EVENT_PENALTY] == 0 && s.report.min_gap == INFINITY && s.report.smallest_step == 1);
    asynchronous_scene_free(&s);
}

/* In contact the layers hold energy: with what is left of motion it is what there was. Kinetic energy is of the last kick, up to a step of the first layer ago, in which it
 * changes by a fraction omega h = 2 gamma at most. */
static void test_energies(void **state)
{
    (void)state;
    asynchronous_scene s;
    two_particles(&s, 0.65);
    const double all = 2 * 0.5 * 2 * 0.65 * 0.65;
    double most = 0;
    s.options.frame = 1.0 / 512;
    asynchronous_scene_start(&s);
    for (int i = 0; i < 1024; i++) {
        asynchronous_steps(&s, 1);
        assert_true(fabs(s.report.kinetic + s.report.contact - all) < 0.05 * all);
        most = fmax(most, s.report.contact);
    }
    assert_true(most > 0.8 * all);
    asynchronous_scene_free(&s);
}

/* Springs and gravity by hand: a segment twice as long as at rest, 5 m up. */
static void test_elastic_and_gravitational(void **state)
{
    (void)state;
    static const double rest[6] = {0, 0, 0, 1, 0, 0}, at[6] = {0, 5, 0, 2, 5, 0};
    static const int segment[1][2] = {{0, 1}};
    asynchronous_scene s;
    cipc_body_description body = {.name = "spring", .kind = CIPC_BODY_RODS, .node_count = 2, .rest = rest, .position = at, .segment_count = 1, .segments = segment};
    body.material = (cipc_material){.density = 1000, .thickness = 0.01, .young = 10};
    asynchronous_scene_init(&s);
    s.sheet.gravity[1] = -1;
    s.options.frame = 1e-6; /* hardly time to move */
    asynchronous_add_floor(&s, 0, 1); /* fixed: of no weight */
    sheet_add(&s.sheet, &body);
    asynchronous_scene_build(&s);
    asynchronous_steps(&s, 1);
    const double area = acos(-1) / 4 * 1e-4, mass = 1000 * area;
    assert_true(fabs(s.report.elastic / (0.5 * 10 * area) - 1) < 1e-6);
    assert_true(fabs(s.report.gravitational / (mass * 5) - 1) < 1e-6);
    asynchronous_scene_free(&s);
}

/* Frame by the number of instants with a kick, least first; a node that nothing kicks counts as one with a step of a frame. */
static void test_steps_of_vertices(void **state)
{
    (void)state;
    const double x[12] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, v[3] = {0};
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    s.options.frame = 1;
    s.options.gravity_step = 1.0 / 16;
    asynchronous_add_particles(&s, "four", 4, x, v, 1);
    asynchronous_scene_model(&s);
    for (int i = 1; i < 4; i++) {
        int node[1] = {i};
        const cipc_load load = {.node_count = 1, .nodes = node, .force = {1, 0, 0}, .begin = 0, .end = i / 4.0};
        assert_int_equal(cipc_model_add_load(s.sheet.model, &load, &s.error), CIPC_OK); /* 3, 7, 11 ticks */
    }
    asynchronous_scene_start(&s);
    asynchronous_steps(&s, 1);
    const double *q = s.report.vertex_steps;
    assert_true(q[0] == 1.0 / 11 && q[6] == 1 && q[3] == 1.0 / 3); /* least, greatest, the third of four */
    for (int i = 1; i < CIPC_QUANTILES; i++) assert_true(q[i] >= q[i - 1]);
    asynchronous_scene_free(&s);
}

/* All numbers of a frame but times and the certificates' come out the same if the state is taken up by another integrator. */
static void test_taken_up_states_report_the_same(void **state)
{
    (void)state;
    const crowd_shape shape = crowd_shape_default();
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    crowd_add(&s, &shape, 1);
    s.sheet.gravity[1] = 0;
    s.options.restitution = 0.8; /* grains fly off, which nothing kicks for a while */
    crowd_build(&s, &shape);
    int contacts = 0;
    for (int frame = 0; frame < 30; frame++) {
        cipc_asynchronous *other;
        cipc_asynchronous_report report;
        cipc_state copy = *s.sheet.state;
        const size_t size = 3 * (size_t)copy.node_count;
        copy.position = cipc_alloc(size, sizeof(double));
        copy.velocity = cipc_alloc(size, sizeof(double));
        memcpy(copy.position, s.sheet.state->position, size * sizeof(double));
        memcpy(copy.velocity, s.sheet.state->velocity, size * sizeof(double));
        assert_int_equal(cipc_asynchronous_create(&other, s.sheet.model, &s.options, NULL), CIPC_OK);
        assert_int_equal(cipc_asynchronous_step(other, &copy, &report, NULL), CIPC_OK);
        asynchronous_steps(&s, 1);
        for (int k = 0; k < CIPC_EVENT_IDLE; k++) assert_int_equal(report.events[k], s.report.events[k]);
        assert_true(report.kinetic == s.report.kinetic && report.elastic == s.report.elastic && report.gravitational == s.report.gravitational);
        assert_true(fabs(report.contact - s.report.contact) <= 1e-12 * s.report.contact); /* summed in another order */
        assert_memory_equal(report.vertex_steps, s.report.vertex_steps, sizeof report.vertex_steps);
        contacts += s.report.contacts;
        cipc_asynchronous_destroy(other);
        cipc_free(copy.position);
        cipc_free(copy.velocity);
    }
    assert_true(contacts > 0);
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_contact),
        cmocka_unit_test(test_energies),
        cmocka_unit_test(test_elastic_and_gravitational),
        cmocka_unit_test(test_steps_of_vertices),
        cmocka_unit_test(test_taken_up_states_report_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
