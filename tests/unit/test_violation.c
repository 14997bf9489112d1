/* violation.json: what the monitors found, complete. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <string.h>

#include "cipc/output.h"
#include "support/sample_run.h"

static void test_fields(void **state)
{
    (void)state;
    cipc_error error, violation;
    const path folder = folder_make(), file = path_in(&folder, "violation.json");
    const double x[3] = {0, 0, 0};
    const cipc_accepted_point point = {
        .x = x, .step = 4, .iteration = 2, .energy_valid = true, .energy_before = 2, .energy_after = NAN, .energy_noise = 1e-9};
    const cipc_invariant_report report = {
        .min_gap = -1e-7, .min_gap_nodes = {5, 9, -1, -1}, .max_stretch = 1.01, .max_stretch_triangle = 3};
    cipc_fail(&violation, CIPC_E_VIOLATED_GAP, "step 5", "node 5 is too near");
    assert_int_equal(cipc_violation_write(file.text, &point, 0.04, &report, &violation, &error), CIPC_OK);
    json_t *o = json_load_file(file.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(o);
    const char *status, *where, *what, *after, *kind;
    int number, steps, iteration, comparable, a, b;
    double time, before, noise, gap;
    assert_int_equal(json_unpack(o, "{s:s, s:i, s:s, s:s, s:i, s:i, s:F, s:{s:b, s:F, s:s, s:F}, s:{s:F, s:[ii!], s:s}}", "status", &status,
                                 "number", &number, "where", &where, "what", &what, "steps_taken", &steps, "iteration", &iteration,
                                 "time_before", &time, "energy", "comparable", &comparable, "before", &before, "after", &after, "noise",
                                 &noise, "report", "min_gap", &gap, "min_gap_nodes", &a, &b, "min_gap_kind", &kind),
                     0);
    assert_string_equal(status, "VIOLATED_GAP");
    assert_int_equal(number, 3002);
    assert_string_equal(where, "step 5");
    assert_string_equal(what, "node 5 is too near");
    assert_string_equal(after, "nan");
    assert_true(steps == 4 && iteration == 2 && time == 0.04 && comparable && before == 2 && noise == 1e-9);
    assert_true(gap == -1e-7 && a == 5 && b == 9);
    assert_string_equal(kind, "point_point");
    json_decref(o);
    assert_int_equal(cipc_violation_write(file.text, &point, 0.04, NULL, &violation, &error), CIPC_OK);
    o = json_load_file(file.text, 0, NULL);
    assert_true(json_is_null(json_object_get(o, "report")));
    json_decref(o);
    assert_int_equal(cipc_violation_write("/no/such/folder/v.json", &point, 0.04, NULL, &violation, &error), CIPC_E_IO);
    folder_remove(&folder);
}

static void test_of_the_method_asynchronous(void **state)
{
    (void)state;
    cipc_error error, violation;
    const path folder = folder_make(), file = path_in(&folder, "violation.json");
    const double window[2] = {0.05, 0.0625};
    cipc_fail(&violation, CIPC_E_VIOLATED_SWEPT, "step 2", "node 5 passes");
    assert_int_equal(cipc_asynchronous_violation_write(file.text, 1, 0.04, window, NULL, &violation, &error), CIPC_OK);
    json_t *o = json_load_file(file.text, JSON_REJECT_DUPLICATES, NULL);
    const char *status, *where, *what;
    int number, steps;
    double time, begin, end;
    assert_int_equal(json_unpack_ex(o, NULL, JSON_STRICT, "{s:s, s:i, s:s, s:s, s:i, s:F, s:{s:F, s:F}, s:n}", "status", &status, "number", &number, "where", &where, "what", &what,
                                    "steps_taken", &steps, "time_before", &time, "window", "begin", &begin, "end", &end, "report"), 0);
    assert_string_equal(status, "VIOLATED_SWEPT");
    assert_string_equal(what, "node 5 passes");
    assert_true(number == 3005 && steps == 1 && time == 0.04 && begin == 0.05 && end == 0.0625);
    json_decref(o);
    assert_int_equal(cipc_asynchronous_violation_write("/no/such/folder/v.json", 1, 0.04, window, NULL, &violation, &error), CIPC_E_IO);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fields), cmocka_unit_test(test_of_the_method_asynchronous)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
