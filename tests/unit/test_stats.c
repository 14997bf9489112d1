/* stats.jsonl: every field there and back, and cut to the right length for a resumed run. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/every_kind.h"

/* A report whose fields all differ. */
static cipc_step_report sample_report(int step)
{
    cipc_step_report r = {.converged = true,
                          .newton_iterations = 3 + step,
                          .line_search_halvings = 1,
                          .friction_passes = 2,
                          .factorizations = 4,
                          .symbolic_analyses = 5,
                          .contacts = 6,
                          .max_contacts = 7 + step,
                          .residual = 1.0 / 3,
                          .barrier_stiffness = 1e3,
                          .strain_stiffness_factor = 2,
                          .min_gap = 1e-5,
                          .kinetic = 0.5,
                          .gravitational = -0.25,
                          .elastic = 0.125};
    r.incremental = (cipc_energy_terms){1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 66, 1e-15};
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        r.seconds[i] = 0.5 * (i + 1);
    }
    return r;
}

static cipc_step_invariants sample_invariants(void)
{
    cipc_step_invariants v = cipc_step_invariants_none();
    const cipc_invariant_report report = {.min_gap = 2e-5, .min_gap_nodes = {3, 10, 11, 12}, .max_stretch = 1.05, .max_stretch_triangle = 6,
                                          .max_stretch_ratio = 0.8, .exact_gap_checks = 4, .exact_strain_checks = 5, .paths_checked = 8, .exact_path_checks = 9, .pairs_checked = 60,
                                          .crossings_checked = 7};
    cipc_step_invariants_add(&v, &report);
    v.energy_checks = 1;
    v.momentum_checks = 1;
    v.momentum_change = 1e-12;
    v.max_segment_stretch = 1.25;
    return v;
}

static json_t *write_one(const cipc_step_report *report, const cipc_step_invariants *invariants)
{
    cipc_error error;
    sample_run run = sample_run_create();
    sample_run_advance(&run);
    FILE *file = tmpfile();
    assert_int_equal(cipc_stats_write(file, run.state, report, invariants, &error), CIPC_OK);
    sample_run_destroy(&run);
    char text[8192];
    rewind(file);
    const size_t length = fread(text, 1, sizeof text, file);
    fclose(file);
    assert_in_range(length, 1, sizeof text - 1);
    assert_ptr_equal(memchr(text, '\n', length), text + length - 1); /* one line, ended */
    json_t *line = json_loadb(text, length, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(line);
    return line;
}

static double number(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value)) {
        fail_msg("%s is not a number", key);
    }
    return json_number_value(value);
}

static void test_every_field(void **state)
{
    (void)state;
    const cipc_step_report report = sample_report(0);
    const cipc_step_invariants invariants = sample_invariants();
    json_t *line = write_one(&report, &invariants);
    const struct { const char *key; double value; } expected[] = {
        {"step", 1}, {"time", 0.01}, {"newton_iterations", 3}, {"line_search_halvings", 1}, {"friction_passes", 2}, {"factorizations", 4},
        {"symbolic_analyses", 5}, {"contacts", 6}, {"max_contacts", 7}, {"residual", 1.0 / 3}, {"barrier_stiffness", 1e3},
        {"strain_stiffness_factor", 2}, {"solver_min_gap", 1e-5}, {"min_gap", 2e-5}, {"max_stretch", 1.05}, {"max_stretch_triangle", 6},
        {"max_stretch_ratio", 0.8}, {"max_segment_stretch", 1.25}, {"points_checked", 1}, {"energy_checks", 1}, {"momentum_checks", 1}, {"momentum_change", 1e-12}, {"exact_gap_checks", 4}, {"exact_strain_checks", 5}, {"paths_checked", 8}, {"exact_path_checks", 9},
        {"pairs_checked", 60}, {"crossings_checked", 7},
    };
    enum { SCALARS = sizeof expected / sizeof expected[0], OTHERS = 5 }; /* converged, min_gap_nodes and three objects */
    assert_int_equal(json_object_size(line), SCALARS + OTHERS);
    for (int i = 0; i < SCALARS; i++) {
        if (number(line, expected[i].key) != expected[i].value) {
            fail_msg("%s is %.17g", expected[i].key, number(line, expected[i].key));
        }
    }
    assert_true(json_is_true(json_object_get(line, "converged")));
    const json_t *nodes = json_object_get(line, "min_gap_nodes");
    assert_int_equal(json_array_size(nodes), 4);
    assert_int_equal(json_integer_value(json_array_get(nodes, 1)), 10);

    const json_t *energy = json_object_get(line, "energy");
    assert_true(number(energy, "kinetic") == 0.5 && number(energy, "gravitational") == -0.25 && number(energy, "elastic") == 0.125);
    assert_true(number(energy, "total") == 0.375);
    const json_t *terms = json_object_get(line, "incremental_potential");
    static const char *const names[] = {"inertia", "membrane", "bending", "strain_limit", "barrier", "friction", "penalty", "damping", "stretching", "volume", "stitches"};
    for (int i = 0; i < 11; i++) {
        assert_true(number(terms, names[i]) == i + 1);
    }
    assert_true(number(terms, "total") == 66 && number(terms, "noise") == 1e-15);
    const json_t *seconds = json_object_get(line, "seconds");
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        assert_true(number(seconds, cipc_phase_name((cipc_phase)i)) == 0.5 * (i + 1));
    }
    assert_true(number(seconds, "total") == 0.25 * CIPC_PHASE_COUNT * (CIPC_PHASE_COUNT + 1));
    json_decref(line);
}

static void test_values_that_json_has_no_number_for(void **state)
{
    (void)state;
    cipc_step_report report = sample_report(0);
    cipc_step_invariants invariants = cipc_step_invariants_none();
    report.residual = NAN;
    report.kinetic = -INFINITY;
    json_t *line = write_one(&report, &invariants);
    assert_string_equal(json_string_value(json_object_get(line, "residual")), "nan");
    assert_string_equal(json_string_value(json_object_get(line, "min_gap")), "inf"); /* no pair within reach */
    assert_string_equal(json_string_value(json_object_get(json_object_get(line, "energy"), "kinetic")), "-inf");
    assert_true(json_is_null(json_object_get(line, "min_gap_nodes")));
    json_decref(line);
}

static void test_without_monitors_fields_are_null(void **state)
{
    (void)state;
    const cipc_step_report report = sample_report(0);
    json_t *line = write_one(&report, NULL);
    static const char *const keys[] = {"min_gap", "min_gap_nodes", "max_stretch", "points_checked", "exact_gap_checks"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        assert_true(json_is_null(json_object_get(line, keys[i])));
    }
    assert_true(number(line, "solver_min_gap") == 1e-5);
    json_decref(line);
}

static void test_worst_of_several_points(void **state)
{
    (void)state;
    cipc_step_invariants v = cipc_step_invariants_none();
    assert_true(isinf(v.worst.min_gap) && v.points == 0);
    const cipc_invariant_report a = {
        .min_gap = 3e-5, .min_gap_nodes = {1, 2, 3, 4}, .max_stretch = 1.2, .max_stretch_triangle = 1, .exact_gap_checks = 1};
    const cipc_invariant_report b = {.min_gap = 1e-5, .min_gap_nodes = {5, 6, 7, 8}, .max_stretch = 1.1, .max_stretch_triangle = 2,
                                     .max_stretch_ratio = 0.5, .exact_gap_checks = 2, .min_gap_kind = CIPC_EDGE_EDGE};
    cipc_step_invariants_add(&v, &a);
    cipc_step_invariants_add(&v, &b);
    cipc_step_invariants_add(&v, &a);
    assert_int_equal(v.points, 3);
    assert_true(v.worst.min_gap == 1e-5 && v.worst.min_gap_nodes[0] == 5 && v.worst.min_gap_kind == CIPC_EDGE_EDGE);
    assert_true(v.worst.max_stretch == 1.2 && v.worst.max_stretch_triangle == 1 && v.worst.max_stretch_ratio == 0.5);
    assert_int_equal(v.worst.exact_gap_checks, 4);
}

/* The strand's middle segment, twice as long: of fixed needles nothing is said, of no segments 0. */
static void test_stretch_of_segments(void **state)
{
    (void)state;
    sample_run run = every_kind_create_all(), shells = sample_run_create();
    cipc_step_invariants v = cipc_step_invariants_none();
    double *x = run.state->position;
    cipc_step_invariants_add_segments(&v, run.model, x);
    assert_true(v.max_segment_stretch == 1);
    x[3 * 15] -= 10; /* an end of a needle */
    for (int n = 6; n < 8; n++) {
        x[3 * n] += 0.3; /* nodes 5 and 6 are (0.3, 0, 0.3) apart */
        x[3 * n + 2] += 0.3;
    }
    cipc_step_invariants_add_segments(&v, run.model, x);
    const double rounding = 1e-15;
    assert_true(fabs(v.max_segment_stretch - 2) < 4 * rounding);
    cipc_step_invariants_add_segments(&v, run.model, run.model->rest); /* the largest stays */
    assert_true(fabs(v.max_segment_stretch - 2) < 4 * rounding);
    v = cipc_step_invariants_none();
    cipc_step_invariants_add_segments(&v, shells.model, shells.state->position);
    assert_true(v.max_segment_stretch == 0);
    sample_run_destroy(&run);
    sample_run_destroy(&shells);
}

static void test_full_device(void **state)
{
    (void)state;
    cipc_error error;
    sample_run run = sample_run_create();
    const cipc_step_report report = sample_report(0);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    assert_int_equal(cipc_stats_write(full, run.state, &report, NULL, &error), CIPC_E_IO);
    assert_non_null(strstr(error.what, "No space left"));
    fclose(full);
    sample_run_destroy(&run);
}

/* ---- Resuming ------------------------------------------------------------------------------------------------------------- */

static void write_lines(const path *file, int steps, bool monitored)
{
    sample_run run = sample_run_create();
    FILE *out = fopen(file->text, "w");
    const cipc_step_invariants invariants = sample_invariants();
    for (int i = 1; i <= steps; i++) {
        const cipc_step_report report = sample_report(i);
        sample_run_advance(&run);
        assert_int_equal(cipc_stats_write(out, run.state, &report, monitored ? &invariants : NULL, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

static void test_cut_keeps_the_bytes_and_adds_up(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    write_lines(&file, 3, true);
    char *three = file_read(&file, NULL);
    write_lines(&file, 5, true);
    cipc_run_summary summary = cipc_run_summary_default();
    assert_int_equal(cipc_stats_resume(file.text, 3, &summary, &error), CIPC_OK);
    char *kept = file_read(&file, NULL);
    assert_string_equal(kept, three);
    assert_int_equal(summary.newton_iterations, 4 + 5 + 6);
    assert_int_equal(summary.max_newton_iterations, 6);
    assert_int_equal(summary.max_contacts, 10);
    assert_int_equal(summary.factorizations, 12);
    assert_int_equal(summary.points_checked, 3);
    assert_int_equal(summary.energy_checks, 3);
    assert_int_equal(summary.exact_strain_checks, 15);
    assert_true(summary.monitored && summary.converged);
    assert_true(summary.min_gap == 2e-5 && summary.max_stretch == 1.05 && summary.max_stretch_ratio == 0.8);
    assert_true(summary.max_segment_stretch == 1.25);
    assert_true(summary.seconds_by_phase[0] == 1.5);
    assert_true(summary.seconds == 3 * 0.25 * CIPC_PHASE_COUNT * (CIPC_PHASE_COUNT + 1));
    free(three);
    free(kept);
    folder_remove(&folder);
}

/* A killed run leaves half a line; it is of a step that has no frame. */
static void test_broken_last_line_is_cut(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    size_t size;
    write_lines(&file, 3, true);
    char *text = file_read(&file, &size);
    file_write(&file, text, size - 20);
    cipc_run_summary summary = cipc_run_summary_default();
    assert_int_equal(cipc_stats_resume(file.text, 3, &summary, &error), CIPC_E_NOT_RESUMABLE);
    assert_non_null(strstr(error.what, "step 3"));
    char *untouched = file_read(&file, NULL);
    assert_memory_equal(untouched, text, size - 20);
    free(untouched);
    summary = cipc_run_summary_default();
    assert_int_equal(cipc_stats_resume(file.text, 2, &summary, &error), CIPC_OK);
    assert_int_equal(summary.points_checked, 2);
    free(text);
    folder_remove(&folder);
}

static void test_unmonitored_steps_are_remembered(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    write_lines(&file, 2, false);
    cipc_run_summary summary = cipc_run_summary_default();
    assert_int_equal(cipc_stats_resume(file.text, 2, &summary, &error), CIPC_OK);
    assert_false(summary.monitored);
    assert_int_equal(summary.points_checked, 0);
    folder_remove(&folder);
}

static void test_missing_file(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    cipc_run_summary summary = cipc_run_summary_default();
    assert_int_equal(cipc_stats_resume(file.text, 1, &summary, &error), CIPC_E_NOT_RESUMABLE);
    assert_false(file_exists(&file));
    assert_int_equal(cipc_stats_resume(file.text, 0, &summary, &error), CIPC_OK); /* nothing is missing yet */
    assert_true(file_exists(&file));
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_field),
        cmocka_unit_test(test_values_that_json_has_no_number_for),
        cmocka_unit_test(test_without_monitors_fields_are_null),
        cmocka_unit_test(test_worst_of_several_points),
        cmocka_unit_test(test_stretch_of_segments),
        cmocka_unit_test(test_full_device),
        cmocka_unit_test(test_cut_keeps_the_bytes_and_adds_up),
        cmocka_unit_test(test_broken_last_line_is_cut),
        cmocka_unit_test(test_unmonitored_steps_are_remembered),
        cmocka_unit_test(test_missing_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
