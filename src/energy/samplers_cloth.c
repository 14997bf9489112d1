/* Samplers of the lower strain limit and of the orthotropic membrane. */
#include "base/vector.h"
#include "energy/samplers.h"

/* --- lower strain limit; t = (shat - sigma)/(shat - s) runs from 0 (threshold) to 1 (limit) --- */

const char *const energy_strain_limit_lower_branch_names[ENERGY_STRAIN_LIMIT_LOWER_BRANCHES] = {
    "inactive", "threshold", "one_active", "both_active", "near_equal", "near_limit",
};
enum { INACTIVE = 0, THRESHOLD, ONE_ACTIVE, BOTH_ACTIVE, NEAR_EQUAL, NEAR_LIMIT };
static const double THRESHOLD_T = 1e-5, EQUAL_STRETCHES = 1e-7, LIMIT_T = 1e-5;

void energy_sample_strain_limit_lower(gsl_rng *rng, int branch, double *x, void *params)
{
    double rest[9], limit = energy_draw_uniform(rng, 0.3, 0.99);
    double activation = energy_draw_index(rng, 2) ? 1 : 1 - energy_draw_uniform(rng, 0.1, 0.8) * (1 - limit), width = activation - limit;
    energy_draw_triangle(rng, energy_draw_log(rng, 1e-3, 1), 0.05, rest);
    double thickness = energy_draw_log(rng, 1e-4, 1e-2), stiffness = energy_draw_log(rng, 1e2, 1e5);
    (void)cipc_strain_limit_lower_init(params, rest, thickness, limit, activation, stiffness);
    double slack = energy_draw_uniform(rng, 1.01, 1.6) * activation, t = energy_draw_uniform(rng, 0.05, 0.95);
    double sigma[2] = {slack, activation - t * width};
    if (branch == INACTIVE) sigma[1] = energy_draw_uniform(rng, 1.001 * activation, slack);
    if (branch == THRESHOLD) sigma[1] = activation - width * energy_draw_log(rng, 1e-6, 0.9 * THRESHOLD_T);
    if (branch == BOTH_ACTIVE) sigma[0] = activation - t * width * energy_draw_uniform(rng, 0.01, 0.999);
    if (branch == NEAR_EQUAL) sigma[0] = sigma[1] + energy_draw_log(rng, 1e-17, 0.9 * EQUAL_STRETCHES) * width;
    if (branch == NEAR_LIMIT) {
        sigma[1] = limit + width * energy_draw_log(rng, 1e-6, 0.9 * LIMIT_T);
        if (energy_draw_index(rng, 2)) sigma[0] = activation - width * energy_draw_uniform(rng, 0, 0.99);
    }
    energy_draw_deformed_triangle(rng, ((const cipc_strain_limit *)params)->inverse_rest, sigma, x);
}

int energy_branch_strain_limit_lower(const double *x, const void *params)
{
    const cipc_strain_limit *p = params;
    double sigma[2], width = p->activation - p->limit;
    cipc_principal_stretches(x, p->inverse_rest, sigma);
    if (sigma[1] >= p->activation) return INACTIVE;
    if (sigma[1] - p->limit <= LIMIT_T * width) return NEAR_LIMIT;
    if (p->activation - sigma[1] <= THRESHOLD_T * width) return THRESHOLD;
    if (sigma[0] >= p->activation) return ONE_ACTIVE;
    return sigma[0] - sigma[1] <= EQUAL_STRETCHES * width ? NEAR_EQUAL : BOTH_ACTIVE;
}

/* --- orthotropic membrane: seven shapes, each with the weft across the warp and askew. Moduli, limits and thickness span those of measured cloth
 * (SPEC C.3) --- */

const char *const energy_orthotropic_branch_names[ENERGY_ORTHOTROPIC_BRANCHES] = {
    "rest",      "stretched",      "compressed",      "mixed",      "sheared",      "near_limit",      "near_shear_limit",
    "rest_skew", "stretched_skew", "compressed_skew", "mixed_skew", "sheared_skew", "near_limit_skew", "near_shear_limit_skew",
};
enum { REST = 0, BOTH_LONGER, BOTH_SHORTER, MIXED, SHEARED, NEAR_NORMAL_LIMIT, NEAR_SHEAR_LIMIT, CLOTH_SHAPES };
/* Shares of the limits: below REST_SHARE at rest; beyond NEAR_SHARE near a limit; a shear above SHEAR_SHARE counts as one. */
static const double REST_SHARE = 1e-9, NEAR_SHARE = 1 - 1e-4, SHEAR_SHARE = 0.1;
/* A Green strain of -1/2 is a length of zero: limits beyond are never reached in compression. With both directions at this and the weft 0.2 rad askew there
 * is an angle between them at which they have the shear asked for: 1 - 2 * 0.35 = 0.3 > sin 0.2 + 2 * 0.13 SHEAR_SHARE. */
static const double MOST_COMPRESSED = 0.35, MOST_SKEW = 0.2;

/* Strains as shares of their limits. */
static void draw_shares(gsl_rng *rng, int shape, double share[3])
{
    share[0] = energy_draw_uniform(rng, 0.01, 0.95);
    share[1] = energy_draw_uniform(rng, 0.01, 0.95);
    share[2] = energy_draw_uniform(rng, -0.9, 0.9) * SHEAR_SHARE;
    int first = energy_draw_index(rng, 2);
    double sign = energy_draw_index(rng, 2) ? 1 : -1, near = 1 - energy_draw_log(rng, 1e-6, 0.5 * (1 - NEAR_SHARE));
    if (shape == REST) share[0] = share[1] = share[2] = 0;
    if (shape == BOTH_SHORTER) share[0] = -share[0];
    if (shape == BOTH_SHORTER) share[1] = -share[1];
    if (shape == MIXED) share[first] = -share[first];
    if (shape == SHEARED) share[2] = sign * energy_draw_uniform(rng, 1.1 * SHEAR_SHARE, 0.95);
    if (shape == NEAR_NORMAL_LIMIT) share[first] = near;
    if (shape == NEAR_SHEAR_LIMIT) share[2] = sign * near;
}

static double strain_of(double share, double limit)
{
    return share * (share < 0 ? fmin(limit, MOST_COMPRESSED) : limit);
}

/* Positions whose images f_1, f_2 of warp and weft have the strains e11, e22, e12, placed in space: [d1, d2] = [f_1, f_2] W^-1, W = (warp, weft). */
static void draw_strained(gsl_rng *rng, const cipc_orthotropic *p, const double strain[3], double x[9])
{
    double length1 = sqrt(1 + 2 * strain[0]), length2 = sqrt(1 + 2 * strain[1]), along = (2 * strain[2] + p->rest_cosine) / length1;
    double f1[2] = {length1, 0}, f2[2] = {along, sqrt(length2 * length2 - along * along)}, local[9] = {0};
    double det = p->warp[0] * p->weft[1] - p->warp[1] * p->weft[0];
    for (int k = 0; k < 2; k++) {
        local[3 + k] = (f1[k] * p->weft[1] - f2[k] * p->warp[1]) / det;
        local[6 + k] = (f2[k] * p->warp[0] - f1[k] * p->weft[0]) / det;
    }
    energy_draw_placement(rng, hypot(local[3], local[4]), 3, local, x);
}

void energy_sample_membrane_orthotropic(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_orthotropic *p = params;
    int shape = branch % CLOTH_SHAPES;
    double rest[9], share[3], angle = energy_draw_uniform(rng, -3.15, 3.15), between = 0.5 * M_PI + energy_draw_uniform(rng, -MOST_SKEW, MOST_SKEW);
    const double moduli[4] = {energy_draw_log(rng, 2e6, 1.6e7), energy_draw_log(rng, 1e6, 8e6), energy_draw_log(rng, 2e6, 2.5e7), energy_draw_log(rng, 3e5, 2.5e6)};
    const double limits[3] = {energy_draw_log(rng, 0.1, 0.5), energy_draw_log(rng, 0.06, 0.62), energy_draw_log(rng, 0.05, 0.13)};
    const double warp[3] = {cos(angle), sin(angle), 0}, weft[3] = {cos(angle + between), sin(angle + between), 0};
    energy_draw_triangle(rng, energy_draw_log(rng, 1e-3, 1), 0.05, rest);
    (void)cipc_orthotropic_init(p, rest, energy_draw_log(rng, 1.8e-4, 1.3e-3), warp, branch < CLOTH_SHAPES ? NULL : weft, moduli, limits);
    draw_shares(rng, shape, share);
    const double strain[3] = {strain_of(share[0], p->limit11), strain_of(share[1], p->limit22), share[2] * p->limit12};
    draw_strained(rng, p, strain, x);
}

/* Green strains over their limits. */
static void shares_of(const double x[9], const cipc_orthotropic *p, double share[3])
{
    double d1[3], d2[3], f1[3], f2[3];
    v3_sub(d1, x + 3, x);
    v3_sub(d2, x + 6, x);
    for (int k = 0; k < 3; k++) {
        f1[k] = p->warp[0] * d1[k] + p->warp[1] * d2[k];
        f2[k] = p->weft[0] * d1[k] + p->weft[1] * d2[k];
    }
    share[0] = 0.5 * (v3_norm2(f1) - 1) / p->limit11;
    share[1] = 0.5 * (v3_norm2(f2) - 1) / p->limit22;
    share[2] = 0.5 * (v3_dot(f1, f2) - p->rest_cosine) / p->limit12;
}

int energy_branch_membrane_orthotropic(const double *x, const void *params)
{
    const cipc_orthotropic *p = params;
    int weft = p->rest_cosine == 0 ? 0 : CLOTH_SHAPES;
    double share[3];
    shares_of(x, p, share);
    double normal = fmax(fabs(share[0]), fabs(share[1])), shear = fabs(share[2]);
    if (fmax(normal, shear) < REST_SHARE) return weft + REST;
    if (shear > NEAR_SHARE) return weft + NEAR_SHEAR_LIMIT;
    if (normal > NEAR_SHARE) return weft + NEAR_NORMAL_LIMIT;
    if (shear > SHEAR_SHARE) return weft + SHEARED;
    if (share[0] >= 0 && share[1] >= 0) return weft + BOTH_LONGER;
    return weft + (share[0] < 0 && share[1] < 0 ? BOTH_SHORTER : MIXED);
}
