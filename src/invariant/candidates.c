/* Candidate pairs of the monitors M1, M2 and M5, made by a broad phase of their own and kept while nothing has moved far. */
#include "invariant/candidates.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "cipc/base.h"
#include "invariant/separation.h"

/* Patches of eight primitives in one part of the search: enough to outweigh a part's overhead, few enough to balance threads. */
enum { PART_SIZE = 16 };
/* A few roundings, upwards: sums of three or four terms are off by less than this relatively. */
#define ROUND_UP (1 + 4 * DBL_EPSILON)

/* Squares above this are not spoilt by underflow; with a smaller margin (or none) the lists serve for the very same positions only. */
#define SMALLEST_SQUARE 0x1p-600

/* The kinds of primitives of the two sides of a candidate kind. */
static const int sides[CIPC_CANDIDATE_KINDS][2] = {
    [CIPC_CANDIDATE_POINT_POINT] = {CIPC_PARTICLES, CIPC_PARTICLES},
    [CIPC_CANDIDATE_POINT_EDGE] = {CIPC_ENDS, CIPC_SEGMENTS},
    [CIPC_CANDIDATE_POINT_TRIANGLE] = {CIPC_POINTS, CIPC_TRIANGLES},
    [CIPC_CANDIDATE_EDGE_EDGE] = {CIPC_EDGES, CIPC_EDGES},
    [CIPC_CANDIDATE_EDGE_TRIANGLE] = {CIPC_EDGES, CIPC_TRIANGLES},
};

double invariant_candidates_offset(const cipc_model *model, int node_a, int node_b)
{
    return 0.5 * (model->bodies[model->node_body[node_a]].offset + model->bodies[model->node_body[node_b]].offset);
}

void cipc_gather(double *stencil, const double *x, const int *nodes, int n)
{
    for (int i = 0; i < n; i++) {
        const double *p = &x[3 * (size_t)nodes[i]];
        stencil[3 * i] = p[0];
        stencil[3 * i + 1] = p[1];
        stencil[3 * i + 2] = p[2];
    }
}

double invariant_candidates_nodes(const cipc_model *model, cipc_pair_kind kind, const int pair[2], int nodes[4])
{
    int na = cipc_pair_first_nodes(kind), nb = cipc_pair_nodes(kind) - na;
    const int *a = na == 2 ? model->edges[pair[0]] : &pair[0];
    const int *b = nb == 3 ? model->triangles[pair[1]] : nb == 2 ? model->edges[pair[1]] : &pair[1];
    for (int i = 0; i < 4; i++) { nodes[i] = i < na ? a[i] : i < na + nb ? b[i - na] : -1; }
    return invariant_candidates_offset(model, a[0], b[0]);
}

/* --- creation --- */

static const cipc_primitives *first_side(const invariant_candidates *c, invariant_candidate_kind kind)
{
    return &c->primitives[sides[kind][0]];
}

static const cipc_primitives *second_side(const invariant_candidates *c, invariant_candidate_kind kind)
{
    return &c->primitives[sides[kind][1]];
}

/* Patches of the first side of a kind; none if there is nothing to meet. */
static int asking_patches(const invariant_candidates *c, invariant_candidate_kind kind)
{
    const cipc_primitives *first = first_side(c, kind);
    return first->count > 0 && second_side(c, kind)->count > 0 ? first->tree.patch_count[0] : 0;
}

static bool make_parts(invariant_candidates *c)
{
    for (int kind = 0; kind < CIPC_CANDIDATE_KINDS; kind++) {
        c->part_count += (asking_patches(c, (invariant_candidate_kind)kind) + PART_SIZE - 1) / PART_SIZE;
    }
    c->parts = cipc_alloc((size_t)c->part_count, sizeof *c->parts);
    if (c->parts == NULL) { return false; }
    invariant_candidate_part *part = c->parts;
    for (int kind = 0; kind < CIPC_CANDIDATE_KINDS; kind++) {
        int count = asking_patches(c, (invariant_candidate_kind)kind);
        for (int first = 0; first < count; first += PART_SIZE, part++) {
            part->kind = (invariant_candidate_kind)kind;
            part->first = first;
            part->last = count - first > PART_SIZE ? first + PART_SIZE : count;
        }
    }
    return true;
}

bool invariant_candidates_init(invariant_candidates *c, const cipc_model *model, double reach, double margin, int threads, bool skip_fixed)
{
    memset(c, 0, sizeof *c);
    c->model = model;
    c->reach = reach;
    c->margin = margin;
    c->threads = threads;
    size_t n = (size_t)model->node_count;
    if (!invariant_exemptions_init(&c->exemptions, model)) { return false; }
    c->fixed = cipc_alloc(n, sizeof *c->fixed);
    c->made_at = cipc_alloc(3 * n, sizeof *c->made_at);
    if (c->fixed == NULL || c->made_at == NULL) { return false; }
    for (int i = 0; i < model->node_count; i++) { c->fixed[i] = skip_fixed && model->bodies[model->node_body[i]].fixed; }
    return invariant_primitives_init(c->primitives, model, c->fixed) && make_parts(c);
}

void invariant_candidates_free(invariant_candidates *c)
{
    invariant_primitives_free(c->primitives);
    for (int i = 0; c->parts != NULL && i < c->part_count; i++) {
        cipc_free(c->parts[i].pairs);
        cipc_free(c->parts[i].patches.places);
    }
    invariant_exemptions_free(&c->exemptions);
    cipc_free(c->fixed);
    cipc_free(c->made_at);
    cipc_free(c->parts);
    memset(c, 0, sizeof *c);
}

/* --- boxes --- */

/* How far a primitive's box is inflated, so that two primitives within xi + reach + margin of one another have boxes that overlap: xi is
 * half of the sum of the two bodies' offsets. */
static double inflation(const invariant_candidates *c, int node)
{
    double offset = c->model->bodies[c->model->node_body[node]].offset;
    return 0.5 * (offset + c->reach + c->margin) * ROUND_UP;
}

static void widen(double *lo, double *hi, double v)
{
    *lo = v < *lo ? v : *lo;
    *hi = v > *hi ? v : *hi;
}

/* Box of a primitive, inflated by r and rounded outwards; with `to`, of all of its nodes' boxes between the places in x and there: a straight path is in that of its ends. */
static cipc_patch_box inflated_box(const int *nodes, int n, const double *x, const double *to, double r)
{
    cipc_patch_box box;
    for (int k = 0; k < 3; k++) {
        double lo = x[3 * (size_t)nodes[0] + (size_t)k], hi = lo;
        for (int i = 0; i < n; i++) {
            widen(&lo, &hi, x[3 * (size_t)nodes[i] + (size_t)k]);
            if (to != NULL) { widen(&lo, &hi, to[3 * (size_t)nodes[i] + (size_t)k]); }
        }
        /* The rounding of lo - r is at most u (|lo| + r), u = DBL_EPSILON / 2; take four times that, which covers its own rounding. */
        box.lo[k] = cipc_round_down(lo - (r + 2 * DBL_EPSILON * (fabs(lo) + r)));
        box.hi[k] = cipc_round_up(hi + (r + 2 * DBL_EPSILON * (fabs(hi) + r)));
    }
    return box;
}

static void make_boxes(const invariant_candidates *c, int kind, const double *x, cipc_patch_tree *tree)
{
    const cipc_primitives *p = &c->primitives[kind];
    for (int place = 0; place < p->count; place++) {
        const int *nodes = &p->nodes[p->size * p->order[place]];
        cipc_patch_box box = inflated_box(nodes, p->size, x, c->sweep_to, inflation(c, nodes[0]));
        cipc_patch_tree_set(tree, place, &box);
    }
    cipc_patch_tree_refit(tree);
}

/* --- pairs --- */

/* Do the primitives share a node? With few branches, for this is asked of every pair of boxes that overlap. */
static bool is_incident(const int *a, int na, const int *b, int nb)
{
    bool shared = a[0] == b[0];
    if (nb > 1) { shared |= a[0] == b[1]; }
    if (nb > 2) { shared |= a[0] == b[2]; }
    if (na > 1) { shared |= (a[1] == b[0]) | (a[1] == b[1]); }
    return na > 1 && nb > 2 ? shared | (a[1] == b[2]) : shared;
}

/* Is the pair proven to be so far apart that it stays out of reach while the lists serve? */
static bool is_out_of_reach(const invariant_candidates *c, invariant_candidate_kind kind, const int *a, int na, const int *b, int nb,
                            const double *x)
{
    double stencil[15];
    cipc_gather(stencil, x, a, na);
    cipc_gather(&stencil[3 * na], x, b, nb);
    if (kind == CIPC_CANDIDATE_EDGE_TRIANGLE) { return cipc_edge_triangle_far(stencil, &stencil[6], c->margin); }
    double enough = (invariant_candidates_offset(c->model, a[0], b[0]) + c->reach + c->margin) * ROUND_UP;
    return cipc_separate((cipc_pair_kind)kind, stencil, enough).lower > enough;
}

static bool append_pair(invariant_candidate_part *part, int a, int b)
{
    if (part->count == part->capacity) {
        int capacity = 2 * part->capacity + 64;
        int(*grown)[2] = cipc_realloc(part->pairs, (size_t)capacity, sizeof *grown);
        if (grown == NULL) { return false; }
        part->pairs = grown;
        part->capacity = capacity;
    }
    part->pairs[part->count][0] = a;
    part->pairs[part->count][1] = b;
    part->count++;
    return true;
}

static int number_of(const cipc_primitives *p, int item)
{
    return p->size == 1 ? p->nodes[item] : p->first + item;
}

/* Keep primitive a of the first side and b of the second, unless they share a node, pass through each other or are proven out of reach. */
static bool offer_pair(const invariant_candidates *c, invariant_candidate_part *part, int a, int b, const double *x)
{
    const cipc_primitives *pa = first_side(c, part->kind), *pb = second_side(c, part->kind);
    if (pa == pb && b < a) {
        int swap = a;
        a = b;
        b = swap;
    }
    const int *na = &pa->nodes[pa->size * a], *nb = &pb->nodes[pb->size * b];
    bool skip = is_incident(na, pa->size, nb, pb->size);
    skip = skip || invariant_exempt(&c->exemptions, na, pa->size, nb, pb->size);
    skip = skip || (c->sweep_to == NULL && is_out_of_reach(c, part->kind, na, pa->size, nb, pb->size, x));
    return skip || append_pair(part, number_of(pa, a), number_of(pb, b));
}

/* The places of the second side that the primitive at `place` of the first is to meet, [begin, end). The fixed come last in the order: a
 * moving primitive meets all, a fixed one the moving only; among primitives of one kind each meets those after it. */
typedef struct place_range {
    int begin, end;
} place_range;

static inline place_range range_to_meet(const cipc_primitives *first, const cipc_primitives *second, int place)
{
    return (place_range){first == second ? place + 1 : 0, place < first->moving ? second->count : second->moving};
}

/* One patch of each side, and what is needed to compare their primitives. */
typedef struct patch_pair {
    const invariant_candidates *c;
    const cipc_primitives *first, *second;
    const double *x;
    int asking, asked;
} patch_pair;

/* The pairs of the primitive at one place of the asking patch with those of the asked one. */
static bool meet_item(const patch_pair *p, invariant_candidate_part *part, int place)
{
    place_range range = range_to_meet(p->first, p->second, place);
    cipc_patch_box box = cipc_patch_tree_item_box(&p->first->tree, place);
    for (unsigned bits = cipc_patch_overlaps(&p->second->tree.levels[0][p->asked], &box); bits != 0; bits &= bits - 1) {
        int other = p->asked * CIPC_PATCH_SIZE + cipc_lowest_bit(bits);
        bool meets = other >= range.begin && other < range.end;
        if (meets && !offer_pair(p->c, part, p->first->order[place], p->second->order[other], p->x)) { return false; }
    }
    return true;
}

static bool meet_patch(const patch_pair *p, invariant_candidate_part *part)
{
    cipc_patch_box box = cipc_patch_tree_patch_box(&p->second->tree, p->asked);
    for (unsigned bits = cipc_patch_overlaps(&p->first->tree.levels[0][p->asking], &box); bits != 0; bits &= bits - 1) {
        int place = p->asking * CIPC_PATCH_SIZE + cipc_lowest_bit(bits);
        bool is_there = place < p->first->count; /* a box without bounds meets the empty ones that fill up the last patch as well */
        if (is_there && !meet_item(p, part, place)) { return false; }
    }
    return true;
}

/* All pairs of the primitives of one patch of the first side. */
static bool search_patch(const invariant_candidates *c, invariant_candidate_part *part, int patch, const double *x)
{
    patch_pair p = {c, first_side(c, part->kind), second_side(c, part->kind), x, patch, 0};
    /* The first place of a patch meets the most. */
    place_range range = range_to_meet(p.first, p.second, patch * CIPC_PATCH_SIZE);
    cipc_patch_box box = cipc_patch_tree_patch_box(&p.first->tree, patch);
    part->patches.count = 0;
    if (!cipc_patch_tree_query(&p.second->tree, &box, range.begin, range.end, &part->patches)) { return false; }
    for (int i = 0; i < part->patches.count; i++) {
        p.asked = part->patches.places[i];
        if (!meet_patch(&p, part)) { return false; }
    }
    return true;
}

static void search_part(const invariant_candidates *c, invariant_candidate_part *part, const double *x)
{
    part->count = 0;
    part->failed = false;
    if (c->sweep_to != NULL && part->kind == CIPC_CANDIDATE_EDGE_TRIANGLE) { return; }
    for (int patch = part->first; patch < part->last && !part->failed; patch++) { part->failed = !search_patch(c, part, patch, x); }
}

static bool make_lists(invariant_candidates *c, const double *x)
{
#pragma omp parallel for schedule(dynamic) num_threads(c->threads) if (c->threads > 1)
    for (int kind = 0; kind < CIPC_PRIMITIVE_KINDS; kind++) { make_boxes(c, kind, x, &c->primitives[kind].tree); }
#pragma omp parallel for schedule(dynamic) num_threads(c->threads) if (c->threads > 1)
    for (int i = 0; i < c->part_count; i++) { search_part(c, &c->parts[i], x); }
    for (int i = 0; i < c->part_count; i++) {
        if (c->parts[i].failed) { return false; }
    }
    return true;
}

/* Is a node within half the margin of where the lists were made? If all are, no distance has changed by more than the margin: each of its two primitives moved
 * by at most half of it. */
static inline bool is_near(const invariant_candidates *c, size_t node, const double place[3])
{
    /* Seven roundings in the sum of squares and in the limit: far below the 2^-40 taken off. */
    double limit = 0.25 * c->margin * c->margin * (1 - 0x1p-40);
    const double *made = &c->made_at[3 * node];
    if (!(limit > SMALLEST_SQUARE)) { return memcmp(place, made, 3 * sizeof *place) == 0; }
    double dx = place[0] - made[0], dy = place[1] - made[1], dz = place[2] - made[2];
    return dx * dx + dy * dy + dz * dz <= limit;
}

static bool still_valid(const invariant_candidates *c, const double *x)
{
    size_t n = (size_t)c->model->node_count;
    for (size_t i = 0; c->made && i < n; i++) {
        if (!is_near(c, i, &x[3 * i])) { return false; }
    }
    return c->made;
}

bool invariant_candidates_update(invariant_candidates *c, const double *x, bool *made_now)
{
    *made_now = !still_valid(c, x);
    if (*made_now) {
        c->made = make_lists(c, x);
        memcpy(c->made_at, x, 3 * (size_t)c->model->node_count * sizeof *x);
    }
    return c->made;
}

bool invariant_candidates_valid(const invariant_candidates *c, const double *x)
{
    return still_valid(c, x);
}

bool invariant_candidates_near(const invariant_candidates *c, int node, const double place[3])
{
    return c->made && is_near(c, (size_t)node, place);
}

bool invariant_candidates_sweep(invariant_candidates *c, const double *from, const double *to)
{
    c->sweep_to = to;
    c->made = false;
    bool good = make_lists(c, from);
    c->sweep_to = NULL;
    return good;
}
