/* M7: total momentum, to the bound and no further; what takes it away. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/invariant.h"
#include "support/exact_geometry.h"
#include "support/hand_model.h"

/* `count` nodes of these masses in a body of particles. */
static hand_model *particles(const double *mass, int count)
{
    hand_model *h = hand_model_create();
    int body = hand_body_of(h, CIPC_BODY_PARTICLES, "sand", 0, false);
    for (int i = 0; i < count; i++) { hand_node(h, body, i, 0, 0); }
    h->model.mass = calloc((size_t)count, sizeof *mass);
    memcpy(h->model.mass, mass, (size_t)count * sizeof *mass);
    return h;
}

static void destroy(hand_model *h)
{
    free(h->model.mass);
    hand_model_destroy(h);
}

/* Two particles exchange momentum exactly, or all but one ulp of it. */
static void test_to_the_last_bit(void **state)
{
    (void)state;
    cipc_error error;
    double change;
    hand_model *h = particles((const double[2]){2, 0.5}, 2);
    const double before[6] = {1, 0, 0, -3, 0.25, 7};
    double after[6] = {0.75, -0.125, 1.75, -2, 0.75, 0};
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0, &change, &error), CIPC_OK);
    assert_true(change == 0);
    after[5] = 0x1p-40;
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0, &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    assert_true(change == 0x1p-41);
    assert_non_null(strstr(error.what, "0x1p-41"));
    assert_string_equal(error.place, "monitor momentum");
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0x1p-41, &change, &error), CIPC_OK);
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0x1p-41 * (1 - 0x1p-48), &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    destroy(h);
}

/* All directions count, by their norm. */
static void test_norm(void **state)
{
    (void)state;
    cipc_error error;
    double change;
    hand_model *h = particles((const double[1]){2}, 1);
    const double before[3] = {0}, after[3] = {1, -2, 2};
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 6, &change, &error), CIPC_OK);
    assert_true(change == 6);
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 5.999999999999, &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    destroy(h);
}

/* Many nodes whose momenta cancel to the last bits: plain sums would be off by thousands of ulp, these are not. */
static void test_cancellation(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    uint64_t seed = 31;
    cipc_error error;
    double *mass = calloc(COUNT, sizeof *mass), *before = calloc(3 * COUNT, sizeof *before), *after = calloc(3 * COUNT, sizeof *after), change;
    for (int i = 0; i < COUNT; i++) { mass[i] = random_uniform(&seed, 0.1, 1); }
    random_fill(&seed, before, 3 * COUNT, 1e3);
    for (int i = 0; i < COUNT; i++) { /* a shuffle among nodes of the same mass keeps the sum */
        if (i % 2) { mass[i] = mass[i - 1]; }
    }
    for (int i = 0; i < 3 * COUNT; i++) { after[i] = before[i / 3 % 2 ? i - 3 : i + 3]; }
    hand_model *h = particles(mass, COUNT);
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0, &change, &error), CIPC_OK);
    assert_true(change < 1e-20);
    after[7] += 1e-9;
    assert_int_equal(cipc_monitor_momentum(&h->model, before, after, 0, &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    destroy(h);
    free(mass);
    free(before);
    free(after);
}

static void test_bad_numbers(void **state)
{
    (void)state;
    cipc_error error;
    double change;
    hand_model *h = particles((const double[1]){2}, 1);
    const double good[3] = {0}, bad[3] = {0, NAN, 0}, endless[3] = {INFINITY, 0, 0};
    assert_int_equal(cipc_monitor_momentum(&h->model, good, bad, 1, &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    assert_int_equal(cipc_monitor_momentum(&h->model, good, endless, 1, &change, &error), CIPC_E_VIOLATED_MOMENTUM);
    assert_int_equal(cipc_monitor_momentum(&h->model, good, good, NAN, &change, &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_monitor_momentum(&h->model, good, good, -1, &change, &error), CIPC_E_OUT_OF_RANGE);
    assert_int_equal(cipc_monitor_momentum(&h->model, good, good, INFINITY, &change, NULL), CIPC_E_OUT_OF_RANGE);
    destroy(h);
}

static void test_what_changes_momentum(void **state)
{
    (void)state;
    hand_model *h = particles((const double[1]){2}, 1);
    assert_null(cipc_momentum_source(&h->model));
    h->model.load_count = 1;
    assert_string_equal(cipc_momentum_source(&h->model), "loads");
    h->model.load_count = 0;
    h->model.bodies[0].material.damping_stiffness = 1; /* internal */
    assert_null(cipc_momentum_source(&h->model));
    h->model.bodies[0].material.damping_mass = 1;
    assert_string_equal(cipc_momentum_source(&h->model), "mass damping");
    h->model.bodies[0].fixed = true;
    assert_string_equal(cipc_momentum_source(&h->model), "Dirichlet nodes");
    h->model.bodies[0].fixed = false;
    h->model.dirichlet_count = 1;
    assert_string_equal(cipc_momentum_source(&h->model), "Dirichlet nodes");
    h->model.gravity[2] = 0x1p-40;
    assert_string_equal(cipc_momentum_source(&h->model), "gravity");
    destroy(h);
}

/* Masses 3 and 4: 7 tolerances in the largest norm, sqrt(2 * 25) in the mean one. */
static void test_bound(void **state)
{
    (void)state;
    hand_model *h = particles((const double[2]){3, 4}, 2);
    const double here[6] = {0}, far[6] = {1, 0, 0, 0, 0, 1};
    cipc_momentum_rule rule = {.tolerance = 0.5, .time_step = 0.25, .beta = 1, .minimisations = 1};
    assert_true(cipc_momentum_bound(&h->model, here, &rule) == 3.5);
    rule.beta = 0.5;
    rule.minimisations = 2;
    assert_true(cipc_momentum_bound(&h->model, here, &rule) == 14);
    rule.rms = true;
    assert_true(fabs(cipc_momentum_bound(&h->model, here, &rule) - 2 * sqrt(50)) < 1e-14);
    rule.tolerance = 0; /* what is left is the rounding of positions */
    assert_true(cipc_momentum_bound(&h->model, far, &rule) == 8 * 0x1p-53 * 7 / 0.25 / 0.5);
    destroy(h);
}

/* sum m |v| is 3 * 5 + 4 * 2 before and 7 after; energy decides when it is larger, and never when it is not a number to take a root of. */
static void test_bound_of_kicks(void **state)
{
    (void)state;
    hand_model *h = particles((const double[2]){3, 4}, 2);
    const double fast[6] = {3, 0, 4, 0, -2, 0}, slow[6] = {1, 0, 0, 0, 0, 1}, rest[6] = {0};
    const double unit = 0x1p-53;
    assert_true(cipc_momentum_rounding(&h->model, fast, slow, 8, 0) == 64 * 10 * unit * 23);
    assert_true(cipc_momentum_rounding(&h->model, slow, fast, 8, 0) == 64 * 10 * unit * 23);
    assert_true(cipc_momentum_rounding(&h->model, slow, slow, 0, -1) == 64 * 2 * unit * 7);
    assert_true(cipc_momentum_rounding(&h->model, slow, slow, 0, 14) == 64 * 2 * unit * 14); /* sqrt(2 * 7 * 14) */
    assert_true(cipc_momentum_rounding(&h->model, rest, rest, 1000, 0) == 0);
    destroy(h);
}

/* A chain of stretched springs that starts at rest, kick by kick: rounding stays within the bound although nothing moves at the start; 1e-10 of every second
 * impulse missing at one end does not. */
static void test_kicks_of_a_chain(void **state)
{
    (void)state;
    enum { COUNT = 20, ROUNDS = 2000 };
    const double stiffness = 50, h = 0.01;
    cipc_error error;
    double mass[COUNT], change;
    uint64_t seed = 7;
    for (int i = 0; i < COUNT; i++) { mass[i] = random_uniform(&seed, 0.3, 1); }
    hand_model *model = particles(mass, COUNT);
    for (int wrong = 0; wrong < 2; wrong++) {
        double x[3 * COUNT] = {0}, v[3 * COUNT] = {0}, energy = 0;
        const double start[3 * COUNT] = {0};
        for (int i = 0; i < COUNT; i++) { x[3 * i] = 1.3 * i + random_uniform(&seed, -0.1, 0.1); }
        for (int i = 0; i + 1 < COUNT; i++) { energy += 0.5 * stiffness * (x[3 * i + 3] - x[3 * i] - 1) * (x[3 * i + 3] - x[3 * i] - 1); }
        for (int round = 0; round < ROUNDS; round++) {
            for (int i = 0; i + 1 < COUNT; i++) {
                double impulse = h * stiffness * (x[3 * i + 3] - x[3 * i] - 1);
                v[3 * i] += impulse / mass[i] * (wrong && i % 2 == 0 && impulse > 0 ? 1 - 1e-10 : 1);
                v[3 * i + 3] -= impulse / mass[i + 1];
            }
            for (int i = 0; i < COUNT; i++) { x[3 * i] += h * v[3 * i]; }
        }
        const double bound = cipc_momentum_rounding(&model->model, start, v, (COUNT - 1) * ROUNDS, energy);
        const cipc_status status = cipc_monitor_momentum(&model->model, start, v, bound, &change, &error);
        assert_int_equal(status, wrong ? CIPC_E_VIOLATED_MOMENTUM : CIPC_OK);
        assert_true(change > 0); /* there was something to bound */
    }
    destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_to_the_last_bit),       cmocka_unit_test(test_norm),  cmocka_unit_test(test_cancellation), cmocka_unit_test(test_bad_numbers),
        cmocka_unit_test(test_what_changes_momentum), cmocka_unit_test(test_bound_of_kicks),
        cmocka_unit_test(test_kicks_of_a_chain),
        cmocka_unit_test(test_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
