/* Monitor M3: the principal stretches of every limited triangle are within its limits, lower < sigma_2, sigma_1 < s, and the Green strains of orthotropic cloth below theirs
 * (SPEC V.5).
 *
 * With first fundamental forms Ibar (rest) and I (now):  sigma_1 < s  <=>  M = s^2 Ibar - I positive definite  <=>  M11 > 0 and det M >
 * 0. Both are evaluated in double with an error bound (docs/monitors.md, "The strain bound"); what it cannot decide goes to exact
 * arithmetic. */
#include "cipc/invariant.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/vector.h"
#include "cipc/oracle.h"
#include "invariant/monitor.h"

#define UNIT (0.5 * DBL_EPSILON)
/* With Q = s^2 tr Ibar + tr I, every entry of M is off by at most 9 u Q, hence det M by at most 43 u Q^2; rounded up to cover the bounds'
 * own rounding. */
#define ENTRY_ERROR       (10 * UNIT)
#define DETERMINANT_ERROR (48 * UNIT)
/* Outside of these, underflow or overflow could spoil the bounds: nothing is proven then. */
/* A Green strain is half of a sum of six products less one number: nine roundings of what is summed. */
#define STRAIN_ERROR (16 * UNIT)
#define SMALLEST_TRACE 0x1p-400
#define LARGEST_TRACE  0x1p400

/* form = |e1|^2, e1.e2, |e2|^2. */
static void fundamental_form(double form[3], const double e1[3], const double e2[3])
{
    form[0] = v3_norm2(e1);
    form[1] = v3_dot(e1, e2);
    form[2] = v3_norm2(e2);
}

static void edges_of(const double *x, const int nodes[3], double e1[3], double e2[3])
{
    v3_sub(e1, &x[3 * (size_t)nodes[1]], &x[3 * (size_t)nodes[0]]);
    v3_sub(e2, &x[3 * (size_t)nodes[2]], &x[3 * (size_t)nodes[0]]);
}

/* Inverse of [E1 E2] = [l a; 0 b] in the frame whose first axis is along E1; all zero for a triangle without area. */
static void invert_rest(double inverse[4], const double E1[3], const double E2[3])
{
    double normal[3], l = v3_norm(E1);
    v3_cross(normal, E1, E2);
    double a = v3_dot(E1, E2) / l, b = v3_norm(normal) / l;
    bool has_area = l > 0 && b > 0;
    inverse[0] = has_area ? 1 / l : 0;
    inverse[1] = has_area ? -a / (l * b) : 0;
    inverse[2] = 0;
    inverse[3] = has_area ? 1 / b : 0;
}

/* Coefficients on the edges of the unit vector along a direction's part in the plane of E1, E2, from its products with the edges; form = Ibar. */
static void edge_coefficients(double coefficients[2], const double form[3], const double E1[3], const double E2[3], const double direction[3])
{
    double p = v3_dot(E1, direction), q = v3_dot(E2, direction), determinant = form[0] * form[2] - form[1] * form[1];
    double a = (form[2] * p - form[1] * q) / determinant, b = (form[0] * q - form[1] * p) / determinant, length = sqrt(a * p + b * q);
    coefficients[0] = a / length;
    coefficients[1] = b / length;
}

/* Warp and weft of orthotropic cloth; weft 0: across the warp. */
static void orthotropic_init(cipc_strain_rest *rest, const cipc_orthotropic_material *m, const double E1[3], const double E2[3])
{
    double warp[3], across[3], n[3], *a = rest->directions[0], *b = rest->directions[1];
    edge_coefficients(a, rest->form, E1, E2, m->warp);
    for (int k = 0; k < 3; k++) { warp[k] = a[0] * E1[k] + a[1] * E2[k]; }
    v3_cross(n, E1, E2);
    v3_cross(across, n, warp);
    bool given = v3_norm2(m->weft) > 0;
    edge_coefficients(b, rest->form, E1, E2, given ? m->weft : across);
    rest->cosine = given ? a[0] * b[0] * rest->form[0] + (a[0] * b[1] + a[1] * b[0]) * rest->form[1] + a[1] * b[1] * rest->form[2] : 0;
    memcpy(rest->strain_limits, m->limits, sizeof rest->strain_limits);
}

void cipc_strain_rest_init(cipc_strain_rest *rest, const cipc_model *model)
{
    for (int t = 0; t < model->triangle_count; t++) {
        const cipc_material *material = &model->bodies[model->triangle_body[t]].material;
        double E1[3], E2[3];
        edges_of(model->rest, model->triangles[t], E1, E2);
        fundamental_form(rest[t].form, E1, E2);
        invert_rest(rest[t].inverse, E1, E2);
        rest[t].limit = material->strain_limit;
        rest[t].lower = material->strain_lower_limit;
        if (material->membrane == CIPC_MEMBRANE_ORTHOTROPIC) { orthotropic_init(&rest[t], &material->orthotropic, E1, E2); }
        rest[t].measured = material->membrane != CIPC_MEMBRANE_NONE || material->strain_limit > 0 || material->strain_lower_limit > 0;
    }
}

/* Does double arithmetic prove that M = s^2 Ibar - I is positive definite, or with sign -1 that -M is? */
static bool is_proven(const cipc_strain_rest *rest, const double form[3], double limit, double sign)
{
    double s2 = limit * limit;
    double m11 = sign * (s2 * rest->form[0] - form[0]), m12 = s2 * rest->form[1] - form[1], m22 = sign * (s2 * rest->form[2] - form[2]);
    double trace = s2 * (rest->form[0] + rest->form[2]) + (form[0] + form[2]);
    bool in_range = trace > SMALLEST_TRACE && trace < LARGEST_TRACE;
    return in_range && m11 > ENTRY_ERROR * trace && m11 * m22 - m12 * m12 > DETERMINANT_ERROR * trace * trace;
}

/* Largest eigenvalue of C = F^T F with F = [e1 e2] B, B the inverse at rest; its root is sigma_1. */
static double largest_stretch2(const cipc_strain_rest *rest, const double e1[3], const double e2[3])
{
    double f1[3], f2[3];
    v3_scale(f1, rest->inverse[0], e1);
    for (int k = 0; k < 3; k++) { f2[k] = rest->inverse[1] * e1[k] + rest->inverse[3] * e2[k]; }
    double c11 = v3_norm2(f1), c12 = v3_dot(f1, f2), c22 = v3_norm2(f2);
    double half = 0.5 * (c11 - c22);
    return 0.5 * (c11 + c22) + sqrt(half * half + c12 * c12);
}

/* Positive doubles are in the order of their bits. */
static uint64_t rank_of(double positive)
{
    uint64_t rank;
    memcpy(&rank, &positive, sizeof rank);
    return rank;
}

static double of_rank(uint64_t rank)
{
    double value;
    memcpy(&value, &rank, sizeof value);
    return value;
}

/* sigma_1 rounded upwards: the least double that exact comparison finds not below it, sought from the estimate in steps that double until it
 * lies between two, then by halves. Where there is none (a rest triangle without area) the estimate stands. */
static double stretch_upwards(const cipc_model *m, int triangle, const double *x, double estimate)
{
    const uint64_t end = rank_of(INFINITY);
    double rest[9], now[9];
    if (!(estimate > 0) || !isfinite(estimate)) { return estimate; }
    cipc_gather(rest, m->rest, m->triangles[triangle], 3);
    cipc_gather(now, x, m->triangles[triangle], 3);
    uint64_t above = rank_of(estimate), below = above - 1, step = 1;
    for (; below > 0 && cipc_exact_compare_stretch(rest, now, of_rank(below)) >= 0; step *= 2) {
        above = below;
        below = below > step ? below - step : 0;
    }
    for (; above < end && cipc_exact_compare_stretch(rest, now, of_rank(above)) < 0; step *= 2) {
        below = above;
        above = end - above > step ? above + step : end;
    }
    if (above == end) { return estimate; }
    while (above - below > 1) {
        uint64_t middle = below + (above - below) / 2;
        if (cipc_exact_compare_stretch(rest, now, of_rank(middle)) >= 0) {
            above = middle;
        } else {
            below = middle;
        }
    }
    return of_rank(above);
}

/* What one section of the triangles gave. */
typedef struct strain_result {
    double other_ratio; /* largest used part of a lower limit or of one of a Green strain */
    double stretch, ratio; /* as doubles give them */
    int triangle;          /* of the largest stretch; -1: none */
    int ratio_triangle;    /* of the largest ratio; -1: none limited */
    int violating; /* the first violating triangle; -1: none */
    long exact;
} strain_result;

static bool is_violating(const cipc_model *m, int triangle, double limit, const double *x)
{
    double rest[9], now[9];
    cipc_gather(rest, m->rest, m->triangles[triangle], 3);
    cipc_gather(now, x, m->triangles[triangle], 3);
    return cipc_exact_compare_stretch(rest, now, limit) <= 0;
}

/* The three Green strains: decided exactly where doubles cannot tell. The directions are the doubles that were computed for them. */
static void check_strains(strain_result *r, const cipc_monitor *monitor, int t, const double form[3], const double *x)
{
    static const int pairs[3][2] = {{0, 0}, {1, 1}, {0, 1}};
    const cipc_strain_rest *rest = &monitor->rest[t];
    for (int k = 0; k < 3; k++) {
        const double *a = rest->directions[pairs[k][0]], *b = rest->directions[pairs[k][1]], at_rest = k < 2 ? 1 : rest->cosine, limit = rest->strain_limits[k];
        double terms[3] = {a[0] * b[0] * form[0], (a[0] * b[1] + a[1] * b[0]) * form[1], a[1] * b[1] * form[2]};
        double size = fabs(terms[0]) + (fabs(a[0] * b[1]) + fabs(a[1] * b[0])) * sqrt(form[0] * form[2]) + fabs(terms[2]) + at_rest;
        double strain = fabs(0.5 * (terms[0] + terms[1] + terms[2] - at_rest));
        r->other_ratio = fmax(r->other_ratio, strain / limit);
        if (strain + STRAIN_ERROR * size < limit) { continue; }
        double now[9];
        cipc_gather(now, x, monitor->model->triangles[t], 3);
        r->exact++;
        if (cipc_exact_compare_strain(now, a, b, at_rest, limit) <= 0 && r->violating < 0) { r->violating = t; }
    }
}

/* sigma_2 > lower limit. */
static void check_lower(strain_result *r, const cipc_monitor *monitor, int t, const double form[3], double largest, const double *x)
{
    const cipc_strain_rest *rest = &monitor->rest[t];
    double determinant = form[0] * form[2] - form[1] * form[1], at_rest = rest->form[0] * rest->form[2] - rest->form[1] * rest->form[1];
    double least = sqrt(fmax(determinant, 0) / at_rest) / largest;
    r->other_ratio = fmax(r->other_ratio, (1 - least) / (1 - rest->lower));
    if (is_proven(rest, form, rest->lower, -1)) { return; }
    double initial[9], now[9];
    cipc_gather(initial, monitor->model->rest, monitor->model->triangles[t], 3);
    cipc_gather(now, x, monitor->model->triangles[t], 3);
    r->exact++;
    if (cipc_exact_compare_least_stretch(initial, now, rest->lower) <= 0 && r->violating < 0) { r->violating = t; }
}

static void check_triangle(strain_result *r, const cipc_monitor *monitor, int t, const double *x)
{
    const cipc_strain_rest *rest = &monitor->rest[t];
    double e1[3], e2[3], form[3];
    edges_of(x, monitor->model->triangles[t], e1, e2);
    double stretch = sqrt(largest_stretch2(rest, e1, e2));
    if (r->triangle < 0 || stretch > r->stretch) {
        r->stretch = stretch;
        r->triangle = t;
    }
    fundamental_form(form, e1, e2);
    if (rest->lower > 0) { check_lower(r, monitor, t, form, stretch, x); }
    if (rest->strain_limits[0] > 0) { check_strains(r, monitor, t, form, x); }
    if (!(rest->limit > 0)) { return; }
    double ratio = (stretch - 1) / (rest->limit - 1);
    if (r->ratio_triangle < 0 || ratio > r->ratio) {
        r->ratio = ratio;
        r->ratio_triangle = t;
    }
    if (!is_proven(rest, form, rest->limit, 1)) {
        r->exact++;
        if (is_violating(monitor->model, t, rest->limit, x) && r->violating < 0) { r->violating = t; }
    }
}

static strain_result check_section(const cipc_monitor *monitor, int section, const double *x)
{
    strain_result r = {0, 0, 0, -1, -1, -1, 0};
    int first = section * CIPC_MONITOR_SECTION, count = monitor->model->triangle_count;
    int last = first + CIPC_MONITOR_SECTION < count ? first + CIPC_MONITOR_SECTION : count;
    for (int t = first; t < last; t++) {
        if (monitor->rest[t].measured) { check_triangle(&r, monitor, t, x); }
    }
    return r;
}

static strain_result merge(const strain_result *results, int count)
{
    strain_result all = {0, 0, 0, -1, -1, -1, 0};
    for (int i = 0; i < count; i++) {
        const strain_result *r = &results[i];
        if (r->triangle >= 0 && (all.triangle < 0 || r->stretch > all.stretch)) {
            all.stretch = r->stretch;
            all.triangle = r->triangle;
        }
        if (r->ratio_triangle >= 0 && (all.ratio_triangle < 0 || r->ratio > all.ratio)) {
            all.ratio = r->ratio;
            all.ratio_triangle = r->ratio_triangle;
        }
        all.violating = all.violating < 0 ? r->violating : all.violating;
        all.exact += r->exact;
        all.other_ratio = fmax(all.other_ratio, r->other_ratio);
    }
    return all;
}

/* A lower limit, or one of the Green strains. */
static cipc_status fail_other(const cipc_monitor *monitor, int t, const double e1[3], const double e2[3], cipc_error *error)
{
    const cipc_strain_rest *rest = &monitor->rest[t];
    const int *n = monitor->model->triangles[t];
    double form[3], E[3];
    fundamental_form(form, e1, e2);
    for (int k = 0; k < 3; k++) {
        const double *a = rest->directions[k == 1], *b = rest->directions[k > 0];
        E[k] = 0.5 * (a[0] * b[0] * form[0] + (a[0] * b[1] + a[1] * b[0]) * form[1] + a[1] * b[1] * form[2] - (k < 2 ? 1 : rest->cosine));
    }
    const char *body = monitor->model->bodies[monitor->model->triangle_body[t]].name;
    if (rest->strain_limits[0] > 0)
        return cipc_fail(error, CIPC_E_VIOLATED_STRAIN, "monitor strain",
                         "triangle %d (nodes %d %d %d, body \"%s\"): Green strains %.17g, %.17g, %.17g of warp, weft and shear must be smaller than %.17g, %.17g, %.17g", t, n[0], n[1], n[2],
                         body, E[0], E[1], E[2], rest->strain_limits[0], rest->strain_limits[1], rest->strain_limits[2]);
    double largest2 = largest_stretch2(rest, e1, e2), determinant = form[0] * form[2] - form[1] * form[1];
    double least = sqrt(fmax(determinant, 0) / (rest->form[0] * rest->form[2] - rest->form[1] * rest->form[1]) / largest2);
    return cipc_fail(error, CIPC_E_VIOLATED_STRAIN, "monitor strain", "triangle %d (nodes %d %d %d, body \"%s\"): least principal stretch %.17g (%a) must be above the limit %.17g (%a)", t,
                     n[0], n[1], n[2], body, least, least, rest->lower, rest->lower);
}

static cipc_status fail_strain(const cipc_monitor *monitor, int t, const double *x, cipc_error *error)
{
    const cipc_model *m = monitor->model;
    const int *n = m->triangles[t];
    double e1[3], e2[3], limit = monitor->rest[t].limit;
    edges_of(x, n, e1, e2);
    double stretch = stretch_upwards(m, t, x, sqrt(largest_stretch2(&monitor->rest[t], e1, e2)));
    if (!(limit > 0 && is_violating(m, t, limit, x))) { return fail_other(monitor, t, e1, e2, error); }
    return cipc_fail(error, CIPC_E_VIOLATED_STRAIN, "monitor strain",
                     "triangle %d (nodes %d %d %d, body \"%s\"): largest principal stretch %.17g (%a, exact, rounded upwards) must be "
                     "below the limit %.17g (%a)",
                     t, n[0], n[1], n[2], m->bodies[m->triangle_body[t]].name, stretch, stretch, limit, limit);
}

/* What double arithmetic found to be the largest, rounded upwards from its exact value: what is reported below a limit is below it. */
static void fill_report(cipc_invariant_report *report, const strain_result *r, const cipc_monitor *monitor, const double *x)
{
    report->max_stretch = r->triangle >= 0 ? stretch_upwards(monitor->model, r->triangle, x, r->stretch) : 0;
    report->max_stretch_triangle = r->triangle;
    report->max_stretch_ratio = 0;
    if (r->ratio_triangle >= 0) {
        double limit = monitor->rest[r->ratio_triangle].limit, stretch = r->ratio * (limit - 1) + 1;
        report->max_stretch_ratio = fmax(0, (stretch_upwards(monitor->model, r->ratio_triangle, x, stretch) - 1) / (limit - 1));
    }
    /* Where no limit is violated, every one is used by less than all, however that was rounded. */
    double other = r->violating < 0 ? fmin(r->other_ratio, nextafter(1, 0)) : r->other_ratio;
    report->max_stretch_ratio = fmax(report->max_stretch_ratio, other);
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
    return all.violating < 0 ? CIPC_OK : fail_strain(monitor, all.violating, x, error);
}
