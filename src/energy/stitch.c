/* Stitch: k/2 |x0 - ((1 - r) x1 + r x2)|^2 (SPEC C.6; docs/theory/energies.md (39)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

/* What is left between the node and its point on the edge; relative to x1, so that nothing is lost far from the origin. */
static void opening(const double x[9], double ratio, double d[3])
{
    for (int k = 0; k < 3; k++) d[k] = (x[k] - x[3 + k]) - ratio * (x[6 + k] - x[3 + k]);
}

double cipc_stitch_value(const double x[9], const cipc_stitch *params)
{
    double d[3];
    opening(x, params->ratio, d);
    return 0.5 * params->stiffness * v3_norm2(d);
}

void cipc_stitch_gradient(const double x[9], const cipc_stitch *params, double g[9])
{
    double d[3];
    opening(x, params->ratio, d);
    for (int k = 0; k < 3; k++) {
        g[k] = params->stiffness * d[k];
        g[3 + k] = -(1 - params->ratio) * g[k];
        g[6 + k] = -params->ratio * g[k];
    }
}

void cipc_stitch_hessian(const double x[9], const cipc_stitch *params, double H[81])
{
    (void)x;
    const double w[3] = {1, -(1 - params->ratio), -params->ratio};
    put_zeros(H, 81);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) H[(3 * i + k) * 9 + 3 * j + k] = params->stiffness * w[i] * w[j];
}
