/* Every energy of the registry on every branch: gradient and Hessian against differences, symmetry, invariances (SPEC V.6);
 * and first the proof that the checker rejects wrong energies (SPEC V.7). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "cipc/energy.h"
#include "support/wrong_energies.h"
#include "verify/derivative_check.h"

/* Forty configurations aimed at each branch; a rounding may put one on the neighbouring branch, but no branch may lose half of them. */
enum { SAMPLES = 40, MINIMUM = 20 };
static const unsigned long SEED = 20201117;

static void assert_rejected(const cipc_energy *wrong, const char *reason)
{
    verify_derivative_report report;
    assert_false(verify_derivatives_of(wrong, SEED, SAMPLES, MINIMUM, &report));
    if (strstr(report.failure, reason) == NULL) fail_msg("rejected for another reason: %s", report.failure);
}

/* Every planted fault that differences can see; what is wrong and consistent they must let pass, so that a test of the other kind is known to be needed. */
static void test_wrong_energies_are_rejected(void **state)
{
    (void)state;
    for (int i = 0; i < wrong_energy_count(); i++) {
        const wrong_energy *wrong = wrong_energy_at(i);
        cipc_energy energy = wrong_energy_entry(wrong);
        verify_derivative_report report;
        bool good = verify_derivatives_of(&energy, SEED, SAMPLES, MINIMUM, &report);
        if (good != (wrong->differences == NULL)) fail_msg("%s: %s", wrong->what, good ? "accepted" : report.failure);
        if (!good && strstr(report.failure, wrong->differences) == NULL) fail_msg("%s: rejected for another reason: %s", wrong->what, report.failure);
    }
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
        cmocka_unit_test(test_wrong_energies_are_rejected),
        cmocka_unit_test(test_false_claims_of_invariance_are_rejected),
        cmocka_unit_test(test_missed_branch_is_rejected),
        cmocka_unit_test(test_every_energy_of_the_registry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
