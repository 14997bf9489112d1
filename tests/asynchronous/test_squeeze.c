/* A squeeze that cannot end well (SPEC T-A10): two walls close on a triangle. The integrator slows down without end, says which pair it is, never lets anything through, and can be asked to go on. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/invariant.h"
#include "support/asynchronous_scene.h"
#include "support/claim.h"

enum { WALL_NODES = 4, NODES = 2 * WALL_NODES + 3 };
static const double frame = 1.0 / 256, start_gap = 0.02, closing = 0.5 /* m/s, each wall */, thickness = 5e-3;

static const double meeting = 0.02 / 0.5; /* s: when the walls would be in one place */

/* ---- What is seen of the paths ------------------------------------------------------------------------------------------------------------ */

/* All breaks, and what the exact monitor says of the paths between them, if there is one. */
typedef struct record {
    cipc_path_break *breaks;
    long count, capacity, paths_checked;
    cipc_monitor *monitor;
} record;

static cipc_status look(void *context, const cipc_paths *paths, cipc_error *error)
{
    record *r = context;
    if (r->count + paths->break_count > r->capacity) {
        r->capacity = 2 * (r->count + paths->break_count);
        r->breaks = realloc(r->breaks, (size_t)r->capacity * sizeof *r->breaks);
        assert_non_null(r->breaks);
    }
    memcpy(r->breaks + r->count, paths->breaks, (size_t)paths->break_count * sizeof *r->breaks);
    r->count += paths->break_count;
    if (!r->monitor) return CIPC_OK;
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    const cipc_status status = cipc_monitor_paths(r->monitor, paths, &report, error);
    r->paths_checked += report.paths_checked;
    return status;
}

static void begin_record(record *r, asynchronous_scene *s, bool watched)
{
    const cipc_invariant_options options = cipc_invariant_options_default();
    *r = (record){0};
    if (watched) assert_int_equal(cipc_monitor_create(&r->monitor, s->sheet.model, &options, &s->error), CIPC_OK);
    cipc_asynchronous_set_monitor(s->integrator, look, r);
}

static void end_record(record *r)
{
    cipc_monitor_destroy(r->monitor);
    free(r->breaks);
}

/* ---- The scene ------------------------------------------------------------------------------------------------------------------------------ */

static void add_wall(asynchronous_scene *s, const char *name, double y)
{
    const double corner[3] = {-1, y, -1}, u[3] = {0, 0, 2}, v[3] = {2, 0, 0};
    sheet_add_grid(&s->sheet, name, corner, u, v, 1, 1);
}

static void squeeze_scene(asynchronous_scene *s, double restitution, long event_limit)
{
    static const int lower[WALL_NODES] = {0, 1, 2, 3}, upper[WALL_NODES] = {4, 5, 6, 7};
    asynchronous_scene_init(s);
    add_wall(s, "lower", -start_gap);
    add_wall(s, "upper", start_gap);
    sheet_add_triangle(&s->sheet, "between", (const double[3]){-0.5, 1e-3, 0.2}, (const double[3]){-0.4, -1e-3, 0.4}, (const double[3]){-0.6, 0, 0.5});
    s->options.frame = frame;
    s->options.thickness = thickness;
    s->options.restitution = restitution;
    s->options.event_limit = event_limit;
    asynchronous_scene_model(s);
    sheet_hold(&s->sheet, lower, WALL_NODES, &(cipc_motion){.end = INFINITY, .velocity = {0, closing, 0}}, INFINITY);
    sheet_hold(&s->sheet, upper, WALL_NODES, &(cipc_motion){.end = INFINITY, .velocity = {0, -closing, 0}}, INFINITY);
    asynchronous_scene_start(s);
}

enum { FRAMES_MOST = 16 };

/* Frames until the first that does not come to its end; the state at the beginning of that one is kept. Each has more events and layers than the one before, once there is contact. */
static void run_until_stalled(asynchronous_scene *s, double *x, double *v)
{
    long events = 0;
    int layers = 0;
    cipc_status status = CIPC_OK;
    for (int n = 0; n < FRAMES_MOST && status == CIPC_OK; n++) {
        memcpy(x, s->sheet.state->position, 3 * NODES * sizeof *x);
        memcpy(v, s->sheet.state->velocity, 3 * NODES * sizeof *v);
        status = asynchronous_try_step(s);
        if (s->report.layers == 0) continue;
        assert_true(s->report.layers > layers && s->report.total_events > events);
        layers = s->report.layers;
        events = s->report.total_events;
    }
    assert_int_equal(status, CIPC_E_NO_PROGRESS);
}

/* ---- Tests ---------------------------------------------------------------------------------------------------------------------------------- */

/* With ever more events a step it gets ever nearer to where the walls would meet, and deeper, without getting there. */
static void test_slows_down_without_end(void **state)
{
    (void)state;
    double x[3 * NODES], v[3 * NODES], reached = 0;
    long seen = 0;
    for (int elastic = 0; elastic < 2; elastic++) {
        double time = 0;
        int layers = 0;
        for (long limit = 10000; limit <= 1000000; limit *= 10) {
            asynchronous_scene s;
            record r;
            squeeze_scene(&s, elastic, limit);
            begin_record(&r, &s, true);
            run_until_stalled(&s, x, v);
            print_message("e = %d, %ld events a step: %.6f s, %d layers, gap %.4g m\n  %s: %s\n", elastic, limit, s.sheet.state->time, s.report.layers, s.report.min_gap, s.error.place, s.error.what);
            /* It says what holds it up. */
            const cipc_contact_place *deepest = &s.report.deepest;
            assert_int_equal(deepest->layers, s.report.layers);
            assert_true(deepest->gap > 0);
            assert_non_null(strstr(s.error.what, "deepest pair is point_triangle"));
            assert_non_null(strstr(s.error.what, "between"));
            assert_non_null(strstr(s.error.what, deepest->nodes[1] < WALL_NODES ? "lower" : "upper"));
            /* The state is of the instant reached, within the step, and sound. */
            assert_true(s.sheet.state->time > time && s.sheet.state->time > s.sheet.state->step * frame && s.sheet.state->time < (s.sheet.state->step + 1) * frame);
            assert_true(s.report.layers > layers);
            assert_int_equal(cipc_monitor_check(r.monitor, s.sheet.state->position, NULL, &s.error), CIPC_OK);
            assert_true(r.paths_checked > 0 && r.count > 1000);
            seen += r.count;
            time = s.sheet.state->time;
            layers = s.report.layers;
            reached = fmax(reached, time / meeting);
            end_record(&r);
            asynchronous_scene_free(&s);
        }
    }
    claim_figure("A4", "infeasible squeeze, up to a million events a step: time reached over that at which the walls would meet, largest", reached, "1", CLAIM_LESS, 1);
    claim_figure("A4", "the same: breaks of the paths that the exact monitor found without contact", (double)seen, "1", CLAIM_MORE, 1e5);
}

/* Breaks that a run with a limit has made, and one that goes on from its last frame with a larger limit, are to the last bit those of a run with the larger limit from the start. */
static void test_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    double x[3 * NODES], v[3 * NODES], ignored[3 * NODES];
    asynchronous_scene stopped, whole;
    record before, after, all;
    squeeze_scene(&stopped, 0.5, 30000);
    squeeze_scene(&whole, 0.5, 300000);
    begin_record(&before, &stopped, false);
    begin_record(&all, &whole, false);
    run_until_stalled(&stopped, x, v);
    run_until_stalled(&whole, ignored, ignored);
    assert_true(before.count > 1000 && all.count > before.count + 1000);
    assert_memory_equal(before.breaks, all.breaks, (size_t)before.count * sizeof *all.breaks);

    cipc_state *s = stopped.sheet.state;
    memcpy(s->position, x, sizeof x);
    memcpy(s->velocity, v, sizeof v);
    s->time = s->step * frame;
    long frames = 0; /* breaks up to the frame */
    while (all.breaks[frames].time <= s->time) frames++;
    stopped.options.event_limit = 300000;
    asynchronous_scene_start(&stopped);
    begin_record(&after, &stopped, false);
    run_until_stalled(&stopped, x, v);
    /* Where they stall is not to the event the same, as certificates count too, which are made anew. */
    const long common = after.count < all.count - frames ? after.count : all.count - frames;
    assert_true(common > before.count && 100 * common > 99 * (all.count - frames));
    assert_memory_equal(after.breaks, all.breaks + frames, (size_t)common * sizeof *all.breaks);
    end_record(&before);
    end_record(&after);
    end_record(&all);
    asynchronous_scene_free(&stopped);
    asynchronous_scene_free(&whole);
}

/* The same integrator, asked again, goes on from the instant where it stalled. */
static void test_goes_on_from_where_it_stalled(void **state)
{
    (void)state;
    double x[3 * NODES], v[3 * NODES];
    asynchronous_scene s;
    record r;
    squeeze_scene(&s, 0.5, 10000);
    begin_record(&r, &s, true);
    run_until_stalled(&s, x, v);
    for (int n = 0; n < 5; n++) {
        const double time = s.sheet.state->time;
        const int step = s.sheet.state->step;
        assert_int_equal(asynchronous_try_step(&s), CIPC_E_NO_PROGRESS);
        assert_true(s.sheet.state->time > time);
        assert_int_equal(s.sheet.state->step, step);
        assert_int_equal(cipc_monitor_check(r.monitor, s.sheet.state->position, NULL, &s.error), CIPC_OK);
    }
    end_record(&r);
    asynchronous_scene_free(&s);
}

/* Walls that stop short of the triangle's thickness are no trouble: the same horizon, to its end. */
static void test_a_feasible_squeeze_completes(void **state)
{
    (void)state;
    static const double stop = 0.03; /* s: at a distance of 5 mm from the middle */
    asynchronous_scene s;
    squeeze_scene(&s, 0.5, 100000);
    for (int d = 0; d < s.sheet.model->dirichlet_count; d++) s.sheet.model->dirichlet[d].motions[0].end = stop;
    asynchronous_scene_start(&s);
    asynchronous_steps(&s, FRAMES_MOST);
    assert_true(s.sheet.state->time > meeting && s.layers >= 1);
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slows_down_without_end),
        cmocka_unit_test(test_goes_on_with_the_same_bits),
        cmocka_unit_test(test_goes_on_from_where_it_stalled),
        cmocka_unit_test(test_a_feasible_squeeze_completes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
