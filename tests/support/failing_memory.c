#include "support/failing_memory.h"

#include <stdatomic.h>
#include <stddef.h>

/* Atomic, because the code under test may allocate in parallel loops. */
static atomic_long count;
static atomic_long failing;
static atomic_bool failed;

void *__real_calloc(size_t elements, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_calloc(size_t elements, size_t size);
void *__wrap_realloc(void *block, size_t size);

void fail_allocation(long n)
{
    count = 0;
    failing = n;
    failed = false;
}

bool allocation_failed(void)
{
    return failed;
}

long allocation_count(void)
{
    return count;
}

static bool refuse(void)
{
    long number = ++count;
    if (number == failing) {
        failed = true;
        return true;
    }
    return false;
}

void *__wrap_calloc(size_t elements, size_t size)
{
    return refuse() ? NULL : __real_calloc(elements, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    return refuse() ? NULL : __real_realloc(block, size);
}
