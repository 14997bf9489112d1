/* cipc/geometry.h - distances with closest features, mollifier, exact predicates, intersection, bounding volumes.
 * Floor 1. Positions are metres; a stencil is the concatenation of its nodes' positions, point or first edge first:
 *   point-point x[6] = p, q        point-edge     x[9]  = p, e0, e1
 *   point-triangle x[12] = p, t0, t1, t2           edge-edge x[12] = a0, a1, b0, b1
 * Hessians are row-major n x n, symmetric. */
#ifndef CIPC_GEOMETRY_H
#define CIPC_GEOMETRY_H

#include <stdbool.h>
#include <stddef.h>
#include "cipc/base.h"

/* Closest features (SPEC D.1, V.4): right for degenerate (zero-length edge, zero-area triangle) and near-parallel input. A feature
 * that is not unique (parallel edges, ties) is any one that attains the minimum to within rounding. A feature is only ever reported
 * as CIPC_POINT_EDGE / _TRIANGLE / _EDGE_EDGE when the smooth formula below is defined there (edge of positive length, n != 0). */
cipc_feature cipc_point_edge_feature(const double x[9]);
cipc_feature cipc_point_triangle_feature(const double x[12]);
cipc_feature cipc_edge_edge_feature(const double x[12]);

/* Smooth squared distances of a given feature pair: point to point, point to the edge's LINE, point to the triangle's PLANE, LINE to
 * LINE, with gradient and Hessian. (SPEC D.1; docs/theory/distance.md) */
double cipc_point_point_distance2_value(const double x[6]);
void cipc_point_point_distance2_gradient(const double x[6], double g[6]);
void cipc_point_point_distance2_hessian(const double x[6], double H[36]);
double cipc_point_line_distance2_value(const double x[9]);
void cipc_point_line_distance2_gradient(const double x[9], double g[9]);
void cipc_point_line_distance2_hessian(const double x[9], double H[81]);
double cipc_point_plane_distance2_value(const double x[12]);
void cipc_point_plane_distance2_gradient(const double x[12], double g[12]);
void cipc_point_plane_distance2_hessian(const double x[12], double H[144]);
double cipc_line_line_distance2_value(const double x[12]);
void cipc_line_line_distance2_gradient(const double x[12], double g[12]);
void cipc_line_line_distance2_hessian(const double x[12], double H[144]);

/* The same by kind, for a stencil of that kind's own nodes: n = 3 * (2, 3, 4, 4); g[n], H[n*n]. */
double cipc_distance2_value(cipc_pair_kind kind, const double *x);
void cipc_distance2_gradient(cipc_pair_kind kind, const double *x, double *g);
void cipc_distance2_hessian(cipc_pair_kind kind, const double *x, double *H);

/* True squared distance between the two primitives (classification and formula together). */
double cipc_point_edge_distance2(const double x[9]);
double cipc_point_triangle_distance2(const double x[12]);
double cipc_edge_edge_distance2(const double x[12]);
/* Its gradient and Hessian: those of the closest feature's smooth distance, in the places of its nodes, 0 elsewhere. */
void cipc_point_edge_distance2_gradient(const double x[9], double g[9]);
void cipc_point_edge_distance2_hessian(const double x[9], double H[81]);
void cipc_point_triangle_distance2_gradient(const double x[12], double g[12]);
void cipc_point_triangle_distance2_hessian(const double x[12], double H[144]);
void cipc_edge_edge_distance2_gradient(const double x[12], double g[12]);
void cipc_edge_edge_distance2_hessian(const double x[12], double H[144]);

/* Weights w of the closest vector of a feature pair: sum_i w_i x_i = a - b for closest points a (first primitive) and b. Sum of w is 0.
 * Unclamped: the formulas of the feature's own lines and planes (SPEC D.6). */
void cipc_closest_weights(cipc_pair_kind kind, const double *x, double w[4]);

/* Edge-edge mollifier (SPEC D.3): c = |(a1-a0) x (b1-b0)|^2, e(c) = c/eps (2 - c/eps) for c < eps, else 1. */
double cipc_edge_edge_cross2(const double x[12]);
double cipc_edge_edge_mollifier_value(const double x[12], double eps);
void cipc_edge_edge_mollifier_gradient(const double x[12], double eps, double g[12]);
void cipc_edge_edge_mollifier_hessian(const double x[12], double eps, double H[144]);

/* Exact sign (-1, 0, +1) of det[b-a, c-a, d-a]: floating-point filter, then GMP. Any finite input. */
int cipc_orient3d(const double a[3], const double b[3], const double c[3], const double d[3]);
/* Exact sign of the 2-D orientation of (a, b, c) after dropping coordinate `axis` (0, 1, 2), the other two taken in cyclic order: the
 * sign of component `axis` of (b - a) x (c - a). */
int cipc_orient2d(const double a[3], const double b[3], const double c[3], int axis);
/* Exact: does the closed edge meet the closed triangle? Touching counts. Degenerate edges and triangles are handled as the sets they are. */
bool cipc_edge_triangle_intersect(const double edge[6], const double triangle[9]);

/* Axis-aligned box: lo[3], hi[3]. */
typedef struct cipc_box { double lo[3], hi[3]; } cipc_box;
bool cipc_box_overlap(const cipc_box *a, const cipc_box *b); /* closed boxes */

/* Bounding-volume hierarchy over boxes: built in O(n log n), refit in O(n), queried in O(log n + answers) for spread-out boxes. */
typedef struct cipc_box_tree cipc_box_tree;
cipc_status cipc_box_tree_create(cipc_box_tree **tree, const cipc_box *boxes, int count, cipc_error *error);
void cipc_box_tree_destroy(cipc_box_tree *tree);
/* New boxes for the same items, same topology of the tree. */
void cipc_box_tree_refit(cipc_box_tree *tree, const cipc_box *boxes);
/* Indices of the items whose box overlaps `box`, in a fixed order that depends on the tree only. `visit` is called for each; `visited`
 * (may be NULL) is increased by the number of box tests made (complexity test). Thread-safe for one tree. */
void cipc_box_tree_query(const cipc_box_tree *tree, const cipc_box *box, void (*visit)(void *context, int item), void *context, size_t *visited);

#endif
