/* Monitor M5: along the straight path between two accepted points no pair comes to its thickness or below (SPEC V.5; docs/monitors.md, "The swept check").
 * A direction along which both ends are certified to be further apart than xi clears the whole path. What no direction tried clears is decided by the exact time
 * of impact. */
#include "cipc/invariant.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/oracle.h"
#include "invariant/monitor.h"
#include "invariant/moving_pair.h"

static void check_pair(cipc_moving_result *r, cipc_moving_pair *p, const double *from, const double *to)
{
    double here[12], there[12], n[3] = {0, 0, 0};
    int count = cipc_pair_nodes(p->kind);
    cipc_gather(here, from, p->nodes, count);
    cipc_gather(there, to, p->nodes, count);
    r->checked++;
    if (cipc_moving_pair_clear(p->kind, here, there, p->offset, n)) { return; }
    cipc_stencil_path path = {.kind = p->kind, .to_end = true};
    memcpy(path.x, here, 3 * (size_t)count * sizeof *here);
    memcpy(path.p, there, 3 * (size_t)count * sizeof *there);
    r->exact++;
    cipc_verdict clear = cipc_exact_path_clear(&path, p->offset, 1);
    if (clear == CIPC_YES) { return; }
    p->time = cipc_exact_toi(&path, p->offset, 1).lo;
    p->violated = clear == CIPC_NO;
    cipc_moving_result_keep(r, p);
}

static cipc_moving_result check_part(const cipc_model *m, const invariant_candidate_part *part, const double *from, const double *to)
{
    cipc_moving_result r = {0};
    cipc_moving_pair p = {.kind = (cipc_pair_kind)part->kind};
    for (int i = 0; i < part->count; i++) {
        p.offset = invariant_candidates_nodes(m, p.kind, part->pairs[i], p.nodes);
        check_pair(&r, &p, from, to);
    }
    return r;
}

static cipc_status fail_swept(const cipc_model *m, const cipc_moving_result *r, cipc_error *error)
{
    const cipc_moving_pair *p = &r->first;
    cipc_status status = p->violated ? CIPC_E_VIOLATED_SWEPT : CIPC_E_INDETERMINATE;
    char text[192], pair[CIPC_MONITOR_PAIR_SIZE];
    cipc_monitor_name_pair(pair, m, p->kind, p->nodes);
    snprintf(text, sizeof text, "on the way the distance falls to the offset %.17g (%a) at %.17g (%a) of the path", p->offset, p->offset, p->time, p->time);
    if (!p->violated) { snprintf(text, sizeof text, "exact arithmetic could not decide whether the distance falls to the offset %.17g (%a)", p->offset, p->offset); }
    return cipc_fail(error, status, "monitor swept", "%s: %s", pair, text);
}

/* The lists of the resting monitors serve for the whole path if they serve for both ends: a node that is within half their margin of where they were made at
 * both ends is so all the way between. */
static cipc_status find_pairs(cipc_monitor *monitor, const double *from, const double *to, const invariant_candidates **pairs, cipc_error *error)
{
    *pairs = &monitor->candidates;
    if (invariant_candidates_valid(*pairs, from) && invariant_candidates_valid(*pairs, to)) { return CIPC_OK; }
    *pairs = &monitor->paths;
    if (invariant_candidates_sweep(&monitor->paths, from, to)) { return CIPC_OK; }
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor swept", "no memory for the lists of candidate pairs");
}

cipc_status cipc_monitor_swept(cipc_monitor *monitor, const double *from, const double *to, cipc_invariant_report *report, cipc_error *error)
{
    const invariant_candidates *c = NULL;
    cipc_status status = cipc_monitor_finite(monitor->model, from, error);
    if (status == CIPC_OK) { status = cipc_monitor_finite(monitor->model, to, error); }
    if (status == CIPC_OK) { status = find_pairs(monitor, from, to, &c, error); }
    if (status != CIPC_OK) { return status; }
    cipc_moving_result *results = cipc_alloc((size_t)c->part_count, sizeof *results);
    if (results == NULL) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor swept", "no memory for the results of %d parts", c->part_count); }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < c->part_count; i++) {
        if (c->parts[i].kind != CIPC_CANDIDATE_EDGE_TRIANGLE) { results[i] = check_part(monitor->model, &c->parts[i], from, to); }
    }
    cipc_moving_result all = cipc_moving_result_merge(results, c->part_count);
    cipc_free(results);
    if (report != NULL) {
        report->paths_checked = all.checked;
        report->exact_path_checks = all.exact;
    }
    return all.any ? fail_swept(monitor->model, &all, error) : CIPC_OK;
}
