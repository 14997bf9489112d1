/* Every energy of the registry on every branch: gradient and Hessian against differences, symmetry, invariances (SPEC V.6);
 * and first the proof that the checker rejects wrong energies (SPEC V.7). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/energy.h"
#include "verify/derivative_check.h"

/* Forty configurations aimed at each branch; a rounding may put one on the neighbouring branch, but no branch may lose half of them. */
enum { SAMPLES = 40, MINIMUM = 20 };
static const unsigned long SEED = 20201117;

/* --- wrong energies: each is a registry entry with one function replaced --- */

static void assert_rejected(const cipc_energy *wrong, const char *reason)
{
    verify_derivative_report report;
    assert_false(verify_derivatives_of(wrong, SEED, SAMPLES, MINIMUM, &report));
    if (strstr(report.failure, reason) == NULL) fail_msg("rejected for another reason: %s", report.failure);
}

static void membrane_gradient_of_flipped_sign(const double *x, const void *params, double *g)
{
    cipc_membrane_neo_hookean_gradient(x, params, g);
    for (int i = 0; i < 9; i++) g[i] = -g[i];
}

static void test_flipped_sign_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("membrane_neo_hookean");
    wrong.gradient = membrane_gradient_of_flipped_sign;
    assert_rejected(&wrong, "differences give");
}

/* The factor 2 of d(d^2) = 2 d dd lost. */
static void point_point_gradient_without_two(const double *x, const void *params, double *g)
{
    cipc_barrier_point_point_gradient(x, params, g);
    for (int i = 0; i < 6; i++) g[i] *= 0.5;
}

static void test_factor_two_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("barrier_point_point");
    wrong.gradient = point_point_gradient_without_two;
    assert_rejected(&wrong, "gradient[");
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

static void test_lost_hessian_bracket_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("barrier_point_edge");
    wrong.hessian = point_edge_hessian_without_bracket;
    assert_rejected(&wrong, "Hessian[");
}

/* The gradient of the barrier alone, without the mollifier and its product rule. */
static void edge_edge_gradient_without_product_rule(const double *x, const void *params, double *g)
{
    cipc_contact_barrier plain = *(const cipc_contact_barrier *)params;
    plain.mollifier_eps = 0;
    cipc_barrier_edge_edge_gradient(x, &plain, g);
}

static void test_lost_mollifier_product_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("barrier_edge_edge");
    wrong.gradient = edge_edge_gradient_without_product_rule;
    assert_rejected(&wrong, "mollified");
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

static void test_transposed_friction_basis_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("friction");
    wrong.gradient = friction_gradient_with_transposed_basis;
    assert_rejected(&wrong, "differences give");
}

/* d(theta)/dv = -n/|n|^2 without the length of the edge. */
static void hinge_gradient_without_length(const double *x, const void *params, double *g)
{
    double edge[3];
    v3_sub(edge, x + 3, x);
    cipc_hinge_bending_gradient(x, params, g);
    for (int i = 0; i < 12; i++) g[i] /= v3_norm(edge);
}

static void test_lost_edge_length_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("hinge_bending");
    wrong.gradient = hinge_gradient_without_length;
    assert_rejected(&wrong, "differences give");
}

/* theta instead of theta - thetabar: right on the flat rest shapes, wrong on the curved ones only. */
static void hinge_gradient_without_rest_angle(const double *x, const void *params, double *g)
{
    cipc_hinge_bending wrong = *(const cipc_hinge_bending *)params;
    wrong.rest_angle = 0;
    cipc_hinge_bending_gradient(x, &wrong, g);
}

static void test_lost_rest_angle_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("hinge_bending");
    wrong.gradient = hinge_gradient_without_rest_angle;
    assert_rejected(&wrong, "curved_rest");
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

static void test_misprinted_strain_limit_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("strain_limit");
    wrong.value = strain_limit_value_as_misprinted;
    assert_rejected(&wrong, "not finite");
}

/* Off by one part in 1e7 in a single entry of the Hessian and its mirror image. */
static void stvk_hessian_with_one_entry_off(const double *x, const void *params, double *H)
{
    double most = 0;
    cipc_membrane_stvk_hessian(x, params, H);
    for (int i = 0; i < 81; i++) most = fmax(most, fabs(H[i]));
    H[9 * 7 + 2] += 1e-7 * most;
    H[9 * 2 + 7] += 1e-7 * most;
}

static void test_one_entry_off_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("membrane_stvk");
    wrong.hessian = stvk_hessian_with_one_entry_off;
    assert_rejected(&wrong, "Hessian[7][2]");
}

static void test_false_claims_of_invariance_are_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("gravity");
    wrong.invariances = CIPC_INVARIANT_TRANSLATION;
    assert_rejected(&wrong, "net force");
    wrong = *cipc_energy_find("friction");
    wrong.invariances = CIPC_INVARIANT_ROTATION;
    assert_rejected(&wrong, "rotation");
}

static void sample_one_branch_only(gsl_rng *rng, int branch, double *x, void *params)
{
    (void)branch;
    cipc_energy_find("membrane_stvk")->sample(rng, 1, x, params);
}

static void test_missed_branch_is_rejected(void **state)
{
    (void)state;
    cipc_energy wrong = *cipc_energy_find("membrane_stvk");
    wrong.sample = sample_one_branch_only;
    assert_rejected(&wrong, "branch rest reached 0 times");
}

/* --- the right ones --- */

static void check_one(const cipc_energy *energy)
{
    verify_derivative_report report;
    bool good = verify_derivatives_of(energy, SEED, SAMPLES, MINIMUM, &report);
    print_message("%-24s gradient %.1e (tolerance up to %.1e), Hessian %.1e (up to %.1e), %ld samples\n", energy->name,
                  report.gradient_error, report.gradient_tolerance, report.hessian_error, report.hessian_tolerance, report.samples);
    if (!good) fail_msg("%s (seed %lu)", report.failure, SEED);
}

static void test_every_energy_of_the_registry(void **state)
{
    (void)state;
    for (int i = 0; i < CIPC_ENERGY_COUNT; i++) check_one(cipc_energy_entry((cipc_energy_id)i));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flipped_sign_is_rejected),
        cmocka_unit_test(test_factor_two_is_rejected),
        cmocka_unit_test(test_lost_hessian_bracket_is_rejected),
        cmocka_unit_test(test_lost_mollifier_product_is_rejected),
        cmocka_unit_test(test_transposed_friction_basis_is_rejected),
        cmocka_unit_test(test_lost_edge_length_is_rejected),
        cmocka_unit_test(test_lost_rest_angle_is_rejected),
        cmocka_unit_test(test_misprinted_strain_limit_is_rejected),
        cmocka_unit_test(test_one_entry_off_is_rejected),
        cmocka_unit_test(test_false_claims_of_invariance_are_rejected),
        cmocka_unit_test(test_missed_branch_is_rejected),
        cmocka_unit_test(test_every_energy_of_the_registry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
