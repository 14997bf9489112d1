/* The judge of one answer. It needs no oracle: the vector carries the right numbers and how far off they may be. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/json_number.h"
#include "verify/conformance.h"
#include "verify/two_triangles.h"

/* Of one field: the Hessian of two triangles. */
enum { MOST_NUMBERS = VERIFY_TWO_TRIANGLES_NUMBERS * VERIFY_TWO_TRIANGLES_NUMBERS };

/* Rounding to float instead of double: u is 2^29 times larger, and with it every condition-based tolerance. */
static double factor_of(verify_precision precision) { return precision == VERIFY_BINARY32 ? 0x1p29 : 1; }

static void reject(verify_verdict *v, const char *format, ...)
{
    if (v->failed) return; /* the first reason is enough */
    va_list arguments;
    va_start(arguments, format);
    v->failed = true;
    vsnprintf(v->reason, sizeof v->reason, format, arguments);
    va_end(arguments);
}

/* Read `count` finite numbers: a number alone stands for an array of one. */
static bool read_numbers(const json_t *value, const char *whose, const char *field, int count, double *numbers, verify_verdict *v)
{
    if (value == NULL) {
        reject(v, "%s lacks \"%s\"", whose, field);
        return false;
    }
    bool array = json_is_array(value);
    if (array ? json_array_size(value) != (size_t)count : count != 1) {
        reject(v, "%s \"%s\" has not %d numbers", whose, field, count);
        return false;
    }
    for (int i = 0; i < count; i++) {
        numbers[i] = cipc_json_double(array ? json_array_get(value, (size_t)i) : value);
        if (isnan(numbers[i])) {
            reject(v, "%s \"%s\" holds something that is not a number", whose, field);
            return false;
        }
    }
    return true;
}

/* A field whose wanted numbers and tolerance are in the vector. */
static void judge_numbers(const json_t *entry, const json_t *got, const char *field, double factor, verify_verdict *v)
{
    double want[MOST_NUMBERS], have[MOST_NUMBERS], tolerance;
    const json_t *numbers = json_object_get(entry, "numbers");
    int count = (int)json_array_size(numbers);
    if (count < 1 || count > MOST_NUMBERS || !read_numbers(numbers, "want", field, count, want, v) ||
        !read_numbers(json_object_get(entry, "tolerance"), "want", "tolerance", 1, &tolerance, v)) {
        reject(v, "want \"%s\" is malformed", field);
        return;
    }
    if (!read_numbers(got, "got", field, count, have, v)) return;
    for (int i = 0; i < count; i++) {
        double error = fabs(have[i] - want[i]), ratio = error == 0 ? 0 : error / (tolerance * factor);
        v->ratio = fmax(v->ratio, ratio);
        if (!(ratio <= 1)) reject(v, "%s[%d] is %.17g, not %.17g: off by %.3g, %.3g allowed", field, i, have[i], want[i], error, tolerance * factor);
    }
}

/* f, f', f'' come as one array "f". */
static void judge_scalar(const json_t *want, const json_t *got, double factor, verify_verdict *v)
{
    static const char *const names[3] = {"f0", "f1", "f2"};
    const json_t *f = json_object_get(got, "f");
    if (json_array_size(f) != 3) reject(v, "got lacks \"f\" with three numbers");
    for (int i = 0; i < 3 && !v->failed; i++) judge_numbers(json_object_get(want, names[i]), json_array_get(f, (size_t)i), names[i], factor, v);
}

static bool among(const json_t *set, const char *name)
{
    for (size_t i = 0; i < json_array_size(set); i++) {
        const char *member = json_string_value(json_array_get(set, i));
        if (member != NULL && strcmp(member, name) == 0) return true;
    }
    return false;
}

/* Finite numbers of the right count, whatever they are. */
static void judge_presence(const json_t *got, const char *field, int count, verify_verdict *v)
{
    double have[MOST_NUMBERS];
    if (!read_numbers(got, "got", field, count, have, v)) return;
    for (int i = 0; i < count; i++)
        if (!isfinite(have[i])) reject(v, "%s[%d] is not finite", field, i);
}

/* Is the feature one that attains the minimum, or one so near to it that the arithmetic may confuse them (*border)? */
static bool is_right_feature(const json_t *want, const char *feature, double factor, bool *border)
{
    if (among(json_object_get(want, "features"), feature)) return true;
    const json_t *off = json_object_get(json_object_get(want, "neighbours"), feature);
    *border = off != NULL && cipc_json_double(off) <= factor;
    return *border;
}

/* Value always; derivatives where the vector has them. An answer with a neighbouring feature sits on a border: its derivatives are those of the other side; they must
 * be there, and are not compared. */
static void judge_derivatives(const json_t *want, const json_t *got, int n, double factor, verify_verdict *v)
{
    static const char *const fields[2] = {"gradient", "hessian"};
    const int counts[2] = {n, n * n};
    const char *feature = json_string_value(json_object_get(got, "feature"));
    judge_numbers(json_object_get(want, "value"), json_object_get(got, "value"), "value", factor, v);
    if (json_object_get(want, "features") != NULL) {
        if (feature == NULL) reject(v, "got lacks \"feature\"");
        else if (!is_right_feature(want, feature, factor, &v->other_feature)) reject(v, "feature \"%.16s\" is not among those nearest", feature);
    }
    const json_t *nearest = json_object_get(want, "border"); /* of an assembled potential: of all its pairs */
    if (nearest != NULL && cipc_json_double(nearest) <= factor) v->other_feature = true;
    for (int i = 0; i < 2; i++) {
        const json_t *entry = json_object_get(want, fields[i]);
        judge_presence(json_object_get(got, fields[i]), fields[i], counts[i], v);
        if (entry != NULL && !v->other_feature) judge_numbers(entry, json_object_get(got, fields[i]), fields[i], factor, v);
    }
}

static int numbers_of_stencil(const char *fn)
{
    cipc_pair_kind kind;
    if (verify_function_level(fn) == 4) return verify_query_numbers(fn);
    return verify_query_kind(fn, "distance2_", &kind) ? 3 * cipc_pair_nodes(kind) : 3 * cipc_energy_find(fn + 7)->nodes;
}

/* Past the enclosure is unsafe; before it is early, and may be, but not before the bound of eq. (16), of which a port may lose 2^-9 to rounding. */
static void judge_toi(const json_t *want, const json_t *got, verify_verdict *v)
{
    static const double BOUND_SLACK = 1 - 0x1p-9;
    double toi, hi, least;
    const json_t *hit = json_object_get(got, "hit"), *contact = json_object_get(want, "hit");
    if (!json_is_boolean(contact) || !read_numbers(json_object_get(want, "least"), "want", "least", 1, &least, v)) reject(v, "want is malformed");
    if (!read_numbers(json_object_get(got, "toi"), "got", "toi", 1, &toi, v)) return;
    if (!json_is_boolean(hit)) reject(v, "got lacks \"hit\", true or false");
    if (v->failed) return;
    if (json_is_true(contact)) {
        if (!read_numbers(json_object_get(want, "hi"), "want", "hi", 1, &hi, v)) return;
        if (!json_is_true(hit)) reject(v, "missed: contact at %.17g, and no hit reported", hi);
        if (toi > hi) reject(v, "unsafe: %.17g is past the contact at %.17g", toi, hi);
        v->scored = hi > 0;
        v->score = hi > 0 ? toi / hi : 0;
    } else {
        v->early = json_is_true(hit);
    }
    if (toi < 0 || toi > 1) reject(v, "toi %.17g is not between 0 and 1", toi);
    if (toi < BOUND_SLACK * least) reject(v, "toi %.17g is below the bound of eq. 16, %.17g", toi, least);
}

static void judge_exact(const json_t *want, const json_t *got, const char *field, verify_verdict *v)
{
    const json_t *right = json_object_get(want, field), *have = json_object_get(got, field);
    if (right == NULL) reject(v, "want lacks \"%s\"", field);
    else if (have == NULL) reject(v, "got lacks \"%s\"", field);
    else if (json_is_integer(right) ? cipc_json_double(have) != (double)json_integer_value(right) : !json_equal(right, have)) reject(v, "%s is wrong", field);
}

verify_verdict verify_judge(const char *fn, const json_t *want, const json_t *got, verify_precision precision)
{
    verify_verdict v = {.failed = false};
    cipc_pair_kind kind;
    double factor = factor_of(precision);
    if (!json_is_object(want)) reject(&v, "the vector has no \"want\"");
    else if (!json_is_object(got)) reject(&v, "there is no \"got\"");
    else if (verify_query_kind(fn, "toi_", &kind)) judge_toi(want, got, &v);
    else if (verify_function_level(fn) == 0) judge_scalar(want, got, factor, &v);
    else if (strcmp(fn, "orient3d") == 0) judge_exact(want, got, "sign", &v);
    else if (strcmp(fn, "intersect_edge_triangle") == 0) judge_exact(want, got, "intersects", &v);
    else judge_derivatives(want, got, numbers_of_stencil(fn), factor, &v);
    return v;
}
