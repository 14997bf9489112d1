/* Regular clocks: the first tick is the first one later than a given time, to the last bit, for steps and times however unfortunate; mirrored clocks tick at the same times backwards. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "asynchronous/clock.h"
#include "support/exact_geometry.h"

/* Ticks must be told apart: the integrator refuses steps below 4 * 2^-52 of the time, which makes this the largest number of a tick. */
static const double MOST_TICKS = 0x1p50;

static void assert_first(double h, double t)
{
    const int64_t k = asynchronous_first_tick(0, h, t);
    assert_true(asynchronous_tick_time(0, h, k) > t);
    assert_true(asynchronous_tick_time(0, h, k - 1) <= t);
}

static void assert_first_mirrored(double mirror, double h, double t)
{
    const int64_t k = asynchronous_first_tick(mirror, h, t);
    assert_true(asynchronous_tick_time(mirror, h, k) > t);
    assert_true(asynchronous_tick_time(mirror, h, k + 1) <= t);
}

static double draw_step(uint64_t *seed)
{
    static const double nasty[] = {0.1, 1.0 / 3, 0.04, 1e-3, 1.0 / 49, 0x1p-20, 0x1.fffffffffffffp-8, 0x1.0000000000001p-8, 1e-9};
    return random_below(seed, 3) ? exp(random_uniform(seed, -20, 5)) : nasty[random_below(seed, 9)];
}

/* On a tick, one unit in the last place beside it, and anywhere. */
static double draw_time(uint64_t *seed, double h)
{
    const double most = fmin(MOST_TICKS, 1e6 / h), ticks = floor(exp(random_uniform(seed, 0, log(most)))), t = ticks * h;
    switch (random_below(seed, 5)) {
    case 0: return nextafter(t, 0);
    case 1: return nextafter(t, INFINITY);
    case 2: return t * random_uniform(seed, 0, 1);
    case 3: return 0;
    default: return t;
    }
}

static void test_first_tick_after(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 300000; i++) {
        const double h = draw_step(&seed);
        assert_first(h, draw_time(&seed, h));
    }
    assert_int_equal(asynchronous_first_tick(0, 0.25, 0), 1); /* what ticks at the start has ticked */
    assert_int_equal(asynchronous_first_tick(0, 0.25, 0.5), 3);
}

static void test_first_tick_mirrored(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 300000; i++) {
        const double h = draw_step(&seed), mirror = 2 * (draw_time(&seed, h) + h);
        assert_first_mirrored(mirror, h, mirror - draw_time(&seed, h));
        assert_first_mirrored(mirror, h, mirror / 2);
    }
}

/* A clock that is asked after each of its ticks for the next one leaves none out, and so does one that counts. */
static void test_no_tick_is_left_out(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 300; i++) {
        const double h = draw_step(&seed), mirror = random_below(&seed, 2) ? 2000.5 * h : 0;
        int64_t k = asynchronous_first_tick(mirror, h, mirror / 2);
        for (int tick = 0; tick < 900; tick++) {
            const double t = asynchronous_tick_time(mirror, h, k);
            k = asynchronous_tick_after(mirror, k);
            assert_true(asynchronous_tick_time(mirror, h, k) > t);
            assert_true(asynchronous_first_tick(mirror, h, t) == k);
        }
    }
}

/* What ticked at t on the way there ticks at mirror - t on the way back: for steps that are exact, to the last bit. */
static void test_mirrored_ticks_are_the_same_backwards(void **state)
{
    (void)state;
    const double h = 0x1.8p-7, turn = 1, mirror = 2 * turn;
    int64_t k = asynchronous_first_tick(0, h, 0), back = asynchronous_first_tick(mirror, h, turn);
    while (asynchronous_tick_time(0, h, asynchronous_tick_after(0, k)) <= turn) k++;
    for (; k > 0; k--, back = asynchronous_tick_after(mirror, back)) assert_true(asynchronous_tick_time(mirror, h, back) == mirror - asynchronous_tick_time(0, h, k));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_first_tick_after),
        cmocka_unit_test(test_first_tick_mirrored),
        cmocka_unit_test(test_no_tick_is_left_out),
        cmocka_unit_test(test_mirrored_ticks_are_the_same_backwards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
