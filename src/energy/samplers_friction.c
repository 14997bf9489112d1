/* Sampler of the lagged friction: four states of sliding for each kind of contact. */
#include "base/vector.h"
#include "energy/samplers.h"

const char *const energy_friction_branch_names[ENERGY_FRICTION_BRANCHES] = {
    "rest_point_point",     "rest_point_edge",     "rest_point_triangle",     "rest_edge_edge",
    "stick_point_point",    "stick_point_edge",    "stick_point_triangle",    "stick_edge_edge",
    "boundary_point_point", "boundary_point_edge", "boundary_point_triangle", "boundary_edge_edge",
    "slip_point_point",     "slip_point_edge",     "slip_point_triangle",     "slip_edge_edge",
};
enum { REST = 0, STICK, BOUNDARY, SLIP };
static const double BOUNDARY_SHARE = 1e-6; /* |y - e| over e */

/* Weights of the closest vector of each kind: they sum to 0. */
static void draw_weights(gsl_rng *rng, int kind, double w[4])
{
    double s = energy_draw_uniform(rng, 0.1, 0.8), t = energy_draw_uniform(rng, 0.1, 0.9);
    w[0] = 1;
    w[1] = w[2] = w[3] = 0;
    switch (kind) {
    case CIPC_POINT_POINT:
        w[1] = -1;
        break;
    case CIPC_POINT_EDGE:
        w[1] = -(1 - s);
        w[2] = -s;
        break;
    case CIPC_POINT_TRIANGLE:
        w[1] = -(1 - s);
        w[2] = -s * (1 - t);
        w[3] = -s * t;
        break;
    default:
        w[0] = 1 - s;
        w[1] = s;
        w[2] = -(1 - t);
        w[3] = -t;
    }
}

static double draw_slip(gsl_rng *rng, int state, double eps)
{
    switch (state) {
    case REST:
        return 0;
    case STICK:
        return eps * energy_draw_log(rng, 1e-3, 0.99);
    case BOUNDARY:
        return eps * (1 + energy_draw_uniform(rng, -0.5, 0.5) * BOUNDARY_SHARE);
    default:
        return eps * energy_draw_log(rng, 1.01, 1e3);
    }
}

static void slip_of(const double x[12], const cipc_friction *p, double u[2])
{
    u[0] = u[1] = 0;
    for (int i = 0; i < 12; i++) {
        u[0] += p->weights[i / 3] * p->basis[i % 3] * (x[i] - p->start[i]);
        u[1] += p->weights[i / 3] * p->basis[3 + i % 3] * (x[i] - p->start[i]);
    }
}

void energy_sample_friction(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_friction *p = params;
    double frame[3][3], size = energy_draw_log(rng, 1e-2, 0.3);
    int state = branch / CIPC_PAIR_KIND_COUNT;
    draw_weights(rng, branch % CIPC_PAIR_KIND_COUNT, p->weights);
    energy_draw_rotation(rng, frame);
    v3_copy(p->basis, frame[0]);
    v3_copy(p->basis + 3, frame[1]);
    p->coefficient = energy_draw_log(rng, 1e-3, 10);
    p->eps = energy_draw_log(rng, 1e-6, 1e-3);
    for (int i = 0; i < 12; i++) {
        p->start[i] = energy_draw_uniform(rng, -size, size);
        x[i] = p->start[i] + (state == REST ? 0 : energy_draw_uniform(rng, -1, 1) * p->eps);
    }
    if (state == REST) return;
    /* Move node 0 along the tangents so that |u| is what is wanted. */
    double u[2], y = draw_slip(rng, state, p->eps), angle = energy_draw_uniform(rng, -3.15, 3.15);
    slip_of(x, p, u);
    v3_axpy(x, (y * cos(angle) - u[0]) / p->weights[0], p->basis);
    v3_axpy(x, (y * sin(angle) - u[1]) / p->weights[0], p->basis + 3);
}

int energy_branch_friction(const double *x, const void *params)
{
    const cipc_friction *p = params;
    double u[2];
    slip_of(x, p, u);
    double y = sqrt(u[0] * u[0] + u[1] * u[1]);
    int state = y < p->eps ? STICK : SLIP;
    if (y == 0)
        state = REST;
    else if (fabs(y - p->eps) <= BOUNDARY_SHARE * p->eps)
        state = BOUNDARY;
    int kind = CIPC_POINT_TRIANGLE;
    if (p->weights[1] > 0)
        kind = CIPC_EDGE_EDGE;
    else if (p->weights[2] == 0)
        kind = CIPC_POINT_POINT;
    else if (p->weights[3] == 0)
        kind = CIPC_POINT_EDGE;
    return CIPC_PAIR_KIND_COUNT * state + kind;
}
