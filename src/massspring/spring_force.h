/* The force of a spring and the wind on a triangle where the compiler can inline them: they are half of a substep. cipc_spring_force and cipc_wind_force are these. */
#ifndef MASSSPRING_SPRING_FORCE_H
#define MASSSPRING_SPRING_FORCE_H

#include "base/vector.h"
#include "cipc/massspring.h"

/* (1). Ends at the same place have no direction. */
static inline void massspring_spring_force(const cipc_spring *spring, const double x0[3], const double x1[3], const double v0[3], const double v1[3], double f[3])
{
    double along[3], approach[3];
    v3_sub(along, x1, x0);
    v3_sub(approach, v1, v0);
    const double r = v3_norm(along);
    v3_scale(f, 0, along);
    if (!(r > 0)) return;
    v3_scale(along, 1 / r, along);
    const double tension = spring->form == CIPC_SPRING_LINEAR ? spring->stiffness * (r - spring->length) : cipc_spring_tension(spring, r);
    v3_scale(f, tension + spring->damping * v3_dot(approach, along), along);
}

/* (14). The normal is as long as twice the area. The triangle counts as if it were no larger than `most`, m^2. */
static inline void massspring_wind_force(double q, const double wind[3], double most, const double *const x[3], const double *const v[3], double f[3])
{
    double a[3], b[3], normal[3], relative[3];
    v3_sub(a, x[1], x[0]);
    v3_sub(b, x[2], x[0]);
    v3_cross(normal, a, b);
    for (int k = 0; k < 3; k++) relative[k] = wind[k] - (v[0][k] + v[1][k] + v[2][k]) / 3;
    const double twice_area = v3_norm(normal), counts = twice_area > 2 * most ? 2 * most / twice_area : 1;
    v3_scale(f, twice_area > 0 ? q / 6 * counts * (v3_dot(normal, relative) / twice_area) : 0, normal);
}

#endif
