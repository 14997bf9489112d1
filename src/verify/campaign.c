/* The loop of all campaigns. */
#include "verify/campaign.h"

#include <math.h>
#include <string.h>

/* Seed of one sample: the seed asked for, the campaign's name, row and index, mixed so that neighbours differ in every bit (splitmix64). */
static unsigned long mix(unsigned long h)
{
    h += 0x9e3779b97f4a7c15UL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9UL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebUL;
    return h ^ (h >> 31);
}

static unsigned long sample_seed(const verify_campaign *campaign, unsigned long seed, int row, long sample)
{
    unsigned long h = mix(seed);
    for (const char *c = campaign->name; *c != '\0'; c++) h = mix(h ^ (unsigned char)*c);
    return mix(mix(h ^ (unsigned long)row) ^ (unsigned long)sample);
}

/* Part of the samples [begin, end) on one thread, into its own row. */
static void run_part(const verify_campaign *campaign, int index, const verify_run *run, long begin, long end, gsl_rng *rng, verify_row *row)
{
    for (long i = begin; i < end; i++) {
        if (i % run->shards != run->shard - 1) continue;
        gsl_rng_set(rng, sample_seed(campaign, run->seed, index, i));
        row->samples++;
        campaign->sample(index, rng, i, row, campaign->context);
    }
}

enum { PARTS = 64 };

cipc_status verify_run_row(const verify_campaign *campaign, int index, const verify_run *run, verify_row *row, cipc_error *error)
{
    campaign->describe(index, row);
    long samples = (long)fmax(1, ceil(campaign->weight * (double)run->samples));
    bool failed = false, stopped = false;
    int done = 0;
#pragma omp parallel num_threads(run->threads)
    {
        verify_row *mine = cipc_alloc(1, sizeof *mine);
        gsl_rng *rng = gsl_rng_alloc(gsl_rng_taus2); /* cheap to seed */
#pragma omp for schedule(dynamic, 1)
        for (int part = 0; part < PARTS; part++) {
            bool skip = false;
#pragma omp critical
            {
                failed = failed || mine == NULL || rng == NULL;
                skip = failed || stopped;
            }
            if (skip) continue;
            campaign->describe(index, mine);
            run_part(campaign, index, run, samples * part / PARTS, samples * (part + 1) / PARTS, rng, mine);
#pragma omp critical
            {
                verify_row_merge(row, mine); /* sums and maxima with ties by sample: the order does not matter */
                done++;
                if (run->progress != NULL && !stopped) stopped = run->progress(run->progress_context, campaign->name, row->name, (double)done / PARTS);
            }
        }
        if (rng != NULL) gsl_rng_free(rng);
        cipc_free(mine);
    }
    if (failed) return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, campaign->name, "no memory for a row of results");
    return stopped ? cipc_fail(error, CIPC_E_NO_PROGRESS, campaign->name, "interrupted by a signal") : CIPC_OK;
}
