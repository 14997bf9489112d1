/* Closest points of two primitives, as weights of their nodes (SPEC A.4). */
#include "asynchronous/integrator.h"

#include <string.h>

static cipc_feature feature_of(cipc_pair_kind kind, const double x[12])
{
    switch (kind) {
    case CIPC_POINT_POINT: return (cipc_feature){CIPC_POINT_POINT, 2, {0, 1, 0, 0}};
    case CIPC_POINT_EDGE: return cipc_point_edge_feature(x);
    case CIPC_POINT_TRIANGLE: return cipc_point_triangle_feature(x);
    default: return cipc_edge_edge_feature(x);
    }
}

/* The places on two near-parallel edges are good to u/sine only, and not off by the same way along the edges, which would make the distance up to 1e-8 of the edges too long.
 * The foot on the second edge of the place on the first takes that out. */
static void match_places(const double x[12], double w[4])
{
    double along[3], from[3];
    v3_sub(along, x + 9, x + 6);
    for (int k = 0; k < 3; k++) from[k] = w[0] * x[k] + w[1] * x[3 + k] - x[6 + k];
    const double t = fmin(fmax(v3_dot(from, along) / v3_norm2(along), 0), 1);
    w[2] = t - 1;
    w[3] = -t;
}

asynchronous_closest asynchronous_closest_points(cipc_pair_kind kind, const double x[12])
{
    asynchronous_closest r = {.c = {0, 0, 0, 0}};
    const cipc_feature feature = feature_of(kind, x);
    /* A feature has its point first, which may be of the second primitive. */
    const double sign = feature.kind == CIPC_POINT_EDGE && feature.local[0] >= cipc_pair_first_nodes(kind) ? -1 : 1;
    double own[12], weights[4], between[3] = {0, 0, 0};
    for (int i = 0; i < feature.count; i++) memcpy(own + 3 * i, x + 3 * feature.local[i], 3 * sizeof *own);
    cipc_closest_weights(feature.kind, own, weights);
    if (feature.kind == CIPC_EDGE_EDGE) match_places(own, weights);
    for (int i = 0; i < feature.count; i++) {
        r.c[feature.local[i]] = sign * weights[i];
        v3_axpy(between, sign * weights[i], own + 3 * i);
    }
    r.distance = v3_norm(between);
    v3_scale(r.n, 1 / r.distance, between);
    return r;
}
