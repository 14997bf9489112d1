/* Broad phase of the monitors: a tree of boxes over a fixed order of the items. Eight consecutive items make a patch, eight patches a
 * larger one, and so on; when the nodes move only the boxes change. With neighbours of a mesh next to one another in the order, patches
 * stay compact however the mesh deforms; a long item swells the few patches above it only. The order affects speed, never the answer.
 *
 * Nothing here is approximate: boxes are rounded outwards, and every item whose box overlaps the asker's is reported, once. */
#ifndef CIPC_INVARIANT_PATCH_TREE_H
#define CIPC_INVARIANT_PATCH_TREE_H

#include <stdbool.h>

/* Closed box. Infinite bounds are allowed, NaN is not. */
typedef struct cipc_patch_box {
    float lo[3], hi[3];
} cipc_patch_box;

enum { CIPC_PATCH_SIZE = 8, CIPC_PATCH_LEVELS = 11 }; /* 8^11 exceeds any int */

/* The boxes of the children of a patch, coordinate by coordinate, so that all eight are tested at once. Missing children have empty
 * boxes. */
typedef struct cipc_patch {
    float lo[3][CIPC_PATCH_SIZE], hi[3][CIPC_PATCH_SIZE];
} cipc_patch;

typedef struct cipc_patch_tree {
    int count; /* items, named by their place 0 .. count-1 in the order */
    int level_count;
    cipc_patch *levels[CIPC_PATCH_LEVELS]; /* levels[0]: patches of items; the last level is one patch */
    int patch_count[CIPC_PATCH_LEVELS];
} cipc_patch_tree;

/* Growing list of places or patches. */
typedef struct cipc_place_list {
    int *places;
    int count, capacity;
} cipc_place_list;

/* Largest float <= x and smallest float >= x (x not NaN). */
float cipc_round_down(double x);
float cipc_round_up(double x);

/* False: out of memory (free is safe then). */
bool cipc_patch_tree_init(cipc_patch_tree *tree, int count);
void cipc_patch_tree_free(cipc_patch_tree *tree);

/* Set the box of the item at `place`; cipc_patch_tree_refit after all have been set. */
void cipc_patch_tree_set(cipc_patch_tree *tree, int place, const cipc_patch_box *box);
void cipc_patch_tree_refit(cipc_patch_tree *tree);

/* The box of the item at `place`; the box around lowest patch number `patch`. */
cipc_patch_box cipc_patch_tree_item_box(const cipc_patch_tree *tree, int place);
cipc_patch_box cipc_patch_tree_patch_box(const cipc_patch_tree *tree, int patch);

/* Append the numbers of the lowest patches (levels[0]) that cover a place in [begin, end) and have a child whose box overlaps `box`,
 * ascending. False: out of memory. Thread-safe for one tree. */
bool cipc_patch_tree_query(const cipc_patch_tree *tree, const cipc_patch_box *box, int begin, int end, cipc_place_list *patches);

/* Bit i is set if the box of child i of the patch overlaps `box`. */
unsigned cipc_patch_overlaps(const cipc_patch *patch, const cipc_patch_box *box);

/* Index of the lowest bit set; bits is not 0. */
static inline int cipc_lowest_bit(unsigned bits)
{
    return __builtin_ctz(bits);
}

#endif
