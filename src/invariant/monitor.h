/* What the monitors share: the private parts of a cipc_monitor, and how a pair is named in a message. */
#ifndef CIPC_INVARIANT_MONITOR_H
#define CIPC_INVARIANT_MONITOR_H

#include "cipc/invariant.h"
#include "invariant/candidates.h"
#include "invariant/strain_limits.h"

struct cipc_monitor {
    const cipc_model *model;
    cipc_invariant_options options;
    invariant_candidates candidates;
    invariant_candidates paths; /* of M5, when nodes move too far for the lists above */
    cipc_strain_rest *rest; /* triangle_count */
};

/* M8, then valid lists for x; *report gets lists_made. */
cipc_status cipc_monitor_prepare(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error);

/* Sections of a loop with a result slot each: fixed size, so that results do not depend on the number of threads. */
enum { CIPC_MONITOR_SECTION = 1024 };
int cipc_monitor_sections(int count);

/* Name of the body a node belongs to. */
const char *cipc_monitor_body(const cipc_model *model, int node);

/* A pair in words: "node 3 (body "dust") and edge (nodes 4 5, body "rope")". */
enum { CIPC_MONITOR_PAIR_SIZE = 2 * CIPC_NAME_SIZE + 128 };
void cipc_monitor_name_pair(char text[CIPC_MONITOR_PAIR_SIZE], const cipc_model *model, cipc_pair_kind kind, const int nodes[4]);

#endif
