/* What acts from outside: gravity and its exactly constant energy (SPEC A.2), loads while their windows are open, prescribed motion to and fro, about an axis and along tracks, nodes that are
 * released, and those that are fixed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_scene.h"

static const double G = 9.81;

/* Particles in a row, far apart, which nothing else acts on. */
static void start(asynchronous_scene *s, int count, double gravity)
{
    double x[30];
    const double v[3] = {0};
    for (int i = 0; i < count; i++) {
        const double p[3] = {i, 0, 0};
        v3_copy(x + 3 * i, p);
    }
    asynchronous_scene_init(s);
    s->sheet.gravity[1] = -gravity;
    s->options.frame = 0.25;
    asynchronous_add_particles(s, "stones", count, x, v, 2);
    asynchronous_scene_model(s);
}

static const double *position(const asynchronous_scene *s, int node) { return s->sheet.state->position + 3 * node; }
static const double *velocity(const asynchronous_scene *s, int node) { return s->sheet.state->velocity + 3 * node; }

/* ---- Gravity ---- */

/* The step is the longest of frame/2^k that is not longer than asked for; by default a sixteenth of the frame. */
static void test_steps(void **state)
{
    (void)state;
    static const struct { double asked, gravity, script; } cases[] = {{0, 1.0 / 64, 0.25}, {0.25, 0.25, 0.25}, {9, 0.25, 0.25}, {0.2, 0.125, 0.125}, {0.01, 1.0 / 128, 1.0 / 128}};
    asynchronous_scene s;
    start(&s, 1, G);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        s.options.gravity_step = s.options.script_step = cases[i].asked;
        asynchronous_scene_start(&s);
        assert_true(s.integrator->gravity_step == cases[i].gravity && s.integrator->script_step == cases[i].script);
    }
    asynchronous_scene_free(&s);
}

/* From rest E = m g^2 h^2/8 with velocities in the middle of kicks, at every frame and not only in the mean. */
static void test_energy_of_a_fall(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 1, G);
    asynchronous_scene_start(&s);
    const double h = s.integrator->gravity_step, want = 2 * G * G * h * h / 8;
    for (int i = 0; i < 200; i++) {
        asynchronous_steps(&s, 1);
        assert_true(fabs(s.report.kinetic + s.report.gravitational - want) <= 1e-13 * s.report.kinetic);
        assert_int_equal(s.report.events[CIPC_EVENT_GRAVITY], 16);
    }
    assert_true(s.report.smallest_step == h);
    asynchronous_scene_free(&s);
}

static void test_nothing_to_do_is_nothing_done(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 1, 0);
    asynchronous_scene_start(&s);
    asynchronous_steps(&s, 4);
    assert_int_equal(s.events[CIPC_EVENT_GRAVITY], 0);
    assert_int_equal(s.events[CIPC_EVENT_SCRIPT], 0);
    asynchronous_scene_free(&s);
}

/* ---- Loads ---- */

static void load(asynchronous_scene *s, int node, double force, double begin, double end)
{
    int nodes[1] = {node};
    const cipc_load l = {.node_count = 1, .nodes = nodes, .force = {force, 0, 0}, .begin = begin, .end = end};
    assert_int_equal(cipc_model_add_load(s->sheet.model, &l, &s->error), CIPC_OK);
}

/* F h/m at each tick from the window's begin on and before its end; several add up; gravity besides. */
static void test_loads(void **state)
{
    (void)state;
    for (int gravity = 0; gravity < 2; gravity++) {
        asynchronous_scene s;
        start(&s, 4, gravity * G);
        s.options.gravity_step = 1.0 / 32;
        load(&s, 1, 4, 0, INFINITY);
        load(&s, 2, 4, 0.5, 0.75); /* ticks at 16/32 to 23/32 */
        load(&s, 3, 4, 0, 0.5);
        load(&s, 3, 2, 0.25, 1);
        asynchronous_scene_start(&s);
        asynchronous_steps(&s, 4);
        const double per_tick = 4 / 2.0 / 32;
        assert_true(velocity(&s, 0)[0] == 0);
        assert_true(velocity(&s, 1)[0] == 32 * per_tick);
        assert_true(velocity(&s, 2)[0] == 8 * per_tick);
        assert_true(velocity(&s, 3)[0] == 15 * per_tick + 24 * per_tick / 2); /* ticks 1 to 15 and 8 to 31 */
        for (int i = 0; i < 4; i++) assert_true(fabs(velocity(&s, i)[1] + gravity * G) < 1e-12);
        asynchronous_scene_free(&s);
    }
}

/* ---- Prescribed motion ---- */

/* Straight: where the script has it at every tick of the script, with the script's velocity between; gravity and loads do nothing to it. */
static void test_straight_motion(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 2, G);
    const int node[1] = {1};
    const cipc_motion motion = {.begin = 0.5, .end = 1, .velocity = {0, 3, 0}};
    sheet_hold(&s.sheet, node, 1, &motion, INFINITY);
    load(&s, 1, 10, 0, INFINITY);
    asynchronous_scene_start(&s);
    static const double height[] = {0, 0, 0.75, 1.5, 1.5, 1.5};
    for (int i = 0; i < 6; i++) {
        asynchronous_steps(&s, 1);
        const double want[3] = {1, height[i], 0};
        assert_memory_equal(position(&s, 1), want, sizeof want);
        assert_true(velocity(&s, 1)[0] == 0);
        assert_int_equal(s.report.events[CIPC_EVENT_SCRIPT], 1);
    }
    asynchronous_scene_free(&s);
}

/* About an axis: on the circle at every tick of the script, on its chords between. */
static void test_rotation(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 3, G);
    const int nodes[2] = {1, 2};
    const double omega = 2, step = 1.0 / 32;
    const cipc_motion motion = {.end = INFINITY, .axis = {0, 0, 1}, .angular_velocity = omega};
    sheet_hold(&s.sheet, nodes, 2, &motion, INFINITY);
    s.options.script_step = step;
    asynchronous_scene_start(&s);
    for (int i = 1; i <= 40; i++) {
        asynchronous_steps(&s, 1);
        const double angle = omega * s.sheet.state->time;
        for (int node = 1; node < 3; node++) {
            const double want[3] = {node * cos(angle), node * sin(angle), 0};
            for (int k = 0; k < 3; k++) assert_true(fabs(position(&s, node)[k] - want[k]) < 1e-12 * i);
        }
        const double chord = 2 * sin(omega * step / 2) / step; /* speed at radius 1 */
        assert_true(fabs(v3_norm(velocity(&s, 2)) - 2 * chord) < 1e-9);
        assert_int_equal(s.report.events[CIPC_EVENT_SCRIPT], 8);
    }
    asynchronous_scene_free(&s);
}

/* A released node goes on with the velocity that it had, and falls from then on. */
static void test_release(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 2, 1);
    const int node[1] = {1};
    const cipc_motion motion = {.end = INFINITY, .velocity = {0, 3, 0}};
    sheet_hold(&s.sheet, node, 1, &motion, 1);
    asynchronous_scene_start(&s);
    asynchronous_steps(&s, 4);
    assert_true(position(&s, 1)[1] == 3 && velocity(&s, 1)[1] == 3 - 1.0 / 64); /* at 1 s, released just before that instant's tick of gravity */
    assert_true(s.integrator->nodes[1].inverse_mass > 0);
    asynchronous_steps(&s, 4);
    assert_true(fabs(velocity(&s, 1)[1] - (2 - 1.0 / 64)) < 1e-12);
    assert_true(fabs(position(&s, 1)[1] - (3 + 3 - 0.5)) < 1.0 / 64); /* but for the ticks' g h t/2 */
    asynchronous_scene_free(&s);
}

/* A node is held from rest: whatever velocity the state gave it, it does not move. */
static void test_fixed(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 2, G);
    const int node[1] = {1};
    const double want[3] = {1, 0, 0}, fast[3] = {5, 5, 5};
    sheet_hold(&s.sheet, node, 1, NULL, INFINITY);
    asynchronous_scene_start(&s);
    v3_copy(s.sheet.state->velocity + 3, fast);
    asynchronous_steps(&s, 3);
    assert_memory_equal(position(&s, 1), want, sizeof want);
    assert_true(v3_norm(velocity(&s, 1)) == 0);
    asynchronous_scene_free(&s);
}

/* Along a track the node is at each frame of it when its time comes. */
static void test_track(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 2, G);
    int node[1] = {1};
    double frames[9] = {1, 0, 0, 1, 2, 0, 3, 2, 1};
    cipc_dirichlet_set set = {.node_count = 1, .nodes = node, .release = INFINITY, .track = {.frame_count = 3, .begin = 0.5, .interval = 0.5, .frames = frames}};
    assert_int_equal(cipc_model_add_dirichlet(s.sheet.model, &set, &s.error), CIPC_OK);
    asynchronous_scene_start(&s);
    for (int i = 1; i <= 8; i++) {
        asynchronous_steps(&s, 1);
        const int frame = i < 2 ? 0 : i > 6 ? 2 : (i - 2) / 2;
        if (i % 2 == 0 || i < 2 || i > 6)
            for (int k = 0; k < 3; k++) assert_true(fabs(position(&s, 1)[k] - frames[3 * frame + k]) < 1e-14);
    }
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps), cmocka_unit_test(test_energy_of_a_fall), cmocka_unit_test(test_nothing_to_do_is_nothing_done),
        cmocka_unit_test(test_loads), cmocka_unit_test(test_straight_motion),  cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_release), cmocka_unit_test(test_fixed),          cmocka_unit_test(test_track),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
