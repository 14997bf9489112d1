/* A soup of small, crumpled sheets for the tests of model/ and contact/, and the slow twin of their searches: every pair of primitives. */
#ifndef SUPPORT_CLOTH_SOUP_H
#define SUPPORT_CLOTH_SOUP_H

#include <stdbool.h>
#include <stdint.h>

#include "cipc/model.h"

typedef struct soup_shape {
    int sheets, cells;   /* each sheet is a grid of cells x cells, two triangles a cell */
    double size;         /* side of a sheet, m */
    double jitter;       /* largest displacement of a node from the flat sheet, m */
    double world;        /* sheets are centred in a cube of this side, m */
    double offset;       /* thickness xi of even sheets, m; odd ones have twice as much */
    double motion;       /* largest component of a displacement, m */
    bool fixed_first;    /* the first sheet is fixed */
    bool crease_allowed; /* rest shape = start; otherwise the rest shape is flat */
} soup_shape;
/* Four sheets of 4 x 4 cells, some of which cross or nearly touch one another. */
soup_shape soup_shape_default(void);

typedef struct soup {
    cipc_model *model;
    cipc_body_description *bodies;
    double *x, *p;      /* 3 * node_count: positions and displacements */
    bool *is_dirichlet; /* node_count */
} soup;

/* The same shape and seed give the same soup. Fails the test on any error. */
soup soup_create(const soup_shape *shape, uint64_t seed);
void soup_destroy(soup *s);

/* Every (node, triangle), then every (edge, edge) with the lower edge first, in ascending order: of pairs that share no node and are
 * not wholly Dirichlet (is_dirichlet may be NULL). nodes: point or first edge first; xi: the pair's thickness. */
typedef void (*pair_visitor)(void *context, bool edge_edge, const int pair[2], const int nodes[4], double xi);
void visit_all_pairs(const cipc_model *model, const bool *is_dirichlet, pair_visitor visit, void *context);

/* Positions of four nodes, or of x + t p. */
void soup_stencil(const double *x, const int nodes[4], double y[12]);
void soup_moved_stencil(const double *x, const double *p, double t, const int nodes[4], double y[12]);
/* A lower bound of the distance of the two primitives, good to a few ulp: the separation of their boxes. */
double soup_box_distance(bool edge_edge, const double y[12]);

#endif
