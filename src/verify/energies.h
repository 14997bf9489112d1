/* What the campaigns "energies" and "derivatives" share: drawing a configuration of an energy, and its query. */
#ifndef CIPC_VERIFY_ENERGIES_H
#define CIPC_VERIFY_ENERGIES_H

#include "verify/campaign.h"

/* The context of both campaigns: entry(index) is the energy under test; a test can put a wrong one in. */
typedef struct verify_energy_subject {
    const cipc_energy *(*entry)(cipc_energy_id id);
} verify_energy_subject;

enum { VERIFY_PARAMS_SIZE = 1024, VERIFY_COORDINATES = 12 };
typedef union verify_params {
    double align;
    unsigned char bytes[VERIFY_PARAMS_SIZE];
} verify_params;

/* Counters of a row for each branch of the energy, in order, from counter 0. */
void verify_describe_branches(verify_row *row, const cipc_energy *energy);
/* Draw the configuration of sample number `sample`, aimed at branch sample % branch_count, count the branch that it is on, and fill the query. */
void verify_draw_energy(const cipc_energy *energy, gsl_rng *rng, long sample, verify_row *row, double *x, verify_params *params, cipc_query *query);

#endif
