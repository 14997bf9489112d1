/* The mass-spring integrator: its step is semi-implicit Euler, stable or refused; bodies are not entered; sliding cloth stops where Coulomb's law says; the bound on deformation holds. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/massspring.h"
#include "cipc/scene.h"
#include "support/sheet_scene.h"

static const double edge = 0.05, g = 9.81;

typedef struct cloth {
    sheet_scene sheet;
    cipc_massspring_options options;
    cipc_collider collider;
    int collider_count;
    cipc_massspring *integrator;
    cipc_massspring_report report;
    cipc_error error;
} cloth;

/* A sheet of equilateral triangles at a height, moving along x. */
static void start(cloth *c, double height, double speed)
{
    cipc_mesh mesh;
    *c = (cloth){.options = cipc_massspring_options_default()};
    sheet_scene_init(&c->sheet);
    c->sheet.gravity[1] = -g;
    assert_int_equal(cipc_mesh_equilateral(&mesh, edge, 6, 6, NULL), CIPC_OK);
    for (int i = 0; i < mesh.node_count; i++) mesh.nodes[3 * i + 1] += height;
    cipc_body_description *b = sheet_add_body(&c->sheet, "cloth", mesh.node_count, mesh.nodes, mesh.triangle_count, (const int(*)[3])mesh.triangles);
    b->material.membrane = CIPC_MEMBRANE_SPRINGS;
    b->material.membrane_young = 2e4;
    b->material.membrane_poisson = 1.0 / 3;
    b->material.density = 300;
    b->material.thickness = 1e-3;
    b->material.bending_young = 0;
    b->material.damping_stiffness = 1e-3;
    const double velocity[3] = {speed, 0, 0};
    sheet_set_velocity(b, velocity);
    cipc_mesh_free(&mesh);
    sheet_scene_model(&c->sheet);
}

static void build(cloth *c) { assert_int_equal(cipc_massspring_create(&c->integrator, c->sheet.model, &c->collider, c->collider_count, &c->options, &c->error), CIPC_OK); }

static void add_floor(cloth *c, double mu)
{
    c->collider = (cipc_collider){.kind = CIPC_COLLIDER_PLANE, .axis = {0, 1, 0}, .friction = mu};
    c->collider_count = 1;
}

static void finish(cloth *c)
{
    cipc_massspring_destroy(c->integrator);
    sheet_scene_free(&c->sheet);
}

static void steps(cloth *c, int count)
{
    for (int i = 0; i < count; i++) assert_int_equal(cipc_massspring_step(c->integrator, c->sheet.state, &c->report, &c->error), CIPC_OK);
}

/* v += h g, then x += h v: after n substeps the sheet has fallen by g h^2 n (n + 1)/2, all of it. */
static void test_free_fall(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    build(&c);
    steps(&c, 10);
    const double n = 10.0 * c.report.substeps, h = c.report.substep, fallen = g * h * h * n * (n + 1) / 2;
    for (int i = 0; i < c.sheet.model->node_count; i++) {
        assert_true(fabs(c.sheet.state->position[3 * i + 1] - (1 - fallen)) < 1e-12);
        assert_true(fabs(c.sheet.state->velocity[3 * i + 1] + g * n * h) < 1e-11);
    }
    assert_true(c.sheet.state->step == 10 && c.sheet.state->time == 10 * c.options.frame);
    finish(&c);
}

/* What is too long is divided, or refused with the longest that is not. */
static void test_long_steps(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    c.options.frame = 1;
    build(&c);
    steps(&c, 1);
    assert_true(c.report.substeps > 10 && fabs(c.report.substeps * c.report.substep - 1) < 1e-12);
    cipc_massspring_destroy(c.integrator);
    c.options.refuse = true;
    assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &c.options, &c.error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(c.error.what, "too long"));
    c.options.step = 1e-4;
    build(&c);
    steps(&c, 1);
    assert_int_equal(c.report.substeps, 10000);
    finish(&c);
}

/* A repulsion stiffer than the springs shortens the step, or a step is refused because of it; a sheet that lies on a ball by it stays where it is then. */
static void test_stiff_repulsion(void **state)
{
    (void)state;
    cloth c;
    start(&c, 0.1005, 0);
    c.collider = (cipc_collider){.kind = CIPC_COLLIDER_SPHERE, .half = {0.1}, .friction = 0.5};
    c.collider_count = 1;
    build(&c);
    steps(&c, 1);
    const int by_springs = c.report.substeps;
    cipc_massspring_destroy(c.integrator);
    c.options.repulsion = 3e4;
    build(&c);
    steps(&c, 20);
    assert_true(c.report.substeps > 2 * by_springs && c.report.kinetic < 0.1);
    cipc_massspring_destroy(c.integrator);
    c.options.step = c.options.frame / by_springs;
    c.options.refuse = true;
    assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, &c.collider, 1, &c.options, &c.error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(c.error.what, "repulsion"));
    finish(&c);
}

/* Light cloth in thick air brakes faster than its springs swing: that shortens the step as well, or the sheet would swing up in still air. */
static void test_wind_is_in_the_step(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    build(&c);
    steps(&c, 1);
    const int by_springs = c.report.substeps;
    cipc_massspring_destroy(c.integrator);
    c.options.wind_pressure = 2000; /* of 0.3 kg/m^2: 1/s 6667 */
    build(&c);
    steps(&c, 30);
    assert_true(c.report.substeps > 1.5 * by_springs);
    const double drag = 2000 / 0.3 * 1.1 * 1.1, h = c.options.frame / c.report.substeps;
    assert_true(h * drag < 2 * 0.8 && c.report.kinetic < 1e-6); /* it sinks at 1.5 mm/s */
    cipc_massspring_destroy(c.integrator);
    c.options.step = c.options.frame / by_springs;
    c.options.refuse = true;
    assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &c.options, &c.error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(c.error.what, "wind"));
    finish(&c);
}

/* Springs that give way for good let wind blow triangles up beyond what the step was chosen for: they do not count for more, or the sheet would tear itself to infinity. */
static void test_wind_on_plastic_cloth(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    c.options.wind_pressure = 140;
    c.options.wind[1] = 20, c.options.wind[2] = -21;
    c.options.deformation = 0.01;
    c.options.reading = CIPC_DEFORMATION_REST_LENGTH;
    c.sheet.model->bodies[0].material.damping_stiffness = 0;
    build(&c);
    double mass = 0;
    for (int i = 0; i < c.sheet.model->node_count; i++) mass += c.sheet.model->mass[i];
    for (int i = 0; i < 3 * c.sheet.model->node_count; i++) c.sheet.state->velocity[i] = i % 3 == 1 ? 0 : 100 * (c.sheet.state->position[i] - c.sheet.state->position[i % 3]); /* drawn out to many times its size */
    steps(&c, 5);
    for (int k = 0; k < 60; k++) {
        steps(&c, 1);
        assert_true(c.report.kinetic < 0.5 * mass * (20 * 20 + 21 * 21 + 50)); /* no faster than the wind, and gravity a little */
    }
    finish(&c);
}

/* A disc stands in front of a wall of air before a ball: of the way that ends in the ball, what is left ends in the disc, which the whole way passes through. No node may be left in there. */
static void test_a_cut_way_is_looked_at_again(void **state)
{
    (void)state;
    const cipc_collider bodies[2] = {{.kind = CIPC_COLLIDER_BOX, .center = {0, 0.5, 0}, .half = {1, 0.01, 1}, .friction = 0}, {.kind = CIPC_COLLIDER_SPHERE, .center = {0, -0.5, 0}, .half = {1}, .friction = 0}};
    for (int order = 0; order < 2; order++) {
        cloth c;
        start(&c, 0.52, 0);
        c.options.threshold = 0.05;
        c.options.deformation = 0;
        c.options.step = 1;
        c.options.frame = 1e-3;
        for (int i = 0; i < c.sheet.model->node_count; i++) c.sheet.state->velocity[3 * i + 1] = -1000; /* 1 m in a step, if springs allow */
        const cipc_collider both[2] = {bodies[order], bodies[1 - order]};
        assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, both, 2, &c.options, &c.error), CIPC_OK);
        steps(&c, 1);
        assert_true(c.report.hits > 0);
        for (int i = 0; i < c.sheet.model->node_count; i++)
            for (int k = 0; k < 2; k++) assert_true(cipc_collider_distance(&bodies[k], c.sheet.state->position + 3 * i, NULL) >= 0);
        finish(&c);
    }
}

/* More substeps than an int holds were once none at all, and the run ended well without a step. */
static void test_endless_frames_are_refused(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    c.options.step = 1e-30;
    assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &c.options, &c.error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(c.error.what, "substeps"));
    c.options.step = 0;
    const double moduli[] = {1e40, 1e200, 1e300, 1e307}; /* no step is found for the last: that is not for want of memory */
    for (size_t k = 0; k < sizeof moduli / sizeof *moduli; k++) {
        c.sheet.model->bodies[0].material.membrane_young = moduli[k];
        assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &c.options, &c.error), CIPC_E_OUT_OF_RANGE);
        assert_non_null(strstr(c.error.what, "substeps"));
    }
    finish(&c);
}

/* A sheet that slides on a floor: after v0^2/(2 mu g) it is at rest, up to what it sinks and to the displacement before sliding; with every law that has no memory of more. */
static void test_sliding_stops(void **state)
{
    (void)state;
    const double mu = 0.4, v0 = 1, way = v0 * v0 / (2 * mu * g);
    const cipc_friction_law laws[] = {CIPC_LAW_DAHL, CIPC_LAW_BIDIRECTIONAL, CIPC_LAW_CLAMPED};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++) {
        cloth c;
        start(&c, 0, v0);
        add_floor(&c, mu);
        c.options.law = laws[k];
        c.options.breakaway = 1;
        c.options.deformation = 0;
        c.options.step = 1e-4;
        build(&c);
        const double from = c.sheet.state->position[0];
        steps(&c, 40);
        const double gone = c.sheet.state->position[0] - from;
        print_message("%s: %.6g m, closed form %.6g m, reversals %ld\n", cipc_friction_law_name(laws[k]), gone, way, c.report.reversals);
        assert_true(fabs(gone - way) < 0.03 * way);
        assert_true(c.report.kinetic < 1e-6 && c.report.hits > 0 && c.report.arrivals == 0); /* it lies within the threshold all the time */
        for (int i = 0; i < c.sheet.model->node_count; i++) assert_true(c.sheet.state->position[3 * i + 1] >= 0);
        finish(&c);
    }
}

/* On a slope below mu: what memory is for. An explicit Coulomb force takes what sliding there was, not what is coming: h g sin(alpha), for ever. With memory and its differential term the sheet comes to
 * rest, to the last bits and without chatter: the clamped law, elastic below its bound, where sigma0 z is the load, R1 and R1s up to as far again beyond, since the load was put on at once. Dahl's own law has no
 * differential term: it swings on and creeps by it (D7). Root of the mean square of the speed over the second half of 4 s, and the way then. */
static void test_rest_on_a_slope(void **state)
{
    (void)state;
    const double mu = 0.4, slope = 0.2, presliding = 1e-4;
    const cipc_friction_law laws[] = {CIPC_LAW_COULOMB, CIPC_LAW_DAHL, CIPC_LAW_BIDIRECTIONAL, CIPC_LAW_BIDIRECTIONAL_SMOOTH, CIPC_LAW_CLAMPED};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++) {
        cloth c;
        start(&c, 0, 0);
        c.sheet.model->gravity[0] = g * sin(slope);
        c.sheet.model->gravity[1] = -g * cos(slope);
        add_floor(&c, mu);
        c.options.law = laws[k];
        c.options.breakaway = 1;
        c.options.presliding = presliding;
        build(&c);
        const double from = c.sheet.state->position[0], elastic = presliding * tan(slope) / mu;
        double sum = 0, mass = 0;
        for (int i = 0; i < c.sheet.model->node_count; i++) mass += c.sheet.model->mass[i];
        steps(&c, 120);
        for (int n = 0; n < 120; n++) {
            steps(&c, 1);
            sum += 2 * c.report.kinetic / mass;
        }
        const double rms = sqrt(sum / 120), gone = c.sheet.state->position[0] - from;
        print_message("%s: rms speed %.3g m/s, gone %.6g m, reversals in the last frame %ld\n", cipc_friction_law_name(laws[k]), rms, gone, c.report.reversals);
        const double creep = c.report.substep * g * sin(slope);
        if (laws[k] == CIPC_LAW_COULOMB) assert_true(fabs(rms / creep - 1) < 1e-9 && fabs(gone / (4 * creep) - 1) < 1e-3);
        else if (laws[k] == CIPC_LAW_DAHL) assert_true(rms < 0.1 * creep && gone < 1e-3);
        else assert_true(rms < 1e-12 && c.report.reversals == 0 && gone > (1 - 1e-6) * elastic && gone < 2 * elastic);
        if (laws[k] == CIPC_LAW_CLAMPED) assert_true(gone < (1 + 1e-6) * elastic);
        finish(&c);
    }
}

/* A ball: no node inside after any frame, B within its bound. */
static void test_cloth_on_a_ball(void **state)
{
    (void)state;
    cloth c;
    start(&c, 0.11, 0);
    c.collider = (cipc_collider){.kind = CIPC_COLLIDER_SPHERE, .half = {0.1}, .friction = 0.5};
    c.collider_count = 1;
    build(&c);
    long arrivals = 0;
    for (int k = 0; k < 60; k++) {
        steps(&c, 1);
        arrivals += c.report.arrivals;
        for (int i = 0; i < c.sheet.model->node_count; i++) assert_true(cipc_collider_distance(&c.collider, c.sheet.state->position + 3 * i, NULL) >= -2e-3);
        assert_true(c.report.deformation <= 0.1 * (1 + 1e-3) && c.report.beyond_bound == 0);
    }
    assert_true(c.report.contacts > 0 && arrivals > 0);
    finish(&c);
}

/* Bounded cloth is pulled into the ball that it hangs on, and out of it again: no node is inside after a step, where it would be stuck and gather speed; and the bound holds all the same.
 * Without enough sweeps the ball has the last word, and it is said how often the bound did not hold. */
static void test_the_bound_leaves_no_node_inside(void **state)
{
    (void)state;
    cloth c;
    start(&c, 0.12, 0);
    c.collider = (cipc_collider){.kind = CIPC_COLLIDER_SPHERE, .half = {0.1}, .friction = 1};
    c.collider_count = 1;
    c.options.deformation = 0.01;
    int sweeps = 0, beyond = 0;
    for (int few = 0; few < 2; few++) {
        c.options.sweeps = few ? 2 : 2000;
        build(&c);
        for (int k = 0; k < 60; k++) {
            steps(&c, 1);
            sweeps += c.report.sweeps;
            beyond += c.report.beyond_bound;
            assert_true(few || (c.report.beyond_bound == 0 && c.report.deformation <= 0.01 * (1 + 1e-3)));
            for (int i = 0; i < c.sheet.model->node_count; i++) assert_true(cipc_collider_distance(&c.collider, c.sheet.state->position + 3 * i, NULL) >= 0);
        }
        cipc_massspring_destroy(c.integrator);
    }
    c.integrator = NULL;
    assert_true(sweeps > 0 && beyond > 0);
    finish(&c);
}

/* A node in a body, as a caller may put it there, is told of: bisection begins inside and does not let it move. */
static void test_nodes_inside_are_told(void **state)
{
    (void)state;
    cloth c;
    start(&c, 0.5, 0);
    add_floor(&c, 0.3);
    build(&c);
    steps(&c, 1);
    assert_int_equal(c.report.inside, 0);
    c.options.deformation = 0;
    c.options.frame = 1e-6; /* too short for the springs to pull it out */
    cipc_massspring_destroy(c.integrator);
    build(&c);
    c.sheet.state->position[1] = c.sheet.state->position[4] = -0.01;
    steps(&c, 1);
    assert_int_equal(c.report.inside, 2);
    finish(&c);
}

static void test_refusals(void **state)
{
    (void)state;
    cloth c;
    start(&c, 1, 0);
    const double numbers[] = {-1, (double)NAN, (double)INFINITY};
    for (size_t k = 0; k < 3; k++) {
        cipc_massspring_options o = c.options;
        o.threshold = numbers[k];
        assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &o, &c.error), CIPC_E_OUT_OF_RANGE);
        assert_null(c.integrator);
    }
    c.sheet.model->bodies[0].material.membrane = CIPC_MEMBRANE_STVK;
    assert_int_equal(cipc_massspring_create(&c.integrator, c.sheet.model, NULL, 0, &c.options, &c.error), CIPC_E_WRONG_TYPE);
    finish(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_fall), cmocka_unit_test(test_long_steps), cmocka_unit_test(test_stiff_repulsion), cmocka_unit_test(test_endless_frames_are_refused), cmocka_unit_test(test_wind_is_in_the_step), cmocka_unit_test(test_wind_on_plastic_cloth), cmocka_unit_test(test_a_cut_way_is_looked_at_again),
        cmocka_unit_test(test_sliding_stops), cmocka_unit_test(test_rest_on_a_slope), cmocka_unit_test(test_cloth_on_a_ball),
        cmocka_unit_test(test_the_bound_leaves_no_node_inside), cmocka_unit_test(test_nodes_inside_are_told), cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
