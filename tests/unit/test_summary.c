/* summary.json: fields, and the verdicts that a run may claim. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <string.h>

#include "cipc/output.h"
#include "support/every_kind.h"

static cipc_run_summary good_run(void)
{
    cipc_run_summary s = cipc_run_summary_default();
    s.scene_path = "scenes/drape.json";
    s.scene_name = "drape";
    s.scene_size = "ci";
    s.command = "cipc run scenes/drape.json";
    s.steps_asked = s.steps_taken = 4;
    s.time = 0.04;
    s.points_checked = 10;
    s.energy_checks = 9;
    s.swept = true;
    s.limited_triangles = 100;
    s.min_gap = 1e-5;
    s.max_stretch = 1.05;
    s.seconds = 8;
    s.seconds_by_phase[CIPC_PHASE_MONITOR] = 2;
    s.seed = 7;
    s.threads = 2;
    s.peak_memory_kb = 4096;
    return s;
}

static void assert_verdicts(const cipc_run_summary *s, const char *expected)
{
    char text[9] = {0};
    for (int i = 1; i <= 8; i++) {
        const char *verdict = cipc_run_summary_verdict(s, i);
        text[i - 1] = strcmp(verdict, "holds") == 0         ? 'h'
                      : strcmp(verdict, "violated") == 0    ? 'v'
                      : strcmp(verdict, "not checked") == 0 ? '-'
                                                            : '?';
    }
    assert_string_equal(text, expected);
}

static void test_verdicts_of_good_runs(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    assert_verdicts(&s, "hhh-hh-h"); /* no step for M7, no tetrahedra for M4 */
    s.momentum_checks = 4;
    assert_verdicts(&s, "hhh-hhhh");
    s.momentum_checks = 0;
    s.tetrahedra = 1;
    assert_verdicts(&s, "hhhhhh-h");
    s.limited_triangles = 0;
    assert_verdicts(&s, "hh-hhh-h");
    s.energy_checks = 0;
    assert_verdicts(&s, "hh-hh--h");
    s.swept = false;
    assert_verdicts(&s, "hh-h---h");
    s.points_checked = 0;
    assert_verdicts(&s, "--------");
    s = good_run();
    s.monitored = false; /* one step without is enough */
    assert_verdicts(&s, "--------");
    s = good_run();
    s.status = CIPC_E_NOT_CONVERGED; /* what was seen was seen */
    assert_verdicts(&s, "hhh-hh-h");
}

static void test_verdicts_of_violations(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.tetrahedra = 1;
    const struct { cipc_status status; const char *verdicts; } cases[] = {
        {CIPC_E_VIOLATED_INTERSECTION, "vhhhhh-h"}, {CIPC_E_VIOLATED_GAP, "hvhhhh-h"},    {CIPC_E_VIOLATED_STRAIN, "hhvhhh-h"},
        {CIPC_E_VIOLATED_INVERSION, "hhhvhh-h"},    {CIPC_E_VIOLATED_ENERGY, "hhhhhv-h"}, {CIPC_E_VIOLATED_FINITE, "hhhhhh-v"},
        {CIPC_E_VIOLATED_SWEPT, "hhhhvh-h"},    {CIPC_E_INDETERMINATE, "-----h-h"}, {CIPC_E_VIOLATED_MOMENTUM, "hhhhhhvh"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        s.status = cases[i].status;
        assert_verdicts(&s, cases[i].verdicts);
    }
    /* At the only point there was, monitors behind the violated one have not looked. */
    s.points_checked = s.energy_checks = 1;
    s.status = CIPC_E_VIOLATED_GAP;
    assert_verdicts(&s, "hv---h-h");
    s.status = CIPC_E_VIOLATED_ENERGY;
    assert_verdicts(&s, "-----v--");
    assert_string_equal(cipc_run_summary_verdict(&s, 0), "not checked");
    assert_string_equal(cipc_run_summary_verdict(&s, 9), "not checked");
}

/* Windows of paths are for M5, frames for the others; the energy oscillates. */
static void test_verdicts_of_the_method_asynchronous(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.method = CIPC_METHOD_ASYNCHRONOUS;
    s.energy_checks = 0;
    s.limited_triangles = 0;
    s.windows_checked = 7;
    assert_verdicts(&s, "hh--h--h");
    s.momentum_checks = 3;
    s.tetrahedra = 1;
    assert_verdicts(&s, "hh-hh-hh");
    s.windows_checked = 10; /* no frame has been looked at yet */
    assert_verdicts(&s, "----h-h-");
    s.status = CIPC_E_VIOLATED_SWEPT;
    assert_verdicts(&s, "----v-h-");
    s.windows_checked = 9; /* at the only frame, the second to look broke */
    s.status = CIPC_E_VIOLATED_INTERSECTION;
    assert_verdicts(&s, "v---h-hh");
    s.windows_checked = 0;
    s.swept = false;
    s.status = CIPC_OK;
    assert_verdicts(&s, "hh-h--hh");
}

static json_t *written(const cipc_run_summary *s)
{
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "summary.json");
    assert_int_equal(cipc_summary_write(file.text, s, &error), CIPC_OK);
    json_t *object = json_load_file(file.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(object);
    folder_remove(&folder);
    return object;
}

/* A dotted path into an object. */
static json_t *at(json_t *object, const char *where)
{
    char text[128];
    strcpy(text, where);
    char *rest = text;
    for (char *key = strtok_r(text, ".", &rest); key != NULL; key = strtok_r(NULL, ".", &rest)) {
        object = json_object_get(object, key);
    }
    if (object == NULL) {
        fail_msg("no %s", where);
    }
    return object;
}

static void test_fields(void **state)
{
    (void)state;
    const cipc_run_summary s = good_run();
    json_t *o = written(&s);
    static const char *const integers[] = {"exit_status", "seed", "threads", "steps_asked", "steps_taken", "monitors.points_checked",
                                           "monitors.energy_checks", "monitors.exact_gap_checks", "monitors.exact_strain_checks",
                                           "monitors.paths_checked", "monitors.exact_path_checks", "monitors.momentum_checks",
                                           "monitors.bodies_apart", "monitors.stitches",
                                           "extremes.max_contacts", "extremes.max_newton_iterations", "totals.newton_iterations",
                                           "totals.line_search_halvings", "totals.friction_passes", "totals.symbolic_analyses",
                                           "totals.factorizations", "peak_memory_kb"};
    for (size_t i = 0; i < sizeof integers / sizeof integers[0]; i++) {
        assert_true(json_is_integer(at(o, integers[i])));
    }
    static const char *const reals[] = {"time", "monitors.seconds", "monitors.percent", "extremes.min_gap", "extremes.max_stretch",
                                        "extremes.max_stretch_ratio", "extremes.max_segment_stretch", "seconds.total", "seconds.output"};
    for (size_t i = 0; i < sizeof reals / sizeof reals[0]; i++) {
        assert_true(json_is_real(at(o, reals[i])));
    }
    for (int i = 0; i < CIPC_PHASE_COUNT; i++) {
        assert_true(json_is_real(json_object_get(at(o, "seconds"), cipc_phase_name((cipc_phase)i))));
    }
    assert_string_equal(json_string_value(at(o, "status")), "OK");
    assert_true(json_is_null(at(o, "error")) && json_is_null(at(o, "resumed_from")) && json_is_true(at(o, "converged")));
    assert_string_equal(json_string_value(at(o, "scene.name")), "drape");
    assert_string_equal(json_string_value(at(o, "scene.file")), "scenes/drape.json");
    assert_string_equal(json_string_value(at(o, "scene.size")), "ci");
    assert_string_equal(json_string_value(at(o, "invariants.M2")), "holds");
    assert_int_equal(json_object_size(at(o, "invariants")), 8);
    assert_string_equal(json_string_value(at(o, "invariants.M7")), "not checked");
    assert_true(json_is_null(at(o, "extremes.max_momentum_change")));
    assert_true(json_real_value(at(o, "monitors.percent")) == 25);
    assert_true(json_integer_value(at(o, "seed")) == 7);
    assert_string_equal(json_string_value(at(o, "versions.cipc")), cipc_version());
    json_decref(o);
}

static void test_fields_of_the_method_asynchronous(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.method = CIPC_METHOD_ASYNCHRONOUS;
    s.energy_checks = 0;
    s.windows_checked = 6;
    cipc_asynchronous_report r = {.events = {[CIPC_EVENT_PENALTY] = 30, [CIPC_EVENT_SLAB] = 4}, .total_events = 34, .activations = 3, .deactivations = 2, .max_contacts = 5, .layers = 2,
                                  .min_gap = 1e-4, .smallest_step = 1e-6, .deepest = {.layers = 2, .kind = CIPC_POINT_TRIANGLE, .nodes = {1, 2, 3, 4}, .gap = 2e-4, .step = 1e-5}};
    r.seconds[CIPC_ASYNCHRONOUS_PHASE_MONITOR] = 4;
    cipc_asynchronous_summary_add(&s, &r, NULL);
    r.layers = 1; /* neither deeper nor as many */
    r.total_events = 10;
    r.smallest_step = 1e-5;
    r.min_gap = 1e-3;
    cipc_step_invariants seen = cipc_step_invariants_none();
    const cipc_invariant_report window = {.min_gap = INFINITY};
    cipc_step_invariants_add_window(&seen, &window);
    cipc_asynchronous_summary_add(&s, &r, &seen);
    s.monitored = true;
    json_t *o = written(&s);
    assert_string_equal(json_string_value(at(o, "method")), "asynchronous");
    assert_string_equal(json_string_value(at(o, "invariants.M6")), "not checked: the energy oscillates");
    assert_string_equal(json_string_value(at(o, "invariants.M5")), "holds");
    const struct { const char *key; int count; } counts[] = {{"totals.events.penalty", 60}, {"totals.events.slab", 8}, {"totals.events.cell", 0}, {"totals.total_events", 44},
                                                             {"totals.activations", 6}, {"totals.deactivations", 4}, {"extremes.max_events", 34}, {"extremes.layers", 2},
                                                             {"extremes.max_contacts", 5}, {"extremes.deepest.layers", 2}, {"monitors.windows_checked", 7}, {"monitors.points_checked", 11}};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        assert_int_equal(json_integer_value(at(o, counts[i].key)), counts[i].count);
    }
    assert_string_equal(json_string_value(at(o, "extremes.deepest.kind")), "point_triangle");
    assert_true(json_real_value(at(o, "extremes.smallest_step")) == 1e-6 && json_real_value(at(o, "extremes.solver_min_gap")) == 1e-4);
    assert_true(json_real_value(at(o, "monitors.seconds")) == 8 && json_real_value(at(o, "seconds.monitor")) == 8 && json_real_value(at(o, "seconds.slab_processing")) == 0);
    assert_null(json_object_get(at(o, "totals"), "newton_iterations"));
    assert_null(json_object_get(at(o, "extremes"), "max_newton_iterations"));
    assert_null(json_object_get(at(o, "seconds"), "factorization"));
    assert_int_equal(json_object_size(at(o, "totals.events")), CIPC_EVENT_COUNT);
    json_decref(o);
    s.monitored = false;
    o = written(&s);
    assert_string_equal(json_string_value(at(o, "invariants.M6")), "not checked");
    json_decref(o);
    s = good_run(); /* nothing of it where another method ran */
    o = written(&s);
    assert_string_equal(json_string_value(at(o, "method")), "c-ipc");
    assert_null(json_object_get(at(o, "totals"), "events"));
    assert_null(json_object_get(at(o, "monitors"), "windows_checked"));
    json_decref(o);
}

/* M1 and M2 are counted, never said to hold. */
static void test_fields_of_the_method_mass_spring(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.method = CIPC_METHOD_MASS_SPRING;
    s.swept = false;
    s.energy_checks = 0;
    s.massspring = (cipc_massspring_totals){.frames = 9, .intersecting = {.frames = 2, .first_step = 5, .first = {.what = "edge 7 meets"}}, .substeps = 90, .hits = 8, .arrivals = 5, .iterations = 24, .sweeps = 7, .beyond_bound = 4,
                                            .reversals = 6, .max_self_contacts = 3, .max_inside = 2, .max_deformation = 0.0625, .frame_seconds = 3, .step_seconds = 2, .monitor_seconds = 4};
    json_t *o = written(&s);
    assert_string_equal(json_string_value(at(o, "method")), "mass-spring");
    assert_string_equal(json_string_value(at(o, "invariants.M1")), "counted: 2 of 9 frames intersect");
    assert_string_equal(json_string_value(at(o, "invariants.M2")), "counted: 0 of 9 frames are too near");
    assert_string_equal(json_string_value(at(o, "invariants.M5")), "not checked: the method makes no claim about paths");
    assert_string_equal(json_string_value(at(o, "invariants.M6")), "not checked: explicit steps minimise no potential");
    assert_string_equal(json_string_value(at(o, "invariants.M8")), "holds");
    const struct { const char *key; int count; } counts[] = {{"monitors.counted.frames", 9}, {"monitors.counted.M1.frames", 2}, {"monitors.counted.M1.first.step", 5}, {"monitors.counted.M2.frames", 0},
                                                             {"totals.substeps", 90}, {"totals.hits", 8}, {"totals.arrivals", 5}, {"totals.bisection_iterations", 24}, {"totals.sweeps", 7}, {"totals.beyond_bound", 4}, {"totals.reversals", 6},
                                                             {"extremes.max_self_contacts", 3}, {"extremes.max_inside", 2}};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        assert_int_equal(json_integer_value(at(o, counts[i].key)), counts[i].count);
    }
    assert_string_equal(json_string_value(at(o, "monitors.counted.M1.first.what")), "edge 7 meets");
    assert_true(json_is_null(at(o, "monitors.counted.M2.first")));
    assert_true(json_real_value(at(o, "totals.real_time_factor")) == 1.5 && json_real_value(at(o, "extremes.max_deformation")) == 0.0625);
    assert_true(json_real_value(at(o, "seconds.step")) == 2 && json_real_value(at(o, "seconds.monitor")) == 4 && json_real_value(at(o, "monitors.seconds")) == 4);
    assert_null(json_object_get(at(o, "totals"), "newton_iterations"));
    json_decref(o);
    s.monitored = false; /* one step without is enough */
    o = written(&s);
    assert_string_equal(json_string_value(at(o, "invariants.M1")), "not checked");
    json_decref(o);
    s = good_run(); /* nothing of it where another method ran */
    o = written(&s);
    assert_null(json_object_get(at(o, "monitors"), "counted"));
    json_decref(o);
}

/* Of momentum the file says why there is no verdict, or by how much it changed at most. */
static void test_momentum(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.momentum_source = "gravity";
    json_t *o = written(&s);
    assert_string_equal(json_string_value(at(o, "invariants.M7")), "not checked: gravity");
    json_decref(o);
    s.monitored = false;
    o = written(&s);
    assert_string_equal(json_string_value(at(o, "invariants.M7")), "not checked");
    json_decref(o);
    s = good_run();
    const cipc_step_report report = {.converged = true};
    for (int i = 1; i <= 2; i++) {
        cipc_step_invariants v = cipc_step_invariants_none();
        v.momentum_checks = 1;
        v.momentum_change = 1e-9 / i;
        cipc_run_summary_add(&s, &report, &v);
    }
    o = written(&s);
    assert_string_equal(json_string_value(at(o, "invariants.M7")), "holds");
    assert_int_equal(json_integer_value(at(o, "monitors.momentum_checks")), 2);
    assert_true(json_real_value(at(o, "extremes.max_momentum_change")) == 1e-9);
    json_decref(o);
}

static void test_counts_of_the_model(void **state)
{
    (void)state;
    sample_run run = every_kind_create_all();
    cipc_run_summary s = good_run();
    cipc_run_summary_of_model(&s, run.model);
    json_t *o = written(&s);
    const struct { const char *key; int count; } counts[] = {{"model.bodies", 5},   {"model.nodes", 19},    {"model.triangles", 6},
                                                             {"model.segments", 5}, {"model.particles", 3}, {"model.tetrahedra", 1}};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        assert_int_equal(json_integer_value(at(o, counts[i].key)), counts[i].count);
    }
    assert_string_equal(json_string_value(at(o, "invariants.M4")), "holds"); /* there is a tetrahedron */
    json_decref(o);
    sample_run_destroy(&run);
}

static void test_failed_run(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    cipc_error error;
    s.status = cipc_fail(&error, CIPC_E_VIOLATED_GAP, "step 3", "too near: \"%s\"", "a\\b");
    s.error = &error;
    s.resumed_from = 2;
    s.min_gap = INFINITY;
    json_t *o = written(&s);
    assert_string_equal(json_string_value(at(o, "status")), "VIOLATED_GAP");
    assert_int_equal(json_integer_value(at(o, "exit_status")), 3);
    assert_int_equal(json_integer_value(at(o, "error.number")), 3002);
    assert_string_equal(json_string_value(at(o, "error.where")), "step 3");
    assert_string_equal(json_string_value(at(o, "error.what")), "too near: \"a\\b\"");
    assert_string_equal(json_string_value(at(o, "error.remedy")), error.remedy);
    assert_string_equal(json_string_value(at(o, "invariants.M2")), "violated");
    assert_string_equal(json_string_value(at(o, "extremes.min_gap")), "inf");
    assert_int_equal(json_integer_value(at(o, "resumed_from")), 2);
    json_decref(o);
}

static void test_interrupted_and_unmonitored_run(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.interrupted = true;
    s.monitored = false;
    s.scene_path = "\xff\xfe.json"; /* a file name need not be UTF-8 */
    json_t *o = written(&s);
    assert_string_equal(json_string_value(at(o, "status")), "INTERRUPTED");
    assert_int_equal(json_integer_value(at(o, "exit_status")), 1);
    assert_true(json_is_null(at(o, "extremes.min_gap")) && json_is_null(at(o, "extremes.max_stretch")));
    assert_true(json_is_null(at(o, "extremes.max_segment_stretch")));
    assert_true(json_is_null(at(o, "scene.file")));
    json_decref(o);
}

static void test_adding_steps(void **state)
{
    (void)state;
    cipc_run_summary s = cipc_run_summary_default();
    assert_true(isinf(s.min_gap) && s.resumed_from == -1 && s.converged && s.monitored);
    cipc_step_invariants v = cipc_step_invariants_none();
    const cipc_invariant_report seen = {.min_gap = 1e-4, .max_stretch = 1.01, .exact_gap_checks = 3};
    cipc_step_invariants_add(&v, &seen);
    v.max_segment_stretch = 1.5;
    cipc_step_report r = {.converged = true, .newton_iterations = 5, .max_contacts = 9, .factorizations = 5};
    r.seconds[CIPC_PHASE_CCD] = 0.5;
    cipc_run_summary_add(&s, &r, &v);
    r.converged = false;
    r.max_contacts = 2;
    cipc_run_summary_add(&s, &r, NULL);
    assert_int_equal(s.newton_iterations, 10);
    assert_int_equal(s.max_newton_iterations, 5);
    assert_int_equal(s.max_contacts, 9);
    assert_int_equal(s.points_checked, 1);
    assert_true(s.min_gap == 1e-4 && s.seconds_by_phase[CIPC_PHASE_CCD] == 1 && s.exact_gap_checks == 3 && s.max_segment_stretch == 1.5);
    assert_false(s.converged);
    assert_false(s.monitored);
}

static void test_unwritable(void **state)
{
    (void)state;
    cipc_error error;
    const cipc_run_summary s = good_run();
    assert_int_equal(cipc_summary_write("/no/such/folder/summary.json", &s, &error), CIPC_E_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdicts_of_good_runs), cmocka_unit_test(test_verdicts_of_violations),
        cmocka_unit_test(test_verdicts_of_the_method_asynchronous), cmocka_unit_test(test_fields_of_the_method_mass_spring), cmocka_unit_test(test_fields_of_the_method_asynchronous),
        cmocka_unit_test(test_fields), cmocka_unit_test(test_momentum), cmocka_unit_test(test_counts_of_the_model), cmocka_unit_test(test_failed_run),
        cmocka_unit_test(test_interrupted_and_unmonitored_run), cmocka_unit_test(test_adding_steps),
        cmocka_unit_test(test_unwritable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
