/* Allocations that fail on command. Every test program is linked with -Wl,--wrap=calloc,--wrap=realloc, so the calls of
 * base/memory.c (and of the test itself) pass through here; those of system libraries do not.
 *
 * The loop of an out-of-memory test:
 *     for (long n = 1;; n++) {
 *         fail_allocation(n);
 *         cipc_status status = thing_under_test();
 *         if (!allocation_failed()) break;              // fewer than n allocations: all of them have been tried
 *         assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
 *     }
 *     fail_allocation(0); */
#ifndef SUPPORT_FAILING_MEMORY_H
#define SUPPORT_FAILING_MEMORY_H

#include <stdbool.h>

/* Let the n-th allocation from now on fail, once (n = 1 is the next one); 0 lets all succeed. Resets allocation_failed(). */
void fail_allocation(long n);
/* Has the failure asked for happened? */
bool allocation_failed(void);
/* Number of allocations since the last fail_allocation(). */
long allocation_count(void);

#endif
