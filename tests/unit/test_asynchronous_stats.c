/* stats.jsonl of the method asynchronous: every field there and back. */
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
#include "support/sample_run.h"

/* A report whose fields all differ. */
static cipc_asynchronous_report sample_report(int step)
{
    cipc_asynchronous_report r = {.total_events = 1000 + step, .activations = 20, .deactivations = 19, .contacts = 3, .max_contacts = 5 + step, .certificates = 70,
                                  .separations = 80, .layers = 2 + step, .min_gap = 1e-4, .smallest_step = 1e-6 / step, .kinetic = 0.5, .gravitational = -0.25, .elastic = 0.125,
                                  .contact = 0.0625};
    r.deepest = (cipc_contact_place){.layers = 2 + step, .kind = CIPC_EDGE_EDGE, .nodes = {7, 8, 9, 10 + step}, .gap = 3e-4, .step = 1e-5};
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) r.events[k] = 100 * step + k;
    for (int q = 0; q < CIPC_QUANTILES; q++) r.vertex_steps[q] = 1e-5 * (q + 1);
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) r.seconds[i] = 0.5 * (i + 1);
    return r;
}

/* A frame and two windows. */
static cipc_step_invariants sample_invariants(void)
{
    cipc_step_invariants v = cipc_step_invariants_none();
    const cipc_invariant_report frame = {.min_gap = 2e-5, .min_gap_nodes = {3, 10, -1, -1}, .exact_gap_checks = 4}, window = {.min_gap = INFINITY, .paths_checked = 8, .exact_path_checks = 1};
    cipc_step_invariants_add_window(&v, &window);
    cipc_step_invariants_add_window(&v, &window);
    cipc_step_invariants_add(&v, &frame);
    return v;
}

static json_t *write_one(const cipc_asynchronous_report *report, const cipc_step_invariants *invariants)
{
    cipc_error error;
    sample_run run = sample_run_create();
    sample_run_advance(&run);
    FILE *file = tmpfile();
    assert_int_equal(cipc_asynchronous_stats_write(file, run.state, report, invariants, &error), CIPC_OK);
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

static void assert_numbers(const json_t *object, size_t size, const char *const *keys, const double *values, size_t count)
{
    assert_int_equal(json_object_size(object), size);
    for (size_t i = 0; i < count; i++) {
        if (number(object, keys[i]) != values[i]) {
            fail_msg("%s is %.17g", keys[i], number(object, keys[i]));
        }
    }
}

static void test_every_field(void **state)
{
    (void)state;
    const cipc_asynchronous_report report = sample_report(1);
    const cipc_step_invariants invariants = sample_invariants();
    json_t *line = write_one(&report, &invariants);
    static const char *const keys[] = {"step", "time", "total_events", "activations", "deactivations", "contacts", "max_contacts", "certificates", "separations", "layers",
                                       "smallest_step", "solver_min_gap", "min_gap", "max_stretch", "max_stretch_triangle", "max_stretch_ratio", "max_segment_stretch", "points_checked",
                                       "windows_checked", "energy_checks", "momentum_checks", "momentum_change", "exact_gap_checks", "exact_strain_checks", "paths_checked",
                                       "exact_path_checks", "pairs_checked", "crossings_checked"};
    const double values[] = {1, 0.01, 1001, 20, 19, 3, 6, 70, 80, 3, 1e-6, 1e-4, 2e-5, 0, -1, 0, 0, 3, 2, 0, 0, 0, 4, 0, 16, 2, 0, 0};
    enum { SCALARS = sizeof keys / sizeof keys[0], OTHERS = 6 }; /* events, deepest, vertex_steps, min_gap_nodes, energy, seconds */
    assert_numbers(line, SCALARS + OTHERS, keys, values, SCALARS);
    static const char *const events[] = {"script", "gravity", "stretching", "bending", "volume", "penalty", "idle_penalty", "slab", "cell"};
    for (int k = 0; k < CIPC_EVENT_COUNT; k++) {
        assert_true(number(json_object_get(line, "events"), events[k]) == 100 + k);
    }
    static const char *const quantiles[] = {"min", "p5", "p25", "median", "p75", "p95", "max"};
    assert_numbers(json_object_get(line, "vertex_steps"), CIPC_QUANTILES, quantiles, report.vertex_steps, CIPC_QUANTILES);
    static const char *const energies[] = {"kinetic", "gravitational", "elastic", "contact", "total"};
    const double joules[] = {0.5, -0.25, 0.125, 0.0625, 0.4375};
    assert_numbers(json_object_get(line, "energy"), 5, energies, joules, 5);
    const json_t *deepest = json_object_get(line, "deepest"), *nodes = json_object_get(deepest, "nodes");
    static const char *const places[] = {"gap", "layers", "step"};
    const double place[] = {3e-4, 3, 1e-5};
    assert_numbers(deepest, 5, places, place, 3);
    assert_string_equal(json_string_value(json_object_get(deepest, "kind")), "edge_edge");
    assert_true(json_array_size(nodes) == 4 && json_integer_value(json_array_get(nodes, 3)) == 11);
    const json_t *seconds = json_object_get(line, "seconds");
    for (int i = 0; i < CIPC_ASYNCHRONOUS_PHASE_COUNT; i++) {
        assert_true(number(seconds, cipc_asynchronous_phase_name((cipc_asynchronous_phase)i)) == 0.5 * (i + 1));
    }
    assert_true(number(seconds, "total") == 0.25 * CIPC_ASYNCHRONOUS_PHASE_COUNT * (CIPC_ASYNCHRONOUS_PHASE_COUNT + 1));
    json_decref(line);
}

static void test_nothing_to_tell(void **state)
{
    (void)state;
    const cipc_asynchronous_report nothing = {.min_gap = INFINITY, .smallest_step = INFINITY};
    json_t *line = write_one(&nothing, NULL);
    assert_true(json_is_null(json_object_get(line, "deepest")));
    assert_string_equal(json_string_value(json_object_get(line, "solver_min_gap")), "inf");
    assert_string_equal(json_string_value(json_object_get(line, "smallest_step")), "inf");
    static const char *const keys[] = {"min_gap", "min_gap_nodes", "points_checked", "windows_checked"}; /* monitors off */
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        assert_true(json_is_null(json_object_get(line, keys[i])));
    }
    json_decref(line);
}

static void write_lines(const path *file, int steps)
{
    sample_run run = sample_run_create();
    FILE *out = fopen(file->text, "w");
    const cipc_step_invariants invariants = sample_invariants();
    for (int i = 1; i <= steps; i++) {
        const cipc_asynchronous_report report = sample_report(i);
        sample_run_advance(&run);
        assert_int_equal(cipc_asynchronous_stats_write(out, run.state, &report, &invariants, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

/* A resumed run's totals are those of a run in one go. */
static void test_lines_read_back_add_up(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    write_lines(&file, 4);
    cipc_run_summary read = cipc_run_summary_default(), added = cipc_run_summary_default();
    read.method = added.method = CIPC_METHOD_ASYNCHRONOUS;
    assert_int_equal(cipc_stats_resume(file.text, 3, &read, &error), CIPC_OK);
    const cipc_step_invariants invariants = sample_invariants();
    for (int i = 1; i <= 3; i++) {
        const cipc_asynchronous_report report = sample_report(i);
        cipc_asynchronous_summary_add(&added, &report, &invariants);
    }
    const cipc_asynchronous_totals *r = &read.asynchronous, *a = &added.asynchronous;
    assert_memory_equal(r->events, a->events, sizeof r->events);
    assert_memory_equal(r->seconds, a->seconds, sizeof r->seconds);
    assert_true(r->total_events == 3006 && r->max_events == 1003 && r->activations == 60 && r->deactivations == 57 && r->events[2] == 606);
    assert_true(r->layers == 5 && r->min_gap == 1e-4 && r->smallest_step == 1e-6 / 3);
    assert_true(r->deepest.layers == 5 && r->deepest.kind == CIPC_EDGE_EDGE && r->deepest.nodes[3] == 13 && r->deepest.gap == 3e-4 && r->deepest.step == 1e-5);
    assert_true(read.max_contacts == 8 && read.points_checked == 9 && read.windows_checked == 6 && read.monitored && read.converged && read.paths_checked == 48);
    assert_true(read.seconds == 3 * 0.25 * CIPC_ASYNCHRONOUS_PHASE_COUNT * (CIPC_ASYNCHRONOUS_PHASE_COUNT + 1));
    cipc_run_summary cut = cipc_run_summary_default();
    cut.method = CIPC_METHOD_ASYNCHRONOUS;
    assert_int_equal(cipc_stats_resume(file.text, 4, &cut, &error), CIPC_E_NOT_RESUMABLE); /* the fourth line is cut off */
    folder_remove(&folder);
}

/* Lines that say nothing, or nonsense, change no total. */
static void test_empty_lines(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    static const char text[] = "{\"step\":1}\n{\"step\":2,\"deepest\":3,\"events\":[],\"seconds\":{\"monitor\":\"nan\"},\"layers\":null}\n"
                               "{\"step\":3,\"deepest\":{\"layers\":2,\"kind\":\"what\",\"nodes\":[1,2,3,4,5,6]},\"layers\":2}\n";
    file_write(&file, text, strlen(text));
    cipc_run_summary s = cipc_run_summary_default();
    s.method = CIPC_METHOD_ASYNCHRONOUS;
    assert_int_equal(cipc_stats_resume(file.text, 3, &s, &error), CIPC_OK);
    assert_true(s.asynchronous.total_events == 0 && s.seconds == 0 && !s.monitored && isinf(s.asynchronous.smallest_step));
    assert_true(s.asynchronous.layers == 2 && s.asynchronous.deepest.nodes[3] == 4);
    folder_remove(&folder);
}

static void test_full_device(void **state)
{
    (void)state;
    cipc_error error;
    sample_run run = sample_run_create();
    const cipc_asynchronous_report report = sample_report(1);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    assert_int_equal(cipc_asynchronous_stats_write(full, run.state, &report, NULL, &error), CIPC_E_IO);
    fclose(full);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_field), cmocka_unit_test(test_nothing_to_tell), cmocka_unit_test(test_lines_read_back_add_up),
        cmocka_unit_test(test_empty_lines), cmocka_unit_test(test_full_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
