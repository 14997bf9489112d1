/* Stitch: a spring of no length between a node and a place on an edge, k/2 |x0 - ((1-r) x1 + r x2)|^2 (SPEC C.6; docs/theory/energies.md (R12)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

/* Weights of the nodes in the gap y = sum_i w_i x_i. */
static void weights(const cipc_stitch *params, double w[3])
{
    w[0] = 1;
    w[1] = params->ratio - 1;
    w[2] = -params->ratio;
}

/* y from differences of nodes, so that a translation costs no digits. */
static void gap_of(const double x[9], const cipc_stitch *params, double y[3])
{
    for (int k = 0; k < 3; k++) y[k] = (x[k] - x[3 + k]) - params->ratio * (x[6 + k] - x[3 + k]);
}

double cipc_stitch_value(const double x[9], const cipc_stitch *params)
{
    double y[3];
    gap_of(x, params, y);
    return 0.5 * params->stiffness * v3_norm2(y);
}

void cipc_stitch_gradient(const double x[9], const cipc_stitch *params, double g[9])
{
    double y[3], w[3];
    gap_of(x, params, y);
    weights(params, w);
    for (int i = 0; i < 3; i++) v3_scale(g + 3 * i, params->stiffness * w[i], y);
}

void cipc_stitch_hessian(const double x[9], const cipc_stitch *params, double H[81])
{
    double w[3];
    (void)x;
    weights(params, w);
    put_zeros(H, 81);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++) H[9 * (3 * i + k) + 3 * j + k] = params->stiffness * (w[i] * w[j]);
        }
    }
}
