/* Paths of nodes with breaks, made ready for the monitor: every node's corners in order of time, all nodes' places at a few instants between which the time is cut
 * into slices, and how far each node strays from the straight way of a slice (docs/monitors.md, "Paths with breaks"). */
#ifndef CIPC_INVARIANT_POLYLINES_H
#define CIPC_INVARIANT_POLYLINES_H

#include <stdbool.h>

#include "cipc/model.h"

/* A corner of a node's path: its beginning, its breaks, its end. */
typedef struct cipc_knot {
    double time, x[3];
} cipc_knot;

typedef struct cipc_polylines {
    int node_count;
    long *first;       /* node_count + 1: a node's knots are [first[i], first[i + 1]), their times ascend strictly */
    cipc_knot *knots;
    double *rounding;  /* node_count, m: cipc_polylines_place is off by less than this; INFINITY: not known */
    int slices;        /* a power of two */
    double *times;     /* slices + 1 instants, not descending: the beginning, ..., the end */
    double *places;    /* (slices + 1) * 3 * node_count: about where the nodes are at these instants; at the first and last exactly there */
    long *knot_at;     /* (slices + 1) * node_count: the last knot that is not after the instant */
    double *deviation; /* 2 * slices * node_count, m: see cipc_polylines_deviation */
} cipc_polylines;

/* All of finite paths, end - begin finite too, whose breaks are in order and of nodes that there are. CIPC_E_OUT_OF_RANGE: a node is at two places at one time. CIPC_E_OUT_OF_MEMORY. Free is
 * safe after either. */
cipc_status cipc_polylines_init(cipc_polylines *p, const cipc_paths *paths, int threads, cipc_error *error);
void cipc_polylines_free(cipc_polylines *p);

/* Where a node is at a time that knot k is the last one not after, rounded: a knot's place exactly, else off by less than rounding[node]. Returns whether exact. */
bool cipc_polylines_place(const cipc_polylines *p, long k, double time, double x[3]);

/* Bounds of how far each node strays in slice number `slice` of those of a level - level 0 is the whole time, each level halves the slices of the one before - from
 * moving straight and evenly between its places in `places` at the slice's ends. [node_count], m; may be INFINITY. */
static inline const double *cipc_polylines_deviation(const cipc_polylines *p, int level, int slice)
{
    return &p->deviation[(size_t)((1 << level) + slice) * (size_t)p->node_count];
}

/* Boxes of whole paths: lo and hi [3 * node_count] of each. */
void cipc_polylines_boxes(const cipc_polylines *p, double *lo, double *hi);

#endif
