/* Capsules: all points within a radius of a segment. A rod's segment is one; a particle is one whose ends fall together. */
#ifndef OUTPUT_CAPSULE_H
#define OUTPUT_CAPSULE_H

#include <stdbool.h>

typedef struct cipc_capsule { double a[3], b[3], radius; } cipc_capsule;

/* Where the line origin + t direction, t from -infinity on, enters the capsule: t, and the unit normal there. False: it misses. */
bool cipc_capsule_enter(const cipc_capsule *capsule, const double origin[3], const double direction[3], double *t, double normal[3]);

#endif
