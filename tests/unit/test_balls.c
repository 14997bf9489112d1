/* Kinetic balls: a node is inside its ball at all times until the deadline, whatever kicks it gets, and its events keep it so; what cannot move has no size and no events. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/asynchronous_crowd.h"
#include "support/exact_geometry.h"
#include "asynchronous/integrator.h"

static const double FRAME = 0.04;

/* A crowd at rest, its state taken up: nodes are then moved and kicked directly. */
static void start(asynchronous_scene *s)
{
    const crowd_shape shape = crowd_shape_default();
    asynchronous_scene_init(s);
    crowd_add(s, &shape, 1);
    s->options.frame = FRAME;
    crowd_build(s, &shape);
    asynchronous_steps(s, 1);
}

static int free_node(uint64_t *seed, const cipc_asynchronous *a)
{
    int node = 0;
    while (!(a->nodes[node].inverse_mass > 0)) node = random_below(seed, a->model->node_count);
    return node;
}

static double distance_from_centre(const cipc_asynchronous *a, int node, double t)
{
    double x[3], from[3];
    asynchronous_position(&a->nodes[node], t, x);
    v3_sub(from, x, a->balls[node].center);
    return v3_norm(from);
}

/* Paths are straight and balls convex: inside at both ends is inside all the way. */
static void assert_inside_until(const cipc_asynchronous *a, int node, double t)
{
    assert_true(distance_from_centre(a, node, a->now) <= a->balls[node].radius);
    assert_true(distance_from_centre(a, node, t) <= a->balls[node].radius);
}

static void set_velocity(cipc_asynchronous *a, int node, const double v[3])
{
    double x[3];
    asynchronous_position(&a->nodes[node], a->now, x);
    v3_copy(a->nodes[node].q, x);
    a->nodes[node].t = a->now;
    v3_copy(a->nodes[node].v, v);
}

static void test_nodes_stay_inside(void **state)
{
    (void)state;
    uint64_t seed = 1;
    asynchronous_scene s;
    start(&s);
    cipc_asynchronous *a = s.integrator;
    int kept = 0, sooner = 0, refits = 0;
    for (int trial = 0; trial < 300; trial++) {
        const int node = free_node(&seed, a);
        const double speed = exp(random_uniform(&seed, -9, 4));
        double v[3];
        random_fill(&seed, v, 3, speed);
        set_velocity(a, node, v);
        asynchronous_ball_start(a, node);
        for (int instant = 0; instant < 20 && !a->status; instant++) {
            const asynchronous_ball *ball = &a->balls[node];
            const double deadline = ball->deadline;
            assert_true(deadline >= a->now && deadline <= a->now + FRAME);
            assert_true(asynchronous_queue_time(&a->queue, ball->event) == deadline);
            assert_inside_until(a, node, deadline);
            if (random_below(&seed, 2)) {
                a->now = deadline;
                asynchronous_ball_event(a, node);
                refits++;
                continue;
            }
            a->now += random_uniform(&seed, 0, 1) * (deadline - a->now);
            random_fill(&seed, v, 3, random_below(&seed, 2) ? speed : 1e-3 * speed);
            v3_axpy(v, 1, a->nodes[node].v);
            set_velocity(a, node, v);
            asynchronous_ball_check(a, node);
            ball->deadline == deadline ? kept++ : sooner++;
        }
        a->status = CIPC_OK; /* nodes thrown about like this may come too near to others, which is no concern of balls */
    }
    assert_true(kept > 300 && sooner > 300 && refits > 300);
    asynchronous_scene_free(&s);
}

/* A ball near contact lives about a sixteenth of a frame or until its node has crossed the bounds of its size, not much less: it lies ahead of the node. Elsewhere it grows by half. */
static void test_balls_last(void **state)
{
    (void)state;
    uint64_t seed = 2;
    asynchronous_scene s;
    start(&s);
    cipc_asynchronous *a = s.integrator;
    double *radius = cipc_alloc((size_t)s.sheet.model->node_count, sizeof *radius);
    assert_non_null(radius);
    for (int i = 0; i < s.sheet.model->node_count; i++) radius[i] = a->balls[i].radius;
    for (int trial = 0; trial < 300; trial++) {
        const int node = free_node(&seed, a);
        double v[3];
        random_fill(&seed, v, 3, exp(random_uniform(&seed, -9, 3)));
        set_velocity(a, node, v);
        asynchronous_ball_start(a, node);
        const asynchronous_ball *ball = &a->balls[node];
        const double life = ball->deadline - a->now, crossing = 1.5 * ball->radius / v3_norm(v);
        assert_true(ball->radius >= ball->least && ball->radius <= ball->most);
        const double before = radius[node];
        radius[node] = ball->radius;
        if (a->pairs.of_node[node].count == 0 && trial > 0 && before > 0 && ball->radius > ball->most_near) /* away from contact it has grown */
            assert_true(ball->radius == ball->most || fabs(ball->radius / before - 1.5) < 1e-9);
        else
            assert_true(ball->radius == ball->least || ball->radius == ball->most_near || fabs(ball->radius / v3_norm(v) / FRAME - 1.0 / 16) < 1e-9 || fabs(ball->radius / before - 1.5) < 1e-9);
        assert_true(fabs(life - fmin(crossing, FRAME)) < 1e-4 * life);
    }
    cipc_free(radius);
    asynchronous_scene_free(&s);
}

/* Sizes: at least half of eta(1); at most a tenth of the shortest edge at the node near contact, a quarter elsewhere. */
static void test_sizes(void **state)
{
    (void)state;
    asynchronous_scene s;
    start(&s);
    const cipc_model *m = s.sheet.model;
    for (int e = 0; e < m->edge_count; e++) {
        double edge[3];
        v3_sub(edge, m->rest + 3 * m->edges[e][0], m->rest + 3 * m->edges[e][1]);
        for (int k = 0; k < 2; k++) {
            const asynchronous_ball *ball = &s.integrator->balls[m->edges[e][k]];
            assert_true(ball->least == 0.5 * s.options.thickness);
            assert_true(ball->most_near <= fmax(0.1 * v3_norm(edge), ball->least) && ball->most <= fmax(0.25 * v3_norm(edge), ball->least));
        }
    }
    asynchronous_scene_free(&s);
}

/* The floor: no size, no event; steered, it gets both; at rest again, neither. */
static void test_what_is_fixed(void **state)
{
    (void)state;
    const double v[3] = {1, 0, 0}, none[3] = {0, 0, 0};
    asynchronous_scene s;
    start(&s);
    cipc_asynchronous *a = s.integrator;
    const asynchronous_ball *ball = &a->balls[0];
    assert_true(!(a->nodes[0].inverse_mass > 0) && ball->radius == 0 && ball->deadline == INFINITY);
    assert_true(a->queue.events[ball->event].place < 0);
    set_velocity(a, 0, v);
    asynchronous_ball_check(a, 0);
    assert_true(ball->deadline == a->now); /* at once out of a ball of no size */
    asynchronous_ball_event(a, 0);
    assert_true(ball->radius > 0 && ball->deadline > a->now);
    set_velocity(a, 0, none);
    asynchronous_ball_event(a, 0);
    assert_true(ball->radius == 0 && ball->deadline == INFINITY);
    asynchronous_scene_free(&s);
}

/* Leaves are told how far the balls of their nodes have come, so that they know when to look: never less than it was. */
static void test_travel_is_told(void **state)
{
    (void)state;
    uint64_t seed = 3;
    asynchronous_scene s;
    start(&s);
    cipc_asynchronous *a = s.integrator;
    for (int trial = 0; trial < 200; trial++) {
        const int node = free_node(&seed, a), leaf = a->broad.incident[a->broad.incident_first[node]];
        const asynchronous_ball before = a->balls[node];
        const double travel = a->broad.travel[a->broad.leaf_place[leaf]];
        double v[3], moved[3];
        if (a->broad.incident_first[node] == a->broad.incident_first[node + 1]) continue; /* inside a volume */
        random_fill(&seed, v, 3, exp(random_uniform(&seed, -9, 0)));
        set_velocity(a, node, v);
        a->now += 1e-4;
        asynchronous_ball_event(a, node);
        a->status = CIPC_OK;
        v3_sub(moved, a->balls[node].center, before.center);
        assert_true(a->broad.travel[a->broad.leaf_place[leaf]] - travel >= (v3_norm(moved) + fabs(a->balls[node].radius - before.radius)) * (1 - 1e-9));
    }
    asynchronous_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes_stay_inside), cmocka_unit_test(test_balls_last), cmocka_unit_test(test_sizes), cmocka_unit_test(test_what_is_fixed), cmocka_unit_test(test_travel_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
