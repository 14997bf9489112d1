/* One time-of-impact query, judged by the exact oracle (SPEC V.3, V.4, V.8). */
#include <math.h>
#include <string.h>

#include "cipc/oracle.h"
#include "verify/toi.h"
#include "verify/truth.h"

/* Parts of a row, in the order of verify_toi_describe. */
enum {
    UNSAFE, MISSED, ZERO_STEP, BELOW_BOUND, START_MISJUDGED, UNDECIDED,
    HITS, EARLY, CAPPED, ESCALATED, STARTED_CLOSE,
    PLAIN_UNSAFE, PLAIN_MISSED, PLAIN_ZERO, CUBIC_UNSAFE, CUBIC_MISSED,
};
enum { QUALITY, PLAIN_QUALITY };

/* The certified bound may give up 2^-10 of the gap to rounding before it is computed more precisely (docs/theory/certified_ccd.md (9)), at each of s, l_p and
 * the quotient less than 2^-40. */
static const double BOUND_SLACK = 1 - 0x1p-9;
/* The plain algorithms are stopped here; their answer is then the time reached. */
enum { PLAIN_ITERATIONS = 20000 };

void verify_toi_describe(verify_row *row, const char *name, double least_hits)
{
    verify_row_init(row, name);
    verify_row_forbid(row, "unsafe: contact before the time returned");
    verify_row_forbid(row, "missed: a contact, and none reported");
    verify_row_forbid(row, "no step where there is room");
    verify_row_forbid(row, "below the bound of eq. 16");
    verify_row_forbid(row, "start misjudged");
    verify_row_forbid(row, "undecided by the oracle");
    verify_row_branch(row, "hits", least_hits);
    verify_row_counter(row, "early hits");
    verify_row_counter(row, "cap of iterations met");
    verify_row_counter(row, "needed MPFR");
    verify_row_counter(row, "started in contact");
    verify_row_counter(row, "plain ACCD unsafe");
    verify_row_counter(row, "plain ACCD missed");
    verify_row_counter(row, "plain ACCD no step");
    verify_row_counter(row, "cubic roots unsafe");
    verify_row_counter(row, "cubic roots missed");
    verify_row_maximum(row, "iterations", INFINITY);
    verify_row_histogram(row, "returned / first time at the target gap");
    verify_row_histogram(row, "the same of plain ACCD");
}

static cipc_query query_of(const cipc_stencil_path *path, double xi, double scale)
{
    static const char *const names[CIPC_PAIR_KIND_COUNT] = {"toi_point_point", "toi_point_edge", "toi_point_triangle", "toi_edge_edge"};
    cipc_query q = {.fn = names[path->kind], .thickness = xi, .scale = scale, .displacement = !path->to_end};
    memcpy(q.x, path->x, sizeof path->x);
    memcpy(q.x1, path->p, sizeof q.x1);
    return q;
}

/* l_p of SPEC C.5, in long doubles: the displacements less their mean. */
static double relative_speed(const cipc_stencil_path *path)
{
    long double q[12], mean[3] = {0, 0, 0}, most[2] = {0, 0};
    int nodes = cipc_pair_nodes(path->kind);
    for (int i = 0; i < 3 * nodes; i++) q[i] = path->to_end ? (long double)path->p[i] - path->x[i] : (long double)path->p[i];
    for (int i = 0; i < 3 * nodes; i++) mean[i % 3] += q[i] / nodes;
    for (int i = 0; i < nodes; i++) {
        long double length2 = 0;
        for (int k = 0; k < 3; k++) length2 += (q[3 * i + k] - mean[k]) * (q[3 * i + k] - mean[k]);
        int side = i >= cipc_pair_first_nodes(path->kind);
        most[side] = fmaxl(most[side], sqrtl(length2));
    }
    return (double)(most[0] + most[1]);
}

/* Eq. (16) with the slackness: (1 - s)(d - xi) / l_p, at most 1. */
double verify_least_time(const cipc_stencil_path *path, double gap, double slackness)
{
    double speed = relative_speed(path);
    return speed > 0 ? fmin(1, (1 - slackness) * gap / speed) : 1;
}

typedef struct judgement {
    const cipc_stencil_path *path;
    double xi, gap;
    cipc_exact_impact impact;
    cipc_query query;
    long sample;
    verify_row *row;
} judgement;

static bool is_unsafe(const judgement *j, double toi) { return cipc_exact_path_clear(j->path, j->xi, toi) != CIPC_YES; }

static void note(const judgement *j, int counter, bool happened)
{
    if (happened) verify_count(j->row, counter, j->sample, &j->query);
}

static void judge_plain(const judgement *j, double slackness, double target_time)
{
    cipc_ccd_options options = cipc_ccd_options_default();
    options.method = CIPC_CCD_ADDITIVE;
    options.gap_first = true;
    options.slackness = slackness;
    options.max_iterations = PLAIN_ITERATIONS;
    cipc_ccd_result plain = cipc_ccd(j->path, j->xi, 1, &options);
    bool contact = j->impact.verdict == CIPC_YES;
    note(j, PLAIN_UNSAFE, plain.toi > 0 && is_unsafe(j, plain.toi));
    note(j, PLAIN_MISSED, contact && !plain.hit);
    note(j, PLAIN_ZERO, plain.toi <= 0);
    if (target_time > 0 && plain.hit && !plain.capped) verify_ratio(j->row, PLAIN_QUALITY, plain.toi / target_time);
    if (j->path->kind != CIPC_POINT_TRIANGLE && j->path->kind != CIPC_EDGE_EDGE) return;
    options.method = CIPC_CCD_CUBIC;
    cipc_ccd_result cubic = cipc_ccd(j->path, j->xi, 1, &options);
    note(j, CUBIC_UNSAFE, cubic.toi > 0 && is_unsafe(j, cubic.toi));
    note(j, CUBIC_MISSED, contact && !cubic.hit);
}

static void judge_certified(const judgement *j, const cipc_ccd_result *r, double slackness, double target_time)
{
    bool contact = j->impact.verdict == CIPC_YES;
    double iterations = r->iterations;
    note(j, HITS, contact);
    note(j, UNSAFE, is_unsafe(j, r->toi));
    note(j, MISSED, contact && !r->hit);
    note(j, ZERO_STEP, !(r->toi > 0));
    note(j, BELOW_BOUND, r->toi < BOUND_SLACK * verify_least_time(j->path, j->gap, slackness));
    note(j, EARLY, !contact && r->hit);
    note(j, CAPPED, r->capped);
    note(j, ESCALATED, r->precision > 53);
    verify_measure(j->row, 0, iterations, j->sample, &j->query);
    if (target_time > 0 && r->hit && !r->capped) verify_ratio(j->row, QUALITY, r->toi / target_time);
}

void verify_toi_judge(const cipc_stencil_path *path, double xi, long sample, verify_row *row, const verify_toi_subject *subject)
{
    cipc_ccd_options options = cipc_ccd_options_default();
    judgement j = {.path = path, .xi = xi, .sample = sample, .row = row, .query = query_of(path, xi, options.slackness)};
    j.impact = cipc_exact_toi(path, xi, 1);
    cipc_ccd_result r = subject->ccd(path, xi, 1, &options);
    bool close = j.impact.verdict == CIPC_YES && j.impact.hi == 0;
    note(&j, UNDECIDED, j.impact.verdict == CIPC_INDETERMINATE);
    note(&j, START_MISJUDGED, j.impact.verdict != CIPC_INDETERMINATE && close != (r.outcome == CIPC_CCD_INITIALLY_CLOSE));
    note(&j, STARTED_CLOSE, close);
    if (close || j.impact.verdict == CIPC_INDETERMINATE) return;
    j.gap = cipc_exact_distance_gap(path->kind, path->x, xi);
    cipc_exact_impact target = cipc_exact_toi(path, xi + options.slackness * j.gap, 1);
    double target_time = target.verdict == CIPC_YES ? target.hi : 0;
    judge_certified(&j, &r, options.slackness, target_time);
    judge_plain(&j, options.slackness, target_time);
}
