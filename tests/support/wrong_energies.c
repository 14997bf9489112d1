/* Energies of the registry with one function replaced by a wrong one. */
#include "support/wrong_energies.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

enum { N = 12 };
/* One part in ten million: what a checker by differences in double can just see. */
static const double SLIGHT = 1e-7;
/* One part in a billion of everything: consistent, so no difference can see it. */
static const double SCALED = 1 + 1e-9;

static double largest(const double *v, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

static void membrane_gradient_of_flipped_sign(const double *x, const void *params, double *g)
{
    cipc_membrane_neo_hookean_gradient(x, params, g);
    for (int i = 0; i < 9; i++) g[i] = -g[i];
}

/* The factor 2 of d(d^2) = 2 d dd lost. */
static void point_point_gradient_without_two(const double *x, const void *params, double *g)
{
    cipc_barrier_point_point_gradient(x, params, g);
    for (int i = 0; i < 6; i++) g[i] *= 0.5;
}

/* b'' dg dg^T without + b' Hess d^2. */
static void point_edge_hessian_without_bracket(const double *x, const void *params, double *H)
{
    const cipc_contact_barrier *p = params;
    double b[3], dg[9];
    cipc_point_line_distance2_gradient(x, dg);
    cipc_barrier(cipc_point_line_distance2_value(x) - p->offset * p->offset, p->dhat * (2 * p->offset + p->dhat), b);
    for (int i = 0; i < 81; i++) H[i] = p->stiffness * p->weight * b[2] * dg[i / 9] * dg[i % 9];
}

/* The gradient of the barrier alone, without the mollifier and its product rule. */
static void edge_edge_gradient_without_product_rule(const double *x, const void *params, double *g)
{
    cipc_contact_barrier plain = *(const cipc_contact_barrier *)params;
    plain.mollifier_eps = 0;
    cipc_barrier_edge_edge_gradient(x, &plain, g);
}

/* The basis read as the rows of a 3 x 2 matrix instead of its columns. */
static void friction_gradient_with_transposed_basis(const double *x, const void *params, double *g)
{
    cipc_friction wrong = *(const cipc_friction *)params;
    const double *P = ((const cipc_friction *)params)->basis;
    const double transposed[6] = {P[0], P[2], P[4], P[1], P[3], P[5]};
    memcpy(wrong.basis, transposed, sizeof transposed);
    cipc_friction_gradient(x, &wrong, g);
}

/* d(theta)/dv = -n/|n|^2 without the length of the edge. */
static void hinge_gradient_without_length(const double *x, const void *params, double *g)
{
    double edge[3];
    v3_sub(edge, x + 3, x);
    cipc_hinge_bending_gradient(x, params, g);
    for (int i = 0; i < 12; i++) g[i] /= v3_norm(edge);
}

/* theta instead of theta - thetabar: right on the flat rest shapes, wrong on the curved ones only. */
static void hinge_gradient_without_rest_angle(const double *x, const void *params, double *g)
{
    cipc_hinge_bending wrong = *(const cipc_hinge_bending *)params;
    wrong.rest_angle = 0;
    cipc_hinge_bending_gradient(x, &wrong, g);
}

/* The formula as misprinted: ln((shat - sigma)/(s - shat)), SPEC F6. */
static double strain_limit_value_as_misprinted(const double *x, const void *params)
{
    const cipc_strain_limit *p = params;
    double sigma[2], sum = 0;
    cipc_principal_stretches(x, p->inverse_rest, sigma);
    for (int i = 0; i < 2; i++) {
        double y = (p->activation - sigma[i]) / (p->limit - p->activation);
        if (y < 0) sum -= y * y * log(y);
    }
    return p->stiffness * p->volume * sum;
}

/* Off by one part in 1e7 in a single entry of the Hessian and its mirror image. */
static void stvk_hessian_with_one_entry_off(const double *x, const void *params, double *H)
{
    cipc_membrane_stvk_hessian(x, params, H);
    double off = SLIGHT * largest(H, 81);
    H[9 * 7 + 2] += off;
    H[9 * 2 + 7] += off;
}

/* The mollifier's factor off by one part in 1e7 in a single entry of the gradient; in one of the Hessian. */
static void edge_edge_gradient_with_one_entry_off(const double *x, const void *params, double *g)
{
    cipc_barrier_edge_edge_gradient(x, params, g);
    g[7] += SLIGHT * largest(g, N);
}

static void edge_edge_hessian_with_one_entry_off(const double *x, const void *params, double *H)
{
    cipc_barrier_edge_edge_hessian(x, params, H);
    double off = SLIGHT * largest(H, N * N);
    H[N * 4 + 1] += off;
    H[N * 1 + 4] += off;
}

/* d^2 where D = d^2 - xi^2 belongs: thickness ignored. */
static double point_triangle_value_without_thickness(const double *x, const void *params)
{
    cipc_contact_barrier thin = *(const cipc_contact_barrier *)params;
    thin.dhat += thin.offset;
    thin.offset = 0;
    return cipc_barrier_point_triangle_value(x, &thin);
}

/* The sign of the second wing's normal: its tip pushes the other three nodes the wrong way. */
static void hinge_hessian_with_wrong_wing(const double *x, const void *params, double *H)
{
    cipc_hinge_bending_hessian(x, params, H);
    for (int i = 0; i < 9; i++) {
        for (int k = 9; k < N; k++) {
            H[N * i + k] = -H[N * i + k];
            H[N * k + i] = H[N * i + k];
        }
    }
}

static double gravity_value_scaled(const double *x, const void *params) { return SCALED * cipc_gravity_value(x, params); }
static void gravity_gradient_scaled(const double *x, const void *params, double *g)
{
    cipc_gravity_gradient(x, params, g);
    for (int i = 0; i < 3; i++) g[i] *= SCALED;
}

static double membrane_value_scaled(const double *x, const void *params) { return SCALED * cipc_membrane_neo_hookean_value(x, params); }
static void membrane_gradient_scaled(const double *x, const void *params, double *g)
{
    cipc_membrane_neo_hookean_gradient(x, params, g);
    for (int i = 0; i < 9; i++) g[i] *= SCALED;
}
static void membrane_hessian_scaled(const double *x, const void *params, double *H)
{
    cipc_membrane_neo_hookean_hessian(x, params, H);
    for (int i = 0; i < 81; i++) H[i] *= SCALED;
}

/* The mirrored barrier with the slope of the upper one: it pulls a compressed triangle in. */
static void strain_limit_lower_gradient_of_flipped_sign(const double *x, const void *params, double *g)
{
    cipc_strain_limit_lower_gradient(x, params, g);
    for (int i = 0; i < 9; i++) g[i] = -g[i];
}

/* The rotation taken as constant: 2 mu (w_i.w_j) alone, as in a projected "warped stiffness". */
static void corotational_hessian_without_turning(const double *x, const void *params, double *H)
{
    cipc_volume stiffer = *(const cipc_volume *)params;
    const double *b = stiffer.inverse_rest;
    stiffer.mu = 0;
    cipc_volume_corotational_hessian(x, &stiffer, H);
    double scale = 2 * stiffer.volume * ((const cipc_volume *)params)->mu;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            double product = 0;
            for (int a = 0; a < 3; a++) {
                double wi = i > 0 ? b[3 * (i - 1) + a] : -(b[a] + b[3 + a] + b[6 + a]), wj = j > 0 ? b[3 * (j - 1) + a] : -(b[a] + b[3 + a] + b[6 + a]);
                product += wi * wj;
            }
            for (int k = 0; k < 3; k++) H[(3 * i + k) * N + 3 * j + k] += scale * product;
        }
    }
}

/* ln J where (ln J)^2 / 2 has the slope ln J / J: the pressure of nu = 0. */
static void volume_gradient_without_pressure(const double *x, const void *params, double *g)
{
    cipc_volume softer = *(const cipc_volume *)params;
    softer.lambda = 0;
    cipc_volume_neo_hookean_gradient(x, &softer, g);
}

/* eta(E11^2; L11) for eta(E11^2; L11^2): the square of the limit lost in print (SPEC C.3). */
static double orthotropic_value_without_squares(const double *x, const void *params)
{
    cipc_orthotropic wrong = *(const cipc_orthotropic *)params;
    wrong.limit11 = sqrt(wrong.limit11);
    return cipc_membrane_orthotropic_value(x, &wrong);
}

/* The spring along the segment alone, without the tension that holds it sideways. */
static void rod_stretching_hessian_without_tension(const double *x, const void *params, double *H)
{
    const cipc_rod_stretching *p = params;
    double e[3], sign[2] = {-1, 1};
    v3_sub(e, x + 3, x);
    for (int i = 0; i < 36; i++) H[i] = p->stiffness / p->length * sign[i / 18] * sign[i % 6 / 3] * e[i / 6 % 3] * e[i % 3] / v3_norm2(e);
}

/* |kb| instead of |kb| - kbar: right on straight rods, wrong on curved ones only. */
static void rod_bending_gradient_without_rest_curvature(const double *x, const void *params, double *g)
{
    cipc_rod_bending wrong = *(const cipc_rod_bending *)params;
    wrong.rest_curvature = 0;
    cipc_rod_bending_gradient(x, &wrong, g);
}

/* r counted from the edge's other end. */
static void stitch_gradient_from_the_other_end(const double *x, const void *params, double *g)
{
    cipc_stitch wrong = *(const cipc_stitch *)params;
    wrong.ratio = 1 - wrong.ratio;
    cipc_stitch_gradient(x, &wrong, g);
}

static double damping_value_scaled(const double *x, const void *params) { return SCALED * cipc_damping_value(x, params); }
static void damping_gradient_scaled(const double *x, const void *params, double *g)
{
    cipc_damping_gradient(x, params, g);
    for (int i = 0; i < N; i++) g[i] *= SCALED;
}
static void damping_hessian_scaled(const double *x, const void *params, double *H)
{
    cipc_damping_hessian(x, params, H);
    for (int i = 0; i < N * N; i++) H[i] *= SCALED;
}

static void inertia_hessian_not_a_number(const double *x, const void *params, double *H)
{
    cipc_inertia_hessian(x, params, H);
    H[4] = NAN;
}

/* clang-format off */
static const wrong_energy table[] = {
    {"flipped sign", "membrane_neo_hookean", "differences give", "gradient, error", .gradient = membrane_gradient_of_flipped_sign},
    {"factor 2 of the squared distance", "barrier_point_point", "gradient[", "gradient, error", .gradient = point_point_gradient_without_two},
    {"lost bracket of the Hessian", "barrier_point_edge", "Hessian[", "Hessian, error", .hessian = point_edge_hessian_without_bracket},
    {"lost product rule of the mollifier", "barrier_edge_edge", "mollified", "gradient, error", .gradient = edge_edge_gradient_without_product_rule},
    {"mollifier off by 1e-7 in one entry of the gradient", "barrier_edge_edge", "gradient[7]", "gradient, error", .gradient = edge_edge_gradient_with_one_entry_off},
    {"mollifier off by 1e-7 in one entry of the Hessian", "barrier_edge_edge", "Hessian[", "Hessian, error", .hessian = edge_edge_hessian_with_one_entry_off},
    {"thickness ignored", "barrier_point_triangle", "", "value, error", .value = point_triangle_value_without_thickness},
    {"transposed friction basis", "friction", "differences give", "gradient, error", .gradient = friction_gradient_with_transposed_basis},
    {"lost edge length", "hinge_bending", "differences give", "gradient, error", .gradient = hinge_gradient_without_length},
    {"lost rest angle", "hinge_bending", "curved_rest", "gradient, error", .gradient = hinge_gradient_without_rest_angle},
    {"sign of the second wing", "hinge_bending", "Hessian[", "Hessian, error", .hessian = hinge_hessian_with_wrong_wing},
    {"misprinted strain limit", "strain_limit", "not finite", "not finite", .value = strain_limit_value_as_misprinted},
    {"one entry off by 1e-7", "membrane_stvk", "Hessian[7][2]", "Hessian, error", .hessian = stvk_hessian_with_one_entry_off},
    {"compression pulled in", "strain_limit_lower", "differences give", "gradient, error", .gradient = strain_limit_lower_gradient_of_flipped_sign},
    {"rotation held still", "volume_corotational", "Hessian[", "Hessian, error", .hessian = corotational_hessian_without_turning},
    {"lost pressure", "volume_neo_hookean", "differences give", "gradient, error", .gradient = volume_gradient_without_pressure},
    {"lost square of the limit", "membrane_orthotropic", "", "value, error", .value = orthotropic_value_without_squares},
    {"lost tension of a rod", "rod_stretching", "Hessian[", "Hessian, error", .hessian = rod_stretching_hessian_without_tension},
    {"lost rest curvature", "rod_bending", "curved_rest", "gradient, error", .gradient = rod_bending_gradient_without_rest_curvature},
    {"stitch from the other end", "stitch", "differences give", "gradient, error", .gradient = stitch_gradient_from_the_other_end},
    {"not a number", "inertia", "not finite", "not finite", .hessian = inertia_hessian_not_a_number},
    /* Wrong and consistent: only MPFR knows. */
    {"gravity, all of it off by 1e-9", "gravity", NULL, "value, error", .value = gravity_value_scaled, .gradient = gravity_gradient_scaled},
    {"membrane, all of it off by 1e-9", "membrane_neo_hookean", NULL, "value, error", .value = membrane_value_scaled, .gradient = membrane_gradient_scaled, .hessian = membrane_hessian_scaled},
    {"damping, all of it off by 1e-9", "damping", NULL, "value, error", .value = damping_value_scaled, .gradient = damping_gradient_scaled, .hessian = damping_hessian_scaled},
};
/* clang-format on */

int wrong_energy_count(void) { return sizeof table / sizeof table[0]; }

const wrong_energy *wrong_energy_at(int index) { return &table[index]; }

cipc_energy wrong_energy_entry(const wrong_energy *wrong)
{
    cipc_energy energy = *cipc_energy_find(wrong->energy);
    if (wrong->value != NULL) energy.value = wrong->value;
    if (wrong->gradient != NULL) energy.gradient = wrong->gradient;
    if (wrong->hessian != NULL) energy.hessian = wrong->hessian;
    return energy;
}
