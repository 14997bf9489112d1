/* Rest data of a membrane triangle (SPEC C.6; docs/theory/energies.md (4)). */
#include "energy/membrane.h"
#include "cipc/energy.h"

bool energy_rest_triangle(const double rest[9], double inverse_rest[3], double *area)
{
    double e1[3], e2[3], normal[3];
    v3_sub(e1, rest + 3, rest);
    v3_sub(e2, rest + 6, rest);
    v3_cross(normal, e1, e2);
    double length = v3_norm(e1), twice_area = v3_norm(normal);
    if (!(twice_area > 0) || !isfinite(twice_area)) return false;
    /* B = [[length, along], [0, height]] in the basis (e1/length, in-plane normal of e1). */
    double along = v3_dot(e1, e2) / length, height = twice_area / length;
    inverse_rest[0] = 1 / length;
    inverse_rest[1] = -along / twice_area;
    inverse_rest[2] = 1 / height;
    *area = 0.5 * twice_area;
    return true;
}

bool cipc_membrane_init(cipc_membrane *params, const double rest[9], double thickness, double young, double poisson)
{
    if (!energy_rest_triangle(rest, params->inverse_rest, &params->area)) return false;
    params->volume = params->area * thickness;
    params->mu = young / (2 * (1 + poisson));
    params->lambda = young * poisson / (1 - poisson * poisson); /* plane stress */
    return true;
}
