/* Barrier of an edge-edge stencil, on its closest features and with the mollifier of near-parallel edges:
 * kappa w e(c) b(d^2 - xi^2) (SPEC C.4, D.3; docs/theory/energies.md (26)-(29)). */
#include "cipc/energy.h"
#include "energy/barrier.h"
#include "energy/blocks.h"

enum { N = 12, MAX_PART = 12 };

/* The nodes of the closest features, in the order of their own stencil. */
static void gather(const double x[N], const cipc_feature *feature, double part[MAX_PART])
{
    for (int i = 0; i < feature->count; i++) {
        for (int k = 0; k < 3; k++) part[3 * i + k] = x[3 * feature->local[i] + k];
    }
}

static void scatter_gradient(const double *part, const cipc_feature *feature, double g[N])
{
    put_zeros(g, N);
    for (int i = 0; i < feature->count; i++) {
        for (int k = 0; k < 3; k++) g[3 * feature->local[i] + k] = part[3 * i + k];
    }
}

static void scatter_hessian(const double *part, const cipc_feature *feature, double H[N * N])
{
    int n = 3 * feature->count;
    put_zeros(H, N * N);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            int row = 3 * feature->local[i / 3] + i % 3, column = 3 * feature->local[j / 3] + j % 3;
            H[row * N + column] = part[i * n + j];
        }
    }
}

static bool mollified(const double x[N], const cipc_contact_barrier *params)
{
    return params->mollifier_eps > 0 && cipc_edge_edge_cross2(x) < params->mollifier_eps;
}

double cipc_barrier_edge_edge_value(const double x[N], const cipc_contact_barrier *params)
{
    double part[MAX_PART];
    gather(x, &params->feature, part);
    double value = stencil_barrier_value(cipc_distance2_value(params->feature.kind, part), params);
    /* An infeasible pair stays infeasible where the mollifier vanishes. */
    if (value == INFINITY || !mollified(x, params)) return value;
    return cipc_edge_edge_mollifier_value(x, params->mollifier_eps) * value;
}

void cipc_barrier_edge_edge_gradient(const double x[N], const cipc_contact_barrier *params, double g[N])
{
    const cipc_feature *feature = &params->feature;
    double part[MAX_PART], part_g[MAX_PART], b[3];
    gather(x, feature, part);
    stencil_barrier(cipc_distance2_value(feature->kind, part), params, b);
    if (b[1] == 0) {
        put_zeros(g, N);
        return;
    }
    cipc_distance2_gradient(feature->kind, part, part_g);
    chain_gradient(b, 3 * feature->count, part_g);
    scatter_gradient(part_g, feature, g);
    if (!mollified(x, params)) return;
    double e = cipc_edge_edge_mollifier_value(x, params->mollifier_eps), de[N];
    cipc_edge_edge_mollifier_gradient(x, params->mollifier_eps, de);
    for (int i = 0; i < N; i++) g[i] = e * g[i] + b[0] * de[i];
}

/* (29): the barrier's Hessian H, with its gradient b' dg, becomes that of the product with the mollifier. */
static void mollify_hessian(const double x[N], double eps, const double b[3], const double dg[N], double H[N * N])
{
    double e = cipc_edge_edge_mollifier_value(x, eps), de[N], dde[N * N];
    cipc_edge_edge_mollifier_gradient(x, eps, de);
    cipc_edge_edge_mollifier_hessian(x, eps, dde);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) { H[i * N + j] = e * H[i * N + j] + b[1] * (de[i] * dg[j] + dg[i] * de[j]) + b[0] * dde[i * N + j]; }
    }
}

void cipc_barrier_edge_edge_hessian(const double x[N], const cipc_contact_barrier *params, double H[N * N])
{
    const cipc_feature *feature = &params->feature;
    double part[MAX_PART], part_g[MAX_PART], part_H[MAX_PART * MAX_PART], b[3];
    gather(x, feature, part);
    stencil_barrier(cipc_distance2_value(feature->kind, part), params, b);
    if (b[1] == 0) {
        put_zeros(H, N * N);
        return;
    }
    cipc_distance2_gradient(feature->kind, part, part_g);
    cipc_distance2_hessian(feature->kind, part, part_H);
    chain_hessian(b, 3 * feature->count, part_g, part_H);
    scatter_hessian(part_H, feature, H);
    if (!mollified(x, params)) return;
    double dg[N];
    scatter_gradient(part_g, feature, dg);
    mollify_hessian(x, params->mollifier_eps, b, dg, H);
}
