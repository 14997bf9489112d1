/* The loop: a step ends where it says; states that are left and states that are taken up; starts that are too near; stalls, which tell the deepest pair and leave a state that can go on; out of
 * memory at every allocation of creation and of steps. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

static void start(asynchronous_scene *s, double speed)
{
    crowd_shape shape = crowd_shape_default();
    shape.speed = speed;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, 3);
    crowd_build(s, &shape);
}

static size_t size_of(const asynchronous_scene *s) { return 3 * (size_t)s->sheet.model->node_count * sizeof(double); }

static void assert_same_state(const asynchronous_scene *s, const asynchronous_scene *t)
{
    assert_memory_equal(s->sheet.state->position, t->sheet.state->position, size_of(s));
    assert_memory_equal(s->sheet.state->velocity, t->sheet.state->velocity, size_of(s));
    assert_true(s->sheet.state->time == t->sheet.state->time);
    assert_int_equal(s->sheet.state->step, t->sheet.state->step);
}

/* Time is (step + 1) frames, not a sum of frames. */
static void test_time(void **state)
{
    (void)state;
    const double x[3] = {0, 0, 0}, v[3] = {1, 0, 0};
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    s.options.frame = 0.1;
    asynchronous_add_particles(&s, "stone", 1, x, v, 1);
    asynchronous_scene_build(&s);
    for (int i = 1; i <= 1000; i++) {
        asynchronous_steps(&s, 1);
        assert_true(s.sheet.state->time == i * 0.1 && s.sheet.state->step == i);
        assert_true(fabs(s.sheet.state->position[0] - i * 0.1) < 1e-12);
    }
    asynchronous_scene_free(&s);
}

/* A state that ends after the step would is none that the step can go on from. */
static void test_time_does_not_go_back(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 1);
    asynchronous_steps(&s, 2);
    s.sheet.state->step = 1;
    const double before = s.sheet.state->position[1];
    assert_int_equal(asynchronous_try_step(&s), CIPC_E_OUT_OF_RANGE);
    assert_true(s.sheet.state->position[1] == before);
    asynchronous_scene_free(&s);
}

/* A state that somebody has changed is taken up; one that is as it was left is not, which is the same but for what it costs. */
static void test_taking_up(void **state)
{
    (void)state;
    asynchronous_scene left, taken, changed;
    start(&left, 1);
    start(&taken, 1);
    start(&changed, 1);
    for (int frame = 0; frame < 25; frame++) {
        taken.integrator->loaded = false;
        asynchronous_steps(&left, 1);
        asynchronous_steps(&taken, 1);
        assert_same_state(&left, &taken);
    }
    asynchronous_steps(&changed, 1);
    for (int i = 1; i < changed.sheet.model->node_count; i++) changed.sheet.state->velocity[3 * i] += changed.sheet.model->node_body[i] > 0;
    const double before = changed.sheet.state->position[3 * 4];
    asynchronous_steps(&changed, 1);
    assert_true(changed.sheet.state->position[3 * 4] - before > 0.9 * changed.options.frame);
    asynchronous_scene_free(&left);
    asynchronous_scene_free(&taken);
    asynchronous_scene_free(&changed);
}

static void test_initial_gap(void **state)
{
    (void)state;
    const double v[3] = {0};
    for (int touching = 0; touching < 2; touching++) {
        const double x[6] = {0, 0, 0, touching ? 0.01 : 0.01 + 1e-3 / 9, 0, 0}; /* eta(4095) = eta(1)/8 */
        asynchronous_scene s;
        asynchronous_scene_init(&s);
        asynchronous_add_particles(&s, "two", 2, x, v, 1);
        s.sheet.bodies[0].offset = 0.01;
        asynchronous_scene_build(&s);
        assert_int_equal(asynchronous_try_step(&s), CIPC_E_INITIAL_GAP);
        assert_non_null(strstr(s.error.what, "at the start"));
        s.sheet.state->position[3] = 1;
        asynchronous_steps(&s, 1);
        asynchronous_scene_free(&s);
    }
}

/* ---- Stalls ---- */

/* Too many events: the state is that of the instant, the error names the deepest pair; with more allowed the step ends near where it would have ended. */
static void test_event_limit(void **state)
{
    (void)state;
    asynchronous_scene s, reference;
    start(&s, 1);
    start(&reference, 1);
    asynchronous_steps(&reference, 14);
    asynchronous_steps(&s, 13);
    s.integrator->options.event_limit = 1500;
    const double begin = s.sheet.state->time;
    assert_int_equal(asynchronous_try_step(&s), CIPC_E_NO_PROGRESS);
    assert_true(s.report.total_events >= 1500 && s.report.total_events <= 1500 + 200);
    assert_int_equal(s.sheet.state->step, 13);
    assert_true(s.sheet.state->time > begin && s.sheet.state->time < reference.sheet.state->time);
    assert_non_null(strstr(s.error.place, "step 14, t = "));
    assert_non_null(strstr(s.error.what, "more than 1500 events"));
    assert_non_null(strstr(s.error.what, "the deepest pair is "));
    assert_non_null(strstr(s.error.what, " of nodes "));
    assert_non_null(strstr(s.error.remedy, "--resume"));
    for (int i = 0; i < 3 * s.sheet.model->node_count; i++) {
        const double passed = s.sheet.state->time - begin;
        assert_true(isfinite(s.sheet.state->velocity[i]) && fabs(s.sheet.state->position[i] - reference.sheet.state->position[i]) < 10 * (s.options.frame - passed) + 1e-9);
    }
    s.integrator->options.event_limit = 10000000;
    asynchronous_steps(&s, 1);
    assert_true(s.sheet.state->time == reference.sheet.state->time);
    for (int i = 0; i < 3 * s.sheet.model->node_count; i++) assert_true(fabs(s.sheet.state->position[i] - reference.sheet.state->position[i]) < 1e-9);
    asynchronous_scene_free(&s);
    asynchronous_scene_free(&reference);
}

/* Two scripted floors that close on a sheet between them: it ends in a stall, without a gap lost, and says where. */
static void test_impossible_squeeze(void **state)
{
    (void)state;
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    s.options.thickness = 0.01;
    s.options.frame = 0.01;
    s.options.event_limit = 2000000;
    const double low[3] = {-1, 0, -1}, high[3] = {-1, 0.1, -1}, u[3] = {0, 0, 2}, v[3] = {2, 0, 0}, a[3] = {-0.3, 0.05, -0.3}, b[3] = {0.3, 0.05, -0.2}, c[3] = {0, 0.05, 0.3};
    static const int held[4] = {4, 5, 6, 7};
    sheet_add_grid(&s.sheet, "floor", low, u, v, 1, 1)->fixed = true;
    sheet_add_grid(&s.sheet, "press", high, u, v, 1, 1);
    sheet_add_triangle(&s.sheet, "leaf", a, b, c);
    asynchronous_scene_model(&s);
    const cipc_motion down = {.end = INFINITY, .velocity = {0, -1, 0}};
    sheet_hold(&s.sheet, held, 4, &down, INFINITY);
    asynchronous_scene_start(&s);
    cipc_status status = CIPC_OK;
    while (!status && s.sheet.state->step < 20) status = asynchronous_try_step(&s);
    assert_int_equal(status, CIPC_E_NO_PROGRESS);
    const double press = s.sheet.state->position[3 * 4 + 1];
    for (int i = 8; i < 11; i++) assert_true(s.sheet.state->position[3 * i + 1] > 0 && s.sheet.state->position[3 * i + 1] < press);
    assert_true(press > 0 && press < 0.01);
    assert_true(s.report.layers > 50);
    assert_non_null(strstr(s.error.what, "\"leaf\""));
    asynchronous_scene_free(&s);
}

/* ---- Out of memory ---- */

static void test_out_of_memory_in_creation(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s, 1);
    long n = 1;
    for (;; n++) {
        cipc_asynchronous *integrator;
        cipc_error error;
        fail_allocation(n);
        const cipc_status status = cipc_asynchronous_create(&integrator, s.sheet.model, &s.options, &error);
        const bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        assert_int_equal(integrator == NULL, failed);
        if (failed) assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        cipc_asynchronous_destroy(integrator);
        if (!failed) break;
    }
    assert_true(n > 60);
    asynchronous_scene_free(&s);
}

static cipc_status ignore(void *context, const cipc_paths *paths, cipc_error *error)
{
    (void)context, (void)paths, (void)error;
    return CIPC_OK;
}

/* Wherever in a step memory ends, the status says so and the state is as it was; the same integrator then goes on from it as if nothing had happened. */
static void test_out_of_memory_in_steps(void **state)
{
    (void)state;
    enum { BEFORE = 13 };
    asynchronous_scene s, reference;
    start(&s, 1);
    start(&reference, 1);
    asynchronous_steps(&s, BEFORE);
    asynchronous_steps(&reference, BEFORE + 1);
    assert_true(reference.report.contacts > 0);
    double *position = cipc_alloc(1, size_of(&s)), *velocity = cipc_alloc(1, size_of(&s));
    memcpy(position, s.sheet.state->position, size_of(&s));
    memcpy(velocity, s.sheet.state->velocity, size_of(&s));
    long n = 1;
    for (;; n++) {
        memcpy(s.sheet.state->position, position, size_of(&s));
        memcpy(s.sheet.state->velocity, velocity, size_of(&s));
        s.sheet.state->time = BEFORE * s.options.frame;
        s.sheet.state->step = BEFORE;
        asynchronous_scene_start(&s);
        cipc_asynchronous_set_monitor(s.integrator, ignore, NULL);
        fail_allocation(n);
        const cipc_status status = asynchronous_try_step(&s);
        const bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(status, failed ? CIPC_E_OUT_OF_MEMORY : CIPC_OK);
        if (failed) assert_memory_equal(s.sheet.state->position, position, size_of(&s));
        if (failed) asynchronous_steps(&s, 1);
        assert_same_state(&s, &reference);
        if (!failed) break;
    }
    assert_true(n > 100);
    cipc_free(position);
    cipc_free(velocity);
    asynchronous_scene_free(&s);
    asynchronous_scene_free(&reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_time),
        cmocka_unit_test(test_time_does_not_go_back),
        cmocka_unit_test(test_taking_up),
        cmocka_unit_test(test_initial_gap),
        cmocka_unit_test(test_event_limit),
        cmocka_unit_test(test_impossible_squeeze),
        cmocka_unit_test(test_out_of_memory_in_creation),
        cmocka_unit_test(test_out_of_memory_in_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
