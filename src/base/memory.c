/* Checked memory: the only file that calls malloc and its family (ci/check-layers proves it). */
#include "cipc/base.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* An empty array still gets a block of its own, so that NULL always means failure. */
static size_t at_least_one(size_t n)
{
    return n > 0 ? n : 1;
}

static bool overflows(size_t count, size_t size)
{
    return count > SIZE_MAX / size;
}

void *cipc_alloc(size_t count, size_t size)
{
    size_t elements = at_least_one(count), bytes = at_least_one(size);
    if (overflows(elements, bytes)) {
        return NULL;
    }
    return calloc(elements, bytes);
}

void *cipc_realloc(void *block, size_t count, size_t size)
{
    size_t elements = at_least_one(count), bytes = at_least_one(size);
    if (overflows(elements, bytes)) {
        return NULL;
    }
    return realloc(block, elements * bytes);
}

void cipc_free(void *block)
{
    free(block);
}
