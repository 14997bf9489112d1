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
    cipc_box *node_boxes, *triangle_boxes, *edge_boxes, *particle_boxes;
    cipc_box_tree *triangle_tree, *edge_tree, *segment_tree, *particle_tree; /* NULL: none of that kind */
    int *particles, particle_count;                                          /* nodes that are particles */
    pair_list pieces[PIECES];
    bool built; /* all trees that the model needs are there */
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

static cipc_body_kind kind_of(const cipc_model *model, int node) { return model->bodies[model->node_body[node]].kind; }

cipc_status cipc_broad_phase_create(cipc_broad_phase **broad_phase, const cipc_model *model, cipc_error *error)
{
    cipc_broad_phase *b = cipc_alloc(1, sizeof *b);
    *broad_phase = b;
    if (!b) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory");
    b->node_boxes = cipc_alloc((size_t)model->node_count, sizeof(cipc_box));
    b->triangle_boxes = cipc_alloc((size_t)model->triangle_count, sizeof(cipc_box));
    b->edge_boxes = cipc_alloc((size_t)model->edge_count, sizeof(cipc_box));
    b->particle_boxes = cipc_alloc((size_t)model->node_count, sizeof(cipc_box));
    b->particles = cipc_alloc((size_t)model->node_count, sizeof(int));
    if (b->node_boxes && b->triangle_boxes && b->edge_boxes && b->particle_boxes && b->particles) {
        for (int i = 0; i < model->node_count; i++)
            if (kind_of(model, i) == CIPC_BODY_PARTICLES) b->particles[b->particle_count++] = i;
        return CIPC_OK;
    }
    cipc_broad_phase_destroy(b);
    *broad_phase = NULL;
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for %d nodes", model->node_count);
}

static void destroy_trees(cipc_broad_phase *b)
{
    cipc_box_tree **trees[] = {&b->triangle_tree, &b->edge_tree, &b->segment_tree, &b->particle_tree};
    for (size_t i = 0; i < sizeof trees / sizeof *trees; i++) {
        cipc_box_tree_destroy(*trees[i]);
        *trees[i] = NULL;
    }
    b->built = false;
}

void cipc_broad_phase_destroy(cipc_broad_phase *b)
{
    if (!b) return;
    cipc_free(b->node_boxes);
    cipc_free(b->triangle_boxes);
    cipc_free(b->edge_boxes);
    cipc_free(b->particle_boxes);
    cipc_free(b->particles);
    destroy_trees(b);
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
    for (int i = 0; i < b->particle_count; i++) b->particle_boxes[i] = b->node_boxes[b->particles[i]];
}

static cipc_status build_tree(cipc_box_tree **tree, const cipc_box *boxes, int count, cipc_error *error)
{
    return count > 0 ? cipc_box_tree_create(tree, boxes, count, error) : CIPC_OK;
}

static cipc_status build_trees(cipc_broad_phase *b, const cipc_model *model, cipc_error *error)
{
    destroy_trees(b);
    b->refits = 0;
    cipc_status status = build_tree(&b->triangle_tree, b->triangle_boxes, model->triangle_count, error);
    if (!status) status = build_tree(&b->edge_tree, b->edge_boxes, model->edge_count, error);
    if (!status) status = build_tree(&b->segment_tree, b->edge_boxes + model->first_segment, model->segment_count, error);
    if (!status) status = build_tree(&b->particle_tree, b->particle_boxes, b->particle_count, error);
    b->built = !status;
    return status;
}

static cipc_status update_trees(cipc_broad_phase *b, const cipc_model *model, cipc_error *error)
{
    if (!b->built || b->refits >= REFITS_PER_BUILD) return build_trees(b, model, error);
    b->refits++;
    if (b->triangle_tree) cipc_box_tree_refit(b->triangle_tree, b->triangle_boxes);
    if (b->edge_tree) cipc_box_tree_refit(b->edge_tree, b->edge_boxes);
    if (b->segment_tree) cipc_box_tree_refit(b->segment_tree, b->edge_boxes + model->first_segment);
    if (b->particle_tree) cipc_box_tree_refit(b->particle_tree, b->particle_boxes);
    return CIPC_OK;
}

/* One asking primitive. */
typedef struct query {
    const cipc_model *model;
    const cipc_broad_phase *broad_phase;
    const bool *is_dirichlet;
    pair_list *list;
    int item;                 /* the node or edge asking */
    int nodes[2], node_count; /* its nodes */
    bool item_is_dirichlet;
} query;

static bool all_dirichlet(const bool *is_dirichlet, const int *nodes, int count)
{
    for (int i = 0; i < count; i++)
        if (!is_dirichlet || !is_dirichlet[nodes[i]]) return false;
    return true;
}

/* Do the asking primitive and that of `nodes` meet, and is one of them free? */
static bool is_wanted(const query *q, const int *nodes, int count)
{
    if (q->item_is_dirichlet && all_dirichlet(q->is_dirichlet, nodes, count)) return false;
    return cipc_model_meet(q->model, q->nodes, q->node_count, nodes, count);
}

static void visit_triangle(void *context, int triangle)
{
    query *q = context;
    if (is_wanted(q, q->model->triangles[triangle], 3)) append_pair(q->list, q->item, triangle);
}

static void visit_segment(void *context, int segment)
{
    query *q = context;
    int edge = q->model->first_segment + segment;
    if (is_wanted(q, q->model->edges[edge], 2)) append_pair(q->list, q->item, edge);
}

/* Among primitives of one kind the free ones ask all; a pair of two free ones is taken by the lower one, a pair with a Dirichlet one by the free one. */
static void take_once(query *q, int other, const int *nodes, int count)
{
    if (other < q->item && !all_dirichlet(q->is_dirichlet, nodes, count)) return;
    if (!cipc_model_meet(q->model, q->nodes, q->node_count, nodes, count)) return;
    append_pair(q->list, other < q->item ? other : q->item, other < q->item ? q->item : other);
}

static void visit_edge(void *context, int edge)
{
    query *q = context;
    take_once(q, edge, q->model->edges[edge], 2);
}

static void visit_particle(void *context, int place)
{
    query *q = context;
    int node = q->broad_phase->particles[place];
    take_once(q, node, &node, 1);
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

/* Let a node ask for what it may touch of one kind. */
static void ask_node(cipc_broad_phase *b, query *q, cipc_pair_kind kind)
{
    cipc_body_kind body = kind_of(q->model, q->item);
    const cipc_box *box = &b->node_boxes[q->item];
    if (kind == CIPC_POINT_TRIANGLE) {
        if (b->triangle_tree && !q->model->interior[q->item]) cipc_box_tree_query(b->triangle_tree, box, visit_triangle, q, NULL);
    } else if (kind == CIPC_POINT_EDGE) {
        if (b->segment_tree && (body == CIPC_BODY_RODS || body == CIPC_BODY_PARTICLES)) cipc_box_tree_query(b->segment_tree, box, visit_segment, q, NULL);
    } else if (body == CIPC_BODY_PARTICLES && !q->item_is_dirichlet) {
        cipc_box_tree_query(b->particle_tree, box, visit_particle, q, NULL);
    }
}

/* All queries of one kind of one piece. Sorted per query: the order does not depend on the trees. */
static void query_piece(cipc_broad_phase *b, const cipc_model *model, const bool *is_dirichlet, cipc_pair_kind kind, int piece)
{
    pair_list *list = &b->pieces[piece];
    bool edges = kind == CIPC_EDGE_EDGE;
    query q = {.model = model, .broad_phase = b, .is_dirichlet = is_dirichlet, .list = list, .node_count = edges ? 2 : 1};
    long count = edges ? model->edge_count : model->node_count;
    list->count = 0;
    list->failed = false;
    for (long i = count * piece / PIECES; i < count * (piece + 1) / PIECES; i++) {
        int first = list->count;
        q.item = q.nodes[0] = (int)i;
        for (int k = 0; edges && k < 2; k++) q.nodes[k] = model->edges[i][k];
        q.item_is_dirichlet = all_dirichlet(is_dirichlet, q.nodes, q.node_count);
        if (!edges)
            ask_node(b, &q, kind);
        else if (!q.item_is_dirichlet)
            cipc_box_tree_query(b->edge_tree, &b->edge_boxes[i], visit_edge, &q, NULL);
        sort_found(list, first);
    }
}

/* Join the pieces into one array. */
static cipc_status gather(cipc_broad_phase *b, cipc_candidate_list *into, cipc_error *error)
{
    long total = 0;
    for (int i = 0; i < PIECES; i++) {
        if (b->pieces[i].failed) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for the candidate pairs");
        total += b->pieces[i].count;
    }
    if (total > into->capacity) {
        int(*larger)[2] = cipc_realloc(into->pairs, (size_t)total, sizeof *larger);
        if (!larger) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "broad phase", "no memory for %ld candidate pairs", total);
        into->pairs = larger;
        into->capacity = (int)total;
    }
    into->count = 0;
    for (int i = 0; i < PIECES; i++) {
        if (b->pieces[i].count) memcpy(into->pairs + into->count, b->pieces[i].pairs, (size_t)b->pieces[i].count * sizeof *into->pairs);
        into->count += b->pieces[i].count;
    }
    return CIPC_OK;
}

/* Kinds that this model has no primitives for need no queries. */
static bool has_kind(const cipc_broad_phase *b, const cipc_model *model, cipc_pair_kind kind)
{
    if (kind == CIPC_POINT_TRIANGLE) return model->triangle_count > 0;
    if (kind == CIPC_POINT_EDGE) return model->segment_count > 0;
    return kind == CIPC_POINT_POINT ? b->particle_count > 1 : model->edge_count > 1;
}

cipc_status cipc_broad_phase_find(cipc_broad_phase *b, const cipc_model *model, const double *x, const double *p, double t_max, double reach,
                                  const bool *is_dirichlet, int threads, cipc_candidates *c, cipc_error *error)
{
    swept_boxes(b, model, x, p, t_max, reach);
    cipc_status status = update_trees(b, model, error);
    for (int kind = 0; kind < CIPC_PAIR_KIND_COUNT && !status; kind++) {
        c->lists[kind].count = 0;
        if (!has_kind(b, model, (cipc_pair_kind)kind)) continue;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
        for (int piece = 0; piece < PIECES; piece++) query_piece(b, model, is_dirichlet, (cipc_pair_kind)kind, piece);
        status = gather(b, &c->lists[kind], error);
    }
    return status;
}
