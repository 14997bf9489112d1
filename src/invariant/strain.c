/* Monitor M3: every strain is within its limits (SPEC V.5): principal stretches below s and above the lower s, Green strains of woven cloth
 * below theirs. What double arithmetic cannot prove is decided exactly (strain_limits.c). */
#include "cipc/invariant.h"

#include <math.h>

#include "invariant/monitor.h"
#include "invariant/strain_limits.h"

/* What one section of the triangles gave. */
typedef struct strain_result {
    double stretch, used; /* as doubles give them */
    int triangle;         /* of the largest stretch; -1: none */
    int used_triangle;    /* of the limit used most; -1: none limited */
    cipc_strain_kind used_kind;
    int violating; /* the first violating triangle; -1: none */
    cipc_strain_kind violated;
    long exact;
} strain_result;

static const strain_result nothing = {.used = -INFINITY, .triangle = -1, .used_triangle = -1, .violating = -1};

static void check_limit(strain_result *r, const cipc_monitor *monitor, int t, cipc_strain_kind kind, const cipc_strain_edges *edges,
                        double value, const double *x)
{
    const cipc_strain_rest *rest = &monitor->rest[t];
    double used = cipc_strain_used(kind, value, rest->limits[kind]);
    if (used > r->used) { /* not a number where doubles have no axes */
        r->used = used;
        r->used_triangle = t;
        r->used_kind = kind;
    }
    if (cipc_strain_is_proven(rest, kind, edges)) { return; }
    r->exact++;
    if (r->violating < 0 && cipc_strain_compare(monitor->model, t, kind, x, rest->limits[kind]) <= 0) {
        r->violating = t;
        r->violated = kind;
    }
}

static void check_triangle(strain_result *r, const cipc_monitor *monitor, int t, const double *x)
{
    const cipc_strain_rest *rest = &monitor->rest[t];
    cipc_strain_edges edges = cipc_strain_edges_of(x, monitor->model->triangles[t]);
    double stretch = cipc_strain_value(rest, CIPC_STRAIN_LARGEST, &edges);
    if (r->triangle < 0 || stretch > r->stretch) {
        r->stretch = stretch;
        r->triangle = t;
    }
    for (int k = 0; k < CIPC_STRAIN_KINDS; k++) {
        cipc_strain_kind kind = (cipc_strain_kind)k;
        if (!(rest->limits[k] > 0)) { continue; }
        check_limit(r, monitor, t, kind, &edges, k == CIPC_STRAIN_LARGEST ? stretch : cipc_strain_value(rest, kind, &edges), x);
    }
}

static strain_result check_section(const cipc_monitor *monitor, int section, const double *x)
{
    strain_result r = nothing;
    int first = section * CIPC_MONITOR_SECTION, count = monitor->model->triangle_count;
    int last = first + CIPC_MONITOR_SECTION < count ? first + CIPC_MONITOR_SECTION : count;
    for (int t = first; t < last; t++) {
        if (monitor->rest[t].measured) { check_triangle(&r, monitor, t, x); }
    }
    return r;
}

static strain_result merge(const strain_result *results, int count)
{
    strain_result all = nothing;
    for (int i = 0; i < count; i++) {
        const strain_result *r = &results[i];
        if (r->triangle >= 0 && (all.triangle < 0 || r->stretch > all.stretch)) {
            all.stretch = r->stretch;
            all.triangle = r->triangle;
        }
        if (r->used > all.used) {
            all.used = r->used;
            all.used_triangle = r->used_triangle;
            all.used_kind = r->used_kind;
        }
        if (all.violating < 0) {
            all.violating = r->violating;
            all.violated = r->violated;
        }
        all.exact += r->exact;
    }
    return all;
}

/* The value of a limited strain as exact arithmetic has it, rounded towards what is forbidden. */
static double exact_value(const cipc_monitor *monitor, int t, cipc_strain_kind kind, const double *x)
{
    cipc_strain_edges edges = cipc_strain_edges_of(x, monitor->model->triangles[t]);
    return cipc_strain_rounded(monitor->model, t, kind, x, cipc_strain_value(&monitor->rest[t], kind, &edges));
}

static cipc_status fail_strain(const cipc_monitor *monitor, int t, cipc_strain_kind kind, const double *x, cipc_error *error)
{
    static const char *const names[] = {"largest principal stretch", "least principal stretch", "Green strain along the warp, in magnitude,",
                                        "Green strain along the weft, in magnitude,", "Green strain in shear, in magnitude,"};
    const cipc_model *m = monitor->model;
    const int *n = m->triangles[t];
    double limit = monitor->rest[t].limits[kind], value = exact_value(monitor, t, kind, x);
    bool least = kind == CIPC_STRAIN_LEAST;
    return cipc_fail(error, CIPC_E_VIOLATED_STRAIN, "monitor strain",
                     "triangle %d (nodes %d %d %d, body \"%s\"): %s %.17g (%a, exact, rounded %s) must be %s the limit %.17g (%a)", t, n[0],
                     n[1], n[2], m->bodies[m->triangle_body[t]].name, names[kind], value, value, least ? "downwards" : "upwards",
                     least ? "above" : "below", limit, limit);
}

/* What double arithmetic found to be the largest, rounded upwards from its exact value: what is reported below a limit is below it. */
static void fill_report(cipc_invariant_report *report, const strain_result *r, const cipc_monitor *monitor, const double *x)
{
    report->max_stretch = r->triangle >= 0 ? exact_value(monitor, r->triangle, CIPC_STRAIN_LARGEST, x) : 0;
    report->max_stretch_triangle = r->triangle;
    report->max_stretch_ratio = 0;
    if (r->used_triangle >= 0) {
        double value = exact_value(monitor, r->used_triangle, r->used_kind, x), limit = monitor->rest[r->used_triangle].limits[r->used_kind];
        report->max_stretch_ratio = fmax(0, cipc_strain_used(r->used_kind, value, limit));
    }
    report->exact_strain_checks = r->exact;
}

cipc_status cipc_monitor_strain(cipc_monitor *monitor, const double *x, cipc_invariant_report *report, cipc_error *error)
{
    cipc_status status = cipc_monitor_finite(monitor->model, x, error);
    if (status != CIPC_OK) { return status; }
    int sections = cipc_monitor_sections(monitor->model->triangle_count);
    strain_result *results = cipc_alloc((size_t)sections, sizeof *results);
    if (results == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "monitor strain", "no memory for the results of %d sections", sections);
    }
#pragma omp parallel for schedule(dynamic) num_threads(monitor->options.threads) if (monitor->options.threads > 1)
    for (int i = 0; i < sections; i++) { results[i] = check_section(monitor, i, x); }
    strain_result all = merge(results, sections);
    cipc_free(results);
    if (report != NULL) { fill_report(report, &all, monitor, x); }
    return all.violating < 0 ? CIPC_OK : fail_strain(monitor, all.violating, all.violated, x, error);
}

int cipc_invariant_limited_triangles(const cipc_model *model)
{
    int count = 0;
    for (int b = 0; b < model->body_count; b++) {
        const cipc_material *m = &model->bodies[b].material;
        bool limited = m->strain_limit > 0 || m->strain_lower_limit > 0 || m->membrane == CIPC_MEMBRANE_ORTHOTROPIC;
        count += limited && model->bodies[b].kind == CIPC_BODY_SHELL ? model->bodies[b].triangle_count : 0;
    }
    return count;
}
