/* The limits of a triangle's strain, one by one: what double arithmetic makes of it, whether it proves the limit kept, and the exact truth
 * (docs/monitors.md, "The strain bounds"). */
#ifndef CIPC_INVARIANT_STRAIN_LIMITS_H
#define CIPC_INVARIANT_STRAIN_LIMITS_H

#include <stdbool.h>

#include "cipc/model.h"

/* Largest and least principal stretch; Green strains along warp and weft and between them, in magnitude. */
typedef enum cipc_strain_kind {
    CIPC_STRAIN_LARGEST = 0,
    CIPC_STRAIN_LEAST,
    CIPC_STRAIN_WARP,
    CIPC_STRAIN_WEFT,
    CIPC_STRAIN_SHEAR,
    CIPC_STRAIN_KINDS
} cipc_strain_kind;

/* What M3 keeps of a triangle at rest. */
typedef struct cipc_strain_rest {
    double form[3];                   /* first fundamental form Ibar: |E1|^2, E1.E2, |E2|^2 */
    double inverse[4];                /* rows of the inverse of the 2 x 2 matrix of E1, E2 in an orthonormal frame of the rest triangle */
    double limits[CIPC_STRAIN_KINDS]; /* 0: not limited */
    double axes[4], cosine;           /* warp and weft in E1, E2, of unit length, and their product; NaN where there are none */
    bool measured;                    /* counts for max_stretch */
} cipc_strain_rest;

/* The edges of a triangle in its present shape. */
typedef struct cipc_strain_edges {
    double e1[3], e2[3];
} cipc_strain_edges;

void cipc_strain_rest_init(cipc_strain_rest *rest, const cipc_model *model, int triangle);
cipc_strain_edges cipc_strain_edges_of(const double *x, const int nodes[3]);

/* About the value. */
double cipc_strain_value(const cipc_strain_rest *rest, cipc_strain_kind kind, const cipc_strain_edges *edges);
/* Does double arithmetic prove that the limit is kept? */
bool cipc_strain_is_proven(const cipc_strain_rest *rest, cipc_strain_kind kind, const cipc_strain_edges *edges);
/* +1: the exact value keeps this limit, 0: it equals it, -1: it is beyond. */
int cipc_strain_compare(const cipc_model *model, int triangle, cipc_strain_kind kind, const double *x, double limit);
/* The exact value rounded towards what is forbidden, sought from the estimate; where there is none (a rest triangle without area, an
 * estimate of 0) the estimate. */
double cipc_strain_rounded(const cipc_model *model, int triangle, cipc_strain_kind kind, const double *x, double estimate);

/* How much of the way from rest to the limit has been used: 1 at the limit. */
double cipc_strain_used(cipc_strain_kind kind, double value, double limit);

#endif
