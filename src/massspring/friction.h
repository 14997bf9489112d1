/* The friction laws one by one, and what they share. `bound` is h/sigma0, m: the largest z of steady motion; `travel` is |v| dt, m. docs/theory/massspring.md, "Friction". */
#ifndef CIPC_MASSSPRING_FRICTION_H
#define CIPC_MASSSPRING_FRICTION_H

#include "cipc/massspring.h"

/* sigma1 as the law uses it: 0 for those without a differential term, else min(sigma1, 4 h/|v|) (F7). */
double massspring_differential(const cipc_friction_force *force, double level, double speed);

/* As cipc_friction_step, for one law each. */
double massspring_coulomb_step(const cipc_friction_force *force, double v);
double massspring_dahl_step(const cipc_friction_force *force, double v, double dt, double *z);
double massspring_bidirectional_step(const cipc_friction_force *force, double v, double dt, double *z);
double massspring_clamped_step(const cipc_friction_force *force, double v, double dt, double *z);

/* h of R1 and R2, and of R1s. */
double massspring_banded_level(const cipc_friction_force *force, double speed);
double massspring_smooth_level(const cipc_friction_force *force, double speed);

/* The part 1 - exp(-travel/bound) of the way from z to its steady value that the exact solution goes (F3); travel > 0. */
double massspring_dahl_share(double travel, double bound);
/* z' - z of (F3), to a few units in the last place of what it is the difference of, however small it is against z. */
double massspring_dahl_change(double v, double dt, double bound, double z);

/* The clamped law in the plane: z moves along the unit vector inside the circle of radius bound, then slides on it (F12); |z| <= bound, travel > 0. */
void massspring_clamped_slide(double bound, double travel, const double along[3], double z[3]);

#endif
