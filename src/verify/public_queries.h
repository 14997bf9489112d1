/* The public collision queries as a campaign of their own. */
#ifndef CIPC_VERIFY_PUBLIC_QUERIES_H
#define CIPC_VERIFY_PUBLIC_QUERIES_H

#include "verify/report.h"

/* Judge every query of the directory (query_files.h) that is of the shard: one row without thickness, which also compares the oracle with the truth column, and
 * one with a thickness of 1e-3 of the stencil's size. */
cipc_status verify_public_campaign(const char *directory, int shard, int shards, verify_report *report, cipc_error *error);

#endif
