/* Squared distance of two points. SPEC D.1; docs/theory/distance.md eqs. 1-3 with no parameter. */
#include <string.h>

#include "cipc/geometry.h"
#include "base/vector.h"

double cipc_point_point_distance2_value(const double x[6])
{
    double u[3];
    v3_sub(u, x, x + 3);
    return v3_norm2(u);
}

void cipc_point_point_distance2_gradient(const double x[6], double g[6])
{
    for (int k = 0; k < 3; k++) {
        g[k] = 2.0 * (x[k] - x[3 + k]);
        g[3 + k] = -g[k];
    }
}

/* Constant: 2 [I, -I; -I, I]. The positions are not used; they are taken so that the three functions look alike. */
void cipc_point_point_distance2_hessian(const double x[6], double H[36])
{
    (void)x;
    memset(H, 0, 36 * sizeof H[0]);
    for (int k = 0; k < 3; k++) {
        H[6 * k + k] = H[6 * (3 + k) + 3 + k] = 2.0;
        H[6 * k + 3 + k] = H[6 * (3 + k) + k] = -2.0;
    }
}
