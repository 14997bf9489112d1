/* Reports of campaigns: tables for people, JSON for machines, and the way back for merging. */
#ifndef CIPC_VERIFY_REPORT_H
#define CIPC_VERIFY_REPORT_H

#include "verify/campaign.h"

/* All that a call of `cipc verify` found. */
typedef struct verify_report {
    unsigned long seed;
    long samples;
    int shards;
    unsigned long long shards_done; /* bit k - 1: shard k of at most 64 is in it */
    double seconds;
    int campaign_count;
    struct verify_campaign_rows {
        char name[VERIFY_NAME];
        int row_count;
        verify_row *rows;
    } campaigns[8];
} verify_report;

void verify_report_free(verify_report *report);
/* Room for another campaign's rows; NULL: out of memory. */
verify_row *verify_report_add(verify_report *report, const char *name, int row_count);
/* Are all shards in it, so that minima count? */
bool verify_report_whole(const verify_report *report);
/* Number of rows that fail; the first few reasons go to `stream` (may be NULL), a line each. */
int verify_report_failures(const verify_report *report, FILE *stream);

/* The table. */
void verify_report_print(const verify_report *report, FILE *stream);
/* The JSON, a new reference; NULL: out of memory. versions: stolen. */
json_t *verify_report_json(const verify_report *report, json_t *versions);
/* A line per worst case and per first failure, as queries of the conformance protocol. */
cipc_status verify_report_worst(const verify_report *report, FILE *stream, cipc_error *error);
/* Add a report read from JSON to *into (empty: becomes it). CIPC_E_BAD_QUERY with the reason: another seed, number of samples, version, set of rows, or a shard
 * that is there already. `file` names it in messages. */
cipc_status verify_report_merge(verify_report *into, const json_t *from, const char *file, cipc_error *error);

#endif
