/* The sweeps of the bound on deformation, of the springs alone that may be beyond it (docs/theory/massspring_springs.md (12), and "The springs that are looked at"). */
#include "massspring/bound.h"

#include <stdint.h>
#include <string.h>

#include "base/vector.h"
#include "massspring/deformation.h"

/* A set of springs or nodes, in order. */
typedef struct bit_set {
    uint64_t *words;
    int count; /* of words */
} bit_set;

struct massspring_bound {
    int *first;        /* by node, node_count + 1: where its springs begin in `springs` */
    int *springs;
    bit_set open;      /* springs that may be beyond the bound: an end has moved since they were last within it */
    bit_set moved;     /* nodes that this sweep has moved */
};

static bool bit_set_create(bit_set *set, int bits)
{
    set->count = bits / 64 + 1;
    set->words = cipc_alloc((size_t)set->count, sizeof *set->words);
    return set->words != NULL;
}

static void put(bit_set *set, int i) { set->words[i / 64] |= UINT64_C(1) << (i % 64); }
static void take(bit_set *set, int i) { set->words[i / 64] &= ~(UINT64_C(1) << (i % 64)); }
static void clear(bit_set *set) { memset(set->words, 0, (size_t)set->count * sizeof *set->words); }

/* The first member at or above i, or the last at or below it; -1: none. What has been put in on the way is seen, if it is still ahead. */
static int next_up(const bit_set *set, int i)
{
    uint64_t mask = ~UINT64_C(0) << (i % 64);
    for (int w = i / 64; w < set->count; w++, mask = ~UINT64_C(0))
        if (set->words[w] & mask) return 64 * w + __builtin_ctzll(set->words[w] & mask);
    return -1;
}

static int next_down(const bit_set *set, int i)
{
    if (i < 0) return -1;
    uint64_t mask = ~UINT64_C(0) >> (63 - i % 64);
    for (int w = i / 64; w >= 0; w--, mask = ~UINT64_C(0))
        if (set->words[w] & mask) return 64 * w + 63 - __builtin_clzll(set->words[w] & mask);
    return -1;
}

/* ---- Springs of nodes ---- */

static void list_springs(massspring_bound *b, const int (*ends)[2], int count, int node_count)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) b->first[ends[i][k] + 1]++;
    for (int i = 0; i < node_count; i++) b->first[i + 1] += b->first[i];
    for (int i = count - 1; i >= 0; i--) /* from the back: `first` ends as the end of the node before, which is the beginning */
        for (int k = 0; k < 2; k++) b->springs[--b->first[ends[i][k] + 1]] = i;
    memmove(b->first, b->first + 1, (size_t)node_count * sizeof *b->first);
    b->first[node_count] = 2 * count;
}

massspring_bound *massspring_bound_create(const int (*ends)[2], int count, int node_count)
{
    massspring_bound *b = cipc_alloc(1, sizeof *b);
    if (!b) return NULL;
    b->first = cipc_alloc((size_t)node_count + 1, sizeof *b->first);
    b->springs = cipc_alloc(2 * (size_t)count, sizeof *b->springs);
    if (!b->first || !b->springs || !bit_set_create(&b->open, count) || !bit_set_create(&b->moved, node_count)) {
        massspring_bound_destroy(b);
        return NULL;
    }
    list_springs(b, ends, count, node_count);
    return b;
}

void massspring_bound_destroy(massspring_bound *b)
{
    if (!b) return;
    cipc_free(b->first);
    cipc_free(b->springs);
    cipc_free(b->open.words);
    cipc_free(b->moved.words);
    cipc_free(b);
}

/* ---- Sweeps ---- */

static void open_springs_of(massspring_bound *b, int node)
{
    for (int k = b->first[node]; k < b->first[node + 1]; k++) put(&b->open, b->springs[k]);
}

static void sweep_one(massspring_bound *b, const massspring_sheet *s, const massspring_ends_moved *m, double bound, int i)
{
    if (!massspring_project_spring(m, &s->springs[i], s->ends[i], bound)) {
        take(&b->open, i);
        return;
    }
    for (int k = 0; k < 2; k++) {
        const int node = s->ends[i][k];
        if (!(s->inverse_mass[node] > 0)) continue;
        open_springs_of(b, node);
        put(&b->moved, node);
    }
}

static void let_move(massspring_bound *b, const massspring_sheet *s, massspring_after_sweep *after, void *context)
{
    for (int i = next_up(&b->moved, 0); i >= 0 && after; i = next_up(&b->moved, i + 1))
        if (after(context, i, s->x + 3 * (size_t)i, s->v + 3 * (size_t)i)) open_springs_of(b, i);
    clear(&b->moved);
}

static bool any_beyond(const massspring_bound *b, const massspring_sheet *s, double bound, double tolerance)
{
    for (int i = next_up(&b->open, 0); i >= 0; i = next_up(&b->open, i + 1))
        if (!(massspring_deformation_of(&s->springs[i], s->ends[i], s->x) <= bound * (1 + tolerance))) return true;
    return false;
}

int massspring_bound_sweep(massspring_bound *b, const massspring_sheet *s, double bound, double tolerance, int sweeps, massspring_after_sweep *after, void *context, bool *kept)
{
    const massspring_ends_moved m = {s->inverse_mass, s->dt > 0 ? 1 / s->dt : 0, s->x, s->v};
    int done = 0;
    clear(&b->open);
    clear(&b->moved);
    for (int i = 0; i < s->count; i++) put(&b->open, i);
    while (!(*kept = !any_beyond(b, s, bound, tolerance)) && done < sweeps) {
        if (done % 2 == 0)
            for (int i = next_up(&b->open, 0); i >= 0; i = next_up(&b->open, i + 1)) sweep_one(b, s, &m, bound, i);
        else
            for (int i = next_down(&b->open, s->count - 1); i >= 0; i = next_down(&b->open, i - 1)) sweep_one(b, s, &m, bound, i);
        let_move(b, s, after, context);
        done++;
    }
    return done;
}
