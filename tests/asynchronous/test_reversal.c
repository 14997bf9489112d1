/* Time reversal (SPEC T-A11): leapfrog undoes what it did when every clock's ticks come in reverse order. Sheets fly into each other and crumple; then all velocities are reversed, the clocks run
 * backwards, and they fly back to where they came from, but for rounding and what has become of it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "asynchronous/integrator.h"
#include "support/exact_geometry.h"
#include "support/asynchronous_scene.h"

enum { CELLS = 4, NODES = 2 * (CELLS + 1) * (CELLS + 1), FRAMES = 4 };
static const double frame = 0.04, forward = FRAMES * 0.04;

/* No gravity, whose clock ticks at frames and so at the turning, where one tick of two would be lost; bending so stiff that no hinge's step is cut to a frame, for the same reason. */
static void crumple_scene(asynchronous_scene *s, cipc_membrane_model membrane, double restitution)
{
    const double a[3] = {-0.2, 0, -0.2}, au[3] = {0.4, 0.02, 0}, av[3] = {0.03, 0, 0.4}, b[3] = {-0.13, 0.03, 0.05}, bu[3] = {0.3, 0.01, 0.02}, bv[3] = {0.02, 0.3, 0.01};
    asynchronous_scene_init(s);
    cipc_body_description *bodies[2] = {sheet_add_grid(&s->sheet, "lying", a, au, av, CELLS, CELLS), sheet_add_grid(&s->sheet, "edge-on", b, bu, bv, CELLS, CELLS)};
    for (int i = 0; i < 2; i++) {
        bodies[i]->material.membrane = membrane;
        bodies[i]->material.membrane_young = 2e4;
        bodies[i]->material.bending_young = 1e8;
    }
    sheet_set_velocity(bodies[0], (const double[3]){0.1, 1, 0});
    sheet_set_velocity(bodies[1], (const double[3]){0.3, -3, -0.5});
    s->options.frame = frame;
    s->options.thickness = 5e-3;
    s->options.restitution = restitution;
    s->options.clocks = CIPC_CLOCKS_OWN;
    asynchronous_scene_build(s);
    for (int c = 0; c < s->integrator->clock_count; c++) assert_true(s->integrator->clocks[c].h < 0.99 * frame);
}

typedef struct snapshot { double x[3 * NODES], v[3 * NODES]; } snapshot;

static snapshot take(const asynchronous_scene *s)
{
    snapshot r;
    memcpy(r.x, s->sheet.state->position, sizeof r.x);
    memcpy(r.v, s->sheet.state->velocity, sizeof r.v);
    return r;
}

static double largest(const double *a)
{
    double most = 0;
    for (int i = 0; i < 3 * NODES; i++) most = fmax(most, fabs(a[i]));
    return most;
}

static double apart(const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 3 * NODES; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Frames one by one; returns how often the busiest node was kicked. */
static long steps(asynchronous_scene *s, int count)
{
    long kicks = 0;
    for (int n = 0; n < count; n++) {
        long most = 0;
        asynchronous_steps(s, 1);
        for (int i = 0; i < NODES; i++) most = s->integrator->kicks[i] > most ? s->integrator->kicks[i] : most;
        kicks += most;
    }
    return kicks;
}

/* From the turning, with all velocities reversed and, if asked for, each number shaken by a part of the largest, until one frame before the start: there no clock ticks, as at the start all do. */
static long fly_back(asynchronous_scene *s, const snapshot *turning, double mirror, double shaken, snapshot *there)
{
    uint64_t random = 3;
    cipc_state *state = s->sheet.state;
    for (int i = 0; i < 3 * NODES; i++) {
        state->position[i] = turning->x[i] + random_uniform(&random, -shaken, shaken) * largest(turning->x);
        state->velocity[i] = -turning->v[i] + random_uniform(&random, -shaken, shaken) * largest(turning->v);
    }
    state->time = forward;
    state->step = FRAMES;
    s->options.mirror = mirror;
    asynchronous_scene_start(s);
    const long kicks = steps(s, FRAMES - 1);
    *there = take(s);
    for (int i = 0; i < 3 * NODES; i++) there->v[i] *= -1;
    return kicks;
}

/* How far the way back misses the state one frame after the start, x and v, over what rounding explains. Each of N kicks of a node rounds its position and its velocity by half a unit in the last
 * place, and what is off at the turning grows by a factor that is measured by shaking the turning; roundings on the way have less time to grow. */
static void reverse(cipc_membrane_model membrane, double restitution, double mirror, double over[2])
{
    static const double shaken = 0x1p-40;
    snapshot start, turning, back, shaken_back;
    asynchronous_scene s;
    crumple_scene(&s, membrane, restitution);
    long kicks = steps(&s, 1);
    start = take(&s);
    kicks += steps(&s, FRAMES - 1);
    turning = take(&s);
    assert_true(s.layers > 10 && s.events[CIPC_EVENT_PENALTY] > 2000);
    fly_back(&s, &turning, mirror, shaken, &shaken_back);
    kicks += fly_back(&s, &turning, mirror, 0, &back);
    const double off[2] = {apart(back.x, start.x), apart(back.v, start.v)}, growth[2] = {apart(shaken_back.x, back.x) / shaken, apart(shaken_back.v, back.v) / shaken};
    for (int k = 0; k < 2; k++) over[k] = off[k] / ((double)kicks * UNIT_ROUNDOFF * growth[k]);
    print_message("e = %g, %s: back to %.2g m, %.2g m/s; %ld kicks, shaken by 1e-16: %.2g m, %.2g m/s\n", restitution, mirror > 0 ? "mirrored" : "not mirrored", off[0], off[1], kicks, 1e-16 * growth[0],
                  1e-16 * growth[1]);
    asynchronous_scene_free(&s);
}

static void test_there_and_back(void **state)
{
    (void)state;
    const cipc_membrane_model membranes[2] = {CIPC_MEMBRANE_SPRINGS, CIPC_MEMBRANE_NEO_HOOKEAN};
    for (int m = 0; m < 2; m++) {
        double over[2];
        reverse(membranes[m], 1, 2 * forward, over);
        assert_true(over[0] <= 1 && over[1] <= 1);
    }
}

/* What must not come back: clocks that go on as they went, by which ticks fall elsewhere; impacts that lose energy. */
static void test_no_way_back(void **state)
{
    (void)state;
    static const double far = 1e4;
    double over[2];
    reverse(CIPC_MEMBRANE_SPRINGS, 1, 0, over);
    assert_true(over[0] > far && over[1] > far);
    reverse(CIPC_MEMBRANE_SPRINGS, 0.9, 2 * forward, over);
    assert_true(over[0] > far && over[1] > far);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_there_and_back),
        cmocka_unit_test(test_no_way_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
