/* Rest data of a tetrahedron (SPEC C.6; docs/theory/energies.md (V1)). */
#include "energy/volume.h"

#include "cipc/energy.h"
#include "energy/inverse3.h"

bool cipc_volume_init(cipc_volume *params, const double rest[12], double young, double poisson)
{
    double B[9], inverse[9];
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) B[3 * k + j] = rest[3 * (j + 1) + k] - rest[k];
    }
    double six_volumes = energy_inverse3(B, inverse);
    if (!(six_volumes > 0) || !isfinite(six_volumes)) return false;
    for (int i = 0; i < 9; i++) params->inverse_rest[i] = inverse[i];
    params->volume = six_volumes / 6;
    params->mu = young / (2 * (1 + poisson));
    params->lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    return true;
}
