/* A run goes on from a state as if it had never ended, with every law: what friction and lengthened springs remember is in the state. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/scene.h"
#include "support/failing_memory.h"

typedef struct trial {
    cipc_scene *scene;
    cipc_massspring *integrator;
} trial;

static void load(trial *t, const char *name, const char *override)
{
    const char *const overrides[] = {"size=ci", override};
    char path[128];
    cipc_error error;
    snprintf(path, sizeof path, "tests/scenes/%s.json", name);
    if (cipc_scene_load(&t->scene, path, override ? 2 : 1, overrides, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
}

static void start(trial *t)
{
    const cipc_scene *s = t->scene;
    assert_int_equal(cipc_massspring_create(&t->integrator, s->model, s->colliders, s->collider_count, &s->massspring, NULL), CIPC_OK);
}

static void step(trial *t)
{
    cipc_massspring_report report;
    assert_int_equal(cipc_massspring_step(t->integrator, t->scene->state, &report, NULL), CIPC_OK);
}

static void end(trial *t)
{
    cipc_massspring_destroy(t->integrator);
    cipc_scene_destroy(t->scene);
}

/* Step, time and all numbers of `from`. */
static void copy_state(cipc_state *to, const cipc_state *from)
{
    assert_int_equal(to->memory_count, from->memory_count);
    to->step = from->step;
    to->time = from->time;
    memcpy(to->position, from->position, 3 * (size_t)to->node_count * sizeof *to->position);
    memcpy(to->velocity, from->velocity, 3 * (size_t)to->node_count * sizeof *to->velocity);
    memcpy(to->memory, from->memory, (size_t)to->memory_count * sizeof *to->memory);
}

static bool same(const cipc_state *a, const cipc_state *b)
{
    return memcmp(a->position, b->position, 3 * (size_t)a->node_count * sizeof *a->position) == 0 && memcmp(a->velocity, b->velocity, 3 * (size_t)a->node_count * sizeof *a->velocity) == 0 &&
           memcmp(a->memory, b->memory, (size_t)a->memory_count * sizeof *a->memory) == 0;
}

/* Is a run that begins in the middle, with another integrator, the same as one that went through? `forget`: the first number of the memory that is lost, and how many. */
static bool goes_on(const char *name, const char *override, int steps, int forget, int count)
{
    trial through, anew;
    load(&through, name, override);
    load(&anew, name, override);
    start(&through);
    for (int k = 0; k < steps; k++) step(&through);
    copy_state(anew.scene->state, through.scene->state);
    memset(anew.scene->state->memory + forget, 0, (size_t)count * sizeof *anew.scene->state->memory);
    start(&anew);
    for (int k = 0; k < 3; k++) {
        step(&through);
        step(&anew);
    }
    const bool good = same(through.scene->state, anew.scene->state);
    end(&through);
    end(&anew);
    return good;
}

static void test_every_law_goes_on(void **state)
{
    (void)state;
    static const char *const laws[] = {"coulomb", "dahl", "bidirectional", "bidirectional-smooth", "clamped"};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++) {
        char override[64];
        snprintf(override, sizeof override, "mass_spring.friction.law=%s", laws[k]);
        assert_true(goes_on("round-table", override, 20, 0, 0));
        assert_true(goes_on("dress-on-body", override, 25, 0, 0));
    }
    assert_true(goes_on("table-materials", NULL, 30, 0, 0));
    assert_true(goes_on("cloth-ball", NULL, 30, 0, 0));
}

/* The literal reading of the bound changes lengths for good. */
static void test_lengths_go_on(void **state)
{
    (void)state;
    static const char reading[] = "mass_spring.deformation.reading=rest-length";
    trial t;
    load(&t, "cloth-hang", reading);
    const int nodes = 8 * t.scene->model->node_count, all = cipc_massspring_memory(t.scene->model, &t.scene->massspring);
    cipc_scene_destroy(t.scene);
    assert_true(all > nodes);
    assert_true(goes_on("cloth-hang", reading, 40, 0, 0));
    assert_false(goes_on("cloth-hang", reading, 40, nodes, all - nodes));
}

/* What is remembered is needed: without it the run is another one. */
static void test_forgetting_shows(void **state)
{
    (void)state;
    trial t;
    load(&t, "round-table", NULL);
    const int all = cipc_massspring_memory(t.scene->model, &t.scene->massspring);
    assert_int_equal(t.scene->state->memory_count, all);
    assert_int_equal(all, 8 * t.scene->model->node_count);
    cipc_scene_destroy(t.scene);
    assert_false(goes_on("round-table", NULL, 20, 0, all));
}

/* A memory that no run has written: numbers of colliders that there are not are none. */
static void test_odd_memories(void **state)
{
    (void)state;
    const double odd[] = {-1, 0.5, 2, 1e300, (double)INFINITY, (double)NAN};
    for (size_t k = 0; k < sizeof odd / sizeof *odd; k++) {
        trial t;
        load(&t, "round-table", NULL);
        start(&t);
        for (int i = 0; i < t.scene->model->node_count; i++) t.scene->state->memory[8 * i] = odd[k];
        step(&t);
        for (int i = 0; i < t.scene->model->node_count; i++) assert_true(t.scene->state->memory[8 * i] == 0); /* it is above the table yet */
        end(&t);
    }
}

static void test_a_state_may_not_remember(void **state)
{
    (void)state;
    trial t;
    cipc_error error;
    load(&t, "round-table", NULL);
    start(&t);
    fail_allocation(1);
    assert_int_equal(cipc_state_remember(t.scene->state, 5, &error), CIPC_E_OUT_OF_MEMORY);
    fail_allocation(0);
    assert_int_equal(t.scene->state->memory_count, 8 * t.scene->model->node_count);
    assert_int_equal(cipc_state_remember(t.scene->state, 0, NULL), CIPC_OK);
    step(&t); /* then the integrator does */
    end(&t);
}

/* Through the state or past it: no bit is another one. */
static void test_nothing_is_lost_between_frames(void **state)
{
    (void)state;
    static const char *const readings[] = {NULL, "mass_spring.deformation.reading=rest-length"};
    for (size_t k = 0; k < 2; k++) {
        trial with, without;
        load(&with, "dress-on-body", readings[k]);
        load(&without, "dress-on-body", readings[k]);
        assert_int_equal(cipc_state_remember(without.scene->state, 0, NULL), CIPC_OK);
        start(&with);
        start(&without);
        for (int n = 0; n < 25; n++) {
            step(&with);
            step(&without);
        }
        const size_t size = 3 * (size_t)with.scene->model->node_count * sizeof(double);
        assert_memory_equal(with.scene->state->position, without.scene->state->position, size);
        assert_memory_equal(with.scene->state->velocity, without.scene->state->velocity, size);
        end(&with);
        end(&without);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_law_goes_on), cmocka_unit_test(test_lengths_go_on), cmocka_unit_test(test_forgetting_shows), cmocka_unit_test(test_odd_memories), cmocka_unit_test(test_a_state_may_not_remember),
        cmocka_unit_test(test_nothing_is_lost_between_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
