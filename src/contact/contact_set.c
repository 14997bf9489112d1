/* Active contact stencils: classification, activation, merging (SPEC D.1-D.3, C.4; docs/theory/contact.md (4)-(9)). */
#include "cipc/contact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "contact/stencil.h"

/* (8): eps_x = mollifier_fraction |A|^2 |B|^2 with rest lengths (SPEC D.3). */
static const double mollifier_fraction = 1e-3;

cipc_contact_options cipc_contact_options_default(void)
{
    cipc_contact_options options = {.dhat = 1e-3, .area_weights = true};
    return options;
}

/* What the tests of one candidate need to know. */
typedef struct activation {
    const cipc_model *model;
    const double *x;
    const cipc_contact_options *options;
    double stiffness;
} activation;

static double edge_rest_length2(const cipc_model *m, int edge)
{
    double e[3];
    v3_sub(e, m->rest + 3 * m->edges[edge][0], m->rest + 3 * m->edges[edge][1]);
    return v3_norm2(e);
}

/* A contact on the nodes of a feature of a stencil. Point-point: lower node first; point-edge: lower edge node first - so that equal ones compare
 * equal; not so if only stencils of one direction are to merge. */
static cipc_contact feature_contact(const cipc_feature *feature, const int nodes[4], bool directed)
{
    static const cipc_energy_id energies[] = {CIPC_ENERGY_BARRIER_POINT_POINT, CIPC_ENERGY_BARRIER_POINT_EDGE, CIPC_ENERGY_BARRIER_POINT_TRIANGLE,
                                              CIPC_ENERGY_BARRIER_EDGE_EDGE};
    cipc_contact c = {.energy = energies[feature->kind], .count = feature->count, .nodes = {-1, -1, -1, -1}, .multiplicity = 1};
    for (int i = 0; i < feature->count; i++) c.nodes[i] = nodes[feature->local[i]];
    int low = feature->kind == CIPC_POINT_POINT ? 0 : 1;
    if (!directed && feature->kind <= CIPC_POINT_EDGE && c.nodes[low] > c.nodes[low + 1]) {
        int swap = c.nodes[low];
        c.nodes[low] = c.nodes[low + 1];
        c.nodes[low + 1] = swap;
    }
    return c;
}

/* (9): d - xi from d^2, without cancellation of the root. */
static double gap_of(double d2, double xi) { return (d2 - xi * xi) / (sqrt(d2) + xi); }

/* Box test on the stencil's own nodes: most candidates end here. `first` nodes belong to the first primitive. */
static bool boxes_apart(const double y[12], int first, int count, double distance)
{
    for (int k = 0; k < 3; k++) {
        double lo_a = y[k], hi_a = y[k], lo_b = y[3 * first + k], hi_b = lo_b;
        if (first == 2) {
            lo_a = min2(lo_a, y[3 + k]);
            hi_a = max2(hi_a, y[3 + k]);
        }
        for (int i = first + 1; i < count; i++) {
            lo_b = min2(lo_b, y[3 * i + k]);
            hi_b = max2(hi_b, y[3 * i + k]);
        }
        if (lo_a - hi_b > distance || lo_b - hi_a > distance) return true;
    }
    return false;
}

/* The closest features of a pair; of a pair of points there is one only. */
static cipc_feature closest_feature(cipc_pair_kind kind, const double y[12])
{
    if (kind == CIPC_EDGE_EDGE) return cipc_edge_edge_feature(y);
    if (kind == CIPC_POINT_TRIANGLE) return cipc_point_triangle_feature(y);
    return kind == CIPC_POINT_EDGE ? cipc_point_edge_feature(y) : (cipc_feature){CIPC_POINT_POINT, 2, {0, 1, 0, 0}};
}

/* (6): the weight of the pair's own primitives: two edges count half each, else the point counts, of two particles half each too. */
static double pair_weight(const activation *a, cipc_pair_kind kind, const int pair[2])
{
    const cipc_model *m = a->model;
    if (!a->options->area_weights) return 1;
    if (kind == CIPC_EDGE_EDGE) return 0.5 * (m->edge_weight[pair[0]] + m->edge_weight[pair[1]]);
    return m->node_weight[pair[0]];
}

/* Test one candidate; true if active, with the contact in *c. */
static bool activate(const activation *a, cipc_pair_kind kind, const int pair[2], cipc_contact *c)
{
    int nodes[4], count = cipc_pair_nodes(kind);
    double y[12];
    bool edge_edge = kind == CIPC_EDGE_EDGE;
    cipc_stencil_nodes(a->model, kind, pair, nodes);
    cipc_stencil_positions(a->x, nodes, count, y);
    double xi = cipc_stencil_offset(a->model, kind, nodes), reach = xi + a->options->dhat;
    if (boxes_apart(y, cipc_pair_first_nodes(kind), count, reach)) return false;
    cipc_feature feature = closest_feature(kind, y);
    double z[12];
    for (int i = 0; i < feature.count; i++) v3_copy(z + 3 * i, y + 3 * feature.local[i]);
    double d2 = cipc_distance2_value(feature.kind, z);
    if (!(d2 < reach * reach)) return false; /* (4) */
    double mollifier_eps = 0;
    if (edge_edge) {
        double eps = mollifier_fraction * edge_rest_length2(a->model, pair[0]) * edge_rest_length2(a->model, pair[1]);
        if (cipc_edge_edge_cross2(y) < eps) mollifier_eps = eps;
    }
    if (mollifier_eps > 0) {
        cipc_contact whole = {.energy = CIPC_ENERGY_BARRIER_EDGE_EDGE, .count = 4, .nodes = {nodes[0], nodes[1], nodes[2], nodes[3]}, .multiplicity = 1};
        *c = whole;
    } else {
        *c = feature_contact(&feature, nodes, a->options->merge_directed);
    }
    cipc_contact_barrier barrier = {.stiffness = a->stiffness, .weight = pair_weight(a, kind, pair), .offset = xi, .dhat = a->options->dhat,
                                    .mollifier_eps = mollifier_eps, .feature = feature};
    if (mollifier_eps == 0 && feature.kind == CIPC_EDGE_EDGE) barrier.feature = (cipc_feature){CIPC_EDGE_EDGE, 4, {0, 1, 2, 3}};
    c->barrier = barrier;
    return true;
}

double cipc_contact_gap(const cipc_contact *c, const double *x)
{
    double y[12] = {0}, z[12];
    const cipc_feature *feature = &c->barrier.feature;
    for (int i = 0; i < c->count; i++) v3_copy(y + 3 * i, x + 3 * c->nodes[i]);
    if (c->energy != CIPC_ENERGY_BARRIER_EDGE_EDGE) {
        cipc_pair_kind kind = (cipc_pair_kind)(c->energy - CIPC_ENERGY_BARRIER_POINT_POINT);
        return gap_of(cipc_distance2_value(kind, y), c->barrier.offset);
    }
    for (int i = 0; i < feature->count; i++) v3_copy(z + 3 * i, y + 3 * feature->local[i]);
    return gap_of(cipc_distance2_value(feature->kind, z), c->barrier.offset);
}

static cipc_status append_contact(cipc_contact_set *set, const cipc_contact *c, cipc_error *error)
{
    if (set->count == set->capacity) {
        int capacity = set->capacity ? 2 * set->capacity : 1024;
        cipc_contact *contacts = cipc_realloc(set->contacts, (size_t)capacity, sizeof *contacts);
        if (!contacts) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "contact", "no memory for %d contacts", capacity);
        set->contacts = contacts;
        set->capacity = capacity;
    }
    set->contacts[set->count++] = *c;
    return CIPC_OK;
}

/* Order: by energy, then by nodes: equal stencils become neighbours. Stable ties are broken by weight, so that sums have one order. */
static int compare_contacts(const void *p, const void *q)
{
    const cipc_contact *a = p, *b = q;
    if (a->energy != b->energy) return a->energy < b->energy ? -1 : 1;
    for (int i = 0; i < 4; i++)
        if (a->nodes[i] != b->nodes[i]) return a->nodes[i] < b->nodes[i] ? -1 : 1;
    return (a->barrier.weight > b->barrier.weight) - (a->barrier.weight < b->barrier.weight);
}

static bool same_stencil(const cipc_contact *a, const cipc_contact *b)
{
    return a->energy == b->energy && a->energy <= CIPC_ENERGY_BARRIER_POINT_EDGE && memcmp(a->nodes, b->nodes, sizeof a->nodes) == 0;
}

/* (7): equal point-point and point-edge stencils become one with the sum of their weights (SPEC D.1). */
static void merge(cipc_contact_set *set)
{
    if (set->count == 0) return;
    qsort(set->contacts, (size_t)set->count, sizeof *set->contacts, compare_contacts);
    int kept = 0;
    for (int i = 1; i < set->count; i++) {
        if (same_stencil(&set->contacts[kept], &set->contacts[i])) {
            set->contacts[kept].barrier.weight += set->contacts[i].barrier.weight;
            set->contacts[kept].multiplicity += set->contacts[i].multiplicity;
        } else {
            set->contacts[++kept] = set->contacts[i];
        }
    }
    set->count = kept + 1;
}

/* Pieces of the candidate list, filled in parallel, each into a slot of its own. */
enum { PIECES = 64 };

typedef struct piece {
    cipc_contact_set set;
    cipc_status status;
} piece;

static void activate_piece(const activation *a, const cipc_candidates *candidates, piece *p, int index)
{
    long total = cipc_candidates_count(candidates);
    for (long i = total * index / PIECES; i < total * (index + 1) / PIECES && !p->status; i++) {
        cipc_contact c;
        cipc_pair_kind kind;
        const int *pair = cipc_candidates_pair(candidates, i, &kind);
        if (!activate(a, kind, pair, &c)) continue;
        p->status = append_contact(&p->set, &c, NULL);
    }
}

/* The contact of the smallest gap. */
static void find_min_gap(cipc_contact_set *set, const double *x)
{
    set->min_gap = INFINITY;
    set->min_gap_contact = -1;
    set->total_multiplicity = 0;
    for (int i = 0; i < set->count; i++) {
        double gap = cipc_contact_gap(&set->contacts[i], x);
        set->total_multiplicity += set->contacts[i].multiplicity;
        if (gap < set->min_gap) {
            set->min_gap = gap;
            set->min_gap_contact = i;
        }
    }
}

cipc_status cipc_contact_set_build(cipc_contact_set *set, const cipc_model *model, const cipc_candidates *candidates, const double *x, double stiffness,
                                   const cipc_contact_options *options, int threads, cipc_error *error)
{
    activation a = {.model = model, .x = x, .options = options, .stiffness = stiffness};
    cipc_status status = CIPC_OK;
    set->count = 0;
    piece *pieces = cipc_alloc(PIECES, sizeof *pieces);
    if (!pieces) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "contact", "no memory");
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (int i = 0; i < PIECES; i++) activate_piece(&a, candidates, &pieces[i], i);
    for (int i = 0; i < PIECES; i++) {
        if (pieces[i].status && !status) status = cipc_fail(error, pieces[i].status, "contact", "no memory for the contacts");
        for (int k = 0; k < pieces[i].set.count && !status; k++) status = append_contact(set, &pieces[i].set.contacts[k], error);
        cipc_contact_set_free(&pieces[i].set);
    }
    cipc_free(pieces);
    if (status) return status;
    merge(set);
    find_min_gap(set, x);
    return CIPC_OK;
}

void cipc_contact_set_free(cipc_contact_set *set)
{
    cipc_free(set->contacts);
    memset(set, 0, sizeof *set);
}
