/* Culling changes nothing (SPEC T-A6, the paper's central observation): runs in which only the layers in touch tick have the same bits as runs in which every layer of every pair ticks at all
 * times. And nothing else that the integrator remembers or is asked to do besides changes a bit: lists made afresh, states taken up by new integrators, monitors, repetition. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

#include "asynchronous/integrator.h"
#include "support/asynchronous_crowd.h"
#include "support/claim.h"
#include "support/exact_geometry.h"

static size_t size_of(const asynchronous_scene *s) { return 3 * (size_t)s->sheet.model->node_count * sizeof(double); }

static bool same_bits(const asynchronous_scene *s, const asynchronous_scene *t)
{
    return memcmp(s->sheet.state->position, t->sheet.state->position, size_of(s)) == 0 && memcmp(s->sheet.state->velocity, t->sheet.state->velocity, size_of(s)) == 0;
}

static long bits_that_differ(const double *a, const double *b, size_t bytes)
{
    long count = 0;
    for (size_t i = 0; i < bytes; i++) count += __builtin_popcount((unsigned)(((const unsigned char *)a)[i] ^ ((const unsigned char *)b)[i]));
    return count;
}

/* ---- With and without culling ---- */

typedef struct culled_case {
    unsigned kinds;
    double speed, restitution, friction, damping;
    cipc_clocks clocks;
    int layers; /* that the reference has; more than the run ever needs */
    int frames, seeds;
} culled_case;

static void start(asynchronous_scene *s, const culled_case *c, uint64_t seed)
{
    crowd_shape shape = crowd_shape_default();
    shape.kinds = c->kinds;
    shape.cells = 1;
    shape.speed = c->speed;
    shape.friction = c->friction;
    shape.damping = c->damping;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    s->options.restitution = c->restitution;
    s->options.clocks = c->clocks;
    s->options.layer_factor = 0.3; /* coarse: what is compared is bits, not energies */
    crowd_build(s, &shape);
}

/* How many bits of all frames differ. Which kinds of pairs were in contact is added up. */
static long compare_with_reference(const culled_case *c, uint64_t seed, long contacts[CIPC_PAIR_KIND_COUNT])
{
    asynchronous_scene culled, reference;
    long different = 0;
    start(&culled, c, seed);
    start(&reference, c, seed);
    reference.options.always_layers = c->layers;
    reference.options.event_limit = 1000000000;
    asynchronous_scene_start(&reference);
    for (int frame = 0; frame < c->frames; frame++) {
        asynchronous_steps(&culled, 1);
        asynchronous_steps(&reference, 1);
        different += bits_that_differ(culled.sheet.state->position, reference.sheet.state->position, size_of(&culled));
        different += bits_that_differ(culled.sheet.state->velocity, reference.sheet.state->velocity, size_of(&culled));
        crowd_count_contacts(&culled, contacts);
    }
    if (!different) assert_int_equal(culled.events[CIPC_EVENT_PENALTY], reference.events[CIPC_EVENT_PENALTY]);
    assert_true(culled.layers < c->layers);
    assert_true(culled.events[CIPC_EVENT_IDLE] < reference.events[CIPC_EVENT_IDLE] / 10);
    asynchronous_scene_free(&culled);
    asynchronous_scene_free(&reference);
    return different;
}

static void test_culling_changes_nothing(void **state)
{
    (void)state;
    static const culled_case cases[] = {
        {CROWD_SHEETS, 0.3, 0, 0.3, 0, CIPC_CLOCKS_NESTED, 9, 50, 2},
        {CROWD_SHEETS | CROWD_RODS, 0.3, 1, 0, 1e-3, CIPC_CLOCKS_OWN, 14, 30, 1},
        {CROWD_RODS | CROWD_PARTICLES, 0.5, 0.5, 0.4, 0, CIPC_CLOCKS_NESTED, 12, 40, 2},
        {CROWD_VOLUME | CROWD_RODS, 0.3, 0.7, 0.2, 1e-3, CIPC_CLOCKS_OWN, 8, 28, 1},
        {CROWD_SHEETS | CROWD_STITCHES | CROWD_PARTICLES, 0.3, 0.2, 0.2, 1e-4, CIPC_CLOCKS_NESTED, 13, 32, 1},
    };
    long contacts[CIPC_PAIR_KIND_COUNT] = {0}, different = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (uint64_t seed = 0; seed < (uint64_t)cases[i].seeds; seed++) different += compare_with_reference(&cases[i], 10 * i + seed, contacts);
    claim_figure("A5", "bits that differ between culled and unculled", (double)different, "1", CLAIM_EQUAL, 0);
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) assert_true(contacts[k] > 0);
}

/* ---- Everything else that must not change a bit ---- */

enum { FRAMES = 30 };

/* A crowd of all kinds, with restitution, friction and damping. */
static void start_crowd(asynchronous_scene *s, uint64_t seed)
{
    crowd_shape shape = crowd_shape_default();
    shape.cells = 3;
    shape.friction = 0.3;
    shape.damping = 1e-4;
    shape.speed = 0.6;
    asynchronous_scene_init(s);
    crowd_add(s, &shape, seed);
    s->options.restitution = 0.4;
    crowd_build(s, &shape);
}

/* What is done to the second of two runs before each frame. */
typedef void disturbance(asynchronous_scene *s, uint64_t *seed);

static void assert_undisturbed(disturbance *disturb, uint64_t seed)
{
    asynchronous_scene s, reference;
    long contacts[CIPC_PAIR_KIND_COUNT] = {0};
    start_crowd(&s, seed);
    start_crowd(&reference, seed);
    for (int frame = 0; frame < FRAMES; frame++) {
        disturb(&s, &seed);
        asynchronous_steps(&s, 1);
        asynchronous_steps(&reference, 1);
        assert_true(same_bits(&s, &reference));
        crowd_count_contacts(&s, contacts);
    }
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) assert_true(contacts[k] > 0);
    asynchronous_scene_free(&s);
    asynchronous_scene_free(&reference);
}

static void nothing(asynchronous_scene *s, uint64_t *seed) { (void)s, (void)seed; }

static void test_repeated_runs(void **state)
{
    (void)state;
    assert_undisturbed(nothing, 1);
}

/* Now or at the next event of a ball, in the middle of the frame, every certificate is thrown away and the list of near pairs made anew. */
static void make_lists_afresh(asynchronous_scene *s, uint64_t *seed)
{
    cipc_asynchronous *a = s->integrator;
    if (!a->loaded) return;
    if (random_below(seed, 3) == 0) a->broad.fresh_entries = -100000;
    if (random_below(seed, 3) == 0) asynchronous_separation_start(a);
}

static void test_lists_made_afresh(void **state)
{
    (void)state;
    assert_undisturbed(make_lists_afresh, 2);
    assert_undisturbed(make_lists_afresh, 3);
}

/* --resume: the run goes on with another integrator, which knows the state and nothing else. */
static void go_on_with_another(asynchronous_scene *s, uint64_t *seed)
{
    if (random_below(seed, 2)) asynchronous_scene_start(s);
}

static void test_states_taken_up(void **state)
{
    (void)state;
    assert_undisturbed(go_on_with_another, 4);
    assert_undisturbed(go_on_with_another, 5);
}

static void watch_or_not(asynchronous_scene *s, uint64_t *seed)
{
    const int what = random_below(seed, 3);
    if (what == 0) asynchronous_watch(s);
    if (what == 1) cipc_asynchronous_set_monitor(s->integrator, NULL, NULL);
}

static void test_monitors(void **state)
{
    (void)state;
    assert_undisturbed(watch_or_not, 3);
}

/* ---- An instant at which everything happens at once ---- */

/* A particle in contact with another, in one layer whose steps are exactly 1/64 s; a third one, far away and slow, whose ball's certificate ends with the frame at exactly 1/16 s. */
static void start_coincidence(asynchronous_scene *s)
{
    const double x[9] = {0, 0, 0, 0.09, 0, 0, 50, 0, 0}, at_rest[3] = {0}, slow[3] = {1e-4, 0, 0};
    asynchronous_scene_init(s);
    s->options.thickness = 0.1;
    s->options.stiffness = 2;
    s->options.layer_factor = 1.0 / 64;
    s->options.frame = 1.0 / 16;
    asynchronous_add_particles(s, "two", 2, x, at_rest, 1);
    asynchronous_add_particles(s, "one", 1, x + 6, slow, 1);
    asynchronous_scene_model(s);
    for (int i = 0; i < 3; i++) s->sheet.model->mass[i] = 1;
    asynchronous_scene_start(s);
}

/* The list is made afresh in the instant of a layer's tick, before it: the tick is not lost. */
static void test_list_made_afresh_at_a_tick(void **state)
{
    (void)state;
    asynchronous_scene s, reference;
    start_coincidence(&s);
    start_coincidence(&reference);
    for (int frame = 0; frame < 4; frame++) {
        asynchronous_steps(&s, 1);
        asynchronous_steps(&reference, 1);
        assert_int_equal(s.report.events[CIPC_EVENT_PENALTY], 4);
        assert_int_equal(reference.report.events[CIPC_EVENT_PENALTY], 4);
        assert_true(same_bits(&s, &reference));
        assert_true(asynchronous_queue_time(&s.integrator->queue, s.integrator->balls[2].event) == s.sheet.state->time + s.options.frame);
        s.integrator->broad.fresh_entries = -100000;
        s.integrator->balls[2].radius = 0; /* nobody is in the middle of that: it is made anew at its deadline, and the list with it */
    }
    asynchronous_scene_free(&s);
    asynchronous_scene_free(&reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_culling_changes_nothing),
        cmocka_unit_test(test_repeated_runs),
        cmocka_unit_test(test_lists_made_afresh),
        cmocka_unit_test(test_states_taken_up),
        cmocka_unit_test(test_monitors),
        cmocka_unit_test(test_list_made_afresh_at_a_tick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
