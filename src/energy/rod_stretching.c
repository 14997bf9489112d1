/* Rod stretching: E A l0/2 (l/l0 - 1)^2 of one segment (SPEC C.6; docs/theory/energies.md (R1)-(R3)). */
#include "base/vector.h"
#include "cipc/energy.h"
#include "energy/blocks.h"

bool cipc_rod_stretching_init(cipc_rod_stretching *params, const double rest[6], double diameter, double young)
{
    double edge[3];
    v3_sub(edge, rest + 3, rest);
    double length = v3_norm(edge);
    if (!(length > 0) || !isfinite(length)) return false;
    params->stiffness = young * (M_PI / 4) * diameter * diameter;
    params->length = length;
    return true;
}

/* Edge vector, its length l, and l - l0. The difference is taken first: it is exact near rest, where l/l0 - 1 would round once more. */
typedef struct segment {
    double edge[3], length, longer;
} segment;

static segment segment_of(const double x[6], const cipc_rod_stretching *params)
{
    segment s;
    v3_sub(s.edge, x + 3, x);
    s.length = v3_norm(s.edge);
    s.longer = s.length - params->length;
    return s;
}

double cipc_rod_stretching_value(const double x[6], const cipc_rod_stretching *params)
{
    segment s = segment_of(x, params);
    return 0.5 * (params->stiffness / params->length) * s.longer * s.longer;
}

void cipc_rod_stretching_gradient(const double x[6], const cipc_rod_stretching *params, double g[6])
{
    segment s = segment_of(x, params);
    double tension = params->stiffness / params->length * s.longer;
    for (int k = 0; k < 3; k++) {
        g[3 + k] = tension * (s.edge[k] / s.length);
        g[k] = -g[3 + k];
    }
}

void cipc_rod_stretching_hessian(const double x[6], const cipc_rod_stretching *params, double H[36])
{
    segment s = segment_of(x, params);
    double k = params->stiffness / params->length, across = k * (s.longer / s.length), along = k * (params->length / s.length);
    double K[3][3], minus[3][3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            K[r][c] = along * (s.edge[r] / s.length) * (s.edge[c] / s.length) + (r == c ? across : 0); /* (R3) */
            minus[r][c] = -K[r][c];
        }
    }
    put_block_pair(H, 6, 0, 0, K);
    put_block_pair(H, 6, 0, 1, minus);
    put_block_pair(H, 6, 1, 1, K);
}
