/* stats.jsonl of the method mass-spring: every field there and back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cipc/output.h"
#include "support/sample_run.h"

/* A report whose fields all differ. */
static cipc_massspring_report sample_report(int step)
{
    return (cipc_massspring_report){.substeps = 10 + step, .substep = 1e-4, .contacts = 20 + step, .hits = 30 + step, .arrivals = 15 + step, .iterations = 60, .self_contacts = 5 - step, .sweeps = 7, .beyond_bound = 8, .inside = 6 - step,
                                    .deformation = 0.0625 * step, .kinetic = 0.5, .gravitational = -0.25, .elastic = 0.125, .reversals = 9};
}
static const cipc_massspring_times times = {.frame = 0.5, .step = 0.25, .monitor = 0.125};

/* From the second frame on they intersect, the third is too near. */
static cipc_step_invariants sample_invariants(int step)
{
    cipc_step_invariants seen = cipc_step_invariants_none();
    const cipc_invariant_report point = {.min_gap = 1e-3};
    cipc_step_invariants_add(&seen, &point);
    seen.counted = true;
    seen.intersects = step >= 2;
    seen.too_near = step == 3;
    return seen;
}

static void write_lines(const path *file, int steps, bool monitored)
{
    sample_run run = sample_run_create();
    FILE *out = fopen(file->text, "w");
    assert_non_null(out);
    for (int i = 1; i <= steps; i++) {
        const cipc_massspring_report report = sample_report(i);
        const cipc_step_invariants invariants = sample_invariants(i);
        sample_run_advance(&run);
        assert_int_equal(cipc_massspring_stats_write(out, run.state, &report, &times, monitored ? &invariants : NULL, NULL), CIPC_OK);
    }
    fclose(out);
    sample_run_destroy(&run);
}

static json_t *last_line(const path *file)
{
    FILE *in = fopen(file->text, "r");
    json_t *line = NULL, *next;
    while ((next = json_loadf(in, JSON_DISABLE_EOF_CHECK, NULL)) != NULL) {
        json_decref(line);
        line = next;
    }
    fclose(in);
    return line;
}

static double number(const json_t *object, const char *key) { return json_number_value(json_object_get(object, key)); }

static void test_every_field(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    write_lines(&file, 2, true);
    json_t *line = last_line(&file);
    const json_t *energy = json_object_get(line, "energy"), *seconds = json_object_get(line, "seconds");
    assert_true(number(line, "step") == 2 && number(line, "substeps") == 12 && number(line, "substep") == 1e-4 && number(line, "contacts") == 22);
    assert_true(number(line, "hits") == 32 && number(line, "bisection_iterations") == 60 && number(line, "self_contacts") == 3 && number(line, "sweeps") == 7);
    assert_true(number(line, "arrivals") == 17 && number(line, "beyond_bound") == 8 && number(line, "inside") == 4);
    assert_true(number(line, "deformation") == 0.125 && number(line, "reversals") == 9 && number(line, "min_gap") == 1e-3);
    assert_true(json_is_true(json_object_get(line, "intersects")) && json_is_false(json_object_get(line, "too_near")));
    assert_true(number(energy, "kinetic") == 0.5 && number(energy, "gravitational") == -0.25 && number(energy, "elastic") == 0.125 && number(energy, "total") == 0.375);
    assert_true(number(seconds, "step") == 0.25 && number(seconds, "monitor") == 0.125 && number(seconds, "total") == 0.375);
    assert_true(number(line, "real_time_factor") == 2);
    json_decref(line);
    write_lines(&file, 1, false);
    line = last_line(&file);
    assert_true(json_is_null(json_object_get(line, "intersects")) && json_is_null(json_object_get(line, "too_near")) && json_is_null(json_object_get(line, "min_gap")));
    json_decref(line);
    folder_remove(&folder);
}

static void test_lines_read_back_add_up(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    write_lines(&file, 4, true);
    cipc_run_summary read = cipc_run_summary_default();
    read.method = CIPC_METHOD_MASS_SPRING;
    assert_int_equal(cipc_stats_resume(file.text, 3, &read, &error), CIPC_OK);
    const cipc_massspring_totals *t = &read.massspring;
    assert_true(t->frames == 3 && t->intersecting.frames == 2 && t->intersecting.first_step == 2 && t->too_near.frames == 1 && t->too_near.first_step == 3);
    assert_true(t->substeps == 36 && t->hits == 96 && t->iterations == 180 && t->sweeps == 21 && t->reversals == 27 && t->max_self_contacts == 4);
    assert_true(t->arrivals == 51 && t->beyond_bound == 24 && t->max_inside == 5);
    assert_true(t->max_deformation == 0.1875 && t->frame_seconds == 1.5 && t->step_seconds == 0.75 && t->monitor_seconds == 0.375);
    assert_true(read.max_contacts == 23 && read.points_checked == 3 && read.monitored && read.converged && read.seconds == 1.125 && read.min_gap == 1e-3);
    write_lines(&file, 2, false);
    read = cipc_run_summary_default();
    read.method = CIPC_METHOD_MASS_SPRING;
    assert_int_equal(cipc_stats_resume(file.text, 2, &read, &error), CIPC_OK);
    assert_true(!read.monitored && read.massspring.frames == 0 && read.massspring.substeps == 23);
    folder_remove(&folder);
}

/* Lines that say nothing, or nonsense, change no total. */
static void test_empty_lines(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "stats.jsonl");
    static const char text[] = "{\"step\":1}\n{\"step\":2,\"seconds\":{\"step\":\"nan\",\"monitor\":\"inf\"},\"real_time_factor\":null,\"hits\":null,\"intersects\":3}\n";
    file_write(&file, text, strlen(text));
    cipc_run_summary s = cipc_run_summary_default();
    s.method = CIPC_METHOD_MASS_SPRING;
    assert_int_equal(cipc_stats_resume(file.text, 2, &s, &error), CIPC_OK);
    assert_true(s.seconds == 0 && s.massspring.hits == 0 && s.massspring.frames == 0 && s.massspring.frame_seconds == 0 && !s.monitored);
    folder_remove(&folder);
}

static void test_full_device(void **state)
{
    (void)state;
    cipc_error error;
    sample_run run = sample_run_create();
    const cipc_massspring_report report = sample_report(1);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    assert_int_equal(cipc_massspring_stats_write(full, run.state, &report, &times, NULL, &error), CIPC_E_IO);
    fclose(full);
    sample_run_destroy(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_field), cmocka_unit_test(test_lines_read_back_add_up), cmocka_unit_test(test_empty_lines), cmocka_unit_test(test_full_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
