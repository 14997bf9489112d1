/* The projected Hessian of an unmollified barrier in closed form: a problem of 1, 3 or 5 dimensions instead of 6, 9 or 12. */
#ifndef CIPC_IMPLICIT_CONTACT_HESSIAN_H
#define CIPC_IMPLICIT_CONTACT_HESSIAN_H

#include <stdbool.h>
#include "cipc/energy.h"

/* H = nearest positive semi-definite matrix to the Hessian of the barrier at y. False, with H untouched, for stencils that have no closed form here
 * (mollified) or are too close to degenerate for it: the caller then projects the exact Hessian. docs/theory/assembly.md, eqs. 2-6. */
bool cipc_contact_hessian_projected(cipc_energy_id id, const double *y, const cipc_contact_barrier *barrier, double *H);

#endif
