/* Additive continuous collision detection (SPEC C.5, Algorithm 1 of the C-IPC paper). */
#include "cipc/contact.h"

#include <math.h>

#include "base/vector.h"

cipc_ccd_options cipc_ccd_options_default(void)
{
    cipc_ccd_options options = {.slackness = 0.1, .max_iterations = 100000, .gap_first = false};
    return options;
}

static double true_distance2(cipc_pair_kind kind, const double *x)
{
    switch (kind) {
    case CIPC_POINT_POINT: return cipc_point_point_distance2_value(x);
    case CIPC_POINT_EDGE: return cipc_point_edge_distance2(x);
    case CIPC_POINT_TRIANGLE: return cipc_point_triangle_distance2(x);
    default: return cipc_edge_edge_distance2(x);
    }
}

/* l_p: how fast the two primitives can approach at most (SPEC C.5). */
static double largest_approach(cipc_pair_kind kind, const double *p)
{
    static const int first_count[CIPC_PAIR_KIND_COUNT] = {1, 1, 1, 2}, count[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4};
    double a = 0, b = 0;
    for (int i = 0; i < count[kind]; i++) {
        double length = v3_norm(p + 3 * i);
        if (i < first_count[kind]) a = fmax(a, length);
        else b = fmax(b, length);
    }
    return a + b;
}

/* Displacements relative to their mean, positions relative to the first node: the result depends on neither a common motion nor the world's origin. */
static void localize(int count, const double *x, const double *p, double x0[12], double p0[12])
{
    double mean[3] = {0, 0, 0};
    for (int i = 0; i < count; i++) v3_axpy(mean, 1.0 / count, p + 3 * i);
    for (int i = 0; i < count; i++) {
        v3_sub(x0 + 3 * i, x + 3 * i, x);
        v3_sub(p0 + 3 * i, p + 3 * i, mean);
    }
}

cipc_ccd_result cipc_additive_ccd(cipc_pair_kind kind, const double *x, const double *p, double xi, double t_max, const cipc_ccd_options *options)
{
    static const int node_count[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4};
    cipc_ccd_result result = {.toi = t_max, .hit = false};
    double x0[12], p0[12], y[12];
    int n = 3 * node_count[kind];
    localize(node_count[kind], x, p, x0, p0);
    double lp = largest_approach(kind, p0);
    if (lp == 0) return result;
    double d2 = true_distance2(kind, x0);
    double gap = (d2 - xi * xi) / (sqrt(d2) + xi); /* d - xi without cancellation of the root */
    if (!(gap > 0)) {
        result.toi = 0;
        result.hit = true;
        return result;
    }
    double target = options->slackness * gap, t = 0, t_l = (1 - options->slackness) * gap / lp;
    for (result.iterations = 1; result.iterations <= options->max_iterations; result.iterations++) {
        double next = t + t_l;
        /* Certified beyond t_max: asked before the gap is looked at, this saves early hits (SPEC V.4); Algorithm 1 asks after it. */
        if (!options->gap_first && next > t_max) return result;
        for (int i = 0; i < n; i++) y[i] = x0[i] + next * p0[i];
        d2 = true_distance2(kind, y);
        gap = (d2 - xi * xi) / (sqrt(d2) + xi);
        if (t > 0 && gap < target) {
            result.toi = t;
            result.hit = true;
            return result;
        }
        if (next > t_max) return result;
        t = next;
        t_l = (1 - options->slackness) * gap / lp;
        if (!(t_l > 0)) break; /* only after a first step that rounding spoilt */
    }
    result.toi = t;
    result.hit = true;
    result.capped = true;
    return result;
}
