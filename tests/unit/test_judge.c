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

/* Another feature passes with the right value, and its derivatives are not compared. */
static void test_features(void **state)
{
    (void)state;
    static const char want[] = "{\"value\": {\"numbers\": [1], \"tolerance\": 0}, \"features\": [\"p-e0\", \"p-e\"], \"gradient\": {\"numbers\": [1,2], \"tolerance\": 0}}";
    const trial right = {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e\", \"gradient\": [1, 2]}", NULL};
    const trial wrong_gradient = {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e\", \"gradient\": [1, 3]}", "gradient[1]"};
    const trial no_gradient = {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e\"}", "lacks \"gradient\""};
    const trial border = {"distance2_point_edge", want, "{\"value\": 1, \"feature\": \"p-e1\", \"gradient\": [7, 7]}", NULL};
    const trial wrong_value = {"distance2_point_edge", want, "{\"value\": 2, \"feature\": \"p-e1\"}", "value[0]"};
    const trial no_feature = {"distance2_point_edge", want, "{\"value\": 1, \"gradient\": [1, 2]}", "lacks \"feature\""};
    expect(&right);
    expect(&wrong_gradient);
    expect(&no_gradient);
    expect(&border);
    expect(&wrong_value);
    expect(&no_feature);
    assert_true(judge(&border, VERIFY_BINARY64).other_feature && !judge(&right, VERIFY_BINARY64).other_feature);
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
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),  cmocka_unit_test(test_nothing_passes_by_nan), cmocka_unit_test(test_single_precision),
        cmocka_unit_test(test_features), cmocka_unit_test(test_times_of_impact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
