/* Broad phase: swept boxes of triangles and edges in two box trees, queried by nodes and edges (docs/theory/contact.md (1)-(3)). */
#include "cipc/contact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"

/* Queries are cut into this many pieces, whatever the number of threads, so that the answer's order never depends on it. */
enum { PIECES = 64 };

typedef struct pair_list {
    int (*pairs)[2];
    int count, capacity;
    bool failed;
} pair_list;

struct cipc_broad_phase {
    cipc_box *node_boxes, *triangle_boxes, *edge_boxes;
    cipc_box_tree *triangle_tree, *edge_tree;
    pair_list pieces[PIECES];
    int refits; /* since the trees were built */
};

/* Trees are rebuilt for the present positions after so many refits: a refit tree stays right, but grows loose as the mesh deforms. */
enum { REFITS_PER_BUILD = 32 };

static void append_pair(pair_list *list, int a, int b)
{
    if (list->count == list->capacity) {
        int capacity = list->capacity ? 2 * list->capacity : 256;
        int(*pairs)[2] = cipc_realloc(list->pairs, (size_t)capacity, sizeof *pairs);
        if (!pairs) {
            list->failed = true;
            return;
        }
        list->pairs = pairs;
        list->capacity = capacity;
    }
    list->pairs[list->count][0] = a;
    list->pairs[list->count][1] = b;
    list->count++;
}

cipc_status cipc_broad_phase_create(cipc_broad_phase **broad_phase, const cipc_model *model, cipc_error *error)
{
    cipc_broad_phase *b = cipc_alloc(1, sizeof *b);
    *broad_phase = b;
    if (!b) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory");
    b->node_boxes = cipc_alloc((size_t)model->node_count, sizeof(cipc_box));
    b->triangle_boxes = cipc_alloc((size_t)model->triangle_count, sizeof(cipc_box));
    b->edge_boxes = cipc_alloc((size_t)model->edge_count, sizeof(cipc_box));
    if (b->node_boxes && b->triangle_boxes && b->edge_boxes) return CIPC_OK;
    cipc_broad_phase_destroy(b);
    *broad_phase = NULL;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for %d nodes", model->node_count);
}

void cipc_broad_phase_destroy(cipc_broad_phase *b)
{
    if (!b) return;
    cipc_free(b->node_boxes);
    cipc_free(b->triangle_boxes);
    cipc_free(b->edge_boxes);
    cipc_box_tree_destroy(b->triangle_tree);
    cipc_box_tree_destroy(b->edge_tree);
    for (int i = 0; i < PIECES; i++) cipc_free(b->pieces[i].pairs);
    cipc_free(b);
}

static cipc_box box_union(const cipc_box *a, const cipc_box *b)
{
    cipc_box r;
    for (int k = 0; k < 3; k++) {
        r.lo[k] = min2(a->lo[k], b->lo[k]);
        r.hi[k] = max2(a->hi[k], b->hi[k]);
    }
    return r;
}

/* (2): boxes of the nodes' paths, each inflated by half of (xi + reach), so that two boxes of primitives that come within xi_pair + reach overlap.
 * The inflation is enlarged by 4 ulp of the largest coordinate and relatively by 2^-40, more than the rounding of the sums below: (3). */
static void swept_boxes(cipc_broad_phase *b, const cipc_model *model, const double *x, const double *p, double t_max, double reach)
{
    for (int i = 0; i < model->node_count; i++) {
        double half = 0.5 * (model->bodies[model->node_body[i]].offset + reach) * (1 + 0x1p-40);
        for (int k = 0; k < 3; k++) {
            double from = x[3 * i + k], to = p ? from + t_max * p[3 * i + k] : from;
            double inflation = half + 4 * DBL_EPSILON * max2(fabs(from), fabs(to));
            b->node_boxes[i].lo[k] = min2(from, to) - inflation;
            b->node_boxes[i].hi[k] = max2(from, to) + inflation;
        }
    }
    for (int t = 0; t < model->triangle_count; t++) {
        const int *v = model->triangles[t];
        cipc_box side = box_union(&b->node_boxes[v[0]], &b->node_boxes[v[1]]);
        b->triangle_boxes[t] = box_union(&side, &b->node_boxes[v[2]]);
    }
    for (int e = 0; e < model->edge_count; e++)
        b->edge_boxes[e] = box_union(&b->node_boxes[model->edges[e][0]], &b->node_boxes[model->edges[e][1]]);
}

static cipc_status update_trees(cipc_broad_phase *b, const cipc_model *model, cipc_error *error)
{
    /* After a failure one tree or both may be missing. */
    if (b->triangle_tree && b->edge_tree && b->refits < REFITS_PER_BUILD) {
        b->refits++;
        cipc_box_tree_refit(b->triangle_tree, b->triangle_boxes);
        cipc_box_tree_refit(b->edge_tree, b->edge_boxes);
        return CIPC_OK;
    }
    cipc_box_tree_destroy(b->triangle_tree);
    cipc_box_tree_destroy(b->edge_tree);
    b->triangle_tree = b->edge_tree = NULL;
    b->refits = 0;
    cipc_status status = cipc_box_tree_create(&b->triangle_tree, b->triangle_boxes, model->triangle_count, error);
    return status ? status : cipc_box_tree_create(&b->edge_tree, b->edge_boxes, model->edge_count, error);
}

typedef struct query {
    const cipc_model *model;
    const bool *is_dirichlet; /* may be NULL */
    pair_list *list;
    int item;                 /* the node or edge asking */
    bool item_is_dirichlet;
} query;

static bool dirichlet(const bool *is_dirichlet, int node) { return is_dirichlet && is_dirichlet[node]; }

static bool edge_is_dirichlet(const query *q, int edge)
{
    return dirichlet(q->is_dirichlet, q->model->edges[edge][0]) && dirichlet(q->is_dirichlet, q->model->edges[edge][1]);
}

static bool triangle_is_dirichlet(const query *q, int triangle)
{
    const int *v = q->model->triangles[triangle];
    return dirichlet(q->is_dirichlet, v[0]) && dirichlet(q->is_dirichlet, v[1]) && dirichlet(q->is_dirichlet, v[2]);
}

static void visit_triangle(void *context, int triangle)
{
    query *q = context;
    const int *v = q->model->triangles[triangle];
    if (v[0] == q->item || v[1] == q->item || v[2] == q->item) return;
    if (q->item_is_dirichlet && triangle_is_dirichlet(q, triangle)) return;
    append_pair(q->list, q->item, triangle);
}

/* Free edges ask all; a pair of two free edges is taken by the lower one, a pair with a Dirichlet edge by the free one. */
static void visit_edge(void *context, int edge)
{
    query *q = context;
    const int *a = q->model->edges[q->item], *b = q->model->edges[edge];
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return;
    if (edge < q->item && !edge_is_dirichlet(q, edge)) return;
    append_pair(q->list, edge < q->item ? edge : q->item, edge < q->item ? q->item : edge);
}

static int compare_pairs(const void *a, const void *b)
{
    const int *p = a, *q = b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

static void sort_found(pair_list *list, int first)
{
    if (list->count - first > 1) qsort(list->pairs + first, (size_t)(list->count - first), sizeof *list->pairs, compare_pairs);
}

/* All queries of nodes (edges false) or edges (true) of one piece. Sorted per query: the order does not depend on the trees. */
static void query_piece(cipc_broad_phase *b, const cipc_model *model, const bool *is_dirichlet, bool edges, int piece)
{
    pair_list *list = &b->pieces[piece];
    query q = {.model = model, .is_dirichlet = is_dirichlet, .list = list};
    long count = edges ? model->edge_count : model->node_count;
    list->count = 0;
    list->failed = false;
    for (long i = count * piece / PIECES; i < count * (piece + 1) / PIECES; i++) {
        int first = list->count;
        q.item = (int)i;
        if (edges) {
            if (edge_is_dirichlet(&q, q.item)) continue;
            cipc_box_tree_query(b->edge_tree, &b->edge_boxes[i], visit_edge, &q, NULL);
        } else {
            q.item_is_dirichlet = dirichlet(is_dirichlet, q.item);
            cipc_box_tree_query(b->triangle_tree, &b->node_boxes[i], visit_triangle, &q, NULL);
        }
        sort_found(list, first);
    }
}

/* Join the pieces into one array. */
static cipc_status gather(cipc_broad_phase *b, int (**pairs)[2], int *count, int *capacity, cipc_error *error)
{
    long total = 0;
    for (int i = 0; i < PIECES; i++) {
        if (b->pieces[i].failed) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for the candidate pairs");
        total += b->pieces[i].count;
    }
    if (total > *capacity) {
        int(*larger)[2] = cipc_realloc(*pairs, (size_t)total, sizeof *larger);
        if (!larger) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for %ld candidate pairs", total);
        *pairs = larger;
        *capacity = (int)total;
    }
    *count = 0;
    for (int i = 0; i < PIECES; i++) {
        if (b->pieces[i].count) memcpy(*pairs + *count, b->pieces[i].pairs, (size_t)b->pieces[i].count * sizeof **pairs);
        *count += b->pieces[i].count;
    }
    return CIPC_OK;
}

cipc_status cipc_broad_phase_find(cipc_broad_phase *b, const cipc_model *model, const double *x, const double *p, double t_max, double reach,
                                  const bool *is_dirichlet, int threads, cipc_candidates *c, cipc_error *error)
{
    swept_boxes(b, model, x, p, t_max, reach);
    cipc_status status = update_trees(b, model, error);
    if (status) return status;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (int piece = 0; piece < PIECES; piece++) query_piece(b, model, is_dirichlet, false, piece);
    status = gather(b, &c->point_triangle, &c->point_triangle_count, &c->point_triangle_capacity, error);
    if (status) return status;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (int piece = 0; piece < PIECES; piece++) query_piece(b, model, is_dirichlet, true, piece);
    return gather(b, &c->edge_edge, &c->edge_edge_count, &c->edge_edge_capacity, error);
}

void cipc_candidates_free(cipc_candidates *c)
{
    cipc_free(c->point_triangle);
    cipc_free(c->edge_edge);
    memset(c, 0, sizeof *c);
}
