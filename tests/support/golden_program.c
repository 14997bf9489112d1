#include "support/golden_program.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/scene_fault.h"

/* ---- One run ----------------------------------------------------------------------------------------------------------------- */

scene_outcome golden_run_or_fail(const scene_request *request)
{
    scene_outcome outcome;
    cipc_error error;
    if (scene_run(request, &outcome, &error) != CIPC_OK) {
        scene_outcome_free(&outcome);
        fail_msg("%s: %s: %s", request->file, error.place, error.what);
    }
    return outcome;
}

golden golden_bands_or_fail(const scene_variant *variant)
{
    char path[SCENE_PATH], command[SCENE_COMMAND], why[GOLDEN_REASON];
    golden bands;
    scene_golden_path(variant, path);
    scene_command(variant, command);
    if (!golden_read(path, command, &bands, why)) {
        fail_msg("%s", why);
    }
    return bands;
}

void golden_assert_monitored(const scene_outcome *o)
{
    assert_true(o->steps > 0 && o->points >= o->steps);
    if (o->method == CIPC_METHOD_ASYNCHRONOUS) {
        assert_true(o->points == o->steps && o->windows >= o->steps);
        assert_true(o->momentum_checks == 0 || o->momentum_checks == o->steps);
    } else if (o->method == CIPC_METHOD_MASS_SPRING) {
        assert_true(o->points == o->steps && o->intersecting <= o->steps && o->too_near == 0);
    } else {
        assert_true(o->energy_checks > 0 && o->energy_checks <= o->points);
    }
    assert_true(o->min_gap > 0);
    if (o->stretch_limit > 0) {
        assert_true(o->max_stretch < o->stretch_limit && o->max_stretch_ratio < 1);
    }
}

void golden_print_figures(const char *name, const scene_outcome *o)
{
    if (o->method == CIPC_METHOD_ASYNCHRONOUS) {
        print_message("%s: %d steps, %d nodes, %ld frames and %ld windows checked, %.0f impulses of layers, at most %d contacts, layer %d, min gap %.3g m, largest stretch %.7f, "
                      "exact gap checks %ld, paths %ld, of which exact %ld\n",
                      name, o->steps, o->node_count, o->points, o->windows, o->last.impulses[0], o->max_contacts, o->max_layers, o->min_gap, o->max_stretch, o->exact_gap_checks,
                      o->paths_checked, o->exact_path_checks);
        return;
    }
    if (o->method == CIPC_METHOD_MASS_SPRING) {
        print_message("%s: %d steps, %d nodes, %ld frames checked, of which %ld intersect, at most %d contacts, largest stretch %.7f, last deformation %.7f\n", name, o->steps, o->node_count,
                      o->points, o->intersecting, o->max_contacts, o->max_stretch, o->last.deformation[0]);
        return;
    }
    print_message("%s: %d steps, %d nodes, %ld points checked, %ld with energies, %.0f Newton iterations, at most %d contacts, min gap %.3g m, "
                  "largest stretch %.7f, largest (sigma - 1)/(s - 1) %.4f, exact gap checks %ld, exact strain checks %ld, paths %ld, of which exact %ld\n",
                  name, o->steps, o->node_count, o->points, o->energy_checks, o->last.newton_iterations[0], o->max_contacts, o->min_gap,
                  o->max_stretch, o->max_stretch_ratio, o->exact_gap_checks, o->exact_strain_checks, o->paths_checked, o->exact_path_checks);
}

/* Every step converges, every invariant holds at every accepted point, every recorded frame is in band. */
static void test_run(void **state)
{
    const scene_variant *v = *state;
    const golden bands = golden_bands_or_fail(v);
    golden_check check = {.bands = &bands};
    scene_request request = v->request;
    request.watch = golden_watch;
    request.context = &check;
    scene_outcome outcome = golden_run_or_fail(&request);
    const bool good = golden_verdict(&check, outcome.steps, outcome.probe);
    golden_print_figures(v->name, &outcome);
    if (good) {
        golden_assert_monitored(&outcome);
    }
    scene_outcome_free(&outcome);
    if (!good) {
        fail_msg("%s: %s", v->name, check.why);
    }
}

/* ---- Faults ------------------------------------------------------------------------------------------------------------------ */

static const double fault_factor = 1.01;
/* A run with factor 1 goes the same way as one with a fault, through the resolved scene and a new file; up to this step that is looked at. */
enum { CONTROL_STEPS = 5 };

typedef struct trial {
    golden_check check; /* first: golden_watch takes its address */
    int steps_at_most;
} trial;

static bool watch_trial(void *context, int step, const scene_frame *frame)
{
    trial *t = context;
    return golden_watch(&t->check, step, frame) && step < t->steps_at_most;
}

/* Is the scene with that coefficient times `factor` told from the golden file? *why: by what. */
static bool is_seen(const scene_variant *v, const char *resolved, const golden *bands, const scene_fault *fault, double factor, int steps,
                    char why[GOLDEN_REASON])
{
    char path[SCENE_FAULT_PATH];
    trial t = {.check = {.bands = bands}, .steps_at_most = steps};
    scene_outcome outcome;
    cipc_error error;
    if (!scene_fault_write(resolved, fault, factor, path)) {
        fail_msg("%s: no file for the fault %s", v->name, fault->name);
    }
    const scene_request request = {.file = path, .threads = v->request.threads, .watch = watch_trial, .context = &t};
    const cipc_status status = scene_run(&request, &outcome, &error);
    remove(path);
    scene_outcome_free(&outcome);
    if (status != CIPC_OK) {
        fail_msg("%s with the fault %s: %s: %s", v->name, fault->name, error.place, error.what);
    }
    snprintf(why, GOLDEN_REASON, "%s", t.check.why);
    return t.check.outside;
}

static const scene_unfelt *unfelt_of(const scene_variant *v, const char *fault)
{
    for (int i = 0; i < SCENE_UNFELT && v->unfelt[i].fault != NULL; i++) {
        if (strcmp(v->unfelt[i].fault, fault) == 0) {
            return &v->unfelt[i];
        }
    }
    return NULL;
}

static cipc_scene *load_or_fail(const scene_variant *v)
{
    cipc_scene *scene = NULL;
    cipc_error error;
    int overrides = 0;
    while (v->request.overrides[overrides] != NULL) {
        overrides++;
    }
    if (cipc_scene_load(&scene, v->request.file, overrides, v->request.overrides, &error) != CIPC_OK) {
        fail_msg("%s: %s: %s", v->name, error.place, error.what);
    }
    return scene;
}

/* Has a variant of this name that fault, and must it see it? */
static bool must_see(const char *name, const char *fault)
{
    scene_fault faults[SCENE_FAULTS];
    const scene_variant *v = scene_variant_of(name);
    if (v == NULL || unfelt_of(v, fault) != NULL) {
        return false;
    }
    cipc_scene *scene = load_or_fail(v);
    const int count = scene_faults(scene->resolved, faults);
    bool has = false;
    for (int i = 0; i < count; i++) {
        has = has || strcmp(faults[i].name, fault) == 0;
    }
    cipc_scene_destroy(scene);
    return has;
}

/* A fault is out of band unless the table says that nothing feels it, and then it is in band to the end: the table cannot rot. 1 if it is not so. */
static int judge_fault(const scene_variant *v, const char *resolved, const golden *bands, const scene_fault *fault)
{
    char why[GOLDEN_REASON];
    const scene_unfelt *unfelt = unfelt_of(v, fault->name);
    if (unfelt != NULL && unfelt->seen_by != NULL) {
        const bool left = must_see(unfelt->seen_by, fault->name);
        print_message("%s, %s x %g: %s %s\n", v->name, fault->name, fault_factor, left ? "left to" : "NOT SEEN by", unfelt->seen_by);
        return !left;
    }
    const bool seen = is_seen(v, resolved, bands, fault, fault_factor, bands->steps, why);
    print_message("%s, %s x %g: %s\n", v->name, fault->name, fault_factor, seen ? why : unfelt != NULL ? unfelt->reason : "NOT SEEN");
    if (seen && unfelt != NULL) {
        print_message("%s: the table says that %s is not felt: %s\n", v->name, fault->name, unfelt->reason);
    }
    return seen == (unfelt != NULL);
}

static void test_faults(void **state)
{
    const scene_variant *v = *state;
    const golden bands = golden_bands_or_fail(v);
    scene_fault faults[SCENE_FAULTS];
    char why[GOLDEN_REASON];
    int declared = 0, wrong = 0;
    cipc_scene *scene = load_or_fail(v);
    const int count = scene_faults(scene->resolved, faults);
    assert_true(count > 0);
    if (is_seen(v, scene->resolved, &bands, &faults[0], 1, CONTROL_STEPS, why)) {
        fail_msg("%s is not accepted as resolved, without any fault: %s", v->name, why);
    }
    for (int i = 0; i < count; i++) {
        wrong += judge_fault(v, scene->resolved, &bands, &faults[i]);
        declared += unfelt_of(v, faults[i].name) != NULL;
    }
    cipc_scene_destroy(scene);
    for (int i = 0; i < SCENE_UNFELT && v->unfelt[i].fault != NULL; i++) {
        declared--;
    }
    assert_int_equal(declared, 0); /* every name in the table is that of a fault */
    assert_int_equal(wrong, 0);
}

/* ---- The program ------------------------------------------------------------------------------------------------------------- */

enum { NAME_SIZE = 96, TESTS = 128 };

int golden_program(int part)
{
    struct CMUnitTest tests[TESTS];
    char names[TESTS][NAME_SIZE];
    size_t count = 0;
    for (int i = part - 1; i < scene_variant_count && count + 2 <= TESTS; i += GOLDEN_PARTS) {
        void *variant = (void *)(uintptr_t)&scene_variants[i];
        snprintf(names[count], NAME_SIZE, "%s", scene_variants[i].name);
        tests[count] = (struct CMUnitTest){names[count], test_run, NULL, NULL, variant};
        count++;
        snprintf(names[count], NAME_SIZE, "%s: faults of 1 %%", scene_variants[i].name);
        tests[count] = (struct CMUnitTest){names[count], test_faults, NULL, NULL, variant};
        count++;
    }
    if (count == 0) {
        return 0;
    }
    struct CMUnitTest *all = tests;
    return _cmocka_run_group_tests("golden", all, count, NULL, NULL);
}
