/* One spring of the projection, for the plain form and for the one of the springs that have moved. */
#ifndef MASSSPRING_DEFORMATION_H
#define MASSSPRING_DEFORMATION_H

#include "cipc/massspring.h"

typedef struct massspring_ends_moved {
    const double *inverse_mass;
    double rate; /* 1/dt; 0: velocities stay */
    double *x, *v;
} massspring_ends_moved;

/* B of one spring. */
double massspring_deformation_of(const cipc_spring *spring, const int ends[2], const double *x);
/* (12). A spring of no length has no direction and stays, as does one with both ends held. Returns whether it was beyond the bound. */
bool massspring_project_spring(const massspring_ends_moved *m, const cipc_spring *spring, const int ends[2], double bound);

#endif
