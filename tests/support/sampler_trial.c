#include "support/sampler_trial.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>

#include "cipc/energy.h"

enum { SAMPLES = 200, MAX_N = 12, MAX_PARAMS = 1024 };

void sampler_check(const char *name)
{
    const cipc_energy *energy = cipc_energy_find(name);
    union {
        double align;
        unsigned char bytes[MAX_PARAMS];
    } params;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    assert_non_null(rng);
    assert_true(energy->params_size <= sizeof params);
    for (int branch = 0; branch < energy->branch_count; branch++) {
        int hits = 0;
        for (int k = 0; k < SAMPLES; k++) {
            double x[MAX_N];
            energy->sample(rng, branch, x, &params);
            if (!isfinite(energy->value(x, &params))) fail_msg("%s: branch %s: infeasible", name, energy->branch_names[branch]);
            hits += energy->branch(x, &params) == branch;
        }
        if (hits < SAMPLES * 9 / 10) fail_msg("%s: branch %s hit %d times of %d", name, energy->branch_names[branch], hits, SAMPLES);
    }
    gsl_rng_free(rng);
}

void sampler_assert_branch(const char *name, const double *x, const void *params, const char *branch)
{
    const cipc_energy *energy = cipc_energy_find(name);
    assert_string_equal(energy->branch_names[energy->branch(x, params)], branch);
}
