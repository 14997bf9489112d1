/* Rod stretching: E A l0/2 (l/l0 - 1)^2 (SPEC C.6; docs/theory/energies.md (31), (32)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

static const double pi = 3.14159265358979323846;

bool cipc_rod_stretching_init(cipc_rod_stretching *params, const double rest[6], double diameter, double young)
{
    double e[3];
    v3_sub(e, rest + 3, rest);
    params->length = v3_norm(e);
    params->stiffness = young * pi * diameter * diameter / 4;
    return params->length > 0;
}

double cipc_rod_stretching_value(const double x[6], const cipc_rod_stretching *params)
{
    double e[3];
    v3_sub(e, x + 3, x);
    double elongation = v3_norm(e) - params->length;
    return params->stiffness / (2 * params->length) * elongation * elongation;
}

void cipc_rod_stretching_gradient(const double x[6], const cipc_rod_stretching *params, double g[6])
{
    double e[3];
    v3_sub(e, x + 3, x);
    double length = v3_norm(e), tension = params->stiffness * (length - params->length) / params->length;
    for (int k = 0; k < 3; k++) {
        g[3 + k] = tension * e[k] / length;
        g[k] = -g[3 + k];
    }
}

/* (32): stiff along the tangent; across it what the tension gives. */
void cipc_rod_stretching_hessian(const double x[6], const cipc_rod_stretching *params, double H[36])
{
    double e[3], K[3][3], minus[3][3];
    v3_sub(e, x + 3, x);
    double length = v3_norm(e), along = params->stiffness / params->length, across = along * (length - params->length) / length;
    v3_scale(e, 1 / length, e);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            K[r][c] = (along - across) * e[r] * e[c] + (r == c ? across : 0);
            minus[r][c] = -K[r][c];
        }
    }
    put_block_pair(H, 6, 0, 0, K);
    put_block_pair(H, 6, 1, 1, K);
    put_block_pair(H, 6, 0, 1, minus);
}
