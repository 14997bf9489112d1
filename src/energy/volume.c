/* Rest data of a tetrahedron (SPEC C.6; docs/theory/energies.md (40)). */
#include "energy/volume.h"

bool cipc_volume_init(cipc_volume *params, const double rest[12], double young, double poisson)
{
    double e[3][3], cofactor[3][3];
    for (int i = 0; i < 3; i++) v3_sub(e[i], rest + 3 + 3 * i, rest);
    for (int i = 0; i < 3; i++) v3_cross(cofactor[i], e[(i + 1) % 3], e[(i + 2) % 3]);
    double determinant = v3_dot(e[0], cofactor[0]);
    if (!(determinant > 0) || !isfinite(determinant)) return false;
    for (int i = 0; i < 3; i++) v3_scale(params->inverse_rest + 3 * i, 1 / determinant, cofactor[i]); /* rows of B^-1, B = [e0, e1, e2] */
    params->volume = determinant / 6;
    params->mu = young / (2 * (1 + poisson));
    params->lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    return true;
}
