/* The right answers to queries, with the tolerance that goes with each number: what a judge needs to know without an oracle. */
#include <math.h>
#include <string.h>

#include "base/json_number.h"
#include "verify/condition.h"
#include "verify/conformance.h"
#include "verify/truth.h"
#include "verify/two_triangles.h"

void verify_put_numbers(json_t *want, const char *key, const double *values, int count, double tolerance, bool *good)
{
    json_t *entry = json_object();
    *good = *good && entry != NULL && isfinite(tolerance);
    cipc_json_put(entry, "numbers", verify_numbers_json(values, count), good);
    cipc_json_put(entry, "tolerance", cipc_json_number(tolerance), good);
    cipc_json_put(want, key, entry, good);
}

/* Scalars: the condition of f, f', f'' in their argument and in D/Dhat and the like: u (|f| + |f'| |x|) and so on; f''' x is estimated by |f''| x over the
 * distance to the nearer end of the range, at most the argument's own size. */
static bool scalar_truth(const cipc_query *q, json_t *want)
{
    double f[3], reach = fabs(q->x[0]), u = VERIFY_ROUNDINGS * VERIFY_UNIT;
    bool good = true;
    if (cipc_oracle_scalar(q->fn, q->x[0], q->x + 1, f) != CIPC_YES) return false;
    double nearer = strcmp(q->fn, "strain_limit_barrier") == 0 ? fmin(fabs(q->x[1] - q->x[0]), fabs(q->x[0] - q->x[2])) : fmin(reach, fabs(q->x[1] - q->x[0]));
    double sharpness = nearer > 0 ? reach / nearer : 1 / VERIFY_UNIT;
    const double tolerance[3] = {u * (fabs(f[0]) * (1 + sharpness) + fabs(f[1]) * reach), u * (fabs(f[1]) * (1 + sharpness) + fabs(f[2]) * reach),
                                 u * fabs(f[2]) * (2 + 2 * sharpness)};
    static const char *const names[3] = {"f0", "f1", "f2"};
    for (int i = 0; i < 3; i++) verify_put_numbers(want, names[i], &f[i], 1, tolerance[i], &good);
    return good;
}

static double size_of(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, n > 3 ? fabs(x[i] - x[i % 3]) : fabs(x[i]));
    return most;
}

/* Gradient and Hessian of an oracle function with tolerances (2), (3) of docs/theory/tolerances.md; the Hessian only where doubles determine it. */
typedef struct derivatives {
    double value, g[12], H[144];
    verify_tolerances tolerance; /* the Hessian's INFINITY: not determined */
} derivatives;

static bool differentiate(const cipc_oracle_function *f, const double *x, const double *fields, derivatives *d)
{
    int n = 3 * f->nodes;
    double size = size_of(x, n);
    if (cipc_oracle_evaluate(f, x, fields, &d->value, d->g, d->H) != CIPC_YES) return false;
    d->tolerance = verify_tolerances_of(d->value, d->g, d->H, n, size, verify_hessian_change(f, x, fields, d->g, d->H, size, 0x5a3c96));
    verify_add_matrix_rounding(&d->tolerance, f, x, fields, d->H);
    return true;
}

/* The oracle's functions of the flats of a feature. */
static const char *const flat_names[CIPC_PAIR_KIND_COUNT] = {"distance2_point_point", "distance2_point_line", "distance2_point_plane", "distance2_line_line"};

/* Tolerance e of d (4). */
static double distance_tolerance(cipc_pair_kind kind, const double *x) { return 2 * VERIFY_DISTANCE_ULPS * VERIFY_UNIT * size_of(x, 3 * cipc_pair_nodes(kind)); }

/* How far the distance of feature i's flats is from d, in units of e; INFINITY: there are no such flats. */
static double neighbour_off(cipc_pair_kind kind, const double *x, int i, double d, double e)
{
    cipc_feature feature = cipc_feature_at(kind, i);
    double y[12], value;
    for (int k = 0; k < feature.count; k++) memcpy(y + 3 * k, x + 3 * feature.local[k], 3 * sizeof *y);
    if (!(e > 0) || cipc_oracle_evaluate(cipc_oracle_function_find(flat_names[feature.kind]), y, NULL, &value, NULL, NULL) != CIPC_YES) return INFINITY;
    return fabs(sqrt(value) - d) / e;
}

double verify_nearest_border(cipc_pair_kind kind, const double *x, unsigned features)
{
    double d = sqrt(cipc_exact_distance2(kind, x, NULL)), e = distance_tolerance(kind, x), nearest = INFINITY;
    if ((features & (features - 1)) != 0) return 0;
    for (int i = 0; i < cipc_feature_count(kind); i++)
        if (!(features >> i & 1)) nearest = fmin(nearest, neighbour_off(kind, x, i, d, e));
    return nearest;
}

/* Features beside those that attain the minimum whose own flats are at nearly its distance: how far off they are, in units of the tolerance e of d. Written as far as
 * a port in floats may confuse them. */
static json_t *neighbours(const cipc_query *q, cipc_pair_kind kind, unsigned features, double d, double e, bool *good)
{
    json_t *object = json_object();
    for (int i = 0; i < cipc_feature_count(kind); i++) {
        if (features >> i & 1) continue;
        double off = neighbour_off(kind, q->x, i, d, e);
        if (off <= 0x1p29) cipc_json_put(object, cipc_feature_name(kind, i), cipc_json_number(off), good);
    }
    return object;
}

/* All features that attain the minimum; derivatives if there is only one. The value's tolerance is (4) squared: (d + e)^2 - d^2, e = 4 ULP of the size. */
static bool distance_truth(const cipc_query *q, cipc_pair_kind kind, json_t *want)
{
    int n = 3 * cipc_pair_nodes(kind), only = -1;
    unsigned features;
    bool good = true;
    double d2 = cipc_exact_distance2(kind, q->x, &features), e = distance_tolerance(kind, q->x);
    json_t *set = json_array();
    verify_put_numbers(want, "value", &d2, 1, (2 * sqrt(d2) + e) * e + VERIFY_UNIT * d2, &good);
    for (int i = 0; i < cipc_feature_count(kind); i++) {
        if (!(features >> i & 1)) continue;
        only = only == -1 ? i : -2;
        good = good && json_array_append_new(set, json_string(cipc_feature_name(kind, i))) == 0;
    }
    cipc_json_put(want, "features", set, &good);
    cipc_json_put(want, "neighbours", neighbours(q, kind, features, sqrt(d2), e, &good), &good);
    if (only >= 0) {
        cipc_feature feature = cipc_feature_at(kind, only);
        double y[12], g[12], H[144];
        derivatives d;
        for (int i = 0; i < feature.count; i++) memcpy(y + 3 * i, q->x + 3 * feature.local[i], 3 * sizeof *y);
        if (!differentiate(cipc_oracle_function_find(flat_names[feature.kind]), y, NULL, &d)) return good;
        verify_scatter(&feature, n, d.g, d.H, g, H);
        verify_put_numbers(want, "gradient", g, n, d.tolerance.gradient, &good);
        if (isfinite(d.tolerance.hessian)) verify_put_numbers(want, "hessian", H, n * n, d.tolerance.hessian, &good);
    }
    return good;
}

static bool energy_truth(const cipc_query *q, json_t *want)
{
    const cipc_oracle_function *f = cipc_oracle_function_find(q->fn + 7);
    int n = 3 * f->nodes;
    derivatives d;
    bool good = true;
    if (!differentiate(f, q->x, q->params, &d)) return false;
    verify_put_numbers(want, "value", &d.value, 1, d.tolerance.value, &good);
    verify_put_numbers(want, "gradient", d.g, n, d.tolerance.gradient, &good);
    if (isfinite(d.tolerance.hessian)) verify_put_numbers(want, "hessian", d.H, n * n, d.tolerance.hessian, &good);
    return good;
}

/* The enclosure of the impact, and eq. (16): no answer need be below (1 - s)(d - xi)/l_p. */
static bool toi_truth(const cipc_query *q, cipc_pair_kind kind, json_t *want)
{
    cipc_stencil_path path;
    bool good = true;
    verify_query_path(q, kind, &path);
    cipc_exact_impact impact = cipc_exact_toi(&path, q->thickness, 1);
    if (impact.verdict == CIPC_INDETERMINATE) return false;
    bool close = impact.verdict == CIPC_YES && impact.hi == 0;
    double least = close ? 0 : verify_least_time(&path, cipc_exact_distance_gap(kind, q->x, q->thickness), q->scale);
    cipc_json_put(want, "hit", json_boolean(impact.verdict == CIPC_YES), &good);
    if (impact.verdict == CIPC_YES) {
        cipc_json_put(want, "lo", cipc_json_number(impact.lo), &good);
        cipc_json_put(want, "hi", cipc_json_number(impact.hi), &good);
    }
    cipc_json_put(want, "least", cipc_json_number(least), &good);
    return good;
}

json_t *verify_truth(const cipc_query *q)
{
    cipc_pair_kind kind;
    json_t *want = json_object();
    bool good = want != NULL;
    if (verify_query_kind(q->fn, "toi_", &kind)) {
        good = good && toi_truth(q, kind, want);
    } else if (verify_query_kind(q->fn, "distance2_", &kind)) {
        good = good && distance_truth(q, kind, want);
    } else if (verify_function_level(q->fn) == 2) {
        good = good && energy_truth(q, want);
    } else if (verify_function_level(q->fn) == 4) {
        good = good && verify_two_triangles_truth(q, want);
    } else if (verify_function_level(q->fn) == 0) {
        good = good && scalar_truth(q, want);
    } else if (strcmp(q->fn, "orient3d") == 0) {
        cipc_json_put(want, "sign", json_integer(cipc_exact_orientation(q->x, q->x + 3, q->x + 6, q->x + 9)), &good);
    } else {
        cipc_json_put(want, "intersects", json_boolean(cipc_exact_edge_triangle(q->x, q->x + 6) == CIPC_YES), &good);
    }
    if (!good) json_decref(want);
    return good ? want : NULL;
}
