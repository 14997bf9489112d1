/* Sampler of friction: legal contacts (weights sum to zero, orthonormal tangents), on the branch aimed at. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "base/vector.h"
#include "cipc/energy.h"

enum { SAMPLES = 200 };
static const double ROUNDINGS = 32 * DBL_EPSILON; /* some twenty operations on numbers of size one */

static void test_samples_are_legal_contacts_on_their_branch(void **state)
{
    (void)state;
    const cipc_energy *energy = cipc_energy_entry(CIPC_ENERGY_FRICTION);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    for (int branch = 0; branch < energy->branch_count; branch++) {
        int hits = 0;
        for (int k = 0; k < SAMPLES; k++) {
            double x[12];
            cipc_friction p;
            energy->sample(rng, branch, x, &p);
            assert_true(isfinite(energy->value(x, &p)) && p.eps > 0 && p.coefficient > 0);
            assert_true(fabs(p.weights[0] + p.weights[1] + p.weights[2] + p.weights[3]) < ROUNDINGS);
            assert_true(fabs(v3_dot(p.basis, p.basis) - 1) < ROUNDINGS && fabs(v3_dot(p.basis + 3, p.basis + 3) - 1) < ROUNDINGS);
            assert_true(fabs(v3_dot(p.basis, p.basis + 3)) < ROUNDINGS);
            hits += energy->branch(x, &p) == branch;
        }
        /* Rounding moves some of those at the boundary. */
        if (hits < SAMPLES * 9 / 10) fail_msg("branch %s hit %d times of %d", energy->branch_names[branch], hits, SAMPLES);
    }
    gsl_rng_free(rng);
}

static void test_classifier_by_hand(void **state)
{
    (void)state;
    const cipc_energy *energy = cipc_energy_entry(CIPC_ENERGY_FRICTION);
    const double slips[] = {0, 0.5, 1, 2},
                 weights[4][4] = {{1, -1, 0, 0}, {1, -0.5, -0.5, 0}, {1, -0.25, -0.25, -0.5}, {0.5, 0.5, -0.5, -0.5}};
    for (int i = 0; i < 4; i++) {
        for (int kind = 0; kind < 4; kind++) {
            cipc_friction p = {.coefficient = 1, .eps = 1, .basis = {1, 0, 0, 0, 1, 0}};
            const double x[12] = {slips[i] / weights[kind][0]};
            for (int j = 0; j < 4; j++) p.weights[j] = weights[kind][j];
            assert_int_equal(energy->branch(x, &p), 4 * i + kind);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples_are_legal_contacts_on_their_branch),
        cmocka_unit_test(test_classifier_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
