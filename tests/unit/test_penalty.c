/* Ticks of penalty layers against SPEC A.4, A.7, A.8 in long double: impulse along the closest vector, momenta, the softer return of finding F3, friction bounded by mu and by
 * stopping, prescribed nodes; layers out of reach rest only when deepest and separating. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "support/exact_geometry.h"
#include "support/two_primitives.h"

static const double ETA1 = 0.1, R1 = 1000;

/* Velocity changes are sums of a few rounded products of lengths, whose ratio to the gap is at most some 1e3 here. */
static const double ROUNDING = 1e-11;

typedef struct trial {
    two_primitives two;
    int pair;
    double x[12], v[12], after[12];
    asynchronous_closest closest;
    double gap;
} trial;

static void trial_init(trial *t, cipc_pair_kind kind, double friction, double restitution)
{
    cipc_asynchronous_options options = cipc_asynchronous_options_default();
    options.thickness = ETA1;
    options.stiffness = R1;
    options.restitution = restitution;
    two_primitives_init(&t->two, kind, &options, 0.02, friction);
}

/* The closest points at a gap of `part` of eta(1), masses over two decades, any velocities. */
static bool draw(uint64_t *seed, trial *t, double part)
{
    double mass[4];
    two_primitives *two = &t->two;
    random_fill(seed, t->x, 12, 0.5);
    random_fill(seed, t->v, 12, 1);
    for (int i = 0; i < 4; i++) mass[i] = exp(random_uniform(seed, -3, 2));
    asynchronous_closest closest = asynchronous_closest_points(two->kind, t->x);
    const double shift = part * ETA1 + 0.02 - closest.distance;
    for (int i = 0; i < 3 * two->first; i++) t->x[i] += shift * closest.n[i % 3];
    t->closest = asynchronous_closest_points(two->kind, t->x);
    t->gap = t->closest.distance - 0.02;
    two_primitives_weigh(two, mass);
    return fabs(t->gap / (part * ETA1) - 1) < 1e-9;
}

static void meet(trial *t)
{
    two_primitives_place(&t->two, t->x, t->v, 0);
    t->pair = two_primitives_meet(&t->two);
}

static void tick(trial *t, int layer)
{
    asynchronous_penalty_tick(t->two.a, t->pair, layer);
    two_primitives_velocities(&t->two, t->after);
}

/* Of the first closest point relative to the second. */
static void relative_velocity(const trial *t, const double v[12], double u[3])
{
    for (int k = 0; k < 3; k++) u[k] = 0;
    for (int i = 0; i < t->two.count; i++) v3_axpy(u, t->closest.c[i], v + 3 * i);
}

static double step_of(const trial *t, int layer)
{
    double lightest = INFINITY;
    for (int i = 0; i < t->two.count; i++) lightest = fmin(lightest, t->two.scene.sheet.model->mass[i]);
    return cipc_layer_step(R1, lightest, 0.025, layer);
}

static double closing_speed(const trial *t) { double u[3]; relative_velocity(t, t->v, u); return -v3_dot(u, t->closest.n); }

/* Turn the velocities round if need be. */
static void let_close(trial *t, bool close)
{
    if ((closing_speed(t) > 0) == close) return;
    for (int i = 0; i < 12; i++) t->v[i] = -t->v[i];
}

/* ---- The impulse ---- */

static void assert_impulse(const trial *t, double normal, double tangential, const double *along)
{
    for (int i = 0; i < t->two.count; i++)
        for (int k = 0; k < 3; k++) {
            const double impulse = normal * t->closest.n[k] + (along ? tangential * along[k] : 0), mass = t->two.mass[i];
            const double want = mass > 0 ? t->closest.c[i] * impulse / mass : 0;
            assert_true(fabs(t->after[3 * i + k] - t->v[3 * i + k] - want) <= ROUNDING * (1 + fabs(want)));
        }
}

/* h r(l) (eta(l) - gap) c_i n / m_i. */
static void test_impulse(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        trial t;
        trial_init(&t, (cipc_pair_kind)kind, 0, 1);
        for (int i = 0; i < 300; i++) {
            if (!draw(&seed, &t, random_uniform(&seed, 0.5, 0.95))) continue;
            meet(&t);
            const int layer = 1 + random_below(&seed, cipc_layer_count(ETA1, t.gap));
            tick(&t, layer);
            assert_impulse(&t, step_of(&t, layer) * cipc_layer_stiffness(R1, layer) * (cipc_layer_thickness(ETA1, layer) - t.gap), 0, NULL);
        }
        assert_true(t.two.a->report.events[CIPC_EVENT_PENALTY] >= 200);
        assert_int_equal(t.two.a->report.events[CIPC_EVENT_IDLE], 0);
        two_primitives_free(&t.two);
    }
}

/* Linear momentum with friction too; angular momentum without: friction acts at two points that are not the same. */
static void test_momenta(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int round = 0; round < 2 * CIPC_PAIR_KIND_COUNT; round++) {
        const bool friction = round % 2 == 1;
        trial t;
        trial_init(&t, (cipc_pair_kind)(round / 2), friction ? 0.5 : 0, 0.5);
        for (int i = 0; i < 100; i++) {
            double linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0}, size = 0;
            if (!draw(&seed, &t, random_uniform(&seed, 0.5, 0.95))) continue;
            meet(&t);
            tick(&t, 1);
            for (int n = 0; n < t.two.count; n++) {
                double dv[3], turn[3];
                v3_sub(dv, t.after + 3 * n, t.v + 3 * n);
                v3_cross(turn, t.x + 3 * n, dv);
                v3_axpy(linear, t.two.mass[n], dv);
                v3_axpy(angular, t.two.mass[n], turn);
                size += t.two.mass[n];
            }
            assert_true(v3_norm(linear) <= 1e-14 * size);
            if (!friction) assert_true(v3_norm(angular) <= 1e-13 * size);
        }
        two_primitives_free(&t.two);
    }
}

/* While the points separate, e^2 of the stiffness; while they close, all of it. */
static void test_restitution(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        const double e = 0.3 * kind;
        trial t;
        trial_init(&t, (cipc_pair_kind)kind, 0, e);
        for (int i = 0; i < 100; i++) {
            if (!draw(&seed, &t, 0.9)) continue;
            let_close(&t, i % 2 == 0);
            meet(&t);
            tick(&t, 1);
            assert_impulse(&t, (i % 2 == 0 ? 1 : e * e) * step_of(&t, 1) * R1 * (ETA1 - t.gap), 0, NULL);
        }
        two_primitives_free(&t.two);
    }
}

/* ---- Friction ---- */

/* Sliding fast, mu times the normal impulse; sliding slowly, what stops it and no more. Across n in either case. */
static void test_friction(void **state)
{
    (void)state;
    uint64_t seed = 4;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        int stopped = 0, slid = 0;
        trial t;
        trial_init(&t, (cipc_pair_kind)kind, 0.4, 1);
        for (int i = 0; i < 400; i++) {
            double u[3], w = 0;
            if (!draw(&seed, &t, 0.9)) continue;
            for (int k = 0; k < 12; k++) t.v[k] *= i % 2 ? 1 : 0.002;
            meet(&t);
            tick(&t, 1);
            for (int n = 0; n < t.two.count; n++) w += t.closest.c[n] * t.closest.c[n] / t.two.mass[n];
            relative_velocity(&t, t.v, u);
            v3_axpy(u, -v3_dot(u, t.closest.n), t.closest.n);
            const double speed = v3_norm(u), normal = step_of(&t, 1) * R1 * (ETA1 - t.gap), most = 0.4 * normal, stopping = speed / w;
            v3_scale(u, 1 / speed, u);
            assert_impulse(&t, normal, -fmin(most, stopping), u);
            most < stopping ? slid++ : stopped++;
            double left[3];
            relative_velocity(&t, t.after, left);
            v3_axpy(left, -v3_dot(left, t.closest.n), t.closest.n);
            if (stopping <= most) assert_true(v3_norm(left) <= 1e-12 * (1 + speed));
            else assert_true(v3_dot(left, u) > 0); /* never back */
        }
        assert_true(stopped >= 30 && slid >= 30);
        two_primitives_free(&t.two);
    }
}

/* ---- Prescribed nodes ---- */

static void test_prescribed_nodes(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT; kind++) {
        trial t;
        trial_init(&t, (cipc_pair_kind)kind, 0.3, 1);
        for (int i = 0; i < 200; i++) {
            double mass[4];
            if (!draw(&seed, &t, 0.9)) continue;
            memcpy(mass, t.two.mass, sizeof mass);
            for (int n = 0; n < t.two.count; n++)
                if (i % 10 == 0 || random_below(&seed, 2)) mass[n] = 0;
            two_primitives_weigh(&t.two, mass);
            meet(&t);
            tick(&t, 1);
            for (int n = 0; n < t.two.count; n++) {
                const bool same = memcmp(t.after + 3 * n, t.v + 3 * n, 3 * sizeof(double)) == 0;
                if (!(mass[n] > 0)) assert_true(same && !t.two.a->dirty[n]);
                else if (fabs(t.closest.c[n]) > 1e-3) assert_false(same);
            }
        }
        two_primitives_free(&t.two);
    }
}

/* A node with no weight in the closest points is left alone: its position is not rounded anew. */
static void test_nodes_without_weight_are_left_alone(void **state)
{
    (void)state;
    trial t;
    trial_init(&t, CIPC_POINT_TRIANGLE, 0, 1);
    const double x[12] = {-0.05, 0, 0, 0.05, 0, 0, 1, 0.1, 0, 1, -0.1, 0}, v[12] = {0};
    two_primitives_place(&t.two, x, v, 0);
    t.pair = two_primitives_meet(&t.two);
    asynchronous_penalty_tick(t.two.a, t.pair, 1);
    assert_true(t.two.a->dirty[0] && t.two.a->dirty[1] && !t.two.a->dirty[2] && !t.two.a->dirty[3]);
    two_primitives_free(&t.two);
}

/* ---- Rest ---- */

static int layers(const trial *t) { return t->two.a->pairs.pair[t->pair].layers; }

/* Two particles with three active layers, then at a gap of `part` of the deepest one's thickness, closing or separating. */
static void three_layers(trial *t, double part, double speed)
{
    const double deep[12] = {0, 0, 0, 0.02 + 0.99 * cipc_layer_thickness(ETA1, 3), 0, 0}, none[12] = {0}, v[12] = {-speed, 0, 0};
    two_primitives_place(&t->two, deep, none, 0);
    t->pair = two_primitives_meet(&t->two);
    assert_int_equal(layers(t), 3);
    t->two.a->nodes[1].q[0] = 0.02 + part * cipc_layer_thickness(ETA1, 3);
    v3_copy(t->two.a->nodes[0].v, v);
}

static void test_rest(void **state)
{
    (void)state;
    trial t;
    trial_init(&t, CIPC_POINT_POINT, 0, 1);
    three_layers(&t, 1.02, 1);
    const double next = asynchronous_queue_time(&t.two.a->queue, t.two.a->pairs.pair[t.pair].layer[0].event);
    tick(&t, 3); /* deepest, out of reach, separating */
    assert_int_equal(layers(&t), 2);
    assert_true(t.two.a->pairs.slab[t.pair].half < 0.5 * (0.02 + cipc_layer_thickness(ETA1, 3)) * (1 + 1e-6)); /* certified against coming back */
    assert_int_equal(t.two.a->report.events[CIPC_EVENT_IDLE], 1);
    assert_true(asynchronous_queue_time(&t.two.a->queue, t.two.a->pairs.pair[t.pair].layer[0].event) == next);
    three_layers(&t, 1.2, 1); /* out of reach of the second as well: both rest, the first does not */
    tick(&t, 3);
    assert_int_equal(layers(&t), 1);
    three_layers(&t, 1.5, 1); /* of all */
    tick(&t, 3);
    assert_int_equal(layers(&t), 0);
    three_layers(&t, 1.02, -1); /* closing */
    tick(&t, 3);
    assert_int_equal(layers(&t), 3);
    three_layers(&t, 0.999, 1); /* within reach */
    tick(&t, 3);
    assert_int_equal(layers(&t), 3);
    three_layers(&t, 1.2, 1); /* not the deepest */
    tick(&t, 2);
    assert_int_equal(layers(&t), 3);
    two_primitives_free(&t.two);
}

/* Each tick schedules the next one of its own clock. */
static void test_clock_goes_on(void **state)
{
    (void)state;
    trial t;
    trial_init(&t, CIPC_POINT_POINT, 0, 1);
    three_layers(&t, 0.9, 1);
    for (int l = 1; l <= 3; l++) {
        const asynchronous_layer *layer = &t.two.a->pairs.pair[t.pair].layer[l - 1];
        const double h = step_of(&t, l);
        for (int k = 2; k < 5; k++) {
            tick(&t, l);
            assert_int_equal(layer->k, k);
            assert_true(fabs(asynchronous_queue_time(&t.two.a->queue, layer->event) / h - k) < 1e-12);
        }
    }
    assert_true(t.two.a->report.smallest_step < step_of(&t, 2) && t.two.a->report.min_gap < 0.1);
    two_primitives_free(&t.two);
}

/* ---- Failures ---- */

static void test_no_gap(void **state)
{
    (void)state;
    trial t;
    trial_init(&t, CIPC_POINT_POINT, 0, 1);
    three_layers(&t, 0, 1);
    tick(&t, 1);
    assert_int_equal(t.two.a->status, CIPC_E_NO_PROGRESS);
    two_primitives_free(&t.two);
}

/* The reference without culling says so when it would need more layers than it has. */
static void test_always_layers_are_enough_or_not(void **state)
{
    (void)state;
    trial t;
    cipc_asynchronous_options options = cipc_asynchronous_options_default();
    options.thickness = ETA1;
    options.stiffness = R1;
    options.always_layers = 3;
    two_primitives_init(&t.two, CIPC_POINT_POINT, &options, 0.02, 0);
    three_layers(&t, 1.2, 1);
    tick(&t, 3);
    assert_int_equal(layers(&t), 3); /* no rest */
    three_layers(&t, 0.95, 1);
    tick(&t, 3);
    assert_int_equal(t.two.a->status, CIPC_OK);
    three_layers(&t, 0.9, 1);
    tick(&t, 2);
    assert_int_equal(t.two.a->status, CIPC_OK); /* only the deepest knows */
    tick(&t, 3);
    assert_int_equal(t.two.a->status, CIPC_E_NO_PROGRESS);
    two_primitives_free(&t.two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_impulse),
        cmocka_unit_test(test_momenta),
        cmocka_unit_test(test_restitution),
        cmocka_unit_test(test_friction),
        cmocka_unit_test(test_prescribed_nodes),
        cmocka_unit_test(test_nodes_without_weight_are_left_alone),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_clock_goes_on),
        cmocka_unit_test(test_no_gap),
        cmocka_unit_test(test_always_layers_are_enough_or_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
