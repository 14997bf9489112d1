/* Lists of candidate pairs. */
#include "cipc/contact.h"

#include <string.h>

static const cipc_pair_kind order[CIPC_PAIR_KIND_COUNT] = {CIPC_POINT_TRIANGLE, CIPC_EDGE_EDGE, CIPC_POINT_EDGE, CIPC_POINT_POINT};

long cipc_candidates_count(const cipc_candidates *c)
{
    long count = 0;
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) count += c->lists[k].count;
    return count;
}

const int *cipc_candidates_pair(const cipc_candidates *c, long index, cipc_pair_kind *kind)
{
    int k = 0;
    while (index >= c->lists[order[k]].count) index -= c->lists[order[k++]].count;
    *kind = order[k];
    return c->lists[order[k]].pairs[index];
}

void cipc_candidates_free(cipc_candidates *c)
{
    for (int k = 0; k < CIPC_PAIR_KIND_COUNT; k++) cipc_free(c->lists[k].pairs);
    memset(c, 0, sizeof *c);
}
