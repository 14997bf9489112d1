/* Regular clocks: ticks at k h, k integer, computed from k and never summed up, so that a clock that was left alone is never out of phase (SPEC A.2). A mirrored clock ticks at
 * mirror - k h instead, with k falling: the ticks of a run from 0 to mirror/2 in reverse order. */
#ifndef ASYNCHRONOUS_CLOCK_H
#define ASYNCHRONOUS_CLOCK_H

#include <math.h>
#include <stdint.h>

static inline double asynchronous_tick_time(double mirror, double h, int64_t k) { return mirror > 0 ? mirror - (double)k * h : (double)k * h; }

static inline int64_t asynchronous_tick_after(double mirror, int64_t k) { return mirror > 0 ? k - 1 : k + 1; }

/* The first tick later than t: k = floor(t/h) + 1, but for the rounding of the quotient. */
static inline int64_t asynchronous_first_tick(double mirror, double h, double t)
{
    if (mirror > 0) {
        int64_t k = (int64_t)ceil((mirror - t) / h) - 1;
        while (mirror - (double)k * h <= t) k--;
        while (mirror - (double)(k + 1) * h > t) k++;
        return k;
    }
    int64_t k = (int64_t)floor(t / h) + 1;
    while ((double)k * h <= t) k++;
    while ((double)(k - 1) * h > t) k--;
    return k;
}

#endif
