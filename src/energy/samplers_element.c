/* Samplers of the energies of single nodes, triangles and hinges. */
#include "base/vector.h"
#include "energy/samplers.h"

/* --- single nodes --- */

const char *const energy_nodal_branch_names[ENERGY_NODAL_BRANCHES] = {"at_target", "away"};
const char *const energy_gravity_branch_names[ENERGY_GRAVITY_BRANCHES] = {"any"};

static int nodal_branch(const double x[3], const double target[3])
{
    return !(x[0] == target[0] && x[1] == target[1] && x[2] == target[2]);
}

static void draw_node(gsl_rng *rng, int branch, double x[3], double target[3])
{
    for (int k = 0; k < 3; k++) {
        target[k] = energy_draw_uniform(rng, -1, 1);
        x[k] = branch == 0 ? target[k] : target[k] + energy_draw_uniform(rng, -0.1, 0.1);
    }
}

void energy_sample_inertia(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_inertia *p = params;
    p->mass = energy_draw_log(rng, 1e-7, 1);
    draw_node(rng, branch, x, p->target);
}

int energy_branch_inertia(const double *x, const void *params)
{
    return nodal_branch(x, ((const cipc_inertia *)params)->target);
}

void energy_sample_gravity(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_gravity *p = params;
    (void)branch;
    p->mass = energy_draw_log(rng, 1e-7, 1);
    for (int k = 0; k < 3; k++) {
        p->acceleration[k] = energy_draw_uniform(rng, -10, 10);
        x[k] = energy_draw_uniform(rng, -1, 1);
    }
}

int energy_branch_gravity(const double *x, const void *params)
{
    (void)x;
    (void)params;
    return 0;
}

void energy_sample_dirichlet_penalty(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_dirichlet_penalty *p = params;
    p->mass = energy_draw_log(rng, 1e-7, 1);
    p->stiffness = energy_draw_log(rng, 1e6, 1e8);
    draw_node(rng, branch, x, p->target);
}

int energy_branch_dirichlet_penalty(const double *x, const void *params)
{
    return nodal_branch(x, ((const cipc_dirichlet_penalty *)params)->target);
}

/* --- triangles --- */

/* Positions with F = sigma_1 u_1 v_1^T + sigma_2 u_2 v_2^T for a random rotation of the plane (v) and of space (u). */
void energy_draw_deformed_triangle(gsl_rng *rng, const double inverse_rest[3], const double sigma[2], double x[9])
{
    double angle = energy_draw_uniform(rng, -3.15, 3.15), c = cos(angle), s = sin(angle);
    double base[2] = {1 / inverse_rest[0], 0}; /* columns of B */
    double side[2] = {-inverse_rest[1] / (inverse_rest[0] * inverse_rest[2]), 1 / inverse_rest[2]};
    double local[9] = {0};
    local[3] = sigma[0] * (c * base[0] + s * base[1]);
    local[4] = sigma[1] * (c * base[1] - s * base[0]);
    local[6] = sigma[0] * (c * side[0] + s * side[1]);
    local[7] = sigma[1] * (c * side[1] - s * side[0]);
    energy_draw_placement(rng, base[0], 3, local, x);
}

const char *const energy_membrane_branch_names[ENERGY_MEMBRANE_BRANCHES] = {"rest", "stretched", "compressed", "sheared",
                                                                            "near_degenerate"};
enum { REST = 0, STRETCHED, COMPRESSED, SHEARED, NEAR_DEGENERATE };
static const double REST_STRAIN = 1e-6, DEGENERATE_STRETCH = 0.01;

static void draw_stretches(gsl_rng *rng, int branch, double sigma[2])
{
    double large = energy_draw_uniform(rng, 1.01, 1.6), small = energy_draw_uniform(rng, 0.2, 0.99);
    sigma[0] = sigma[1] = 1;
    if (branch == STRETCHED) {
        sigma[0] = large;
        sigma[1] = energy_draw_uniform(rng, 1.001, large);
    } else if (branch == COMPRESSED) {
        sigma[0] = small;
        sigma[1] = energy_draw_uniform(rng, 0.1, small);
    } else if (branch == SHEARED) {
        sigma[0] = large;
        sigma[1] = small;
    } else if (branch == NEAR_DEGENERATE) {
        sigma[0] = energy_draw_uniform(rng, 0.5, 1.6);
        sigma[1] = energy_draw_log(rng, 1e-4, 0.9 * DEGENERATE_STRETCH);
    }
}

void energy_sample_membrane(gsl_rng *rng, int branch, double *x, void *params)
{
    double rest[9], sigma[2];
    energy_draw_triangle(rng, energy_draw_log(rng, 1e-3, 1), 0.05, rest);
    double thickness = energy_draw_log(rng, 1e-4, 1e-2), young = energy_draw_log(rng, 1e3, 1e7),
           poisson = energy_draw_uniform(rng, 0, 0.49);
    (void)cipc_membrane_init(params, rest, thickness, young, poisson);
    draw_stretches(rng, branch, sigma);
    energy_draw_deformed_triangle(rng, ((const cipc_membrane *)params)->inverse_rest, sigma, x);
}

int energy_branch_membrane(const double *x, const void *params)
{
    double sigma[2];
    cipc_principal_stretches(x, ((const cipc_membrane *)params)->inverse_rest, sigma);
    if (sigma[1] < DEGENERATE_STRETCH) return NEAR_DEGENERATE;
    if (fabs(sigma[0] - 1) < REST_STRAIN && fabs(sigma[1] - 1) < REST_STRAIN) return REST;
    if (sigma[1] >= 1) return STRETCHED;
    return sigma[0] <= 1 ? COMPRESSED : SHEARED;
}

/* --- strain limit; t = (sigma - shat)/(s - shat) runs from 0 (threshold) to 1 (limit) --- */

const char *const energy_strain_limit_branch_names[ENERGY_STRAIN_LIMIT_BRANCHES] = {
    "inactive", "threshold", "one_active", "one_active_collapsed", "both_active", "near_equal", "near_limit",
};
enum { INACTIVE = 0, THRESHOLD, ONE_ACTIVE, COLLAPSED, BOTH_ACTIVE, NEAR_EQUAL, NEAR_LIMIT };
static const double THRESHOLD_T = 1e-5, EQUAL_STRETCHES = 1e-7, LIMIT_T = 1e-5;

void energy_sample_strain_limit(gsl_rng *rng, int branch, double *x, void *params)
{
    double rest[9], limit = 1 + energy_draw_log(rng, 1e-3, 0.3);
    double activation = energy_draw_index(rng, 2) ? 1 : 1 + energy_draw_uniform(rng, 0.1, 0.8) * (limit - 1), width = limit - activation;
    energy_draw_triangle(rng, energy_draw_log(rng, 1e-3, 1), 0.05, rest);
    double thickness = energy_draw_log(rng, 1e-4, 1e-2), stiffness = energy_draw_log(rng, 1e2, 1e5);
    (void)cipc_strain_limit_init(params, rest, thickness, limit, activation, stiffness);
    double slack = energy_draw_uniform(rng, 0.3, 0.99) * activation, t = energy_draw_uniform(rng, 0.05, 0.95);
    double sigma[2] = {activation + t * width, slack};
    if (branch == INACTIVE) sigma[0] = energy_draw_uniform(rng, slack, 0.999 * activation);
    if (branch == THRESHOLD) sigma[0] = activation + width * energy_draw_log(rng, 1e-6, 0.9 * THRESHOLD_T);
    if (branch == COLLAPSED) sigma[1] = energy_draw_index(rng, 2) ? energy_draw_log(rng, 1e-8, 0.9 * DEGENERATE_STRETCH) : 0;
    if (branch == BOTH_ACTIVE) sigma[1] = activation + t * width * energy_draw_uniform(rng, 0.01, 0.999);
    if (branch == NEAR_EQUAL) sigma[1] = sigma[0] - energy_draw_log(rng, 1e-17, 0.9 * EQUAL_STRETCHES) * width;
    if (branch == NEAR_LIMIT) {
        sigma[0] = limit - width * energy_draw_log(rng, 1e-6, 0.9 * LIMIT_T);
        if (energy_draw_index(rng, 2)) sigma[1] = activation + width * energy_draw_uniform(rng, 0, 0.99);
    }
    energy_draw_deformed_triangle(rng, ((const cipc_strain_limit *)params)->inverse_rest, sigma, x);
}

int energy_branch_strain_limit(const double *x, const void *params)
{
    const cipc_strain_limit *p = params;
    double sigma[2], width = p->limit - p->activation;
    cipc_principal_stretches(x, p->inverse_rest, sigma);
    if (sigma[0] <= p->activation) return INACTIVE;
    if (p->limit - sigma[0] <= LIMIT_T * width) return NEAR_LIMIT;
    if (sigma[0] - p->activation <= THRESHOLD_T * width) return THRESHOLD;
    if (sigma[1] <= p->activation) return sigma[1] < DEGENERATE_STRETCH ? COLLAPSED : ONE_ACTIVE;
    return sigma[0] - sigma[1] <= EQUAL_STRETCHES * width ? NEAR_EQUAL : BOTH_ACTIVE;
}

/* --- hinges: seven shapes, each with a flat and with a curved rest shape --- */

const char *const energy_hinge_branch_names[ENERGY_HINGE_BRANCHES] = {
    "flat",
    "small",
    "large_positive",
    "large_negative",
    "near_pi_positive",
    "near_pi_negative",
    "sliver",
    "flat_curved_rest",
    "small_curved_rest",
    "large_positive_curved_rest",
    "large_negative_curved_rest",
    "near_pi_positive_curved_rest",
    "near_pi_negative_curved_rest",
    "sliver_curved_rest",
};
enum { FLAT = 0, SMALL, LARGE_POSITIVE, LARGE_NEGATIVE, NEAR_PI_POSITIVE, NEAR_PI_NEGATIVE, SLIVER, HINGE_SHAPES };
static const double FLAT_ANGLE = 1e-8, SMALL_ANGLE = 0.01, FOLDED_ANGLE = 3, SLIVER_RATIO = 0.015;

static double draw_angle(gsl_rng *rng, int shape)
{
    double large = energy_draw_uniform(rng, 1.01 * SMALL_ANGLE, 0.99 * FOLDED_ANGLE), folded = 3.14159 - energy_draw_log(rng, 1e-5, 0.14);
    double sign = energy_draw_index(rng, 2) ? 1 : -1;
    switch (shape) {
    case FLAT:
        return 0;
    case SMALL:
        return sign * energy_draw_log(rng, 1e-6, 0.99 * SMALL_ANGLE);
    case LARGE_POSITIVE:
        return large;
    case LARGE_NEGATIVE:
        return -large;
    case NEAR_PI_POSITIVE:
        return folded;
    case NEAR_PI_NEGATIVE:
        return -folded;
    default:
        return sign * large;
    }
}

void energy_sample_hinge_bending(gsl_rng *rng, int branch, double *x, void *params)
{
    cipc_hinge_bending *p = params;
    int shape = branch % HINGE_SHAPES;
    p->stiffness = energy_draw_log(rng, 1e-9, 1e-3);
    p->rest_angle = branch < HINGE_SHAPES ? 0 : energy_draw_uniform(rng, -2.5, 2.5);
    double length = energy_draw_log(rng, 1e-3, 1), angle = draw_angle(rng, shape);
    double h2 = length * energy_draw_log(rng, 0.2, 2), h3 = length * energy_draw_log(rng, 0.2, 2);
    if (shape == SLIVER) h3 = length * energy_draw_log(rng, 1e-3, 0.9 * SLIVER_RATIO);
    double foot2 = length * energy_draw_uniform(rng, -0.5, 1.5), foot3 = length * energy_draw_uniform(rng, -0.5, 1.5);
    double local[12] = {0, 0, 0, length, 0, 0, foot2, h2, 0, foot3, -h3 * cos(angle), -h3 * sin(angle)};
    energy_draw_placement(rng, length, 4, local, x);
}

/* Smaller height of the two triangles over the length of the edge. */
static double height_ratio(const double x[12])
{
    double e[3], a[3], b[3], n[3], m[3];
    v3_sub(e, x + 3, x);
    v3_sub(a, x + 6, x);
    v3_sub(b, x + 9, x);
    v3_cross(n, e, a);
    v3_cross(m, e, b);
    return fmin(v3_norm(n), v3_norm(m)) / v3_norm2(e);
}

int energy_branch_hinge_bending(const double *x, const void *params)
{
    int rest = ((const cipc_hinge_bending *)params)->rest_angle == 0 ? 0 : HINGE_SHAPES;
    double angle = cipc_hinge_angle(x), size = fabs(angle);
    if (height_ratio(x) < SLIVER_RATIO) return rest + SLIVER;
    if (size < FLAT_ANGLE) return rest + FLAT;
    if (size < SMALL_ANGLE) return rest + SMALL;
    if (size < FOLDED_ANGLE) return rest + (angle > 0 ? LARGE_POSITIVE : LARGE_NEGATIVE);
    return rest + (angle > 0 ? NEAR_PI_POSITIVE : NEAR_PI_NEGATIVE);
}
