/* Monitor M2: d > xi for every pair of primitives that meet (SPEC V.5; include/cipc/invariant.h says which). A pair is cleared by a
 * certified separation (separation.c) or else decided by the exact comparison of d^2 with xi^2. The least gap is the exact one: the pairs
 * that the filter cannot tell from it are measured again exactly. */
#include "cipc/invariant.h"

#include <math.h>
#include "cipc/oracle.h"
#include "invariant/monitor.h"
#include "invariant/separation.h"

/* A measured pair; of two nodes or two edges the one of lower index first. */
typedef struct measured_pair {
    double gap;    /* at most d - xi rounded to nearest; if exact, that itself */
    double offset; /* xi */
    cipc_pair_kind kind;
    int nodes[4]; /* unused: -1 */
    bool exact;  /* the filter had to hand over */
    bool beyond; /* proven to be out of reach; then gap is a lower bound only */
    bool violated;
} measured_pair;

/* What one part of the lists gave. */
typedef struct gap_result {
    long checked, exact;
    bool any, any_violated;
    measured_pair least, violated; /* of all pairs within reach; of the violating ones */
} gap_result;

/* A fixed total order, so that the answer depends neither on the order of the lists nor on threads. */
static bool is_less(const measured_pair *a, const measured_pair *b)
{
    if (a->gap != b->gap) { return a->gap < b->gap; }
    if (a->kind != b->kind) { return a->kind < b->kind; }
    for (int i = 0; i < 4; i++) {
        if (a->nodes[i] != b->nodes[i]) { return a->nodes[i] < b->nodes[i]; }
    }
    return false;
}

static void keep_least(gap_result *r, const measured_pair *p)
{
    if (!r->any || is_less(p, &r->least)) {
        r->least = *p;
        r->any = true;
    }
    if (p->violated && (!r->any_violated || is_less(p, &r->violated))) {
        r->violated = *p;
        r->any_violated = true;
    }
}

/* p->gap for a pair with its nodes and offset; decided exactly where the filter cannot tell. */
static void measure(measured_pair *p, const double *x, double reach)
{
    double stencil[12];
    cipc_gather(stencil, x, p->nodes, cipc_pair_nodes(p->kind));
    double enough = p->offset + reach;
    cipc_separation s = cipc_separate(p->kind, stencil, enough);
    p->beyond = s.lower > enough;
    p->exact = !(s.lower > p->offset) || (!s.tight && !p->beyond);
    p->violated = false;
    p->gap = s.lower - p->offset;
    if (p->exact) {
        p->violated = cipc_exact_distance_sign(p->kind, stencil, p->offset) <= 0;
        p->gap = cipc_exact_distance_gap(p->kind, stencil, p->offset);
    }
}

/* Is the pair one of those whose least gap is reported? */
static bool counts(const measured_pair *p, double reach)
{
    return (p->gap <= reach && !p->beyond) || p->violated;
}

static gap_result check_part(const cipc_model *m, const invariant_candidate_part *part, double reach, const double *x)
{
    gap_result r = {0};
    measured_pair p = {.kind = (cipc_pair_kind)part->kind};
    for (int i = 0; i < part->count; i++) {
        p.offset = invariant_candidates_nodes(m, p.kind, part->pairs[i], p.nodes);
        measure(&p, x, reach);
        r.exact += p.exact ? 1 : 0;
        if (counts(&p, reach)) {
            r.checked++;
            keep_least(&r, &p);
        }
    }
    return r;
}

static cipc_status fail_gap(const cipc_model *m, const double *x, const measured_pair *p, cipc_error *error)
{
    double stencil[12], distance2;
    char pair[CIPC_MONITOR_PAIR_SIZE];
    cipc_gather(stencil, x, p->nodes, cipc_pair_nodes(p->kind));
    cipc_monitor_name_pair(pair, m, p->kind, p->nodes);
    distance2 = cipc_exact_distance2(p->kind, stencil, NULL);
    double distance = sqrt(distance2), gap = cipc_exact_distance_gap(p->kind, stencil, p->offset);
    return cipc_fail(error, CIPC_E_VIOLATED_GAP, "monitor gap",
                     "%s: distance %.17g (%a) must exceed the offset %.17g (%a); exact gap, rounded: %.17g (%a)", pair, distance, distance,
                     p->offset, p->offset, gap, gap);
}

static double exact_gap(const measured_pair *p, const double *x)
{
    double stencil[12];
    cipc_gather(stencil, x, p->nodes, cipc_pair_nodes(p->kind));
    return cipc_exact_distance_gap(p->kind, stencil, p->offset);
}

/* Pairs of one part that may be as near as *least, whose gap is exact: measured exactly, and the first of them in the order kept. */
static void settle_part(measured_pair *least, const cipc_model *m, const invariant_candidate_part *part, double reach, const double *x)
{
    measured_pair p = {.kind = (cipc_pair_kind)part->kind};
    for (int i = 0; i < part->count; i++) {
        p.offset = invariant_candidates_nodes(m, p.kind, part->pairs[i], p.nodes);
        measure(&p, x, reach);
        if (!counts(&p, reach) || p.gap > least->gap) { continue; }
        if (!p.exact) { p.gap = exact_gap(&p, x); }
        if (is_less(&p, least)) { *least = p; }
    }
}

/* The exact minimum. Rounding to nearest is monotone, so what the filter proved is at most the exact gap rounded: a part whose least value
 * is above an exact gap holds nothing nearer. Few parts are left. */
static void settle_least(gap_result *all, const gap_result *results, const cipc_monitor *monitor, const double *x)
{
    const invariant_candidates *c = &monitor->candidates;
    if (!all->any) { return; }
    all->least.gap = exact_gap(&all->least, x);
    for (int i = 0; i < c->part_count; i++) {
        if (results[i].any && results[i].least.gap <= all->least.gap) { settle_part(&all->least, monitor->model, &c->parts[i], c->reach, x); }
    }
}

static void fill_report(cipc_invariant_report *report, const gap_result *r)
{
    if (report == NULL) { return; }
    report->pairs_checked = r->checked;
    report->exact_gap_checks = r->exact;
    report->min_gap = r->any ? r->least.gap : INFINITY;
    report->min_gap_kind = r->any ? r->least.kind : CIPC_POINT_POINT;
    for (int i = 0; i < 4; i++) { report->min_gap_nodes[i] = r->any ? r->least.nodes[i] : -1; }
}

static gap_result merge(const gap_result *results, int count)
{
    gap_result all = {0};
    for (int i = 0; i < count; i++) {
        all.checked += results[i].checked;
        all.exact += results[i].exact;
        if (results[i].any) { keep_least(&all, &results[i].least); }
        if (results[i].any_violated) { keep_least(&all, &results[i].violated); }
    }
    return all;
}

cipc_status cipc_monitor_gap(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    cipc_status status = cipc_monitor_prepare(monitor, x, report, error);
    if (status != CIPC_OK) { return status; }
    const invariant_candidates *c = &monitor->candidates;
    gap_result *results = cipc_alloc((size_t)c->part_count, sizeof *results);
    if (results == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor gap", "no memory for the results of %d parts", c->part_count);
    }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < c->part_count; i++) {
        if (c->parts[i].kind != CIPC_CANDIDATE_EDGE_TRIANGLE) { results[i] = check_part(monitor->model, &c->parts[i], c->reach, x); }
    }
    gap_result all = merge(results, c->part_count);
    if (report != NULL) { settle_least(&all, results, monitor, x); }
    cipc_free(results);
    fill_report(report, &all);
    return all.any_violated ? fail_gap(monitor->model, x, &all.violated, error) : CIPC_OK;
}
