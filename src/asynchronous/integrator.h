/* The working memory of the asynchronous integrator, shared by its files. Reading order: integrator.c (the loop), create.c, nodes.c (drift and kick), elements.c, element_steps.c, element_ticks.c, external.c (forces), pair.c and
 * penalty.c (contact of two primitives), balls.c, kdop.c, separation.c (which pairs there are), windows.c (what the monitor is told), report.c. */
#ifndef ASYNCHRONOUS_INTEGRATOR_H
#define ASYNCHRONOUS_INTEGRATOR_H

#include <stdint.h>
#include <time.h>

#include "asynchronous/clock.h"
#include "asynchronous/queue.h"
#include "base/vector.h"
#include "cipc/asynchronous.h"
#include "cipc/energy.h"

/* ---- Nodes ------------------------------------------------------------------------------------------------------------------------------ */

/* q(t') = q + (t' - t) v until the next kick (SPEC A.1). One cache line. */
typedef struct asynchronous_node {
    double q[3], v[3], t;
    double inverse_mass; /* 0: prescribed */
} asynchronous_node;

/* A node is certified to stay in a ball until its deadline; everything coarse is made of the balls (docs/theory/asynchronous.md, section 6). */
typedef struct asynchronous_ball {
    double center[3], radius;
    double deadline;       /* s: a node that goes on as it does is inside until then */
    double least, most_near, most; /* m: bounds of the radius; near contact, and away from it */
    int event;
} asynchronous_ball;

/* ---- Forces inside bodies --------------------------------------------------------------------------------------------------------------- */

typedef enum asynchronous_damping { ASYNCHRONOUS_UNDAMPED = 0, ASYNCHRONOUS_DAMP_EDGES, ASYNCHRONOUS_DAMP_ANGLE, ASYNCHRONOUS_DAMP_GRADIENT } asynchronous_damping;

/* Elements of one energy. */
typedef struct asynchronous_set {
    const cipc_energy *energy;
    cipc_event_kind kind;
    asynchronous_damping form;
    int count;
    int *nodes;        /* count * energy->nodes */
    void *params;      /* count * energy->params_size */
    double *damping;   /* count: k_d of the form, 0: undamped */
    double *step;      /* count: h, s */
} asynchronous_set;
enum {
    ASYNCHRONOUS_NEO_HOOKEAN = 0, ASYNCHRONOUS_STVK, ASYNCHRONOUS_SPRINGS, ASYNCHRONOUS_HINGES, ASYNCHRONOUS_RODS, ASYNCHRONOUS_JOINTS, ASYNCHRONOUS_STITCHES,
    ASYNCHRONOUS_COROTATIONAL, ASYNCHRONOUS_VOLUME_NEO_HOOKEAN, ASYNCHRONOUS_SETS
};

/* Elements of one set that tick together: those whose steps are the same number. */
typedef struct asynchronous_clock {
    double h;
    int64_t k;         /* of the next tick */
    int set, first, count; /* places in the integrator's list of elements */
    int event;
} asynchronous_clock;

/* ---- Contact ---------------------------------------------------------------------------------------------------------------------------- */

typedef struct asynchronous_layer { int64_t k; int event; } asynchronous_layer;

/* A separating slab, | n.x - along - drift (t - since) | <= half, between two primitives: that the next layer is out of reach (SPEC A.6). One cache line, because every change of
 * a node's velocity looks at all slabs that the node keeps to. */
typedef struct asynchronous_slab {
    double normal[3], along, drift, since, half;
    double deadline;       /* s: kept until then if nobody's velocity changes */
} asynchronous_slab;

/* Two primitives that may come near: the active layers are 1..layers. */
typedef struct asynchronous_pair {
    cipc_pair_kind kind;
    int nodes[4];          /* first primitive first; -1: unused */
    double offset, friction;
    double mass;           /* of its lightest node that can move */
    double first_step;     /* h(1), s; h(l) = h(1) l^(-3/2) */
    int event;             /* of its slab's deadline */
    int node_count, first_count;
    int layers, layer_capacity;
    asynchronous_layer *layer;
    int index_in_live;     /* among the pairs in use */
    int chain[4];          /* place in the lists of its nodes */
} asynchronous_pair;

/* A place of a node in a pair, packed: pair, place among its nodes, which primitive. */
static inline int asynchronous_incidence_pair(int incidence) { return incidence / 8; }
static inline int asynchronous_incidence_place(int incidence) { return incidence / 2 % 4; }
static inline bool asynchronous_incidence_second(int incidence) { return incidence % 2 != 0; }

typedef struct asynchronous_pairs {
    asynchronous_pair *pair;
    asynchronous_slab *slab; /* of each pair */
    int count, capacity;
    int *unused, unused_count;
    int *live, live_count;
    struct asynchronous_incidences { int *list; int count, capacity; } *of_node; /* pairs that a node's velocity matters to */
    int in_contact, most_in_contact;
} asynchronous_pairs;

/* Vector from the closest point b of the second primitive to the closest point a of the first; weights c with a - b = sum c_i x_i. */
typedef struct asynchronous_closest { double c[4], n[3], distance; } asynchronous_closest;

/* ---- Broad phase ------------------------------------------------------------------------------------------------------------------------ */

enum { ASYNCHRONOUS_AXES = 13, ASYNCHRONOUS_COMBINATIONS = 15 };

/* Both ends of an interval side by side: whether two k-DOPs are apart is mostly asked along one direction. */
typedef struct asynchronous_kdop { struct { double lo, hi; } along[ASYNCHRONOUS_AXES]; } asynchronous_kdop;

/* An element that meets others, and the nodes and edges of which it is the one owner. */
typedef struct asynchronous_leaf {
    int nodes[3], node_count, body;
    int triangle, segment;      /* -1: not one */
    int owned_nodes[3], owned_edges[3];
    int owned_node_count, owned_edge_count;
} asynchronous_leaf;

typedef struct asynchronous_tree_node {
    asynchronous_kdop dop;
    int child[2], parent;
    int leaf;                   /* -1: inner */
    int first;                  /* head of its entries in the separation list; -1: none */
} asynchronous_tree_node;

/* One entry of the separation list: two disjoint tree nodes, or two leaves that are not. Entry e is in the lists of both, as link 2e and 2e + 1. */
typedef struct asynchronous_separation {
    int node[2];
    double bound;               /* of leaves: nothing changes before the sum of their travels has grown to this */
    int axis;                   /* that separates them; -1: overlapping leaves */
    int previous[2], next[2];   /* links */
    int overlap;                /* of overlapping leaves; also the list of unused entries */
} asynchronous_separation;

/* Two leaves that overlap: the pairs of primitives that they own. */
typedef struct asynchronous_overlap {
    uint16_t meets;             /* combinations that can ever be in contact */
    int pair[ASYNCHRONOUS_COMBINATIONS]; /* -1: not near */
} asynchronous_overlap;

typedef struct asynchronous_broad {
    int leaf_count, tree_count;
    asynchronous_leaf *leaves;
    asynchronous_tree_node *tree;
    int *leaf_place;            /* tree node of a leaf */
    double *travel;             /* by tree node, of leaves, m: how far their balls have moved and grown in all */
    int *incident_first, *incident; /* leaves of a node: incident[incident_first[i] .. incident_first[i+1]) */
    double *shadow;             /* node_count * ASYNCHRONOUS_AXES: projections of the centres */
    asynchronous_separation *entry;
    int entry_count, entry_capacity, unused_entry, live_entries, fresh_entries;
    bool stale;                 /* to be made afresh before time goes on */
    asynchronous_overlap *overlap;
    int overlap_count, overlap_capacity, unused_overlap;
} asynchronous_broad;

/* ---- The whole -------------------------------------------------------------------------------------------------------------------------- */

struct cipc_asynchronous {
    const cipc_model *model;
    cipc_asynchronous_options options;
    double now;                 /* of the event under way */
    double scale;               /* m: largest coordinate so far, for bounds on rounding */
    asynchronous_node *nodes;
    asynchronous_ball *balls;
    double *before;             /* 3 * node_count: velocities before the last kick's instant, for energies */
    double *kicked;             /* node_count: when that was */
    long *kicks;                /* node_count: instants at which a node was kicked in this step */
    bool *dirty;                /* node_count: velocity changed since its certificates were looked at */
    int *dirty_nodes, dirty_count;
    asynchronous_queue queue;
    asynchronous_set sets[ASYNCHRONOUS_SETS];
    asynchronous_clock *clocks;
    int clock_count, *elements; /* places in the sets, clock by clock */
    double gravity_step, script_step;
    int64_t gravity_k, script_k;
    int gravity_event, script_event;
    double *acceleration;       /* 3 * node_count: gravity and the loads that act now */
    double *eta;                /* of layers 1.. at [1..] */
    double *layer_rate;         /* l^(-3/2) likewise */
    asynchronous_pairs pairs;
    asynchronous_broad broad;
    bool loaded;
    double *out_position, *out_velocity; /* 3 * node_count: the state as it was left */
    bool *is_dirichlet;
    double *target;
    bool *moves;
    /* what the monitor is told */
    cipc_paths_callback *monitor;
    void *monitor_context;
    cipc_path_break *breaks;
    long break_count, break_capacity;
    double *window_from, *window_to, window_begin;
    /* the step under way */
    cipc_asynchronous_report report;
    long event_count;
    int timed;                  /* how many events the one under way is timed for; 0: it is not */
    cipc_status status;         /* the first thing that went wrong inside an event */
    cipc_error error;
};

/* Deepest layer that is ever made: eta(4095) is an eighth of eta(1). */
enum { ASYNCHRONOUS_MOST_LAYERS = 4095 };

/* No regular clock ticks more often in a frame: nobody would wait for it, and the ticks of a long run are still counted exactly. */
enum { ASYNCHRONOUS_MOST_TICKS = 1000000000 };
static inline bool asynchronous_is_too_short(const cipc_asynchronous *a, double h) { return !(h * ASYNCHRONOUS_MOST_TICKS >= a->options.frame); }

/* Ranks of simultaneous events: certificates, script, gravity, forces inside bodies, layers from the outermost on. */
enum { ASYNCHRONOUS_RANK_CELL = 0, ASYNCHRONOUS_RANK_SLAB, ASYNCHRONOUS_RANK_SCRIPT, ASYNCHRONOUS_RANK_GRAVITY, ASYNCHRONOUS_RANK_ELEMENTS,
    ASYNCHRONOUS_RANK_PENALTY = 64 };

static inline double asynchronous_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Of small events one in 64 is timed, and counts for all of them; those of many nodes are all timed. */
enum { ASYNCHRONOUS_SAMPLE = 64 };
static inline double asynchronous_phase_begin(const cipc_asynchronous *a) { return a->timed > 0 ? asynchronous_seconds() : 0; }
static inline void asynchronous_phase_end(cipc_asynchronous *a, cipc_asynchronous_phase phase, double begin)
{
    if (a->timed > 0) a->report.seconds[phase] += a->timed * (asynchronous_seconds() - begin);
}

/* nodes.c */
static inline void asynchronous_position(const asynchronous_node *node, double t, double x[3])
{
    const double dt = t - node->t;
    for (int k = 0; k < 3; k++) x[k] = node->q[k] + dt * node->v[k];
}
void asynchronous_gather(const cipc_asynchronous *a, const int *nodes, int count, double *x);
/* Advance a node to x, its position now, and add dv to its velocity. */
void asynchronous_kick(cipc_asynchronous *a, int node, const double x[3], const double dv[3]);
/* A velocity that is prescribed from now on. */
void asynchronous_steer(cipc_asynchronous *a, int node, const double x[3], const double v[3]);
void asynchronous_synchronise(cipc_asynchronous *a, double t);
void asynchronous_fail(cipc_asynchronous *a, cipc_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* primitives.c */
/* Number of the model's mesh edge between two nodes of a triangle. */
int asynchronous_edge_of(const cipc_model *model, int node_a, int node_b);

/* elements.c */
cipc_status asynchronous_elements_create(cipc_asynchronous *a, cipc_error *error);
void asynchronous_elements_free(cipc_asynchronous *a);
static inline const cipc_body *asynchronous_body_of(const cipc_model *m, const int *nodes) { return &m->bodies[m->node_body[nodes[0]]]; }
static inline void asynchronous_gather_rest(const cipc_model *m, const int *nodes, int count, double *rest)
{
    for (int i = 0; i < count; i++) v3_copy(rest + 3 * i, m->rest + 3 * nodes[i]);
}

/* element_steps.c */
cipc_status asynchronous_clocks_create(cipc_asynchronous *a, cipc_error *error);
void asynchronous_elements_start(cipc_asynchronous *a);

/* element_ticks.c */
void asynchronous_elements_tick(cipc_asynchronous *a, int clock);
double asynchronous_elements_energy(const cipc_asynchronous *a, const double *x);

/* external.c */
cipc_status asynchronous_external_create(cipc_asynchronous *a, cipc_error *error);
void asynchronous_external_start(cipc_asynchronous *a);
void asynchronous_gravity_tick(cipc_asynchronous *a);
void asynchronous_script_tick(cipc_asynchronous *a);

/* closest.c */
asynchronous_closest asynchronous_closest_points(cipc_pair_kind kind, const double x[12]);

/* pair.c */
/* Nodes first primitive first. Returns its number, or -1 (out of memory, or nothing to do: then the status tells). */
int asynchronous_pair_create(cipc_asynchronous *a, cipc_pair_kind kind, const int *nodes, uint64_t order);
void asynchronous_pair_destroy(cipc_asynchronous *a, int pair);
void asynchronous_pairs_free(cipc_asynchronous *a);
/* Activate the layers in reach and certify anew that the next one is not. */
void asynchronous_pair_certify(cipc_asynchronous *a, int pair);
/* After a change of a node's velocity: do its slabs hold until their deadlines? Those that do not are made anew. */
void asynchronous_pairs_check(cipc_asynchronous *a, int node);
void asynchronous_pair_deactivate(cipc_asynchronous *a, int pair);
bool asynchronous_pair_activate(cipc_asynchronous *a, int pair);
cipc_contact_place asynchronous_pair_place(const cipc_asynchronous *a, int pair);
/* The pair's place in the order of simultaneous ticks: what it is, not when it was found. */
static inline uint64_t asynchronous_pair_order(cipc_pair_kind kind, int first, int second)
{
    return (uint64_t)kind << 62 | (uint64_t)(uint32_t)first << 31 | (uint64_t)(uint32_t)second;
}

/* penalty.c */
void asynchronous_penalty_tick(cipc_asynchronous *a, int pair, int layer);

/* primitives.c */
cipc_status asynchronous_primitives_create(cipc_asynchronous *a, cipc_error *error);
/* Nodes and order of a combination of two leaves; false: there is none of that number, or it never meets. */
typedef struct asynchronous_combination { cipc_pair_kind kind; int nodes[4]; uint64_t order; } asynchronous_combination;
bool asynchronous_combination_of(const cipc_asynchronous *a, const asynchronous_leaf *p, const asynchronous_leaf *q, int number, asynchronous_combination *combination);

/* balls.c */
void asynchronous_ball_start(cipc_asynchronous *a, int node);
/* After a change of velocity: does the node stay inside until the deadline? If not, an earlier one. */
void asynchronous_ball_check(cipc_asynchronous *a, int node);
/* The deadline has come. */
void asynchronous_ball_event(cipc_asynchronous *a, int node);

/* kdop.c */
cipc_status asynchronous_tree_create(cipc_asynchronous *a, cipc_error *error);
void asynchronous_tree_fit(cipc_asynchronous *a);
void asynchronous_shadow(cipc_asynchronous *a, int node);
void asynchronous_leaf_dop(const cipc_asynchronous *a, int leaf, asynchronous_kdop *dop);
int asynchronous_kdop_axis(const asynchronous_kdop *p, const asynchronous_kdop *q);

/* separation.c */
void asynchronous_separation_start(cipc_asynchronous *a);
/* A node's ball has moved or grown by `travel` at most: the leaves that it is in, and all that is above them. */
void asynchronous_separation_update(cipc_asynchronous *a, int node, double travel);
void asynchronous_broad_free(cipc_asynchronous *a);

/* windows.c */
cipc_status asynchronous_windows_start(cipc_asynchronous *a, cipc_error *error);
void asynchronous_windows_break(cipc_asynchronous *a, int node, const double x[3]);
/* Close the window at time t and begin the next one there. */
cipc_status asynchronous_windows_flush(cipc_asynchronous *a, double t, cipc_error *error);

/* report.c */
void asynchronous_report_begin(cipc_asynchronous *a);
void asynchronous_report_end(cipc_asynchronous *a, cipc_asynchronous_report *report);

#endif
