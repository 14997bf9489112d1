/* The event queue against a plain list of all events; ties by rank, then order, in whatever sequence events came in; out of memory at every allocation. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "asynchronous/queue.h"
#include "support/exact_geometry.h"
#include "support/failing_memory.h"

/* ---- The slow twin: a list that is searched from end to end ---- */

enum { MOST_EVENTS = 300 };

typedef struct listed {
    bool exists;
    uint32_t rank;
    uint64_t order;
    int owner;
    double time; /* INFINITY: not scheduled */
} listed;

static bool comes_before(const listed *p, const listed *q)
{
    if (p->time != q->time) return p->time < q->time;
    if (p->rank != q->rank) return p->rank < q->rank;
    return p->order < q->order;
}

static int first_of(const listed *list)
{
    int first = -1;
    for (int i = 0; i < MOST_EVENTS; i++)
        if (list[i].exists && list[i].time < INFINITY && (first < 0 || comes_before(&list[i], &list[first]))) first = i;
    return first;
}

static int pick_existing(uint64_t *seed, const listed *list)
{
    for (int tries = 0; tries < 100; tries++) {
        const int i = random_below(seed, MOST_EVENTS);
        if (list[i].exists) return i;
    }
    return -1;
}

/* Few distinct times and ranks, so that most decisions are about ties. */
static double draw_time(uint64_t *seed)
{
    const double special[] = {INFINITY, NAN, 0, -0.0, 1, DBL_MAX};
    const int which = random_below(seed, 40);
    return which < 6 ? special[which] : 0.25 * random_below(seed, 12);
}

static void add(uint64_t *seed, asynchronous_queue *queue, listed *list, uint64_t *orders)
{
    const uint32_t rank = (uint32_t)random_below(seed, 3);
    const uint64_t order = (*orders)++ * 0x9E3779B97F4A7C15u; /* each once, in no order of time */
    const int event = asynchronous_queue_add(queue, rank, order, 7 * (int)rank);
    assert_in_range(event, 0, MOST_EVENTS - 1);
    assert_false(list[event].exists);
    list[event] = (listed){true, rank, order, 7 * (int)rank, INFINITY};
}

static void schedule(uint64_t *seed, asynchronous_queue *queue, listed *list, int event)
{
    const double time = draw_time(seed);
    asynchronous_queue_schedule(queue, event, time);
    list[event].time = time < INFINITY ? time : INFINITY; /* what is no time takes it out as well */
}

static void assert_same(const asynchronous_queue *queue, const listed *list)
{
    int scheduled = 0;
    for (int i = 0; i < MOST_EVENTS; i++) {
        if (!list[i].exists) continue;
        assert_int_equal(queue->events[i].rank, list[i].rank);
        assert_true(queue->events[i].order == list[i].order);
        assert_int_equal(queue->events[i].owner, list[i].owner);
        assert_int_equal(queue->events[i].place >= 0, list[i].time < INFINITY);
        if (!(list[i].time < INFINITY)) continue;
        assert_true(asynchronous_queue_time(queue, i) == list[i].time);
        scheduled++;
    }
    assert_int_equal(queue->scheduled, scheduled);
}

static void test_against_a_list(void **state)
{
    (void)state;
    uint64_t seed = 1, orders = 1;
    static listed list[MOST_EVENTS];
    asynchronous_queue queue = {0};
    int count = 0, ties = 0;
    memset(list, 0, sizeof list);
    for (int step = 0; step < 30000; step++) {
        const int what = random_below(&seed, 10), event = pick_existing(&seed, list);
        if (what < 2 && count < MOST_EVENTS) {
            add(&seed, &queue, list, &orders);
            count++;
        } else if (what == 2 && event >= 0) {
            asynchronous_queue_drop(&queue, event);
            list[event].exists = false;
            count--;
        } else if (event >= 0) {
            schedule(&seed, &queue, list, event);
        }
        const int next = asynchronous_queue_next(&queue), wanted = first_of(list);
        assert_int_equal(next, wanted);
        if (step % 100 == 0) assert_same(&queue, list);
        for (int i = 0; next >= 0 && i < MOST_EVENTS; i++) ties += i != next && list[i].exists && list[i].time == list[next].time;
    }
    assert_true(ties > 100000);
    asynchronous_queue_free(&queue);
    assert_null(queue.heap);
}

/* ---- Ties ---- */

enum { TIED = 60 };

static void shuffle(uint64_t *seed, int *list, int count)
{
    for (int i = count - 1; i > 0; i--) {
        const int j = random_below(seed, i + 1), swap = list[i];
        list[i] = list[j];
        list[j] = swap;
    }
}

/* Sixty events at one instant, of ranks 0..2 and orders up to 2^64: in whatever sequence they were put in, moved and taken out again, they come the same. */
static void test_ties_do_not_know_their_history(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int trial = 0; trial < 200; trial++) {
        asynchronous_queue queue = {0};
        int sequence[TIED], event[TIED];
        for (int i = 0; i < TIED; i++) sequence[i] = i;
        shuffle(&seed, sequence, TIED);
        for (int i = 0; i < TIED; i++) {
            const int who = sequence[i]; /* its place in the order wanted */
            event[who] = asynchronous_queue_add(&queue, (uint32_t)(who / 20), UINT64_MAX / 20 * (uint64_t)(who % 20 + 1), who);
            asynchronous_queue_schedule(&queue, event[who], random_uniform(&seed, 0, 9));
        }
        shuffle(&seed, sequence, TIED);
        for (int i = 0; i < TIED; i++) asynchronous_queue_schedule(&queue, event[sequence[i]], 4.5);
        for (int i = 0; i < TIED; i++) {
            const int next = asynchronous_queue_next(&queue);
            assert_int_equal(queue.events[next].owner, i);
            asynchronous_queue_schedule(&queue, next, INFINITY);
        }
        assert_int_equal(asynchronous_queue_next(&queue), -1);
        asynchronous_queue_free(&queue);
    }
}

/* ---- Out of memory ---- */

static void test_out_of_memory(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    long n = 1;
    for (;; n++) {
        asynchronous_queue queue = {0};
        int refused = 0;
        fail_allocation(n);
        for (int i = 0; i < COUNT; i++) {
            int event = asynchronous_queue_add(&queue, 0, (uint64_t)i, i);
            if (event < 0) refused++;
            if (event < 0) event = asynchronous_queue_add(&queue, 0, (uint64_t)i, i); /* the queue is as it was, and goes on when there is memory again */
            assert_true(event >= 0);
            asynchronous_queue_schedule(&queue, event, (double)(COUNT - i));
        }
        const bool failed = allocation_failed();
        fail_allocation(0);
        assert_int_equal(refused, failed);
        for (int i = COUNT - 1; i >= 0; i--) {
            const int next = asynchronous_queue_next(&queue);
            assert_int_equal(queue.events[next].owner, i);
            asynchronous_queue_drop(&queue, next);
        }
        assert_int_equal(asynchronous_queue_next(&queue), -1);
        asynchronous_queue_free(&queue);
        if (!failed) break;
    }
    assert_true(n > 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_a_list),
        cmocka_unit_test(test_ties_do_not_know_their_history),
        cmocka_unit_test(test_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
