/* What the monitor is told: paths without gaps, in windows that end where the next one begins, breaks in order of time, the last stretch of each node as fast as the node is; buffers that
 * run full in the middle of an instant; monitors that object, that come late; out of memory. */
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

enum { MOST_NODES = 100 };

typedef struct witness {
    asynchronous_scene *scene;
    int windows, object_at;
    long breaks;
    double end, last[3 * MOST_NODES];
    bool begun;
} witness;

static bool same(const double *a, const double *b) { return memcmp(a, b, 3 * sizeof *a) == 0; }

static void assert_paths(witness *w, const cipc_paths *paths)
{
    static double at[3 * MOST_NODES], when[MOST_NODES];
    const cipc_asynchronous *a = w->scene->integrator;
    assert_int_equal(paths->node_count, w->scene->sheet.model->node_count);
    assert_true(paths->begin <= paths->end);
    if (w->begun) assert_true(paths->begin == w->end);
    if (w->begun) assert_memory_equal(paths->from, w->last, 3 * (size_t)paths->node_count * sizeof *paths->from);
    memcpy(at, paths->from, 3 * (size_t)paths->node_count * sizeof *at);
    for (int i = 0; i < paths->node_count; i++) when[i] = paths->begin;
    for (long k = 0; k < paths->break_count; k++) {
        const cipc_path_break *b = &paths->breaks[k];
        assert_true(b->time >= (k > 0 ? b[-1].time : paths->begin) && b->time <= paths->end);
        if (b->time == when[b->node]) assert_true(same(b->x, at + 3 * b->node)); /* one node at one time: the same place */
        when[b->node] = b->time;
        v3_copy(at + 3 * b->node, b->x);
    }
    for (int i = 0; i < paths->node_count; i++) { /* and from the last break to the end as the integrator has the node go */
        double to[3];
        asynchronous_position(&a->nodes[i], paths->end, to);
        assert_true(same(to, paths->to + 3 * i));
        if (when[i] > paths->begin && a->nodes[i].t < paths->end) assert_true(when[i] == a->nodes[i].t && same(at + 3 * i, a->nodes[i].q));
    }
    memcpy(w->last, paths->to, 3 * (size_t)paths->node_count * sizeof *w->last);
    w->end = paths->end;
    w->begun = true;
}

static cipc_status look(void *context, const cipc_paths *paths, cipc_error *error)
{
    witness *w = context;
    assert_paths(w, paths);
    w->breaks += paths->break_count;
    if (++w->windows == w->object_at) return cipc_fail(error, CIPC_E_VIOLATED_SWEPT, "here", "objection");
    return CIPC_OK;
}

static void start(asynchronous_scene *s, witness *w)
{
    const crowd_shape shape = crowd_shape_default();
    asynchronous_scene_init(s);
    crowd_add(s, &shape, 1);
    s->options.frame = 0.04;
    crowd_build(s, &shape);
    *w = (witness){.scene = s};
    assert_true(s->sheet.model->node_count <= MOST_NODES);
}

/* A crowd in collision: windows follow one another over the frames, more than one to a frame, and the last ends with the frame where the state is. */
static void test_no_gaps(void **state)
{
    (void)state;
    asynchronous_scene s;
    witness w;
    start(&s, &w);
    cipc_asynchronous_set_monitor(s.integrator, look, &w);
    for (int frame = 0; frame < 3; frame++) {
        asynchronous_steps(&s, 1);
        assert_true(w.end == s.sheet.state->time);
        assert_memory_equal(w.last, s.sheet.state->position, 3 * (size_t)s.sheet.model->node_count * sizeof *w.last);
    }
    assert_true(w.windows >= 6 && w.breaks > 6L * 4096);
    asynchronous_scene_free(&s);
}

/* Gravity alone: a break at every tick, and a velocity that is g h more after it. */
static cipc_status look_at_fall(void *context, const cipc_paths *paths, cipc_error *error)
{
    int *seen = context;
    (void)error;
    for (long k = 0; k + 1 < paths->break_count; k++) {
        const cipc_path_break *b = &paths->breaks[k];
        const double before = k > 0 ? (b->x[1] - b[-1].x[1]) / (b->time - b[-1].time) : 0, after = (b[1].x[1] - b->x[1]) / (b[1].time - b->time);
        if (k > 0) assert_true(fabs(after - before + 9.81 * 0.25) < 1e-9);
        assert_true(b->time == 0.25 * (double)(k + 1));
        ++*seen;
    }
    return CIPC_OK;
}

static void test_breaks_are_kicks(void **state)
{
    (void)state;
    const double x[3] = {0, 100, 0}, v[3] = {0, 1, 0};
    int seen = 0;
    asynchronous_scene s;
    asynchronous_scene_init(&s);
    s.sheet.gravity[1] = -9.81;
    s.options.frame = 2;
    s.options.gravity_step = 0.25;
    asynchronous_add_particles(&s, "stone", 1, x, v, 1);
    asynchronous_scene_build(&s);
    cipc_asynchronous_set_monitor(s.integrator, look_at_fall, &seen);
    asynchronous_steps(&s, 1);
    assert_int_equal(seen, 7);
    asynchronous_scene_free(&s);
}

/* Whatever the size of the buffer, down to a single break: the same paths, in more windows. */
static void test_buffers_run_full_anywhere(void **state)
{
    (void)state;
    static const long capacities[] = {1, 2, 3, 7, 64, 1000};
    for (size_t i = 0; i < sizeof capacities / sizeof *capacities; i++) {
        asynchronous_scene s, reference;
        witness w, other;
        start(&s, &w);
        start(&reference, &other);
        cipc_asynchronous_set_monitor(s.integrator, look, &w);
        asynchronous_steps(&s, 1);
        s.integrator->break_capacity = capacities[i]; /* of the memory that there is */
        w.windows = 0;
        w.breaks = 0;
        asynchronous_steps(&s, 1);
        asynchronous_steps(&reference, 2);
        assert_true(w.windows >= w.breaks / capacities[i] && w.breaks > 1000);
        assert_memory_equal(s.sheet.state->position, reference.sheet.state->position, 3 * (size_t)s.sheet.model->node_count * sizeof *w.last);
        asynchronous_scene_free(&s);
        asynchronous_scene_free(&reference);
    }
}

/* ---- Objections ---- */

/* In the middle of a frame or at its end, the first one ends the step, which returns it with its text; from the state as it was before things can go on. */
static void test_objections(void **state)
{
    (void)state;
    for (int at = 1; at <= 3; at++) {
        asynchronous_scene s;
        witness w;
        start(&s, &w);
        w.object_at = at;
        cipc_asynchronous_set_monitor(s.integrator, look, &w);
        cipc_status status = CIPC_OK;
        int frames = 0;
        while (!status && frames < 10) {
            status = asynchronous_try_step(&s);
            frames += !status;
        }
        assert_int_equal(status, CIPC_E_VIOLATED_SWEPT);
        assert_int_equal(w.windows, at);
        assert_string_equal(s.error.place, "here");
        assert_string_equal(s.error.what, "objection");
        assert_int_equal(s.sheet.state->step, frames);
        w = (witness){.scene = &s};
        asynchronous_steps(&s, 1);
        asynchronous_scene_free(&s);
    }
}

/* A monitor that is set after some steps is told of the paths from then on; one that is taken away, of none; one that comes back, again. */
static void test_monitors_that_come_and_go(void **state)
{
    (void)state;
    asynchronous_scene s;
    witness w;
    start(&s, &w);
    asynchronous_steps(&s, 1);
    cipc_asynchronous_set_monitor(s.integrator, look, &w);
    asynchronous_steps(&s, 1);
    assert_true(w.windows > 0 && w.end == s.sheet.state->time);
    const int windows = w.windows;
    cipc_asynchronous_set_monitor(s.integrator, NULL, NULL);
    asynchronous_steps(&s, 1);
    assert_int_equal(w.windows, windows);
    w.begun = false;
    cipc_asynchronous_set_monitor(s.integrator, look, &w);
    asynchronous_steps(&s, 1);
    assert_true(w.windows > windows && w.end == s.sheet.state->time);
    asynchronous_scene_free(&s);
}

/* The state is one that the integrator did not leave: paths begin there. */
static void test_a_state_from_elsewhere(void **state)
{
    (void)state;
    asynchronous_scene s;
    witness w;
    start(&s, &w);
    cipc_asynchronous_set_monitor(s.integrator, look, &w);
    asynchronous_steps(&s, 1);
    for (int i = 0; i < s.sheet.model->node_count; i++)
        if (s.sheet.model->node_body[i] > 0) s.sheet.state->position[3 * i + 1] += 1;
    w.begun = true;
    memcpy(w.last, s.sheet.state->position, 3 * (size_t)s.sheet.model->node_count * sizeof *w.last); /* where the next window must begin */
    asynchronous_steps(&s, 1);
    asynchronous_scene_free(&s);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    for (long n = 1; n <= 3; n++) {
        asynchronous_scene s;
        witness w;
        start(&s, &w);
        asynchronous_steps(&s, 1);
        cipc_asynchronous_set_monitor(s.integrator, look, &w);
        fail_allocation(n);
        assert_int_equal(asynchronous_windows_start(s.integrator, &s.error), CIPC_E_OUT_OF_MEMORY);
        assert_true(allocation_failed());
        fail_allocation(0);
        asynchronous_steps(&s, 1); /* with memory again all that is missing is asked for */
        assert_true(w.windows > 0);
        asynchronous_scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_gaps),
        cmocka_unit_test(test_breaks_are_kicks),
        cmocka_unit_test(test_buffers_run_full_anywhere),
        cmocka_unit_test(test_objections),
        cmocka_unit_test(test_monitors_that_come_and_go),
        cmocka_unit_test(test_a_state_from_elsewhere),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
