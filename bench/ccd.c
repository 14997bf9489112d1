/* Continuous collision detection on the field's public queries: time per query, early hits, misses and unsafe answers (against the exact oracle) of each method,
 * beside the figures that the peers' code reached on such queries.
 *   build/bench/ccd DIRECTORY [YARDSTICK_SECONDS]   DIRECTORY as ../shared/data/ccd
 * With the yardstick given, the peers' times are scaled from the day of their measurement (0.38 s) to this one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cipc/contact.h"
#include "cipc/oracle.h"
#include "verify/query_files.h"

enum { REPETITIONS = 5 };

typedef struct method {
    const char *name;
    cipc_ccd_options options;
} method;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Least time of some repetitions, ns. */
static double time_query(const cipc_stencil_path *path, double xi, const cipc_ccd_options *options, cipc_ccd_result *result)
{
    double least = INFINITY;
    for (int i = 0; i < REPETITIONS; i++) {
        double begin = now();
        *result = cipc_ccd(path, xi, 1, options);
        least = fmin(least, now() - begin);
    }
    return 1e9 * least;
}

static double size_of(const cipc_stencil_path *path)
{
    double most = 0;
    for (int i = 0; i < 12; i++) most = fmax(most, fabs(path->x[i] - path->x[i % 3]));
    return most;
}

static void row(const verify_public_queries *q, cipc_pair_kind kind, bool thick, const method *m, double peer_ns, double scale)
{
    double *ns = cipc_alloc((size_t)q->count, sizeof *ns), sum = 0;
    int count = 0, hits = 0, early = 0, missed = 0, unsafe = 0, escalated = 0, most = 0, zero = 0;
    for (int i = 0; ns != NULL && i < q->count; i++) {
        const cipc_stencil_path *path = &q->query[i].path;
        if (path->kind != kind) continue;
        double xi = thick ? 1e-3 * size_of(path) : 0;
        cipc_ccd_result r;
        ns[count] = time_query(path, xi, &m->options, &r);
        sum += ns[count++];
        cipc_exact_impact impact = cipc_exact_toi(path, xi, 1);
        if (impact.verdict == CIPC_YES && impact.hi == 0) continue; /* started in contact: nothing to find */
        hits += impact.verdict == CIPC_YES;
        early += r.hit && impact.verdict == CIPC_NO;
        missed += !r.hit && impact.verdict == CIPC_YES;
        unsafe += cipc_exact_path_clear(path, xi, r.toi) != CIPC_YES;
        zero += r.toi == 0;
        escalated += r.precision > 53;
        most = r.iterations > most ? r.iterations : most;
    }
    qsort(ns, (size_t)count, sizeof *ns, ascending);
    printf("%-15s %-9s %-18s %6d %5d %6d %6d %6d %5d %5d %7.0f %7.0f %9.0f %10.0f %7d", cipc_pair_name(kind), thick ? "1e-3 size" : "0", m->name, count, hits, early,
           missed, unsafe, zero, escalated, sum / count, ns[count / 2], ns[(int)(0.99 * count)], ns[count - 1], most);
    if (peer_ns > 0 && scale > 0) printf("   %.2f of IPC Toolkit's ACCD (%.0f ns)", sum / count / (peer_ns * scale), peer_ns * scale);
    printf("\n");
    cipc_free(ns);
}

int main(int argc, char **argv)
{
    verify_public_queries q = {0};
    cipc_error error;
    if (argc < 2 || verify_public_queries_read_all(&q, argv[1], &error) != CIPC_OK) {
        fprintf(stderr, "bench: usage: ccd DIRECTORY [YARDSTICK_SECONDS]%s%s\n", argc < 2 ? "" : ": ", argc < 2 ? "" : error.what);
        return 2;
    }
    double scale = argc > 2 ? atof(argv[2]) / 0.38 : 0;
    method methods[] = {{.name = "certified"}, {.name = "certified, refined"}, {.name = "additive"}, {.name = "cubic"}, {.name = "minimum-separation"}};
    for (int i = 0; i < 5; i++) methods[i].options = cipc_ccd_options_default();
    methods[1].options.refine = true;
    methods[2].options.method = CIPC_CCD_ADDITIVE;
    methods[2].options.gap_first = true;
    methods[3].options.method = CIPC_CCD_CUBIC;
    methods[4].options.method = CIPC_CCD_MINIMUM_SEPARATION;
    static const double peer[2][2] = {{4121, 412}, {794, 137}}; /* mean ns, thickness 0 and 1e-3 of the size */
    printf("%-15s %-9s %-18s %6s %5s %6s %6s %6s %5s %5s %7s %7s %9s %10s %7s\n", "pair", "thickness", "method", "count", "hits", "early", "missed", "unsafe", "zero",
           "mpfr", "mean ns", "median", "p99", "max", "iter");
    for (int kind = CIPC_POINT_TRIANGLE; kind <= CIPC_EDGE_EDGE; kind++)
        for (int thick = 0; thick < 2; thick++)
            for (int i = 0; i < 5; i++) row(&q, (cipc_pair_kind)kind, thick, &methods[i], peer[kind == CIPC_EDGE_EDGE][thick], scale);
    verify_public_queries_free(&q);
    return 0;
}
