/* The two stages of the orientation predicates, apart, so that tests can see which one decides. */
#ifndef CIPC_GEOMETRY_PREDICATES_H
#define CIPC_GEOMETRY_PREDICATES_H

/* What a filter answers when rounding could have changed the sign. */
enum { CIPC_UNDECIDED = 2 };

/* Sign -1, 0, +1 in floating point if it is certain, otherwise CIPC_UNDECIDED. */
int cipc_orient3d_filter(const double a[3], const double b[3], const double c[3], const double d[3]);
int cipc_orient2d_filter(const double a[3], const double b[3], const double c[3], int axis);

/* The sign in integer arithmetic; right for all finite input. GMP aborts the process if it runs out of memory. */
int cipc_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3]);
int cipc_orient2d_exact(const double a[3], const double b[3], const double c[3], int axis);

#endif
