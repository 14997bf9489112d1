/* What the campaign "distance" tests: its context. */
#ifndef CIPC_VERIFY_DISTANCE_H
#define CIPC_VERIFY_DISTANCE_H

#include "cipc/geometry.h"
#include "verify/campaign.h"

typedef struct verify_distance_subject {
    cipc_feature (*feature)(cipc_pair_kind kind, const double *x);
    double (*value)(cipc_pair_kind kind, const double *x); /* of a feature's own stencil */
    void (*gradient)(cipc_pair_kind kind, const double *x, double *g);
    void (*hessian)(cipc_pair_kind kind, const double *x, double *H);
} verify_distance_subject;
extern const verify_distance_subject verify_distance_of_the_solver;

#endif
