/* The filter of straight motion (docs/monitors.md, "The swept check").
 *
 * The separation of two primitives along a fixed direction is a concave function of time when their nodes move on straight lines. So a direction along which it
 * exceeds a length at both ends, certified, does so all the way. */
#include "invariant/moving_pair.h"

#include <math.h>

#include "base/vector.h"
#include "invariant/separation.h"

/* A direction found at one end, tried at the other. The first one found that clears, then the best one. */
static bool clear_from(cipc_pair_kind kind, const double here[12], const double there[12], double enough, double n[3])
{
    cipc_separation s = cipc_separate(kind, here, enough);
    if (!(s.lower > enough)) { return false; }
    v3_copy(n, s.n);
    if (cipc_separation_along(kind, there, s.n) > enough) { return true; }
    s = cipc_separate(kind, here, INFINITY);
    v3_copy(n, s.n);
    return s.lower > enough && cipc_separation_along(kind, there, s.n) > enough;
}

static bool clear_along(cipc_pair_kind kind, const double here[12], const double there[12], double enough, const double n[3])
{
    bool known = n[0] != 0 || n[1] != 0 || n[2] != 0;
    return known && cipc_separation_along(kind, here, n) > enough && cipc_separation_along(kind, there, n) > enough;
}

bool cipc_moving_pair_clear(cipc_pair_kind kind, const double here[12], const double there[12], double enough, double n[3])
{
    return clear_along(kind, here, there, enough, n) || clear_from(kind, here, there, enough, n) || clear_from(kind, there, here, enough, n);
}

/* A violation before what could not be decided. */
static bool is_before(const cipc_moving_pair *a, const cipc_moving_pair *b)
{
    if (a->violated != b->violated) { return a->violated; }
    if (a->kind != b->kind) { return a->kind < b->kind; }
    for (int i = 0; i < 4; i++) {
        if (a->nodes[i] != b->nodes[i]) { return a->nodes[i] < b->nodes[i]; }
    }
    return false;
}

void cipc_moving_result_keep(cipc_moving_result *result, const cipc_moving_pair *pair)
{
    if (!result->any || is_before(pair, &result->first)) { result->first = *pair; }
    result->any = true;
}

cipc_moving_result cipc_moving_result_merge(const cipc_moving_result *results, int count)
{
    cipc_moving_result all = {0};
    for (int i = 0; i < count; i++) {
        if (results[i].any) { cipc_moving_result_keep(&all, &results[i].first); }
        all.checked += results[i].checked;
        all.exact += results[i].exact;
    }
    return all;
}
