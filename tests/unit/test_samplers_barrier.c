/* Samplers of the contact barriers: legal, on the branch aimed at, and truly on the closest features they name. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/energy.h"

enum { SAMPLES = 200, MAX_N = 12 };

static gsl_rng *generator(void)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    return rng;
}

/* Every draw is feasible, and at least nine in ten land where they are aimed (rounding moves some at the edges of the narrow branches). */
static void check_sampler(const cipc_energy *energy)
{
    gsl_rng *rng = generator();
    for (int branch = 0; branch < energy->branch_count; branch++) {
        int hits = 0;
        for (int k = 0; k < SAMPLES; k++) {
            double x[MAX_N];
            cipc_contact_barrier params;
            energy->sample(rng, branch, x, &params);
            assert_true(isfinite(energy->value(x, &params)));
            hits += energy->branch(x, &params) == branch;
        }
        if (hits < SAMPLES * 9 / 10)
            fail_msg("%s: branch %s hit %d times of %d", energy->name, energy->branch_names[branch], hits, SAMPLES);
    }
    gsl_rng_free(rng);
}

static void test_samplers_hit_their_branches(void **state)
{
    (void)state;
    for (int i = CIPC_ENERGY_BARRIER_POINT_POINT; i <= CIPC_ENERGY_BARRIER_EDGE_EDGE; i++)
        check_sampler(cipc_energy_entry((cipc_energy_id)i));
}

/* The distance of the features a sample names is the true distance of its primitives: what the solver would have classified. */
static void test_samples_name_the_closest_features(void **state)
{
    (void)state;
    /* Squared distances of a gap of 1e-6 of the stencil lose twelve digits to the rounding of coordinates. */
    static const double DISTANCE_ERROR = 1e-3;
    gsl_rng *rng = generator();
    for (int i = CIPC_ENERGY_BARRIER_POINT_EDGE; i <= CIPC_ENERGY_BARRIER_EDGE_EDGE; i++) {
        const cipc_energy *energy = cipc_energy_entry((cipc_energy_id)i);
        for (int k = 0; k < SAMPLES * energy->branch_count; k++) {
            double x[MAX_N] = {0}, part[MAX_N] = {0}, named, shortest;
            cipc_contact_barrier params;
            energy->sample(rng, k % energy->branch_count, x, &params);
            if (i == CIPC_ENERGY_BARRIER_POINT_EDGE) {
                named = cipc_point_line_distance2_value(x);
                shortest = cipc_point_edge_distance2(x);
            } else if (i == CIPC_ENERGY_BARRIER_POINT_TRIANGLE) {
                named = cipc_point_plane_distance2_value(x);
                shortest = cipc_point_triangle_distance2(x);
            } else {
                for (int j = 0; j < 3 * params.feature.count; j++) part[j] = x[3 * params.feature.local[j / 3] + j % 3];
                named = cipc_distance2_value(params.feature.kind, part);
                shortest = cipc_edge_edge_distance2(x);
            }
            if (!(fabs(named - shortest) <= DISTANCE_ERROR * shortest))
                fail_msg("%s, branch %s: %.17g is not %.17g", energy->name, energy->branch_names[k % energy->branch_count], named,
                         shortest);
        }
    }
    gsl_rng_free(rng);
}

static void test_classifier_by_hand(void **state)
{
    (void)state;
    const cipc_energy *energy = cipc_energy_entry(CIPC_ENERGY_BARRIER_POINT_POINT);
    const double distances[] = {3, 1.9999, 1.5, 1.000001};
    const char *const thick[] = {"inactive", "onset", "thick", "thick_tiny_gap"};
    const cipc_contact_barrier with = {.stiffness = 1, .weight = 1, .offset = 1, .dhat = 1},
                               without = {.stiffness = 1, .weight = 1, .dhat = 1};
    for (int i = 0; i < 4; i++) {
        const double x[6] = {distances[i]};
        assert_string_equal(energy->branch_names[energy->branch(x, &with)], thick[i]);
    }
    const double near[6] = {1e-5}, middle[6] = {0.5};
    assert_string_equal(energy->branch_names[energy->branch(near, &without)], "thin_tiny_gap");
    assert_string_equal(energy->branch_names[energy->branch(middle, &without)], "thin");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samplers_hit_their_branches),
        cmocka_unit_test(test_samples_name_the_closest_features),
        cmocka_unit_test(test_classifier_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
