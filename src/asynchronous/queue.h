/* The event queue: a binary heap in which every event knows its place, so that it can be moved. At equal times events come by rank, then by order, which depend on what an event is
 * and never on when it was put in: the sequence of events is a function of the scene alone. */
#ifndef ASYNCHRONOUS_QUEUE_H
#define ASYNCHRONOUS_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct asynchronous_event {
    uint64_t order;
    uint32_t rank;
    int owner;      /* what the event is about: a clock, a pair, a node */
    int place;      /* in the heap; -1: not scheduled */
} asynchronous_event;

typedef struct asynchronous_entry { double time; int event; } asynchronous_entry;

typedef struct asynchronous_queue {
    asynchronous_event *events;
    asynchronous_entry *heap;
    int *unused;    /* numbers of events that were given back */
    int count, capacity, unused_count, scheduled;
} asynchronous_queue;

void asynchronous_queue_free(asynchronous_queue *queue);
/* A new event, not scheduled. -1: out of memory. */
int asynchronous_queue_add(asynchronous_queue *queue, uint32_t rank, uint64_t order, int owner);
/* Give an event back; scheduled or not. */
void asynchronous_queue_drop(asynchronous_queue *queue, int event);
/* Schedule, or move: time INFINITY takes the event out. */
void asynchronous_queue_schedule(asynchronous_queue *queue, int event, double time);
/* The next event, or -1. */
static inline int asynchronous_queue_next(const asynchronous_queue *queue) { return queue->scheduled > 0 ? queue->heap[0].event : -1; }
static inline double asynchronous_queue_time(const asynchronous_queue *queue, int event) { return queue->heap[queue->events[event].place].time; }

#endif
