/* Drawing configurations of energies for campaigns. */
#include <stdio.h>
#include <string.h>

#include "verify/energies.h"
#include "verify/query.h"

/* Samples are aimed at the branches in turn; a rounding may put some on a neighbour, but none may lose more than half. */
static const double LEAST_OF_AIMED = 0.5;

void verify_describe_branches(verify_row *row, const cipc_energy *energy)
{
    char name[VERIFY_NAME];
    verify_row_init(row, energy->name);
    for (int b = 0; b < energy->branch_count; b++) {
        snprintf(name, sizeof name, "%s", energy->branch_names[b]);
        verify_row_branch(row, name, LEAST_OF_AIMED / energy->branch_count);
    }
}

void verify_draw_energy(const cipc_energy *energy, gsl_rng *rng, long sample, verify_row *row, double *x, verify_params *params, cipc_query *query)
{
    char name[64];
    memset(params, 0, sizeof *params);
    memset(query, 0, sizeof *query);
    energy->sample(rng, (int)(sample % energy->branch_count), x, params);
    int branch = energy->branch(x, params);
    if (branch >= 0 && branch < energy->branch_count) verify_count(row, branch, sample, NULL);
    snprintf(name, sizeof name, "energy/%s", energy->name);
    query->fn = verify_function_name(name);
    memcpy(query->x, x, (size_t)(3 * energy->nodes) * sizeof *x);
    cipc_energy_numbers(energy, params, query->params);
}
