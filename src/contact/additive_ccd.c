/* Additive continuous collision detection (SPEC C.5, Algorithm 1 of the C-IPC paper; docs/theory/contact.md (10)-(18)). */
#include "cipc/contact.h"

#include <math.h>

#include "base/vector.h"
#include "contact/additive_ccd.h"
#include "contact/stencil.h"

cipc_ccd_options cipc_ccd_options_default(void)
{
    cipc_ccd_options options = {.slackness = 0.1, .max_iterations = 100000, .method = CIPC_CCD_CERTIFIED};
    return options;
}

/* Nodes of a stencil, and how many of them belong to its first primitive. */
static const int node_count[CIPC_PAIR_KIND_COUNT] = {2, 3, 4, 4}, first_count[CIPC_PAIR_KIND_COUNT] = {1, 1, 1, 2};

/* (12) l_p: how fast the two primitives can approach at most. */
static double largest_approach(cipc_pair_kind kind, const double *p)
{
    double a = 0, b = 0;
    for (int i = 0; i < node_count[kind]; i++) {
        double length = v3_norm(p + 3 * i);
        if (i < first_count[kind]) a = max2(a, length);
        else b = max2(b, length);
    }
    return a + b;
}

/* (11): displacements relative to their mean, positions relative to the first node: the result depends on neither a common motion nor the
 * world's origin. */
static void localize(int count, const double *x, const double *p, double x0[12], double p0[12])
{
    double mean[3] = {0, 0, 0};
    for (int i = 0; i < count; i++) v3_axpy(mean, 1.0 / count, p + 3 * i);
    for (int i = 0; i < count; i++) {
        v3_sub(x0 + 3 * i, x + 3 * i, x);
        v3_sub(p0 + 3 * i, p + 3 * i, mean);
    }
}

/* (9): d - xi from d^2, without cancellation of the root. */
static double gap_of(double d2, double xi) { return (d2 - xi * xi) / (sqrt(d2) + xi); }

/* g of (20), certainly smaller than the computed gap: the largest separation of the primitives' boxes along an axis, less xi and less
 * 2^-46 = 128 u of the stencil's size for the rounding of both. */
static double box_gap(cipc_pair_kind kind, const double *x, double xi)
{
    double widest = -INFINITY, size = xi;
    for (int k = 0; k < 3; k++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < node_count[kind]; i++) {
            int side = i >= first_count[kind];
            lo[side] = min2(lo[side], x[3 * i + k]);
            hi[side] = max2(hi[side], x[3 * i + k]);
            size = max2(size, fabs(x[3 * i + k]));
        }
        widest = max2(widest, max2(lo[0] - hi[1], lo[1] - hi[0]));
    }
    return widest - xi - 0x1p-46 * size;
}

cipc_ccd_result cipc_additive_ccd(cipc_pair_kind kind, const double *x, const double *p, double xi, double t_max, const cipc_ccd_options *options)
{
    return cipc_additive_ccd_until(kind, x, p, xi, t_max, t_max, options);
}

cipc_ccd_result cipc_additive_ccd_until(cipc_pair_kind kind, const double *x, const double *p, double xi, double t_max, double bound,
                                        const cipc_ccd_options *options)
{
    cipc_ccd_result result = {.toi = t_max, .outcome = CIPC_CCD_FREE, .precision = 53};
    double x0[12], p0[12], y[12];
    int n = 3 * node_count[kind];
    localize(node_count[kind], x, p, x0, p0);
    double lp = largest_approach(kind, p0);
    if (lp == 0) return result;
    /* (20): the first step alone leads beyond the bound */
    if (bound < t_max && (1 - options->slackness) * box_gap(kind, x0, xi) > bound * lp) return result;
    double gap = gap_of(cipc_stencil_distance2(kind, x0), xi);
    if (!(gap > 0)) {
        result.toi = 0;
        result.hit = true;
        result.outcome = CIPC_CCD_INITIALLY_CLOSE;
        return result;
    }
    double target = options->slackness * gap, t = 0, t_l = (1 - options->slackness) * gap / lp;
    for (result.iterations = 1; result.iterations <= options->max_iterations; result.iterations++) {
        double next = t + t_l;
        /* (17), asked before (15), saves early hits (SPEC V.4); Algorithm 1 asks (15) first. */
        if (!options->gap_first && next > t_max) return result;
        for (int i = 0; i < n; i++) y[i] = x0[i] + next * p0[i];
        gap = gap_of(cipc_stencil_distance2(kind, y), xi);
        if (t > 0 && gap < target) { /* (15) */
            result.toi = t;
            result.hit = true;
            result.outcome = CIPC_CCD_HIT;
            return result;
        }
        if (t == 0 && !(gap > 0) && next <= t_max) { /* (18) a first step that rounding spoilt: a shorter one */
            t_l *= 0.5;
            continue;
        }
        if (next > bound) return result;
        t = next;
        t_l = (1 - options->slackness) * gap / lp; /* (14) */
    }
    result.toi = t;
    result.hit = true;
    result.outcome = CIPC_CCD_HIT;
    result.capped = true;
    return result;
}
