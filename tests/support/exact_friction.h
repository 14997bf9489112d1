/* The exact solution of dz/dt = v - sigma0 |v| z/h over a step of constant v in MPFR, and a block that friction holds. */
#ifndef SUPPORT_EXACT_FRICTION_H
#define SUPPORT_EXACT_FRICTION_H

#include "cipc/massspring.h"

typedef struct exact_friction {
    double z, change; /* z' and z' - z, each rounded once */
    double size;      /* |z| exp(-u) + (h/sigma0)(1 - exp(-u)): what errors of z' are measured by */
} exact_friction;
exact_friction exact_friction_step(double level, double sigma0, double v, double dt, double z);

/* tanh a, and a - tanh a. */
double exact_tanh(double a);
double exact_tanh_defect(double a);
/* scale * log(numerator/denominator). */
double exact_log_ratio(double scale, double numerator, double denominator);

/* A block of the given mass under a load, braked by drag times its velocity, on a spring whose other end moves with the velocity `pull`. Semi-implicit Euler: the velocity is kicked by the forces at x and then moves x and z alike. */
typedef struct friction_block {
    double mass, spring, pull, load, drag;
    double time, x, v, z, friction;
} friction_block;
double friction_block_spring(const friction_block *block);
void friction_block_step(friction_block *block, const cipc_friction_force *force, double dt);

#endif
