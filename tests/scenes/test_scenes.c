/* Every scene of the catalogue and its variants, at the size for continuous integration: every step converges, every invariant holds at
 * every accepted point, and the end lies within the golden bands (tests/golden). Prints the figures that docs/claims.md quotes.
 *
 *     test_scenes                        the tests
 *     test_scenes --regenerate [NAME]... makes the golden files anew (tests/golden/README.md) */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/claim.h"
#include "support/golden_bands.h"
#include "support/scene_run.h"

/* ---- The scenes ------------------------------------------------------------------------------------------------------------- */

typedef struct variant {
    const char *name;
    scene_request request;
} variant;

/* One thread: other tests run on the other cores, and the results are those of any number (test_threads_change_nothing). */
#define SCENE(file_name, ...) {.file = "tests/scenes/" file_name ".json", .threads = 1, .overrides = {__VA_ARGS__}}
#define NO_LIMIT "bodies.cloth.strain_limit=false"
#define LIMIT(s) "bodies.cloth.strain_limit.limit=" #s
#define MEMBRANE(m) "bodies.cloth.membrane_factor=" #m

static const variant variants[] = {
    {"drape-membrane-1", SCENE("drape", MEMBRANE(1), NO_LIMIT)},
    {"drape-membrane-1-limit-1.0608", SCENE("drape", MEMBRANE(1), LIMIT(1.0608))},
    {"drape-membrane-0.1", SCENE("drape", MEMBRANE(0.1), NO_LIMIT)},
    {"drape-membrane-0.1-limit-1.0608", SCENE("drape", MEMBRANE(0.1), LIMIT(1.0608))},
    {"drape-membrane-0.01", SCENE("drape", MEMBRANE(0.01), NO_LIMIT)},
    {"drape-membrane-0.01-limit-1.0608", SCENE("drape", MEMBRANE(0.01), LIMIT(1.0608))},
    {"drape-membrane-0.01-limit-1.01", SCENE("drape", MEMBRANE(0.01), LIMIT(1.01))},
    {"drape-membrane-0.01-limit-1.001", SCENE("drape", MEMBRANE(0.01), LIMIT(1.001))},
    {"two-corner-hang-limit-1.0608", SCENE("two-corner-hang", LIMIT(1.0608))},
    {"two-corner-hang-limit-1.01", SCENE("two-corner-hang", LIMIT(1.01))},
    {"two-corner-hang-limit-1.001", SCENE("two-corner-hang", LIMIT(1.001))},
    {"rotating-sphere", SCENE("rotating-sphere", NULL)},
    {"free-fall", SCENE("free-fall", NULL)},
    {"incline", SCENE("incline", NULL)},
    {"incline-sticks", SCENE("incline", "friction.0.mu=0.5")},
    {"resting", SCENE("resting", NULL)},
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

static const variant *variant_of(const char *name)
{
    for (int i = 0; i < VARIANTS; i++) {
        if (strcmp(variants[i].name, name) == 0) {
            return &variants[i];
        }
    }
    return NULL;
}

enum { PATH_SIZE = 128, COMMAND_SIZE = 256 };

static void golden_path(const variant *v, char path[PATH_SIZE])
{
    snprintf(path, PATH_SIZE, "tests/golden/%s.json", v->name);
}

/* The run as a user would ask for it. */
static void command_of(const variant *v, char command[COMMAND_SIZE])
{
    size_t length = (size_t)snprintf(command, COMMAND_SIZE, "cipc run %s", v->request.file);
    for (int i = 0; v->request.overrides[i] != NULL; i++) {
        length += (size_t)snprintf(command + length, COMMAND_SIZE - length, " --set %s", v->request.overrides[i]);
    }
}

/* ---- Running ---------------------------------------------------------------------------------------------------------------- */

static scene_outcome run_or_fail(const scene_request *request)
{
    scene_outcome outcome;
    cipc_error error;
    if (scene_run(request, &outcome, &error) != CIPC_OK) {
        scene_outcome_free(&outcome);
        fail_msg("%s: %s: %s", request->file, error.place, error.what);
    }
    return outcome;
}

/* The monitors have looked, and what they report agrees with their verdicts. */
static void assert_monitored(const scene_outcome *o)
{
    assert_true(o->steps > 0 && o->points >= o->steps);
    assert_true(o->energy_checks > 0 && o->energy_checks <= o->points);
    assert_true(o->min_gap > 0);
    if (o->stretch_limit > 0) {
        assert_true(o->max_stretch < o->stretch_limit && o->max_stretch_ratio < 1);
    }
}

static void print_figures(const char *name, const scene_outcome *o)
{
    print_message("%s: %d steps, %d nodes, %ld points checked, %.0f Newton iterations, at most %d contacts, min gap %.3g m, "
                  "largest stretch %.7f, largest (sigma - 1)/(s - 1) %.4f, exact gap checks %ld, exact strain checks %ld, paths %ld, of which exact %ld\n",
                  name, o->steps, o->node_count, o->points, o->quantity[QUANTITY_newton_iterations], o->max_contacts, o->min_gap,
                  o->max_stretch, o->max_stretch_ratio, o->exact_gap_checks, o->exact_strain_checks, o->paths_checked, o->exact_path_checks);
}

static golden_bands bands_or_fail(const variant *v)
{
    char path[PATH_SIZE], command[COMMAND_SIZE], why[GOLDEN_REASON];
    golden_bands bands;
    golden_path(v, path);
    command_of(v, command);
    if (!golden_read(path, command, &bands, why)) {
        fail_msg("%s", why);
    }
    return bands;
}

/* One scene: cmocka lists this test under the variant's name. */
static void test_variant(void **state)
{
    const variant *v = *state;
    char why[GOLDEN_REASON];
    const golden_bands bands = bands_or_fail(v);
    scene_outcome outcome = run_or_fail(&v->request);
    const bool within = golden_accepts(&bands, outcome.quantity, why);
    print_figures(v->name, &outcome);
    assert_monitored(&outcome);
    if (strstr(v->request.file, "hang") == NULL && strstr(v->request.file, "free-fall") == NULL) {
        assert_true(outcome.max_contacts > 0);
        assert_true(outcome.max_friction > 0 || strstr(v->request.file, "resting") != NULL);
    }
    scene_outcome_free(&outcome);
    if (!within) {
        fail_msg("%s: %s", v->name, why);
    }
}

/* ---- Threads ---------------------------------------------------------------------------------------------------------------- */

/* Not within a tolerance: the same bytes (docs/validation.md). */
static void assert_threads_change_nothing(scene_request request)
{
    request.threads = 1;
    scene_outcome one = run_or_fail(&request);
    request.threads = 2;
    scene_outcome two = run_or_fail(&request);
    const size_t size = 3 * (size_t)one.node_count * sizeof(double);
    assert_int_equal(one.node_count, two.node_count);
    assert_memory_equal(one.position, two.position, size);
    assert_memory_equal(one.velocity, two.velocity, size);
    assert_memory_equal(one.quantity, two.quantity, sizeof one.quantity);
    assert_int_equal(one.points, two.points);
    scene_outcome_free(&one);
    scene_outcome_free(&two);
}

static void test_threads_change_nothing(void **state)
{
    (void)state;
    assert_threads_change_nothing(variant_of("drape-membrane-0.01-limit-1.0608")->request);
}

/* Larger systems are factorised in halves, by two threads at a time. */
static void test_threads_change_nothing_in_larger_systems(void **state)
{
    (void)state;
    const scene_request request = {.file = "tests/scenes/drape.json", .overrides = {"size=demo", "steps=5"}};
    assert_threads_change_nothing(request);
}

/* That comparison can fail: a start displaced by one unit in the last place leads elsewhere. */
static void test_comparison_of_threads_sees_one_ulp(void **state)
{
    (void)state;
    scene_request request = variant_of("resting")->request;
    scene_outcome one = run_or_fail(&request);
    request.jitter = 0x1p-53; /* the plate starts at 6e-4 m, where doubles are 2^-63 apart, and at 0.5 m, where they are 2^-53 apart */
    request.jitter_seed = 1;
    scene_outcome two = run_or_fail(&request);
    assert_memory_not_equal(one.position, two.position, 3 * (size_t)one.node_count * sizeof(double));
    scene_outcome_free(&one);
    scene_outcome_free(&two);
}

/* ---- The golden check rejects what is wrong --------------------------------------------------------------------------------- */

/* Just outside either end, and what is no number. */
static void test_values_outside_a_band_are_rejected(void **state)
{
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        const golden_bands bands = bands_or_fail(&variants[i]);
        double inside[QUANTITY_COUNT];
        char why[GOLDEN_REASON];
        for (int q = 0; q < QUANTITY_COUNT; q++) {
            inside[q] = 0.5 * bands.low[q] + 0.5 * bands.high[q];
        }
        assert_true(golden_accepts(&bands, inside, why));
        for (int q = 0; q < QUANTITY_COUNT; q++) {
            const double wrong[] = {nextafter(bands.low[q], -INFINITY), nextafter(bands.high[q], INFINITY), NAN, INFINITY, -INFINITY};
            const double right = inside[q];
            for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
                inside[q] = wrong[k];
                assert_false(golden_accepts(&bands, inside, why));
                assert_non_null(strstr(why, scene_quantity_name((scene_quantity)q)));
            }
            inside[q] = right;
        }
    }
}

/* Runs of slightly wrong physics end outside the bands: gravity off by 0.1 %, friction by 2 %, a limit of 1.02 for 1.01. */
static void test_wrong_physics_is_rejected(void **state)
{
    (void)state;
    static const struct {
        const char *name, *fault;
    } faults[] = {
        {"free-fall", "gravity=[0,-9.80019,0]"},
        {"incline", "friction.0.mu=0.204"},
        {"incline-sticks", "contact.friction_velocity=2e-3"},
        {"resting", "contact.dhat=1.1e-3"},
        {"two-corner-hang-limit-1.01", LIMIT(1.02)},
    };
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        const variant *v = variant_of(faults[i].name);
        scene_request request = v->request;
        int count = 0;
        while (request.overrides[count] != NULL) {
            count++;
        }
        request.overrides[count] = faults[i].fault; /* after the variant's own: it counts */
        const golden_bands bands = bands_or_fail(v);
        char why[GOLDEN_REASON];
        scene_outcome outcome = run_or_fail(&request);
        const bool accepted = golden_accepts(&bands, outcome.quantity, why);
        scene_outcome_free(&outcome);
        if (accepted) {
            fail_msg("%s with %s is accepted", faults[i].name, faults[i].fault);
        }
        print_message("%s with %s: %s\n", faults[i].name, faults[i].fault, why);
    }
}

/* Runs of one variant are not accepted as those of another where these differ in physics. */
static void test_bands_tell_variants_apart(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"drape-membrane-1", "drape-membrane-0.1"},
        {"drape-membrane-0.1", "drape-membrane-0.01"},
        {"drape-membrane-0.1", "drape-membrane-0.1-limit-1.0608"},
        {"drape-membrane-0.01", "drape-membrane-0.01-limit-1.0608"},
        {"drape-membrane-0.1-limit-1.0608", "drape-membrane-0.01-limit-1.0608"},
        {"drape-membrane-0.01-limit-1.0608", "drape-membrane-0.01-limit-1.01"},
        {"drape-membrane-0.01-limit-1.01", "drape-membrane-0.01-limit-1.001"},
        {"two-corner-hang-limit-1.0608", "two-corner-hang-limit-1.01"},
        {"two-corner-hang-limit-1.01", "two-corner-hang-limit-1.001"},
        {"incline", "incline-sticks"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        const golden_bands a = bands_or_fail(variant_of(pairs[i][0])), b = bands_or_fail(variant_of(pairs[i][1]));
        bool disjoint = false;
        for (int q = 0; q < QUANTITY_COUNT; q++) {
            disjoint = disjoint || a.high[q] < b.low[q] || b.high[q] < a.low[q];
        }
        if (!disjoint) {
            fail_msg("%s and %s overlap in every band", pairs[i][0], pairs[i][1]);
        }
    }
}

static bool accepts_text(const char *text, char why[GOLDEN_REASON])
{
    char path[] = "/tmp/cipc-golden-XXXXXX";
    golden_bands bands;
    const int file = mkstemp(path);
    assert_true(file >= 0);
    FILE *stream = fdopen(file, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    const bool accepted = golden_read(path, "c", &bands, why);
    remove(path);
    return accepted;
}

/* A file of all bands, the first `count` of them as `entry`. */
static const char *file_of(char text[4096], const char *entry, int count, const char *extra)
{
    int length = snprintf(text, 4096, "{\"command\": \"c\", \"bands\": {");
    for (int q = 0; q < QUANTITY_COUNT; q++) {
        length += snprintf(text + length, 4096 - (size_t)length, "%s\"%s\": %s", q > 0 ? ", " : "", scene_quantity_name((scene_quantity)q),
                           q < count ? entry : "{\"band\": [0, 1], \"comment\": \"\"}");
    }
    snprintf(text + length, 4096 - (size_t)length, "%s}}", extra);
    return text;
}

static void test_broken_golden_files_are_rejected(void **state)
{
    (void)state;
    char why[GOLDEN_REASON], text[4096];
    golden_bands bands;
    assert_false(golden_read("tests/golden/none.json", "c", &bands, why));
    assert_true(accepts_text(file_of(text, "", 0, ""), why));
    assert_false(accepts_text("", why));
    assert_false(accepts_text("{\"command\": \"c\", \"bands\": {}}", why));
    assert_false(accepts_text("{\"command\": \"d\", \"bands\": {}}", why));
    assert_false(accepts_text(file_of(text, "", 0, ", \"unheard of\": {\"band\": [0, 1], \"comment\": \"\"}"), why));
    static const char *const entries[] = {
        "{\"band\": [1, 0], \"comment\": \"\"}",     "{\"band\": [0], \"comment\": \"\"}",       "{\"band\": [0, 1]}",
        "{\"band\": [\"0\", 1], \"comment\": \"\"}", "{\"band\": [0, 1, 2], \"comment\": \"\"}", "null",
    };
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        assert_false(accepts_text(file_of(text, entries[i], 1, ""), why));
    }
}

/* ---- Claims ----------------------------------------------------------------------------------------------------------------- */

/* Claim C13: a stiff membrane on a coarse mesh keeps cloth from folding (locking), so it stays higher; a soft one drapes, but stretches far
 * beyond what cloth does; a soft one with a strain limit does neither. On the bands, which the runs above have to meet. */
static void test_strain_limit_cures_membrane_locking(void **state)
{
    (void)state;
    const golden_bands stiff = bands_or_fail(variant_of("drape-membrane-1")), medium = bands_or_fail(variant_of("drape-membrane-0.1")),
                       soft = bands_or_fail(variant_of("drape-membrane-0.01")),
                       cured = bands_or_fail(variant_of("drape-membrane-0.01-limit-1.0608"));
    const int height = QUANTITY_centre_of_mass_y, stretch = QUANTITY_largest_stretch;
    assert_true(stiff.low[height] > medium.high[height] && medium.low[height] > soft.high[height]);
    assert_true(stiff.high[stretch] < medium.low[stretch] && medium.high[stretch] < soft.low[stretch]);
    assert_true(cured.high[height] < stiff.low[height]);    /* drapes, */
    assert_true(cured.high[stretch] < medium.low[stretch]); /* and stretches no more than it may */
    assert_true(soft.low[stretch] > 1.0608 && medium.low[stretch] > 1.0608); /* cotton's limit (docs/scene.md) */
    claim_figure("C13", "drape: least height of the centre of mass, membrane 1, above the greatest of 0.01 with the limit", stiff.low[height] - cured.high[height], "m", CLAIM_MORE, 0);
    claim_figure("C13", "drape: largest stretch, membrane 0.1, above that of 0.01 with the limit", medium.low[stretch] - cured.high[stretch], "1", CLAIM_MORE, 0);
}

/* Claim C11, its threshold: on a slope of 0.3 rad a plate sticks or slides as mu is above or below tan 0.3, by one part in a hundred. */
static void test_friction_threshold(void **state)
{
    (void)state;
    const double slope = 0.3, g = 9.81, part = 0.01, friction_velocity = 1e-3;
    for (int sign = -1; sign <= 1; sign += 2) {
        char mu[64];
        const double coefficient = tan(slope) * (1 + sign * part);
        snprintf(mu, sizeof mu, "friction.0.mu=%.17g", coefficient);
        const scene_request request = {.file = "tests/scenes/incline.json", .threads = 1, .overrides = {mu}};
        scene_outcome outcome = run_or_fail(&request);
        assert_monitored(&outcome);
        /* g (sin a - mu cos a) t with mu = tan a (1 - part) */
        const double sliding = g * sin(slope) * part * outcome.time_step * outcome.steps;
        print_message("mu %.6f: after %d steps %.6g m/s; sliding would be %.6g m/s\n", coefficient, outcome.steps, outcome.speed, sliding);
        if (sign > 0) {
            /* Sticking, in this friction law, is to creep below eps_v: at eps_v (1 - sqrt(1 - tan a / mu)) (SPEC D.6). Steps converge to
             * the tolerance, and the speed's error is damped from step to step. */
            const double creep = friction_velocity * (1 - sqrt(1 - tan(slope) / coefficient));
            print_message("creep should be %.6g m/s\n", creep);
            assert_true(fabs(outcome.speed - creep) < 2 * outcome.tolerance);
            claim_figure("C11 threshold", "sticks at mu = 1.01 tan a: speed of the plate (eps_v = 1e-3)", outcome.speed, "m/s", CLAIM_LESS, friction_velocity);
        } else {
            /* While it is slower than eps_v friction is weaker than mu N, so it is ahead by at most eps_v. */
            assert_true(outcome.speed > sliding && outcome.speed < sliding + friction_velocity);
            claim_figure("C11 threshold", "slides at mu = 0.99 tan a: speed beyond that of steady sliding", outcome.speed - sliding, "m/s", CLAIM_MORE, 0);
        }
        scene_outcome_free(&outcome);
    }
}

/* Claim C14 in part: the drape up to 0.4 s, from free fall to lying on ball and ground, at smaller time steps (h = 0.04 s is above). */
static void test_smaller_time_steps_keep_every_invariant(void **state)
{
    (void)state;
    static const char *const sizes[][2] = {
        {"time_step=0.02", "steps=20"},
        {"time_step=0.01", "steps=40"},
        {"time_step=0.004", "steps=100"},
    };
    double gap = INFINITY, used = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const scene_request request = {.file = "tests/scenes/drape.json", .threads = 1,
                                       .overrides = {sizes[i][0], sizes[i][1], "bodies.cloth.shell.irregular.nodes=150"}};
        scene_outcome outcome = run_or_fail(&request);
        assert_monitored(&outcome);
        print_figures(sizes[i][0], &outcome);
        assert_true(outcome.max_contacts > 0 && outcome.max_friction > 0);
        assert_true(outcome.quantity[QUANTITY_lowest_node] < -0.158); /* on the ground, which is at -0.16 */
        gap = fmin(gap, outcome.min_gap);
        used = fmax(used, outcome.max_stretch_ratio);
        scene_outcome_free(&outcome);
    }
    claim_figure("C14", "drape to 0.4 s, h = 0.02, 0.01, 0.004 s: smallest gap - xi at any accepted point", gap, "m", CLAIM_MORE, 0);
    claim_figure("C14", "the same: part of the strain limit used at any accepted point", used, "1", CLAIM_LESS, 1);
}

/* ---- Making the golden files ------------------------------------------------------------------------------------------------ */

/* The runs of the rule: as it is, with a tolerance ten times tighter, and with starts displaced by up to a micrometre. */
enum { GOLDEN_RUNS = 8 };
static const double tighter = 0.1, golden_jitter = 1e-6;

static bool regenerate(const variant *v)
{
    double quantity[GOLDEN_RUNS][QUANTITY_COUNT];
    golden_scale scale = {0, 0, 0};
    for (int r = 0; r < GOLDEN_RUNS; r++) {
        scene_request request = v->request;
        scene_outcome outcome;
        cipc_error error;
        request.tolerance_factor = r == 1 ? tighter : 1;
        request.jitter = r > 1 ? golden_jitter : 0;
        request.jitter_seed = (unsigned long)r;
        if (scene_run(&request, &outcome, &error) != CIPC_OK) {
            fprintf(stderr, "%s, run %d: %s: %s\n", v->name, r, error.place, error.what);
            scene_outcome_free(&outcome);
            return false;
        }
        memcpy(quantity[r], outcome.quantity, sizeof quantity[r]);
        if (r == 0) {
            scale = (golden_scale){outcome.time_step, outcome.tolerance, outcome.moving_mass};
        }
        scene_outcome_free(&outcome);
    }
    char path[PATH_SIZE], command[COMMAND_SIZE], why[GOLDEN_REASON];
    golden_path(v, path);
    command_of(v, command);
    const bool good = golden_write(path, command, GOLDEN_RUNS, (const double (*)[QUANTITY_COUNT])quantity, scale, why);
    fprintf(stderr, "%s\n", good ? path : why);
    return good;
}

static int regenerate_named(int count, char **names)
{
    bool good = true;
    for (int i = 0; i < VARIANTS; i++) {
        bool wanted = count == 0;
        for (int k = 0; k < count; k++) {
            wanted = wanted || strcmp(names[k], variants[i].name) == 0;
        }
        good = (!wanted || regenerate(&variants[i])) && good;
    }
    return good ? 0 : 1;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--regenerate") == 0) {
        return regenerate_named(argc - 2, argv + 2);
    }
    struct CMUnitTest scenes[VARIANTS];
    for (int i = 0; i < VARIANTS; i++) {
        scenes[i] = (struct CMUnitTest){variants[i].name, test_variant, NULL, NULL, (void *)(uintptr_t)&variants[i]};
    }
    const struct CMUnitTest checks[] = {
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_threads_change_nothing_in_larger_systems),
        cmocka_unit_test(test_comparison_of_threads_sees_one_ulp),
        cmocka_unit_test(test_values_outside_a_band_are_rejected),
        cmocka_unit_test(test_wrong_physics_is_rejected),
        cmocka_unit_test(test_bands_tell_variants_apart),
        cmocka_unit_test(test_broken_golden_files_are_rejected),
    };
    const struct CMUnitTest claims[] = {
        cmocka_unit_test(test_strain_limit_cures_membrane_locking),
        cmocka_unit_test(test_friction_threshold),
        cmocka_unit_test(test_smaller_time_steps_keep_every_invariant),
    };
    return cmocka_run_group_tests_name("scenes", scenes, NULL, NULL) + cmocka_run_group_tests_name("checks", checks, NULL, NULL) +
           cmocka_run_group_tests_name("claims", claims, NULL, NULL);
}
