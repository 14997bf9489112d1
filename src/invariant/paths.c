/* Monitor M5 for paths with breaks: no pair comes to its thickness or below while every node moves on straight pieces, each node from break to break of its own
 * (SPEC V.5; docs/monitors.md, "Paths with breaks").
 *
 * A node that strays by no more than e from a straight way lends a pair no more than that much nearness. So a direction along which both ends of the straight ways
 * are certified to be further apart than xi and what the two primitives stray clears the time between: the whole, or a half, or a half of that. Where the slices are
 * at their shortest, the pieces between breaks of the pair's nodes are looked at one by one; and what no direction clears there is decided by the exact time of
 * impact. */
#include "cipc/invariant.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/oracle.h"
#include "invariant/monitor.h"
#include "invariant/moving_pair.h"
#include "invariant/polylines.h"

static const char place[] = "monitor paths";
/* xi plus what two primitives stray: two sums, off by u each, u = DBL_EPSILON / 2. */
#define ROUND_UP (1 + 2 * DBL_EPSILON)
/* With no more knots than this, a slice's pieces are looked at without halving it first. */
enum { FEW_KNOTS = 4 };

/* A pair on its way. */
typedef struct journey {
    const cipc_polylines *paths;
    cipc_moving_pair pair;
    int count;   /* of its nodes */
    double n[3]; /* the last direction that cleared something */
    bool exact, undecided;
} journey;

/* --- the paths given --- */

static cipc_status check_break(const cipc_model *m, const cipc_paths *paths, long b, cipc_error *error)
{
    const cipc_path_break *at = &paths->breaks[b];
    if (at->node < 0 || at->node >= m->node_count) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "break %ld is of node %d; there are %d", b, at->node, m->node_count);
    }
    if (!isfinite(at->time) || !isfinite(at->x[0]) || !isfinite(at->x[1]) || !isfinite(at->x[2])) {
        return cipc_fail(error, CIPC_E_VIOLATED_FINITE, place, "break %ld, of node %d of body \"%s\", is at time %g at (%g, %g, %g)", b, at->node,
                         cipc_monitor_body(m, at->node), at->time, at->x[0], at->x[1], at->x[2]);
    }
    double least = b > 0 ? paths->breaks[b - 1].time : paths->begin;
    if (!(at->time >= least && at->time <= paths->end)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "break %ld is at %.17g s; it must lie between %.17g s and the end, %.17g s", b, at->time, least, paths->end);
    }
    return CIPC_OK;
}

static cipc_status check_paths(const cipc_model *m, const cipc_paths *paths, cipc_error *error)
{
    if (paths->node_count != m->node_count || paths->break_count < 0) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "paths of %d nodes with %ld breaks; the model has %d nodes", paths->node_count, paths->break_count,
                         m->node_count);
    }
    cipc_status status = cipc_monitor_finite(m, paths->from, error);
    if (status == CIPC_OK) { status = cipc_monitor_finite(m, paths->to, error); }
    if (status != CIPC_OK) { return status; }
    if (!isfinite(paths->begin) || !isfinite(paths->end)) {
        return cipc_fail(error, CIPC_E_VIOLATED_FINITE, place, "the paths begin at time %g and end at %g", paths->begin, paths->end);
    }
    if (!(paths->begin <= paths->end) || !isfinite(paths->end - paths->begin)) {
        return cipc_fail(error, CIPC_E_OUT_OF_RANGE, place, "the paths begin at %.17g s and end at %.17g s", paths->begin, paths->end);
    }
    for (long b = 0; b < paths->break_count && status == CIPC_OK; b++) { status = check_break(m, paths, b, error); }
    return status;
}

/* --- a piece between breaks --- */

/* xi and what the two primitives stray, rounded up. e: of every node, m, not NaN. */
static double inflate(const cipc_moving_pair *p, const double *e)
{
    double stray[2] = {0, 0};
    int count = cipc_pair_nodes(p->kind), first = cipc_pair_first_nodes(p->kind);
    for (int i = 0; i < count; i++) { stray[i < first ? 0 : 1] = fmax(stray[i < first ? 0 : 1], e[p->nodes[i]]); }
    return (p->offset + stray[0] + stray[1]) * ROUND_UP;
}

/* The piece [begin, end] that begins when the nodes have come past knots k, exactly. A node that has no further knot stays where it is. */
static cipc_stencil_piece exact_piece(const journey *j, const long *k, double begin, double end)
{
    cipc_stencil_piece piece = {.kind = j->pair.kind, .begin = begin, .end = end};
    for (int i = 0; i < j->count; i++) {
        const cipc_knot *here = &j->paths->knots[k[i]], *next = k[i] + 1 < j->paths->first[j->pair.nodes[i] + 1] ? here + 1 : here;
        piece.start[i] = here->time;
        piece.stop[i] = next->time;
        memcpy(&piece.x[3 * i], here->x, sizeof here->x);
        memcpy(&piece.p[3 * i], next->x, sizeof next->x);
    }
    return piece;
}

/* False: violated. */
static bool decide_piece(journey *j, const long *k, double begin, double end)
{
    cipc_stencil_piece piece = exact_piece(j, k, begin, end);
    cipc_exact_impact impact = cipc_exact_piece_toi(&piece, j->pair.offset);
    j->exact = true;
    j->undecided = j->undecided || impact.verdict == CIPC_INDETERMINATE;
    if (impact.verdict == CIPC_YES) {
        j->pair.violated = true;
        j->pair.time = impact.lo;
    }
    return !j->pair.violated;
}

/* When the next of the nodes comes to a knot, or `end`. */
static double next_time(const journey *j, const long *k, double end)
{
    for (int i = 0; i < j->count; i++) {
        bool last = k[i] + 1 == j->paths->first[j->pair.nodes[i] + 1];
        if (!last && j->paths->knots[k[i] + 1].time < end) { end = j->paths->knots[k[i] + 1].time; }
    }
    return end;
}

/* Where the nodes are then, and the knots that they have come past. */
static void move_to(const journey *j, long *k, double time, double stencil[12])
{
    for (int i = 0; i < j->count; i++) {
        bool last = k[i] + 1 == j->paths->first[j->pair.nodes[i] + 1];
        if (!last && j->paths->knots[k[i] + 1].time <= time) { k[i]++; }
        cipc_polylines_place(j->paths, k[i], time, &stencil[3 * i]);
    }
}

/* All pieces from one instant of the slices to another. On each all nodes move straight, so only the rounding of their places is to be allowed for. False:
 * violated. */
static bool walk_pieces(journey *j, int from, int to)
{
    const cipc_polylines *paths = j->paths;
    double here[12], there[12], begin = paths->times[from], end = paths->times[to], enough = inflate(&j->pair, paths->rounding);
    long k[4], passed[4];
    for (int i = 0; i < j->count; i++) { k[i] = paths->knot_at[(size_t)from * (size_t)paths->node_count + (size_t)j->pair.nodes[i]]; }
    move_to(j, k, begin, here);
    bool good = true;
    for (bool more = true; more && good; more = begin < end) {
        double until = next_time(j, k, end);
        memcpy(passed, k, sizeof k);
        move_to(j, k, until, there);
        good = cipc_moving_pair_clear(j->pair.kind, here, there, enough, j->n) || decide_piece(j, passed, begin, until);
        memcpy(here, there, sizeof here);
        begin = until;
    }
    return good;
}

/* --- slices --- */

static long count_knots(const journey *j, int from, int to)
{
    long count = 0;
    size_t nodes = (size_t)j->paths->node_count;
    for (int i = 0; i < j->count; i++) {
        size_t node = (size_t)j->pair.nodes[i];
        count += j->paths->knot_at[(size_t)to * nodes + node] - j->paths->knot_at[(size_t)from * nodes + node];
    }
    return count;
}

/* Clear slice number `slice` of those of a level, or halve it, or look at its pieces. False: violated. */
static bool clear_slice(journey *j, int level, int slice)
{
    const cipc_polylines *paths = j->paths;
    int width = paths->slices >> level, from = slice * width, to = from + width;
    double here[12], there[12], enough = inflate(&j->pair, cipc_polylines_deviation(paths, level, slice));
    cipc_gather(here, &paths->places[3 * (size_t)from * (size_t)paths->node_count], j->pair.nodes, j->count);
    cipc_gather(there, &paths->places[3 * (size_t)to * (size_t)paths->node_count], j->pair.nodes, j->count);
    if (cipc_moving_pair_clear(j->pair.kind, here, there, enough, j->n)) { return true; }
    if (width == 1 || count_knots(j, from, to) <= FEW_KNOTS) { return walk_pieces(j, from, to); }
    return clear_slice(j, level + 1, 2 * slice) && clear_slice(j, level + 1, 2 * slice + 1);
}

/* --- all pairs --- */

static cipc_moving_result check_part(const cipc_model *m, const invariant_candidate_part *part, const cipc_polylines *paths)
{
    cipc_moving_result r = {.checked = part->count};
    cipc_pair_kind kind = (cipc_pair_kind)part->kind;
    for (int i = 0; i < part->count; i++) {
        journey j = {.paths = paths, .pair = {.kind = kind}, .count = cipc_pair_nodes(kind)};
        j.pair.offset = invariant_candidates_nodes(m, kind, part->pairs[i], j.pair.nodes);
        bool good = clear_slice(&j, 0, 0) && !j.undecided;
        r.exact += j.exact ? 1 : 0;
        if (!good) { cipc_moving_result_keep(&r, &j.pair); }
    }
    return r;
}

/* The lists of the resting monitors serve if no knot of any node is too far away. */
static bool lists_serve(const invariant_candidates *c, const cipc_polylines *paths)
{
    for (int i = 0; i < paths->node_count; i++) {
        for (long k = paths->first[i]; k < paths->first[i + 1]; k++) {
            if (!invariant_candidates_near(c, i, paths->knots[k].x)) { return false; }
        }
    }
    return true;
}

static cipc_status find_pairs(cipc_monitor *monitor, const cipc_polylines *paths, const invariant_candidates **pairs, cipc_error *error)
{
    *pairs = &monitor->candidates;
    if (lists_serve(*pairs, paths)) { return CIPC_OK; }
    *pairs = &monitor->paths;
    double *lo = cipc_alloc(3 * (size_t)paths->node_count, sizeof *lo), *hi = cipc_alloc(3 * (size_t)paths->node_count, sizeof *hi);
    bool made = lo != NULL && hi != NULL;
    if (made) {
        cipc_polylines_boxes(paths, lo, hi);
        made = invariant_candidates_sweep(&monitor->paths, lo, hi);
    }
    cipc_free(lo);
    cipc_free(hi);
    return made ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the lists of candidate pairs");
}

static cipc_status fail_paths(const cipc_model *m, const cipc_moving_pair *p, cipc_error *error)
{
    char pair[CIPC_MONITOR_PAIR_SIZE];
    cipc_monitor_name_pair(pair, m, p->kind, p->nodes);
    if (p->violated) {
        return cipc_fail(error, CIPC_E_VIOLATED_SWEPT, place, "%s: the distance falls to the offset %.17g (%a) at the time %.17g s (%a)", pair, p->offset, p->offset,
                         p->time, p->time);
    }
    return cipc_fail(error, CIPC_E_INDETERMINATE, place, "%s: exact arithmetic could not decide whether the distance falls to the offset %.17g (%a)", pair, p->offset,
                     p->offset);
}

static cipc_status check_pairs(cipc_monitor *monitor, const cipc_polylines *paths, cipc_invariant_report *report, cipc_error *error)
{
    const invariant_candidates *c = NULL;
    cipc_status status = find_pairs(monitor, paths, &c, error);
    if (status != CIPC_OK) { return status; }
    cipc_moving_result *results = cipc_alloc((size_t)c->part_count, sizeof *results);
    if (results == NULL) { return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, place, "no memory for the results of %d parts", c->part_count); }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < c->part_count; i++) {
        if (c->parts[i].kind != CIPC_CANDIDATE_EDGE_TRIANGLE) { results[i] = check_part(monitor->model, &c->parts[i], paths); }
    }
    cipc_moving_result all = cipc_moving_result_merge(results, c->part_count);
    cipc_free(results);
    if (report != NULL) {
        report->paths_checked = all.checked;
        report->exact_path_checks = all.exact;
    }
    return all.any ? fail_paths(monitor->model, &all.first, error) : CIPC_OK;
}

cipc_status cipc_monitor_paths(cipc_monitor *monitor, const cipc_paths *paths, cipc_invariant_report *report, cipc_error *error)
{
    cipc_polylines polylines;
    cipc_status status = check_paths(monitor->model, paths, error);
    if (status != CIPC_OK) { return status; }
    status = cipc_polylines_init(&polylines, paths, monitor->options.threads, error);
    if (status == CIPC_OK) { status = check_pairs(monitor, &polylines, report, error); }
    cipc_polylines_free(&polylines);
    return status;
}
