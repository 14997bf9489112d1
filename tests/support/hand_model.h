/* Models made by hand for the tests of the monitors: only the fields that monitors read are filled, anything may be degenerate, and loose
 * points, loose edges and tetrahedra are allowed. Memory is malloc'd, so that counting allocators see the code under test only. */
#ifndef SUPPORT_HAND_MODEL_H
#define SUPPORT_HAND_MODEL_H

#include <stdbool.h>

#include "cipc/model.h"

/* A model that grows: bodies first, then nodes, then elements of nodes. */
typedef struct hand_model {
    cipc_model model;
    double *x; /* 3 * node_count: the positions; the nodes' rest positions are in model.rest */
} hand_model;

hand_model *hand_model_create(void);
void hand_model_destroy(hand_model *h);

/* Returns the index of the body. */
int hand_body(hand_model *h, const char *name, double offset, double strain_limit, bool fixed);
/* The same of a kind other than shell. */
int hand_body_of(hand_model *h, cipc_body_kind kind, const char *name, double offset, bool fixed);
/* Returns the index of the node; rest = position. */
int hand_node(hand_model *h, int body, double x, double y, double z);
void hand_edge(hand_model *h, int a, int b);
/* A segment; no edges or triangles after the first one. */
void hand_segment(hand_model *h, int a, int b);
/* A new body of `count` segments in a row from `from` to `to`. Returns the first node. */
int hand_rope(hand_model *h, int body, const double from[3], const double to[3], int count);
/* A triangle and those of its edges that the model does not have yet. */
void hand_triangle(hand_model *h, int a, int b, int c);
/* Three new nodes of a body and their triangle. Returns the first node. */
int hand_new_triangle(hand_model *h, int body, const double x[9]);
void hand_tetrahedron(hand_model *h, int a, int b, int c, int d);
/* A grid of nx * ny cells with corner `origin` spanned by vectors u and v, two triangles a cell. Returns the first node. */
int hand_grid(hand_model *h, int body, const double origin[3], const double u[3], const double v[3], int nx, int ny);
/* Nothing touches this node. No nodes after the first one. */
void hand_interior(hand_model *h, int node);
/* The two bodies do not meet. No bodies after the first pair. */
void hand_apart(hand_model *h, int body_a, int body_b);
/* A node sewn to another one. */
void hand_sew(hand_model *h, int node_a, int node_b);
/* Add t to the positions (not the rest positions) of all nodes. */
void hand_translate(hand_model *h, const double t[3]);

#endif
