/* Campaigns: many samples of a function against the oracle, the same ones whatever the number of threads and shards. */
#ifndef CIPC_VERIFY_CAMPAIGN_H
#define CIPC_VERIFY_CAMPAIGN_H

#include <gsl/gsl_rng.h>
#include "verify/row.h"

/* What a campaign is: rows, each with a sampler that draws one sample, judges it, and notes the result in a row. `context` is what the rows are held against:
 * the functions under test, so that a test can plant a wrong one. */
typedef struct verify_campaign {
    const char *name;
    int row_count;
    void (*describe)(int index, verify_row *row);
    void (*sample)(int index, gsl_rng *rng, long sample, verify_row *row, const void *context);
    const void *context;
    double weight; /* samples per row, of what is asked for */
} verify_campaign;

extern const verify_campaign verify_distance, verify_toi, verify_intersection, verify_energies, verify_derivatives;

/* Run one row's samples index = shard - 1, shard - 1 + shards, ... below `samples`. progress (may be NULL) is called now and then from one thread; true stops. */
typedef struct verify_run {
    unsigned long seed;
    long samples; /* as asked for; a row runs weight * samples, at least 1 */
    int shard, shards, threads;
    bool (*progress)(void *context, const char *campaign, const char *row, double share);
    void *progress_context;
} verify_run;
/* CIPC_E_OUT_OF_MEMORY; CIPC_E_NO_PROGRESS when stopped. */
cipc_status verify_run_row(const verify_campaign *campaign, int index, const verify_run *run, verify_row *row, cipc_error *error);

#endif
