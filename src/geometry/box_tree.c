/* Bounding-volume hierarchy of axis-aligned boxes: median split by centroid. docs/theory/distance.md section 10.
 * Everything depends on the boxes alone, so the same boxes give the same tree and the same order of answers. */
#include <math.h>

#include "cipc/geometry.h"

/* Items of a leaf: fewer make a deeper tree, more make more tests in vain. */
#define LEAF_ITEMS 4
/* The split halves the items (difference at most 1), so the depth is at most 32 for any int count; the stack holds one node a level. */
#define STACK_DEPTH 64

/* Nodes lie in the order of a walk that takes the left child first, so the left child of node i is i + 1. */
typedef struct tree_node {
    cipc_box box;
    int right;        /* right child; 0 for a leaf */
    int first, count; /* its items, in tree order */
} tree_node;

struct cipc_box_tree {
    int item_count, node_count;
    tree_node *nodes;
    int *items;      /* tree order -> item */
    cipc_box *boxes; /* in tree order */
};

bool cipc_box_overlap(const cipc_box *a, const cipc_box *b)
{
    return a->lo[0] <= b->hi[0] && b->lo[0] <= a->hi[0] && a->lo[1] <= b->hi[1] && b->lo[1] <= a->hi[1] && a->lo[2] <= b->hi[2] &&
           b->lo[2] <= a->hi[2];
}

static const cipc_box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void enlarge(cipc_box *box, const cipc_box *by)
{
    for (int k = 0; k < 3; k++) {
        if (by->lo[k] < box->lo[k]) box->lo[k] = by->lo[k];
        if (by->hi[k] > box->hi[k]) box->hi[k] = by->hi[k];
    }
}

/* Halved before they are added, so that the sum cannot overflow; 0 for a box without a centre (infinite on both sides). */
static double centre(const cipc_box *box, int axis)
{
    double c = 0.5 * box->lo[axis] + 0.5 * box->hi[axis];
    return isnan(c) ? 0.0 : c;
}

/* Does item i come before item j along the axis? Ties go by index: all items differ, which also keeps the selection fast. */
static bool before(const cipc_box *boxes, int i, int j, int axis)
{
    double ci = centre(&boxes[i], axis), cj = centre(&boxes[j], axis);
    return ci < cj || (ci == cj && i < j);
}

static void swap(int *a, int *b)
{
    int c = *a;
    *a = *b;
    *b = c;
}

/* A fixed, well-mixed choice of pivot (multiplicative hash), so that no natural order of the items is a bad one. */
static int pivot_place(int low, int high)
{
    unsigned long long mixed = ((unsigned long long)low * 2654435761u + (unsigned long long)high) * 0x9E3779B97F4A7C15u;
    return low + (int)((mixed >> 33) % (unsigned long long)(high - low + 1));
}

/* Hoare's selection: afterwards items[first .. middle-1] come before items[middle ..] along the axis. Expected O(count). */
static void select_median(const cipc_box *boxes, int *items, int first, int middle, int count, int axis)
{
    int low = first, high = first + count - 1;
    while (low < high) {
        int pivot = items[pivot_place(low, high)], i = low, j = high;
        while (i <= j) {
            while (before(boxes, items[i], pivot, axis)) i++;
            while (before(boxes, pivot, items[j], axis)) j--;
            if (i <= j) swap(&items[i++], &items[j--]);
        }
        if (middle <= j) {
            high = j;
        } else if (middle >= i) {
            low = i;
        } else {
            return;
        }
    }
}

/* The axis along which the centres spread most. */
static int widest_axis(const cipc_box *boxes, const int *items, int count)
{
    cipc_box spread = empty_box;
    for (int i = 0; i < count; i++) {
        cipc_box point;
        for (int k = 0; k < 3; k++) point.lo[k] = point.hi[k] = centre(&boxes[items[i]], k);
        enlarge(&spread, &point);
    }
    int widest = 0;
    for (int k = 1; k < 3; k++)
        if (spread.hi[k] - spread.lo[k] > spread.hi[widest] - spread.lo[widest]) widest = k;
    return widest;
}

/* Split items[first .. first+count-1]; returns the new node. The depth of the recursion is that of the tree. */
static int build(cipc_box_tree *tree, const cipc_box *boxes, int first, int count)
{
    int node = tree->node_count++;
    tree->nodes[node].first = first;
    tree->nodes[node].count = count;
    tree->nodes[node].right = 0;
    if (count <= LEAF_ITEMS) return node;
    int half = count / 2;
    select_median(boxes, tree->items, first, first + half, count, widest_axis(boxes, tree->items + first, count));
    build(tree, boxes, first, half);
    int right = build(tree, boxes, first + half, count - half);
    tree->nodes[node].right = right;
    return node;
}

cipc_status cipc_box_tree_create(cipc_box_tree **tree, const cipc_box *boxes, int count, cipc_error *error)
{
    *tree = NULL;
    if (count < 0) return cipc_fail(error, CIPC_E_OUT_OF_RANGE, "box tree", "the number of boxes is %d", count);
    cipc_box_tree *made = cipc_alloc(1, sizeof *made);
    if (!made) goto no_memory;
    /* Leaves hold at least (LEAF_ITEMS + 1) / 2 items when there is more than one, so there are fewer nodes than items. */
    made->item_count = count;
    made->nodes = cipc_alloc((size_t)count + 1, sizeof *made->nodes);
    made->items = cipc_alloc((size_t)count, sizeof *made->items);
    made->boxes = cipc_alloc((size_t)count, sizeof *made->boxes);
    if (!made->nodes || !made->items || !made->boxes) goto no_memory;
    for (int i = 0; i < count; i++) made->items[i] = i;
    build(made, boxes, 0, count);
    cipc_box_tree_refit(made, boxes);
    *tree = made;
    return CIPC_OK;
no_memory:
    cipc_box_tree_destroy(made);
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "box tree", "no memory for %d boxes", count);
}

void cipc_box_tree_destroy(cipc_box_tree *tree)
{
    if (!tree) return;
    cipc_free(tree->nodes);
    cipc_free(tree->items);
    cipc_free(tree->boxes);
    cipc_free(tree);
}

/* Children come after their parents, so backwards every child is ready before its parent asks. */
void cipc_box_tree_refit(cipc_box_tree *tree, const cipc_box *boxes)
{
    for (int i = 0; i < tree->item_count; i++) tree->boxes[i] = boxes[tree->items[i]];
    for (int i = tree->node_count - 1; i >= 0; i--) {
        tree_node *node = &tree->nodes[i];
        node->box = empty_box;
        if (node->right) {
            enlarge(&node->box, &tree->nodes[i + 1].box);
            enlarge(&node->box, &tree->nodes[node->right].box);
        } else {
            for (int k = node->first; k < node->first + node->count; k++) enlarge(&node->box, &tree->boxes[k]);
        }
    }
}

/* Visit the items of a leaf that overlap the box. */
static void query_leaf(const cipc_box_tree *tree, const tree_node *leaf, const cipc_box *box, void (*visit)(void *, int), void *context)
{
    for (int k = leaf->first; k < leaf->first + leaf->count; k++)
        if (cipc_box_overlap(&tree->boxes[k], box)) visit(context, tree->items[k]);
}

void cipc_box_tree_query(const cipc_box_tree *tree, const cipc_box *box, void (*visit)(void *context, int item), void *context,
                         size_t *visited)
{
    int stack[STACK_DEPTH], depth = 0;
    size_t tests = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        int i = stack[--depth];
        const tree_node *node = &tree->nodes[i];
        tests++;
        if (!cipc_box_overlap(&node->box, box)) continue;
        if (node->right) {
            stack[depth++] = node->right;
            stack[depth++] = i + 1;
        } else {
            tests += (size_t)node->count;
            query_leaf(tree, node, box, visit, context);
        }
    }
    if (visited) *visited += tests;
}
