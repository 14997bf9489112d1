/* Wind on a triangle (SPEC B.6; docs/theory/massspring_springs.md (14)). */
#include "base/vector.h"
#include "cipc/massspring.h"

void cipc_wind_force(double q, const double wind[3], const double x[9], const double v[9], double f[3])
{
    double a[3], b[3], normal[3], relative[3]; /* the normal is as long as twice the area */
    v3_sub(a, x + 3, x);
    v3_sub(b, x + 6, x);
    v3_cross(normal, a, b);
    for (int k = 0; k < 3; k++) relative[k] = wind[k] - (v[k] + v[3 + k] + v[6 + k]) / 3;
    const double twice_area = v3_norm(normal);
    v3_scale(f, twice_area > 0 ? q / 6 * (v3_dot(normal, relative) / twice_area) : 0, normal);
}
