/* cipc/oracle.h - the truth, in exact rational arithmetic (GMP) and in MPFR. Shares no arithmetic with the code it judges.
 * Floor 3; included only by invariant/, verify/, cli/ and tests. All functions are pure and thread-safe. Inputs are doubles and are taken as the
 * dyadic rationals that they are (SPEC V.1). Non-finite input proves nothing: see each function. */
#ifndef CIPC_ORACLE_H
#define CIPC_ORACLE_H

#include <stdbool.h>
#include "cipc/base.h"

/* The answer to an exact question. INDETERMINATE: a precision cap was met, or the input was not finite; never a guess. */
typedef enum cipc_verdict { CIPC_NO = 0, CIPC_YES, CIPC_INDETERMINATE } cipc_verdict;

/* --- distance (SPEC V.2) ----------------------------------------------------------------------------------------------------------------- */

/* The squared distance of the two primitives of a stencil rounded to nearest (ties to even), m^2, and the set of all features that attain it (bit i:
 * cipc_feature_name(kind, i)) in *features (may be NULL). A feature counts if its own closest points really lie in it: an edge's interior needs a foot
 * strictly inside, a face all barycentrics > 0. Degenerate primitives are the sets they are. Non-finite input: NaN and no features. */
double cipc_exact_distance2(cipc_pair_kind kind, const double *x, unsigned *features);

/* computed - d^2, rounded to nearest: how far a computed squared distance is off. NaN for non-finite input. */
double cipc_exact_distance2_error(cipc_pair_kind kind, const double *x, double computed);

/* Exact sign of d^2 - xi^2. xi >= 0. Non-finite input: -1. */
int cipc_exact_distance_sign(cipc_pair_kind kind, const double *x, double xi);

/* The gap d - xi rounded to nearest (ties to even), m. Its sign is that of d - xi, unless it underflows to 0. NaN for non-finite input. */
double cipc_exact_distance_gap(cipc_pair_kind kind, const double *x, double xi);

/* --- intersection (SPEC V.5 M1) ------------------------------------------------------------------------------------------------------------ */

/* Have the two closed sets a point in common? Touching counts; degenerate ones are the sets they are. */
cipc_verdict cipc_exact_edge_triangle(const double edge[6], const double triangle[9]);
cipc_verdict cipc_exact_triangle_triangle(const double a[9], const double b[9]);
/* Sign of det[b - a, c - a, d - a]. Non-finite input: 0. */
int cipc_exact_orientation(const double a[3], const double b[3], const double c[3], const double d[3]);

/* --- time of impact (SPEC V.3) ------------------------------------------------------------------------------------------------------------- */

/* YES: the distance first equals or falls below xi at a time in [lo, hi], 0 <= lo <= hi <= t_max, the doubles around an enclosure of width 2^-200
 * (equal if the time is a double); 0, 0 if d(0) <= xi. Touching without crossing is a hit. NO: d > xi on all of [0, t_max]; lo = hi = NaN.
 * xi >= 0, 0 <= t_max <= 1. */
typedef struct cipc_exact_impact {
    cipc_verdict verdict;
    double lo, hi;
} cipc_exact_impact;
cipc_exact_impact cipc_exact_toi(const cipc_stencil_path *path, double xi, double t_max);

/* YES: d > xi on all of [0, t]. The question that a step's certificate answers. */
cipc_verdict cipc_exact_path_clear(const cipc_stencil_path *path, double xi, double t);

/* A piece of paths with breaks: node i moves straight and evenly, at x at its own time start[i] and at p at stop[i], and is looked at from begin to end, which lie
 * between them: start[i] <= begin <= end <= stop[i] (start = stop: x = p, it stays). Its places at begin and end are rational, not doubles in general. Only the
 * numbers of cipc_pair_nodes(kind) nodes are looked at. */
typedef struct cipc_stencil_piece {
    cipc_pair_kind kind;
    double begin, end;
    double start[4], stop[4];
    double x[12], p[12];
} cipc_stencil_piece;
/* As cipc_exact_toi, of all of [begin, end]; lo and hi are times like these: begin <= lo <= hi <= end; begin, begin if d <= xi there already. INDETERMINATE also if
 * the times are not in order. */
cipc_exact_impact cipc_exact_piece_toi(const cipc_stencil_piece *piece, double xi);

/* The least distance over [0, t], m: *lo <= it <= *hi, neighbouring doubles or equal, reached about the time *at (each may be NULL). */
cipc_verdict cipc_exact_path_minimum(const cipc_stencil_path *path, double t, double *lo, double *hi, double *at);

/* --- strain (SPEC V.5 M3) ------------------------------------------------------------------------------------------------------------------ */

/* Exact sign of s - sigma_1 for the largest principal stretch of a triangle with rest positions X[9] and positions x[9]:
 * s^2 Ibar - I positive definite <=> +1, semi-definite <=> 0, else -1 (Ibar, I: first fundamental forms; all rational). s > 0.
 * Non-finite input proves nothing: -1. */
int cipc_exact_compare_stretch(const double rest[9], const double x[9], double limit);
/* The same of sigma_2 - s for the least one: I - s^2 Ibar. s >= 0. */
int cipc_exact_compare_least_stretch(const double rest[9], const double x[9], double limit);

/* Green strains 1/2 (f.g - d.k) of woven cloth (SPEC C.3): d, k the directions warp and weft, projected onto the plane of the rest triangle, of unit length;
 * f, g what has become of them. The directions may be of any length; weft 0: across the warp in that plane. */
typedef enum cipc_green_strain { CIPC_GREEN_WARP = 0, CIPC_GREEN_WEFT, CIPC_GREEN_SHEAR } cipc_green_strain;
/* Exact sign of L - |E|. L >= 0. 0 when a direction is perpendicular to the triangle: nothing is below L then. Non-finite input: -1. */
int cipc_exact_compare_green_strain(cipc_green_strain component, const double rest[9], const double x[9], const double warp[3], const double weft[3],
                                    double limit);
/* axes: d = axes[0] E1 + axes[1] E2, k = axes[2] E1 + axes[3] E2 with the edges E1, E2 at the first node of the rest triangle; *cosine = d.k. Each number
 * is the exact one cut to 53 bits: off by less than 2^-52 of itself unless it underflows. False: there is no such direction. */
bool cipc_exact_fabric_axes(const double rest[9], const double warp[3], const double weft[3], double axes[4], double *cosine);

/* --- values and derivatives (SPEC V.6) ------------------------------------------------------------------------------------------------------ */

/* A function of a stencil: every energy of the registry under its name there, and the smooth squared distances "distance2_point_point",
 * "distance2_point_line", "distance2_point_plane", "distance2_line_line" and "edge_edge_mollifier". Parameters are a flat list of doubles in the order of
 * `fields` (names as in the conformance protocol; "basis[0]" and so on for arrays). */
typedef struct cipc_oracle_function {
    const char *name;
    int nodes;
    int field_count;
    const char *const *fields;
} cipc_oracle_function;
int cipc_oracle_function_count(void);
const cipc_oracle_function *cipc_oracle_function_at(int index);
const cipc_oracle_function *cipc_oracle_function_find(const char *name); /* or NULL */

/* Value, gradient g[n] and Hessian H[n * n], n = 3 * nodes, each rounded from about 60 digits (central differences at 512 bits, step h = 2^-100 of the
 * stencil's size; within h of a switch with continuous second derivatives, from about 30); g and H may be NULL. INDETERMINATE: infeasible there or within h
 * of it; a switch with a jump within h (a hinge folded to +-pi; for H the mollifier's end); derivatives that change over h so much that the differences
 * contradict one another; not finite; a value that at twice the precision rounds to another double. YES otherwise. (docs/theory/oracle_energies.md) */
cipc_verdict cipc_oracle_evaluate(const cipc_oracle_function *function, const double *x, const double *fields, double *value, double *g, double *H);

/* Value and first two derivatives of "barrier" (of D; fields Dhat), "strain_limit_barrier" (of sigma; s, shat), "friction_mollifier" (of y; e), each rounded
 * from about 60 digits. INDETERMINATE: infeasible, not finite, no such function; so near a switch that the differences contradict one another. */
cipc_verdict cipc_oracle_scalar(const char *name, double x, const double *fields, double f[3]);

#endif
