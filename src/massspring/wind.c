/* Wind on a triangle (SPEC B.6; docs/theory/massspring_springs.md (14)). The formula is in spring_force.h. */
#include "massspring/spring_force.h"

void cipc_wind_force(double q, const double wind[3], const double x[9], const double v[9], double f[3])
{
    massspring_wind_force(q, wind, INFINITY, (const double *const[3]){x, x + 3, x + 6}, (const double *const[3]){v, v + 3, v + 6}, f);
}
