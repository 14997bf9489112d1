/* Monitor M5: along the straight path between two accepted points no pair comes to its thickness or below (SPEC V.5; docs/monitors.md, "The swept check").
 *
 * The separation of two primitives along a fixed direction is a concave function of time when their nodes move on straight lines. So a direction along which it
 * exceeds xi at both ends, certified, clears the whole path. What no direction tried clears is decided by the exact time of impact. */
#include "cipc/invariant.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/oracle.h"
#include "invariant/monitor.h"
#include "invariant/separation.h"

typedef struct moving_pair {
    cipc_pair_kind kind;
    int nodes[4];  /* unused: -1 */
    double offset; /* xi */
    bool violated; /* else undecided */
    cipc_exact_impact impact;
} moving_pair;

/* What one part of the lists gave; of the pairs not cleared the one with the least nodes, so that the answer does not depend on the order of the lists, and
 * not on what else a list holds. */
typedef struct swept_result {
    long checked, exact;
    bool any;
    moving_pair first;
} swept_result;

/* A direction that clears one end, tried at the other. The first one found that clears, then the best one. */
static bool cleared_from(const moving_pair *p, const double here[12], const double there[12])
{
    cipc_separation s = cipc_separate(p->kind, here, p->offset);
    if (!(s.lower > p->offset)) { return false; }
    if (cipc_separation_along(p->kind, there, s.n) > p->offset) { return true; }
    s = cipc_separate(p->kind, here, INFINITY);
    return s.lower > p->offset && cipc_separation_along(p->kind, there, s.n) > p->offset;
}

/* A violation before what could not be decided. */
static bool is_before(const moving_pair *a, const moving_pair *b)
{
    if (a->violated != b->violated) { return a->violated; }
    if (a->kind != b->kind) { return a->kind < b->kind; }
    for (int i = 0; i < 4; i++) {
        if (a->nodes[i] != b->nodes[i]) { return a->nodes[i] < b->nodes[i]; }
    }
    return false;
}

static void keep_first(swept_result *r, const moving_pair *p)
{
    if (!r->any || is_before(p, &r->first)) { r->first = *p; }
    r->any = true;
}

static void check_pair(swept_result *r, moving_pair *p, const double *from, const double *to)
{
    double here[12], there[12];
    int count = cipc_pair_nodes(p->kind);
    cipc_gather(here, from, p->nodes, count);
    cipc_gather(there, to, p->nodes, count);
    r->checked++;
    if (cleared_from(p, here, there) || cleared_from(p, there, here)) { return; }
    cipc_stencil_path path = {.kind = p->kind, .to_end = true};
    memcpy(path.x, here, 3 * (size_t)count * sizeof *here);
    memcpy(path.p, there, 3 * (size_t)count * sizeof *there);
    r->exact++;
    cipc_verdict clear = cipc_exact_path_clear(&path, p->offset, 1);
    if (clear == CIPC_YES) { return; }
    p->impact = cipc_exact_toi(&path, p->offset, 1);
    p->violated = clear == CIPC_NO;
    keep_first(r, p);
}

static swept_result check_part(const cipc_model *m, const invariant_candidate_part *part, const double *from, const double *to)
{
    swept_result r = {0};
    moving_pair p = {.kind = (cipc_pair_kind)part->kind};
    for (int i = 0; i < part->count; i++) {
        p.offset = invariant_candidates_nodes(m, p.kind, part->pairs[i], p.nodes);
        check_pair(&r, &p, from, to);
    }
    return r;
}

static cipc_status fail_swept(const cipc_model *m, const swept_result *r, cipc_error *error)
{
    const moving_pair *p = &r->first;
    cipc_status status = p->violated ? CIPC_E_VIOLATED_SWEPT : CIPC_E_INDETERMINATE;
    char text[192], pair[CIPC_MONITOR_PAIR_SIZE];
    cipc_monitor_name_pair(pair, m, p->kind, p->nodes);
    snprintf(text, sizeof text, "on the way the distance falls to the offset %.17g (%a) at %.17g (%a) of the path", p->offset, p->offset, p->impact.lo, p->impact.lo);
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

static swept_result merge(const swept_result *results, int count)
{
    swept_result all = {0};
    for (int i = 0; i < count; i++) {
        if (results[i].any) { keep_first(&all, &results[i].first); }
        all.checked += results[i].checked;
        all.exact += results[i].exact;
    }
    return all;
}

cipc_status cipc_monitor_swept(cipc_monitor *monitor, const double *from, const double *to, cipc_invariant_report *report, cipc_error *error)
{
    const invariant_candidates *c = NULL;
    cipc_status status = cipc_monitor_finite(monitor->model, from, error);
    if (status == CIPC_OK) { status = cipc_monitor_finite(monitor->model, to, error); }
    if (status == CIPC_OK) { status = find_pairs(monitor, from, to, &c, error); }
    if (status != CIPC_OK) { return status; }
    swept_result *results = cipc_alloc((size_t)c->part_count, sizeof *results);
    if (results == NULL) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor swept", "no memory for the results of %d parts", c->part_count); }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < c->part_count; i++) {
        if (c->parts[i].kind != CIPC_CANDIDATE_EDGE_TRIANGLE) { results[i] = check_part(monitor->model, &c->parts[i], from, to); }
    }
    swept_result all = merge(results, c->part_count);
    cipc_free(results);
    if (report != NULL) {
        report->paths_checked = all.checked;
        report->exact_path_checks = all.exact;
    }
    return all.any ? fail_swept(monitor->model, &all, error) : CIPC_OK;
}
