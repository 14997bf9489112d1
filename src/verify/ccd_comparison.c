/* CCD methods on recorded queries. */
#include "verify/ccd_comparison.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* A step below this share of the way is tiny: a line search that is cut like that a few times makes no progress that Newton's method would notice. */
static const double TINY_SHARE = 1e-3;
/* Each query is asked so often; the least time counts, because whatever else the machine does only adds to it. */
enum { REPETITIONS = 5 };

void verify_ccd_own_methods(verify_ccd_method methods[VERIFY_CCD_METHODS])
{
    static const char *const names[VERIFY_CCD_METHODS] = {"certified", "additive", "cubic", "minimum-separation"}; /* in the order of cipc_ccd_method */
    for (int i = 0; i < VERIFY_CCD_METHODS; i++) {
        methods[i] = (verify_ccd_method){.name = names[i], .ccd = cipc_ccd, .options = cipc_ccd_options_default()};
        methods[i].options.method = (cipc_ccd_method)i;
        methods[i].options.gap_first = i == CIPC_CCD_ADDITIVE;
    }
}

const char *verify_ccd_worth_name(verify_ccd_worth worth)
{
    static const char *const names[VERIFY_CCD_WORTHS] = {"usable", "missed", "unsafe", "zero", "tiny"};
    return names[worth];
}

verify_ccd_worth verify_ccd_worth_of(const verify_ccd_truth *truth, const cipc_ccd_result *answer)
{
    const cipc_exact_impact *c = &truth->contact;
    if (c->verdict == CIPC_YES) {
        if (!answer->hit) return VERIFY_CCD_MISSED;
        bool before = answer->toi < c->lo || (answer->toi == c->lo && c->lo < c->hi); /* the contact is between the doubles lo and hi, or at both */
        if (!before) return VERIFY_CCD_UNSAFE;
    }
    if (!(answer->toi > 0)) return VERIFY_CCD_ZERO;
    return answer->toi < TINY_SHARE * truth->reach ? VERIFY_CCD_TINY : VERIFY_CCD_USABLE;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The answer, and the least time that it took, ns. */
static double ask(const verify_ccd_method *method, const verify_ccd_query *q, cipc_ccd_result *answer)
{
    cipc_ccd_options options = method->options;
    double least = INFINITY;
    options.slackness = q->scale;
    for (int i = 0; i < REPETITIONS; i++) {
        double begin = now();
        *answer = method->ccd(&q->path, q->thickness, 1, &options);
        least = fmin(least, now() - begin);
    }
    return 1e9 * least;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The smallest of the sorted values that at least `share` of them do not exceed. */
static double percentile(const double *sorted, long count, double share)
{
    long place = (long)ceil(share * (double)count) - 1;
    return count > 0 ? sorted[place > 0 ? place : 0] : NAN;
}

/* truth[i] of every query; reach < 0: it is not judged. */
static void find_truth(const verify_ccd_queries *queries, verify_ccd_truth *truth, verify_ccd_comparison *c)
{
    *c = (verify_ccd_comparison){.queries = queries->count};
    for (long i = 0; i < queries->count; i++) {
        const verify_ccd_query *q = &queries->query[i];
        verify_ccd_truth *t = &truth[i];
        t->contact = cipc_exact_toi(&q->path, q->thickness, 1);
        t->reach = -1;
        bool close = t->contact.verdict == CIPC_YES && t->contact.hi == 0, decided = t->contact.verdict != CIPC_INDETERMINATE;
        c->started_close += close;
        c->undecided += !decided;
        if (close || !decided) continue;
        double gap = cipc_exact_distance_gap(q->path.kind, q->path.x, q->thickness);
        cipc_exact_impact target = cipc_exact_toi(&q->path, q->thickness + q->scale * gap, 1);
        t->reach = target.verdict == CIPC_YES ? target.lo : 1;
        c->judged++;
        c->contacts += t->contact.verdict == CIPC_YES;
        c->thick += q->thickness > 0;
    }
}

/* ratio, ns: room for a number per query each. */
static void score(const verify_ccd_queries *queries, const verify_ccd_truth *truth, const verify_ccd_method *method, double *ratio, double *ns, verify_ccd_score *s)
{
    long ratios = 0, asked = 0;
    double sum = 0;
    for (long i = 0; i < queries->count; i++) {
        if (truth[i].reach < 0) continue;
        cipc_ccd_result answer;
        ns[asked] = ask(method, &queries->query[i], &answer);
        sum += ns[asked++];
        verify_ccd_worth worth = verify_ccd_worth_of(&truth[i], &answer);
        bool contact = truth[i].contact.verdict == CIPC_YES;
        s->worth[worth]++;
        s->early += !contact && answer.hit;
        s->capped += answer.capped;
        if (contact && worth != VERIFY_CCD_MISSED) ratio[ratios++] = answer.toi / truth[i].contact.hi;
    }
    qsort(ratio, (size_t)ratios, sizeof *ratio, ascending);
    qsort(ns, (size_t)asked, sizeof *ns, ascending);
    s->median = percentile(ratio, ratios, 0.5);
    s->percentile_1 = percentile(ratio, ratios, 0.01);
    s->mean_ns = asked > 0 ? sum / (double)asked : NAN;
    s->median_ns = percentile(ns, asked, 0.5);
}

cipc_status verify_ccd_compare(const verify_ccd_queries *queries, const verify_ccd_method *methods, int count, verify_ccd_comparison *c, cipc_error *error)
{
    size_t n = (size_t)queries->count;
    verify_ccd_truth *truth = cipc_alloc(n, sizeof *truth);
    double *ratio = cipc_alloc(n, sizeof *ratio), *ns = cipc_alloc(n, sizeof *ns);
    bool good = truth != NULL && ratio != NULL && ns != NULL;
    if (good) {
        find_truth(queries, truth, c);
        for (int m = 0; m < count; m++) score(queries, truth, &methods[m], ratio, ns, &c->scores[m]);
    }
    cipc_free(truth);
    cipc_free(ratio);
    cipc_free(ns);
    return good ? CIPC_OK : cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "ccd", "no memory for %ld queries", queries->count);
}
