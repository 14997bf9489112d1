/* Monitor M1: no edge meets a triangle it shares no node with (SPEC V.5). Touching counts as meeting. A pair is cleared by a certified
 * separating plane, or else decided by the exact predicate. */
#include "cipc/invariant.h"

#include <stdio.h>

#include "cipc/geometry.h"
#include "invariant/monitor.h"
#include "invariant/separation.h"

/* What one part of the lists gave. */
typedef struct crossing_result {
    long checked;
    int edge, triangle; /* the least meeting pair, edge first; -1: none */
} crossing_result;

static void keep_least(crossing_result *r, int edge, int triangle)
{
    if (r->edge < 0 || edge < r->edge || (edge == r->edge && triangle < r->triangle)) {
        r->edge = edge;
        r->triangle = triangle;
    }
}

static crossing_result check_part(const cipc_model *m, const invariant_candidate_part *part, const double *x)
{
    crossing_result r = {0, -1, -1};
    for (int i = 0; i < part->count; i++) {
        int edge = part->pairs[i][0], triangle = part->pairs[i][1];
        double e[6], t[9];
        cipc_gather(e, x, m->edges[edge], 2);
        cipc_gather(t, x, m->triangles[triangle], 3);
        if (cipc_edge_triangle_apart(e, t)) { continue; }
        r.checked++;
        if (cipc_edge_triangle_intersect(e, t)) { keep_least(&r, edge, triangle); }
    }
    return r;
}

static cipc_status fail_crossing(const cipc_model *m, const double *x, int edge, int triangle, cipc_error *error)
{
    const int *e = m->edges[edge], *t = m->triangles[triangle];
    const int nodes[5] = {e[0], e[1], t[0], t[1], t[2]};
    char coordinates[512];
    size_t used = 0;
    for (int i = 0; i < 5 && used < sizeof coordinates; i++) {
        const double *p = &x[3 * (size_t)nodes[i]];
        int n = snprintf(&coordinates[used], sizeof coordinates - used, "; x%d = (%a, %a, %a)", nodes[i], p[0], p[1], p[2]);
        used += n > 0 ? (size_t)n : 0;
    }
    return cipc_fail(
        error, CIPC_E_VIOLATED_INTERSECTION, "monitor intersection",
        "edge %d (nodes %d %d, body \"%s\") meets triangle %d (nodes %d %d %d, body \"%s\") at or near (%.17g, %.17g, %.17g)%s", edge, e[0],
        e[1], cipc_monitor_body(m, e[0]), triangle, t[0], t[1], t[2], cipc_monitor_body(m, t[0]), x[3 * (size_t)e[0]],
        x[3 * (size_t)e[0] + 1], x[3 * (size_t)e[0] + 2], coordinates);
}

cipc_status cipc_monitor_intersection(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    cipc_status status = cipc_monitor_prepare(monitor, x, report, error);
    if (status != CIPC_OK) { return status; }
    const invariant_candidates *c = &monitor->candidates;
    crossing_result *results = cipc_alloc((size_t)c->part_count, sizeof *results);
    if (results == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor intersection", "no memory for the results of %d parts", c->part_count);
    }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < c->part_count; i++) {
        results[i] = (crossing_result){0, -1, -1};
        if (c->parts[i].kind == CIPC_CANDIDATE_EDGE_TRIANGLE) { results[i] = check_part(monitor->model, &c->parts[i], x); }
    }
    crossing_result all = {0, -1, -1};
    for (int i = 0; i < c->part_count; i++) {
        all.checked += results[i].checked;
        if (results[i].edge >= 0) { keep_least(&all, results[i].edge, results[i].triangle); }
    }
    cipc_free(results);
    if (report != NULL) { report->crossings_checked = all.checked; }
    return all.edge < 0 ? CIPC_OK : fail_crossing(monitor->model, x, all.edge, all.triangle, error);
}
