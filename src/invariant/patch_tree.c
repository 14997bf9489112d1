/* Broad phase of the monitors: a tree of boxes over a fixed order of the items. */
#include "invariant/patch_tree.h"

#include <math.h>
#include <string.h>

#include "cipc/base.h"

enum { SIZE = CIPC_PATCH_SIZE };

float cipc_round_down(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

float cipc_round_up(double x)
{
    float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

static void make_empty(cipc_patch *patch)
{
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < SIZE; i++) {
            patch->lo[k][i] = INFINITY;
            patch->hi[k][i] = -INFINITY;
        }
    }
}

bool cipc_patch_tree_init(cipc_patch_tree *tree, int count)
{
    memset(tree, 0, sizeof *tree);
    tree->count = count;
    int n = count;
    do {
        n = n / SIZE + (n % SIZE != 0 ? 1 : 0);
        n = n > 0 ? n : 1; /* an empty tree has one empty patch */
        cipc_patch *patches = cipc_alloc((size_t)n, sizeof *patches);
        if (patches == NULL) { return false; }
        for (int i = 0; i < n; i++) { make_empty(&patches[i]); }
        tree->levels[tree->level_count] = patches;
        tree->patch_count[tree->level_count] = n;
        tree->level_count++;
    } while (n > 1);
    return true;
}

void cipc_patch_tree_free(cipc_patch_tree *tree)
{
    for (int l = 0; l < tree->level_count; l++) { cipc_free(tree->levels[l]); }
    memset(tree, 0, sizeof *tree);
}

static void set_child(cipc_patch *patches, int child, const cipc_patch_box *box)
{
    cipc_patch *patch = &patches[child / SIZE];
    for (int k = 0; k < 3; k++) {
        patch->lo[k][child % SIZE] = box->lo[k];
        patch->hi[k][child % SIZE] = box->hi[k];
    }
}

void cipc_patch_tree_set(cipc_patch_tree *tree, int place, const cipc_patch_box *box)
{
    set_child(tree->levels[0], place, box);
}

/* Box of all children of a patch. */
static cipc_patch_box box_of_patch(const cipc_patch *patch)
{
    cipc_patch_box box;
    for (int k = 0; k < 3; k++) {
        float lo = patch->lo[k][0], hi = patch->hi[k][0];
        for (int i = 1; i < SIZE; i++) {
            lo = patch->lo[k][i] < lo ? patch->lo[k][i] : lo;
            hi = patch->hi[k][i] > hi ? patch->hi[k][i] : hi;
        }
        box.lo[k] = lo;
        box.hi[k] = hi;
    }
    return box;
}

void cipc_patch_tree_refit(cipc_patch_tree *tree)
{
    for (int l = 1; l < tree->level_count; l++) {
        for (int i = 0; i < tree->patch_count[l - 1]; i++) {
            cipc_patch_box box = box_of_patch(&tree->levels[l - 1][i]);
            set_child(tree->levels[l], i, &box);
        }
    }
}

static bool append_place(cipc_place_list *list, int place)
{
    if (list->count == list->capacity) {
        int capacity = 2 * list->capacity + 64;
        int *grown = cipc_realloc(list->places, (size_t)capacity, sizeof *grown);
        if (grown == NULL) { return false; }
        list->places = grown;
        list->capacity = capacity;
    }
    list->places[list->count++] = place;
    return true;
}

static cipc_patch_box box_of_child(const cipc_patch *patch, int child)
{
    cipc_patch_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = patch->lo[k][child];
        box.hi[k] = patch->hi[k][child];
    }
    return box;
}

cipc_patch_box cipc_patch_tree_item_box(const cipc_patch_tree *tree, int place)
{
    return box_of_child(&tree->levels[0][place / SIZE], place % SIZE);
}

cipc_patch_box cipc_patch_tree_patch_box(const cipc_patch_tree *tree, int patch)
{
    return tree->level_count > 1 ? box_of_child(&tree->levels[1][patch / SIZE], patch % SIZE) : box_of_patch(&tree->levels[0][patch]);
}

/* Without branches, so that compilers test several children at once. */
unsigned cipc_patch_overlaps(const cipc_patch *patch, const cipc_patch_box *box)
{
    int hit[SIZE];
    for (int i = 0; i < SIZE; i++) {
        hit[i] = (patch->lo[0][i] <= box->hi[0]) & (patch->hi[0][i] >= box->lo[0]) & (patch->lo[1][i] <= box->hi[1]) &
                 (patch->hi[1][i] >= box->lo[1]) & (patch->lo[2][i] <= box->hi[2]) & (patch->hi[2][i] >= box->lo[2]);
    }
    unsigned bits = 0;
    for (int i = 0; i < SIZE; i++) { bits |= (unsigned)hit[i] << i; }
    return bits;
}

/* One question to a tree. */
typedef struct patch_query {
    const cipc_patch_tree *tree;
    const cipc_patch_box *box;
    int first, last; /* lowest patches asked for, [first, last] */
    cipc_place_list *patches;
} patch_query;

/* Does child `child` of a patch at `level` > 0 cover a lowest patch in [first, last]? */
static inline bool covers(const patch_query *q, int level, int child)
{
    long long begin = (long long)child << (3 * (level - 1)), end = (long long)(child + 1) << (3 * (level - 1));
    return begin <= q->last && end > q->first;
}

static bool visit_patch(const patch_query *q, int level, int patch)
{
    unsigned bits = cipc_patch_overlaps(&q->tree->levels[level][patch], q->box);
    if (level == 0) { return bits == 0 || append_place(q->patches, patch); }
    for (; bits != 0; bits &= bits - 1) {
        int child = patch * SIZE + cipc_lowest_bit(bits);
        if (covers(q, level, child) && !visit_patch(q, level - 1, child)) { return false; }
    }
    return true;
}

bool cipc_patch_tree_query(const cipc_patch_tree *tree, const cipc_patch_box *box, int begin, int end, cipc_place_list *patches)
{
    const patch_query q = {tree, box, begin / SIZE, (end - 1) / SIZE, patches};
    return begin >= end || visit_patch(&q, tree->level_count - 1, 0);
}
