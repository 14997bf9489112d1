/* What the campaign "intersection" tests: its context. */
#ifndef CIPC_VERIFY_INTERSECTION_H
#define CIPC_VERIFY_INTERSECTION_H

#include "cipc/geometry.h"
#include "verify/campaign.h"

typedef struct verify_intersection_subject {
    bool (*meet)(const double edge[6], const double triangle[9]);
    int (*orient3d)(const double a[3], const double b[3], const double c[3], const double d[3]);
} verify_intersection_subject;
extern const verify_intersection_subject verify_intersection_of_the_solver;

#endif
