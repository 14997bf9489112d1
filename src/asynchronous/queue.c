/* The event queue. */
#include "asynchronous/queue.h"

#include <math.h>

#include "cipc/base.h"

void asynchronous_queue_free(asynchronous_queue *queue)
{
    cipc_free(queue->events);
    cipc_free(queue->heap);
    cipc_free(queue->unused);
    *queue = (asynchronous_queue){0};
}

static bool grow(asynchronous_queue *queue)
{
    const int capacity = queue->capacity > 0 ? 2 * queue->capacity : 64;
    asynchronous_event *events = cipc_realloc(queue->events, (size_t)capacity, sizeof *events);
    if (events) queue->events = events;
    asynchronous_entry *heap = cipc_realloc(queue->heap, (size_t)capacity, sizeof *heap);
    if (heap) queue->heap = heap;
    int *unused = cipc_realloc(queue->unused, (size_t)capacity, sizeof *unused);
    if (unused) queue->unused = unused;
    if (!events || !heap || !unused) return false;
    queue->capacity = capacity;
    return true;
}

int asynchronous_queue_add(asynchronous_queue *queue, uint32_t rank, uint64_t order, int owner)
{
    int event = 0;
    if (queue->unused_count > 0) {
        event = queue->unused[--queue->unused_count];
    } else {
        if (queue->count == queue->capacity && !grow(queue)) return -1;
        event = queue->count++;
    }
    queue->events[event] = (asynchronous_event){.order = order, .rank = rank, .owner = owner, .place = -1};
    return event;
}

static bool is_before(const asynchronous_queue *queue, asynchronous_entry a, asynchronous_entry b)
{
    if (a.time != b.time) return a.time < b.time;
    const asynchronous_event *p = &queue->events[a.event], *q = &queue->events[b.event];
    return p->rank != q->rank ? p->rank < q->rank : p->order < q->order;
}

static void put(asynchronous_queue *queue, int place, asynchronous_entry entry)
{
    queue->heap[place] = entry;
    queue->events[entry.event].place = place;
}

static void rise(asynchronous_queue *queue, int place, asynchronous_entry entry)
{
    while (place > 0) {
        const int parent = (place - 1) / 2;
        if (!is_before(queue, entry, queue->heap[parent])) break;
        put(queue, place, queue->heap[parent]);
        place = parent;
    }
    put(queue, place, entry);
}

static void sink(asynchronous_queue *queue, int place, asynchronous_entry entry)
{
    for (int child = 2 * place + 1; child < queue->scheduled; child = 2 * place + 1) {
        if (child + 1 < queue->scheduled && is_before(queue, queue->heap[child + 1], queue->heap[child])) child++;
        if (!is_before(queue, queue->heap[child], entry)) break;
        put(queue, place, queue->heap[child]);
        place = child;
    }
    put(queue, place, entry);
}

static void settle(asynchronous_queue *queue, int place, asynchronous_entry entry)
{
    if (place > 0 && is_before(queue, entry, queue->heap[(place - 1) / 2])) rise(queue, place, entry);
    else sink(queue, place, entry);
}

static void take_out(asynchronous_queue *queue, int event)
{
    const int place = queue->events[event].place;
    if (place < 0) return;
    queue->events[event].place = -1;
    const asynchronous_entry last = queue->heap[--queue->scheduled];
    if (last.event != event) settle(queue, place, last);
}

void asynchronous_queue_drop(asynchronous_queue *queue, int event)
{
    take_out(queue, event);
    queue->unused[queue->unused_count++] = event;
}

void asynchronous_queue_schedule(asynchronous_queue *queue, int event, double time)
{
    if (!(time < INFINITY)) {
        take_out(queue, event);
        return;
    }
    const int place = queue->events[event].place;
    const asynchronous_entry entry = {time, event};
    if (place < 0) rise(queue, queue->scheduled++, entry);
    else settle(queue, place, entry);
}
