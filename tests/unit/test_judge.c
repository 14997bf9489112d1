/* The judge of single answers: right ones pass, and every way to be wrong is told. What streams can do wrong: tests/conformance/check. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "verify/conformance.h"

/* fn, want and got as texts; part of the reason, or NULL: it passes. */
typedef struct trial {
    const char *fn, *want, *got, *reason;
} trial;

static verify_verdict judge(const trial *t, verify_precision precision)
{
    json_t *want = json_loads(t->want, 0, NULL), *got = json_loads(t->got, 0, NULL);
    assert_true(want != NULL && got != NULL);
    verify_verdict v = verify_judge(verify_function_name(t->fn), want, got, precision);
    json_decref(want);
    json_decref(got);
    return v;
}

static void expect(const trial *t)
{
    verify_verdict v = judge(t, VERIFY_BINARY64);
    if (v.failed != (t->reason != NULL) || (v.failed && strstr(v.reason, t->reason) == NULL)) {
        fail_msg("%s %s: %s, wanted %s", t->fn, t->got, v.failed ? v.reason : "passed", t->reason != NULL ? t->reason : "a pass");
    }
}

static void test_numbers(void **state)
{
    (void)state;
    static const char want[] = "{\"f0\": {\"numbers\": [1.0], \"tolerance\": 0.25}, \"f1\": {\"numbers\": [2.0], \"tolerance\": 0}, \"f2\": {\"numbers\": [3], \"tolerance\": 1}}";
    static const trial trials[] = {
        {"barrier", want, "{\"f\": [1, 2, 3]}", NULL},
        {"barrier", want, "{\"f\": [1.25, 2, 4]}", NULL},
        {"barrier", want, "{\"f\": [1.2500001, 2, 3]}", "f0[0]"},
        {"barrier", want, "{\"f\": [1, 2.0000001, 3]}", "f1[0]"},
        {"barrier", want, "{\"f\": [1, 2, \"nan\"]}", "not a number"},
        {"barrier", want, "{\"f\": [1, 2, \"inf\"]}", "f2[0]"},
        {"barrier", want, "{\"f\": [1, 2, null]}", "not a number"},
        {"barrier", want, "{\"f\": [1, 2]}", "three numbers"},
        {"barrier", want, "{}", "lacks \"f\""},
        {"barrier", "{\"f0\": {\"numbers\": []}}", "{\"f\": [1, 2, 3]}", "malformed"},
        {"barrier", "{\"f0\": {\"numbers\": [1], \"tolerance\": \"nan\"}}", "{\"f\": [1, 2, 3]}", "not a number"},
        {"orient3d", "{\"sign\": -1}", "{\"sign\": -1}", NULL},
        {"orient3d", "{\"sign\": -1}", "{\"sign\": -1.0}", NULL},
        {"orient3d", "{\"sign\": -1}", "{\"sign\": 0}", "sign is wrong"},
        {"orient3d", "{\"sign\": -1}", "{\"sing\": -1}", "lacks \"sign\""},
        {"intersect_edge_triangle", "{\"intersects\": true}", "{\"intersects\": true}", NULL},
        {"intersect_edge_triangle", "{\"intersects\": true}", "{\"intersects\": false}", "wrong"},
        {"intersect_edge_triangle", "{\"intersects\": true}", "{\"intersects\": 1}", "wrong"},
    };
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) expect(&trials[i]);
}

/* A tolerance that is no number, or an answer that is one, must not pass by comparing false. */
static void test_nothing_passes_by_nan(void **state)
{
    (void)state;
    const trial infinite = {"barrier", "{\"f0\": {\"numbers\": [\"inf\"], \"tolerance\": 1}}", "{\"f\": [\"inf\", 0, 0]}", "f0[0]"};
    expect(&infinite); /* inf - inf */
}

static void test_single_precision(void **state)
{
    (void)state;
    const trial t = {"barrier", "{\"f0\": {\"numbers\": [1], \"tolerance\": 1e-15}, \"f1\": {\"numbers\": [1], \"tolerance\": 1}, \"f2\": {\"numbers\": [1], \"tolerance\": 1}}",
                     "{\"f\": [1.0000001, 1, 1]}", NULL};
    assert_true(judge(&t, VERIFY_BINARY64).failed);
    assert_false(judge(&t, VERIFY_BINARY32).failed);
}

/* Gradients of 9 numbers and Hessians of 81, as texts. */
#define GRADIENT(second) "[1, " second ", 0, 0, 0, 0, 0, 0, 0]"
#define NINE "0, 0, 0, 0, 0, 0, 0, 0, 0"
#define HESSIAN(first) "[" first ", 0, 0, 0, 0, 0, 0, 0, 0, " NINE ", " NINE ", " NINE ", " NINE ", " NINE ", " NINE ", " NINE ", " NINE "]"

/* A feature of the set, or one so near that rounding may confuse them; then its derivatives must be there, and are not compared. Any other fails. */
static void test_features(void **state)
{
    (void)state;
    static const char want[] = "{\"value\": {\"numbers\": [1], \"tolerance\": 0}, \"features\": [\"p-e0\", \"p-e\"], \"neighbours\": {\"p-e1\": 0.5, \"p-q\": 1000},"
                               " \"gradient\": {\"numbers\": " GRADIENT("2") ", \"tolerance\": 0}}";
#define GOT(value, feature, gradient, hessian) "{\"value\": " value ", \"feature\": \"" feature "\", \"gradient\": " gradient ", \"hessian\": " hessian "}"
    static const trial trials[] = {
        {"distance2_point_edge", want, GOT("1", "p-e", GRADIENT("2"), HESSIAN("5")), NULL},
        {"distance2_point_edge", want, GOT("1", "p-e", GRADIENT("3"), HESSIAN("5")), "gradient[1]"},
        {"distance2_point_edge", want, GOT("1", "p-e1", GRADIENT("7"), HESSIAN("5")), NULL}, /* on the border */
        {"distance2_point_edge", want, GOT("2", "p-e1", GRADIENT("2"), HESSIAN("5")), "value[0]"},
        {"distance2_point_edge", want, GOT("1", "p-e1", "[7, 7]", HESSIAN("5")), "has not 9 numbers"},
        {"distance2_point_edge", want, GOT("1", "p-e1", GRADIENT("\"inf\""), HESSIAN("5")), "not finite"},
        {"distance2_point_edge", want, GOT("1", "p-e", GRADIENT("2"), HESSIAN("\"nan\"")), "not a number"},
        {"distance2_point_edge", want, GOT("1", "p-q", GRADIENT("2"), HESSIAN("5")), "not among those nearest"},
        {"distance2_point_edge", want, GOT("1", "banana", GRADIENT("2"), HESSIAN("5")), "not among those nearest"},
        {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e\"}", "lacks \"gradient\""},
        {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e1\"}", "lacks \"gradient\""},
        {"distance2_point_edge", want, "{\"value\": 1, \"gradient\": " GRADIENT("2") "}", "lacks \"feature\""},
    };
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) expect(&trials[i]);
    assert_true(judge(&trials[2], VERIFY_BINARY64).other_feature && !judge(&trials[0], VERIFY_BINARY64).other_feature);
    const trial in_floats = {"distance2_point_edge", want, GOT("1", "p-q", GRADIENT("2"), HESSIAN("5")), NULL};
    assert_false(judge(&in_floats, VERIFY_BINARY32).failed);
}

static void test_times_of_impact(void **state)
{
    (void)state;
    static const char hit[] = "{\"hit\": true, \"lo\": 0.5, \"hi\": 0.5, \"least\": 0.25}", miss[] = "{\"hit\": false, \"least\": 0.25}";
    static const trial trials[] = {
        {"toi_point_point", hit, "{\"toi\": 0.45, \"hit\": true}", NULL},
        {"toi_point_point", hit, "{\"toi\": 0.5, \"hit\": true}", NULL},
        {"toi_point_point", hit, "{\"toi\": 0.5000001, \"hit\": true}", "unsafe"},
        {"toi_point_point", hit, "{\"toi\": 0.45, \"hit\": false}", "missed"},
        {"toi_point_point", hit, "{\"toi\": 0.2499, \"hit\": true}", NULL},
        {"toi_point_point", hit, "{\"toi\": 0.2, \"hit\": true}", "eq. 16"},
        {"toi_point_point", hit, "{\"toi\": \"nan\", \"hit\": true}", "not a number"},
        {"toi_point_point", hit, "{\"hit\": true}", "lacks \"toi\""},
        {"toi_point_point", hit, "{\"toi\": 0.45}", "lacks \"hit\""},
        {"toi_point_point", miss, "{\"toi\": 1, \"hit\": false}", NULL},
        {"toi_point_point", miss, "{\"toi\": 0.5, \"hit\": true}", NULL},
        {"toi_point_point", miss, "{\"toi\": 0.1, \"hit\": true}", "eq. 16"},
        {"toi_point_point", miss, "{\"toi\": 1.5, \"hit\": false}", "between 0 and 1"},
        {"toi_point_point", "{\"least\": 0}", "{\"toi\": 1, \"hit\": false}", "want is malformed"},
        {"toi_point_point", "[]", "{\"toi\": 1, \"hit\": false}", "no \"want\""},
        {"toi_point_point", miss, "[]", "no \"got\""},
    };
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) expect(&trials[i]);
    const trial early = {"toi_point_point", miss, "{\"toi\": 0.5, \"hit\": true}", NULL};
    assert_true(judge(&early, VERIFY_BINARY64).early);
    assert_true(judge(&trials[0], VERIFY_BINARY64).scored && fabs(judge(&trials[0], VERIFY_BINARY64).score - 0.9) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),  cmocka_unit_test(test_nothing_passes_by_nan), cmocka_unit_test(test_single_precision),
        cmocka_unit_test(test_features), cmocka_unit_test(test_times_of_impact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
