/* Coulomb's law (docs/theory/massspring.md (F1)). It has no memory: z is neither read nor changed. */
#include <math.h>

#include "massspring/friction.h"

/* At v = 0 the law allows anything up to Fs and the load decides, which is not known here. 0 is the value that adds no motion of its own; who wants sticking compares the load with
 * cipc_friction_level(force, 0). */
double massspring_coulomb_step(const cipc_friction_force *force, double v)
{
    return v == 0 ? 0 : copysign(force->coulomb, v);
}
