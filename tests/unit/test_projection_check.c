/* The judge of projections: known ones to the letter, the solver's on Hessians, and wrong ones that it must reject. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "cipc/energy.h"
#include "implicit/psd_projection.h"
#include "verify/projection_check.h"

static void test_known_projections(void **state)
{
    (void)state;
    const double H[4] = {3, 0, 0, -2}, P[4] = {3, 0, 0, 0}, none[4] = {0}, negative[4] = {-1, 0, 0, -4}, swap[4] = {0, 2, 2, 0}, half[4] = {1, 1, 1, 1};
    assert_true(verify_projection_error(2, H, P) <= 1);
    assert_true(verify_projection_error(2, P, P) <= 1); /* positive semi-definite: itself */
    assert_true(verify_projection_error(2, negative, none) <= 1);
    assert_true(verify_projection_error(2, none, none) <= 1);
    assert_true(verify_projection_error(2, swap, half) <= 1); /* eigenvalues 2 and -2 */
    assert_true(verify_projection_error(2, H, H) > 1e10);
    assert_true(verify_projection_error(2, H, none) > 1e10);
    assert_true(verify_projection_error(2, none, P) == INFINITY);
}

static void test_not_finite_or_not_symmetric(void **state)
{
    (void)state;
    const double H[4] = {3, 0, 0, -2}, broken[4] = {3, NAN, NAN, 0}, infinite[4] = {INFINITY, 0, 0, 0}, skew[4] = {3, 1e-9, 0, 0};
    assert_true(verify_projection_error(2, H, broken) == INFINITY);
    assert_true(verify_projection_error(2, infinite, H) == INFINITY);
    assert_true(verify_projection_error(2, H, skew) > 1e3);
}

static bool right(int nodes, double *H) { return cipc_psd_project(nodes, H, true); }
static bool as_it_is(int nodes, double *H)
{
    (void)nodes, (void)H;
    return true;
}
static bool all_gone(int nodes, double *H)
{
    memset(H, 0, (size_t)(9 * nodes * nodes) * sizeof *H);
    return true;
}
/* Positive semi-definite, and further away than need be. */
static bool lifted(int nodes, double *H)
{
    bool good = cipc_psd_project(nodes, H, true);
    for (int i = 0; i < 3 * nodes; i++) H[i * 3 * nodes + i] *= 1 + 1e-6;
    return good;
}
/* The positive eigenvalues dropped instead of the negative ones: P = -(projection of -H). */
static bool wrong_side(int nodes, double *H)
{
    double all[144];
    memcpy(all, H, (size_t)(9 * nodes * nodes) * sizeof *H);
    bool good = cipc_psd_project(nodes, H, true);
    for (int i = 0; i < 9 * nodes * nodes; i++) H[i] = all[i] - H[i];
    return good;
}

/* Largest error over tolerance on the Hessians of edges, most of which have eigenvalues on both sides. */
static double worst(bool (*project)(int nodes, double *H))
{
    const cipc_energy *energy = cipc_energy_find("barrier_edge_edge");
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    double most = 0;
    assert_non_null(rng);
    for (int k = 0; k < 5 * energy->branch_count; k++) {
        cipc_contact_barrier params;
        double x[12], H[144], P[144];
        energy->sample(rng, k % energy->branch_count, x, &params);
        energy->hessian(x, &params, H);
        memcpy(P, H, sizeof P);
        assert_true(project(4, P));
        most = fmax(most, verify_projection_error(12, H, P));
    }
    gsl_rng_free(rng);
    return most;
}

static void test_the_solver_passes_and_wrong_ones_do_not(void **state)
{
    (void)state;
    double most = worst(right);
    print_message("error over tolerance %.3g\n", most);
    assert_true(most <= 1);
    assert_true(worst(as_it_is) > 1);
    assert_true(worst(all_gone) > 1);
    assert_true(worst(lifted) > 1);
    assert_true(worst(wrong_side) > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_projections),
        cmocka_unit_test(test_not_finite_or_not_symmetric),
        cmocka_unit_test(test_the_solver_passes_and_wrong_ones_do_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
