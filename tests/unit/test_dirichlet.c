/* Dirichlet sets: what is refused, which nodes are held when, and where windows of motion carry them in a step. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/model.h"
#include "support/failing_memory.h"

enum { NODES = 4 };

/* Some ten operations a number. */
static const double ROUNDINGS = 16 * DBL_EPSILON;

static const double PI = 3.14159265358979323846;

static const double start[3 * NODES] = {1, 0, 0, 0, 2, 0, 0, 0, 3, 1, 1, 1};

/* Sets need the number of nodes only. */
static void add(cipc_model *m, const int *nodes, int count, double release, const cipc_motion *motions, int motion_count)
{
    cipc_dirichlet_set set = {
        .node_count = count, .nodes = (int *)nodes, .release = release, .motions = (cipc_motion *)motions, .motion_count = motion_count};
    assert_int_equal(cipc_model_add_dirichlet(m, &set, NULL), CIPC_OK);
}

static void free_sets(cipc_model *m)
{
    for (int s = 0; s < m->dirichlet_count; s++) {
        cipc_free(m->dirichlet[s].nodes);
        cipc_free(m->dirichlet[s].motions);
        cipc_free(m->dirichlet[s].track.frames);
    }
    cipc_free(m->dirichlet);
}

static cipc_motion window(double begin, double end, double vx)
{
    cipc_motion m = {.begin = begin, .end = end, .velocity = {vx, 0, 0}};
    return m;
}

typedef struct targets {
    bool is_dirichlet[NODES], moves[NODES];
    double x[3 * NODES];
} targets;

static targets targets_of(const cipc_model *m, double time, double h)
{
    targets t;
    cipc_dirichlet_targets(m, start, time, h, t.is_dirichlet, t.x, t.moves);
    return t;
}

static void assert_close(double got, double want)
{
    if (!(fabs(got - want) <= ROUNDINGS * fmax(1, fabs(want)))) fail_msg("got %.17g, wanted %.17g", got, want);
}

static void test_nodes_are_sorted_and_unique(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {3, 1, 3, 0, 1};
    add(&m, nodes, 5, INFINITY, NULL, 0);
    const int want[] = {0, 1, 3};
    assert_int_equal(m.dirichlet[0].node_count, 3);
    assert_memory_equal(m.dirichlet[0].nodes, want, sizeof want);
    free_sets(&m);
}

static void test_no_set_no_constraint(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    targets t = targets_of(&m, 0, 0.1);
    for (int i = 0; i < NODES; i++) assert_false(t.is_dirichlet[i] || t.moves[i]);
    assert_memory_equal(t.x, start, sizeof start);
}

static void test_fixed_nodes(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {2};
    bool is_dirichlet[NODES];
    double x[3 * NODES];
    add(&m, nodes, 1, INFINITY, NULL, 0);
    cipc_dirichlet_targets(&m, start, 1e6, 0.1, is_dirichlet, x, NULL); /* moves may be NULL */
    for (int i = 0; i < NODES; i++) assert_int_equal(is_dirichlet[i], i == 2);
    assert_memory_equal(x, start, sizeof start);
    free_sets(&m);
}

/* The part of the step inside [begin, end) is driven. */
static void test_partial_steps(void **state)
{
    (void)state;
    const struct {
        double begin, end, moved;
    } cases[] = {
        {-1, INFINITY, 0.5},  {2, 2.5, 0.5}, {0, 9, 0.5}, {2.125, 9, 0.375}, {-1, 2.25, 0.25},
        {2.125, 2.25, 0.125}, {2.5, 9, 0},   {-1, 2, 0},  {3, 4, 0},         {-2, -1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_model m = {.node_count = NODES};
        cipc_motion motion = window(cases[i].begin, cases[i].end, 1);
        const int nodes[] = {0};
        add(&m, nodes, 1, INFINITY, &motion, 1);
        targets t = targets_of(&m, 2, 0.5);
        assert_true(t.is_dirichlet[0]); /* held outside the window too */
        assert_int_equal(t.moves[0], cases[i].moved > 0);
        assert_true(t.x[0] == start[0] + cases[i].moved && t.x[1] == 0 && t.x[2] == 0);
        free_sets(&m);
    }
}

/* A covered step is driven for h to the last bit, however late it is: time + h - time would not be h. */
static void test_late_steps_are_as_long_as_early_ones(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    cipc_motion motion = window(0, INFINITY, 1);
    const int nodes[] = {1};
    add(&m, nodes, 1, INFINITY, &motion, 1);
    const double h = 0.04;
    for (int step = 0; step < 100000; step += 997) assert_true(targets_of(&m, step * h, h).x[3] == h);
    free_sets(&m);
}

/* step * h falls beside the window's ends by rounding: over all steps the window drives the node for its own length, and no step is
 * driven for a sliver. */
static void test_rounding_at_window_ends(void **state)
{
    (void)state;
    const double h = 0.1, begin = 0.3, end = 0.7; /* 3 h > 0.3, 7 h > 0.7 in doubles */
    assert_true(3 * h > begin && 7 * h > end);
    cipc_model m = {.node_count = NODES};
    cipc_motion motion = window(begin, end, 1);
    const int nodes[] = {1};
    add(&m, nodes, 1, INFINITY, &motion, 1);
    double way = 0;
    for (int step = 0; step < 10; step++) {
        targets t = targets_of(&m, step * h, h);
        assert_int_equal(t.moves[1], step >= 3 && step < 7);
        if (t.moves[1]) assert_close(t.x[3], h);
        way += t.x[3];
    }
    assert_close(way, end - begin);
    free_sets(&m);
}

static void test_release(void **state)
{
    (void)state;
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {1};
    add(&m, nodes, 1, 0.3, NULL, 0);
    const double h = 0.1;
    /* free from the first step that starts at 0.3 or later; 3 h > 0.3 */
    for (int step = 0; step < 6; step++) assert_int_equal(targets_of(&m, step * h, h).is_dirichlet[1], step < 3);
    /* 0.7 - 0.4 < 0.3 by rounding counts as 0.3 */
    assert_true(0.7 - 0.4 < 0.3);
    assert_false(targets_of(&m, 0.7 - 0.4, h).is_dirichlet[1]);
    assert_true(targets_of(&m, 0.29, h).is_dirichlet[1]);
    free_sets(&m);
}

/* The rotation of a step is exact: the radius does not grow, and n steps of 2 pi / n come back. */
static void test_rotation_is_exact(void **state)
{
    (void)state;
    enum { STEPS = 1000 };
    const double h = 0.01, c[3] = {0.5, -1, 2};
    cipc_motion motion = {
        .begin = 0, .end = INFINITY, .center = {c[0], c[1], c[2]}, .axis = {1, 2, 2}, .angular_velocity = 2 * PI / (STEPS * h)};
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {0, 1, 2, 3};
    add(&m, nodes, NODES, INFINITY, &motion, 1);
    double x[3 * NODES], y[3 * NODES];
    bool is_dirichlet[NODES];
    memcpy(x, start, sizeof x);
    for (int step = 0; step < STEPS; step++) {
        cipc_dirichlet_targets(&m, x, step * h, h, is_dirichlet, y, NULL);
        memcpy(x, y, sizeof x);
        for (int i = 0; i < NODES; i++) {
            double before = 0, after = 0, along = 0;
            for (int k = 0; k < 3; k++) {
                before += (start[3 * i + k] - c[k]) * (start[3 * i + k] - c[k]);
                after += (x[3 * i + k] - c[k]) * (x[3 * i + k] - c[k]);
                along += (x[3 * i + k] - start[3 * i + k]) * motion.axis[k] / 3;
            }
            assert_true(fabs(after - before) <= (step + 1) * ROUNDINGS * before);
            assert_true(fabs(along) <= (step + 1) * ROUNDINGS);
        }
    }
    for (int i = 0; i < 3 * NODES; i++) assert_true(fabs(x[i] - start[i]) <= STEPS * ROUNDINGS);
    free_sets(&m);
}

/* A quarter turn about z through (1, 1, .) takes (1, 0) to (2, 1); then the translation, which the rotation does not turn. */
static void test_rotation_comes_before_translation(void **state)
{
    (void)state;
    cipc_motion motion = {.begin = 0, .end = 1, .velocity = {10, 0, 3}, .center = {1, 1, 7}, .axis = {0, 0, 5}, .angular_velocity = PI / 2};
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {0};
    add(&m, nodes, 1, INFINITY, &motion, 1);
    targets t = targets_of(&m, 0, 1);
    assert_close(t.x[0], 12);
    assert_close(t.x[1], 1);
    assert_close(t.x[2], 3);
    free_sets(&m);
}

/* To and fro: turns every 0.2 s after its begin at 0.1, on the steps' ends (4 h, 8 h by rounding beside 0.3, 0.5 and so on), and ends at 0.8. */
static void test_turns_at_the_ends_of_steps(void **state)
{
    (void)state;
    const double h = 0.05, begin = 0.1;
    cipc_model m = {.node_count = NODES};
    cipc_motion motion = window(begin, 0.8, 1);
    const int nodes[] = {1}, sign[20] = {0, 0, 1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1, -1, -1, 0, 0, 0, 0};
    motion.turn = 0.2;
    add(&m, nodes, 1, INFINITY, &motion, 1);
    for (int step = 0; step < 20; step++) {
        targets t = targets_of(&m, step * h, h);
        assert_int_equal(t.moves[1], sign[step] != 0);
        assert_true(fabs(t.x[3] - sign[step] * h) <= ROUNDINGS);
    }
    free_sets(&m);
}

/* A step between turns is driven for h to the last bit, however late it is. */
static void test_late_turns_are_as_exact_as_early_ones(void **state)
{
    (void)state;
    const double h = 0.04;
    cipc_model m = {.node_count = NODES};
    cipc_motion motion = window(0, INFINITY, 1);
    const int nodes[] = {1};
    motion.turn = 25 * h;
    add(&m, nodes, 1, INFINITY, &motion, 1);
    for (int step = 0; step < 100000; step += 997) assert_true(targets_of(&m, step * h, h).x[3] == (step / 25 % 2 == 0 ? h : -h));
    free_sets(&m);
}

/* In a step that holds turns, forward and backward cancel. */
static void test_turns_within_a_step(void **state)
{
    (void)state;
    const struct {
        double turn, h, moved;
    } cases[] = {{0.75, 1, 0.5}, {0.5, 1, 0}, {0.25, 1, 0}, {0.4, 1, 0.2}, {1, 1, 1}, {2, 1, 1}, {0.3, 1, 0.2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cipc_model m = {.node_count = NODES};
        cipc_motion motion = {.begin = 0, .end = INFINITY, .velocity = {1, 0, 0}, .axis = {1, 0, 0}, .angular_velocity = PI / 2, .turn = cases[i].turn};
        const int nodes[] = {1};
        add(&m, nodes, 1, INFINITY, &motion, 1);
        targets t = targets_of(&m, 0, cases[i].h);
        assert_true(fabs(t.x[3] - cases[i].moved) <= ROUNDINGS);
        assert_true(fabs(t.x[4] - 2 * cos(PI / 2 * cases[i].moved)) <= ROUNDINGS && fabs(t.x[5] - 2 * sin(PI / 2 * cases[i].moved)) <= ROUNDINGS);
        free_sets(&m);
    }
}

/* Straight from frame to frame, at rest before the first and after the last; a step that ends at a frame's time ends at that frame. */
static void test_tracks(void **state)
{
    (void)state;
    double frames[] = {1, 0, 0, 0, 2, 0, 2, 0, 0, 0, 2, 0, 2, 0, 4, 0, 3, 1};
    int nodes[] = {0, 1};
    cipc_dirichlet_set set = {
        .nodes = nodes, .node_count = 2, .release = INFINITY, .track = {.frame_count = 3, .begin = 1, .interval = 0.5, .frames = frames}};
    cipc_model m = {.node_count = NODES};
    assert_int_equal(cipc_model_add_dirichlet(&m, &set, NULL), CIPC_OK);
    const struct {
        double time, x[6];
    } cases[] = {
        {0, {1, 0, 0, 0, 2, 0}},       {0.75, {1, 0, 0, 0, 2, 0}}, {1, {1.5, 0, 0, 0, 2, 0}},      {1.25, {2, 0, 0, 0, 2, 0}},
        {1.5, {2, 0, 2, 0, 2.5, 0.5}}, {1.75, {2, 0, 4, 0, 3, 1}}, {1.7, {2, 0, 3.6, 0, 2.9, 0.9}}, {9, {2, 0, 4, 0, 3, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        targets t = targets_of(&m, cases[i].time, 0.25);
        for (int k = 0; k < 6; k++) assert_true(fabs(t.x[k] - cases[i].x[k]) <= ROUNDINGS * 4);
        assert_true(t.is_dirichlet[0] && t.is_dirichlet[1] && !t.is_dirichlet[2]);
        assert_int_equal(t.moves[0], cases[i].x[0] != 1);
    }
    free_sets(&m);
}

static void test_motions_follow_one_another(void **state)
{
    (void)state;
    const cipc_motion motions[] = {window(0, 0.25, 4), window(0.25, 1, 8)};
    cipc_model m = {.node_count = NODES};
    const int nodes[] = {0};
    add(&m, nodes, 1, INFINITY, motions, 2);
    assert_true(targets_of(&m, 0, 1).x[0] == 1 + 4 * 0.25 + 8 * 0.75);
    free_sets(&m);
}

/* The last set that holds a node decides, fixed or moving; a released one no longer does. */
static void test_last_set_wins(void **state)
{
    (void)state;
    const cipc_motion motions[] = {window(0, INFINITY, 1), window(0, INFINITY, 2)};
    const int first[] = {0, 1, 2}, second[] = {1, 2}, third[] = {2};
    cipc_model m = {.node_count = NODES};
    add(&m, first, 3, INFINITY, &motions[0], 1);
    add(&m, second, 2, 5, &motions[1], 1);
    add(&m, third, 1, 7, NULL, 0);
    const struct {
        double time, way[NODES];
    } cases[] = {{0, {1, 2, 0, 0}}, {5, {1, 1, 0, 0}}, {7, {1, 1, 1, 0}}};
    for (int c = 0; c < 3; c++) {
        targets t = targets_of(&m, cases[c].time, 1);
        for (int i = 0; i < NODES; i++) {
            assert_int_equal(t.is_dirichlet[i], i < 3);
            assert_int_equal(t.moves[i], cases[c].way[i] > 0);
            assert_true(t.x[3 * i] == start[3 * i] + cases[c].way[i]);
        }
    }
    free_sets(&m);
}

static void test_bad_sets(void **state)
{
    (void)state;
    int good_nodes[] = {0}, too_high[] = {0, NODES}, negative[] = {-1};
    cipc_model m = {.node_count = NODES};
    cipc_error error;
    cipc_dirichlet_set none = {.nodes = good_nodes, .release = INFINITY}, high = {.nodes = too_high, .node_count = 2},
                       low = {.nodes = negative, .node_count = 1};
    assert_int_equal(cipc_model_add_dirichlet(&m, &none, &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_model_add_dirichlet(&m, &high, &error), CIPC_E_OUT_OF_RANGE);
    assert_non_null(strstr(error.what, "node 4"));
    assert_int_equal(cipc_model_add_dirichlet(&m, &low, &error), CIPC_E_OUT_OF_RANGE);
    cipc_motion motion;
    cipc_dirichlet_set set = {.nodes = good_nodes, .node_count = 1, .motions = &motion, .motion_count = 1};
    const struct {
        double *number;
        double bad;
        const char *what;
    } cases[] = {
        {&motion.velocity[1], NAN, "not finite"},
        {&motion.center[2], INFINITY, "not finite"},
        {&motion.axis[0], NAN, "not finite"},
        {&motion.angular_velocity, NAN, "not finite"},
        {&motion.begin, -INFINITY, "not finite"},
        {&motion.end, NAN, "not after"},
        {&motion.end, 1, "not after"},
        {&motion.axis[2], 0, "axis"},
        {&motion.turn, -1, "turns every"},
        {&motion.turn, NAN, "turns every"},
        {&motion.turn, INFINITY, "turns every"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        motion = (cipc_motion){.begin = 1, .end = 2, .axis = {0, 0, 1}, .angular_velocity = 1};
        *cases[i].number = cases[i].bad;
        assert_int_equal(cipc_model_add_dirichlet(&m, &set, &error), CIPC_E_OUT_OF_RANGE);
        assert_non_null(strstr(error.what, cases[i].what));
    }
    assert_int_equal(m.dirichlet_count, 0);
    /* without rotation no axis is needed */
    motion = window(0, 1, 1);
    assert_int_equal(cipc_model_add_dirichlet(&m, &set, NULL), CIPC_OK);
    free_sets(&m);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    const cipc_motion motion = window(0, 1, 1);
    int nodes[] = {0, 1};
    cipc_dirichlet_set set = {.nodes = nodes, .node_count = 2, .motions = (cipc_motion *)&motion, .motion_count = 1};
    cipc_model m = {.node_count = NODES};
    cipc_error error;
    long n = 1;
    for (;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_model_add_dirichlet(&m, &set, &error);
        if (!allocation_failed()) break;
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(error.status, CIPC_E_OUT_OF_MEMORY);
        assert_int_equal(m.dirichlet_count, 0);
    }
    fail_allocation(0);
    assert_int_equal(n, 4); /* three allocations */
    assert_int_equal(m.dirichlet_count, 1);
    free_sets(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes_are_sorted_and_unique),
        cmocka_unit_test(test_no_set_no_constraint),
        cmocka_unit_test(test_fixed_nodes),
        cmocka_unit_test(test_partial_steps),
        cmocka_unit_test(test_late_steps_are_as_long_as_early_ones),
        cmocka_unit_test(test_rounding_at_window_ends),
        cmocka_unit_test(test_release),
        cmocka_unit_test(test_rotation_is_exact),
        cmocka_unit_test(test_rotation_comes_before_translation),
        cmocka_unit_test(test_turns_at_the_ends_of_steps),
        cmocka_unit_test(test_late_turns_are_as_exact_as_early_ones),
        cmocka_unit_test(test_turns_within_a_step),
        cmocka_unit_test(test_tracks),
        cmocka_unit_test(test_motions_follow_one_another),
        cmocka_unit_test(test_last_set_wins),
        cmocka_unit_test(test_bad_sets),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
