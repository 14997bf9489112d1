/* What the scenes of tests/support/scene_table.h show beyond their own runs, which test_golden_*.c hold against golden files: that threads
 * change nothing, that the golden check rejects what is wrong, and claims. Prints the figures that docs/claims.md quotes.
 *
 *     test_scenes                                        the tests
 *     test_scenes --list                                 the names of the scenes
 *     test_scenes --record NAME THREADS JITTER SEED      one run, as JSON (scene_table.h); ci/golden makes golden files of such runs */
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
#include "support/golden_program.h"

static scene_request request_of(const char *name)
{
    const scene_variant *variant = scene_variant_of(name);
    if (variant == NULL) {
        fail_msg("no scene %s", name);
    }
    return variant->request;
}

static golden bands_of(const char *name)
{
    const scene_variant *variant = scene_variant_of(name);
    if (variant == NULL) {
        fail_msg("no scene %s", name);
    }
    return golden_bands_or_fail(variant);
}

/* ---- Threads ---------------------------------------------------------------------------------------------------------------- */

/* Not within a tolerance: the same bytes (docs/validation.md). */
static void assert_threads_change_nothing(scene_request request)
{
    request.threads = 1;
    scene_outcome one = golden_run_or_fail(&request);
    request.threads = 2;
    scene_outcome two = golden_run_or_fail(&request);
    const size_t size = 3 * (size_t)one.node_count * sizeof(double);
    assert_int_equal(one.node_count, two.node_count);
    assert_memory_equal(one.position, two.position, size);
    assert_memory_equal(one.velocity, two.velocity, size);
    assert_memory_equal(&one.last, &two.last, sizeof one.last);
    assert_int_equal(one.points, two.points);
    scene_outcome_free(&one);
    scene_outcome_free(&two);
}

static void test_threads_change_nothing(void **state)
{
    (void)state;
    assert_threads_change_nothing(request_of("drape-membrane-0.01-limit-1.0608"));
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
    scene_request request = request_of("resting");
    scene_outcome one = golden_run_or_fail(&request);
    request.jitter = 0x1p-53; /* the plate starts at 6e-4 m, where doubles are 2^-63 apart, and at 0.5 m, where they are 2^-53 apart */
    request.jitter_seed = 1;
    scene_outcome two = golden_run_or_fail(&request);
    assert_memory_not_equal(one.position, two.position, 3 * (size_t)one.node_count * sizeof(double));
    scene_outcome_free(&one);
    scene_outcome_free(&two);
}

/* ---- The golden check rejects what is wrong --------------------------------------------------------------------------------- */

static scene_frame middle_of(const golden *bands, int index)
{
    scene_frame middle;
    for (int i = 0; i < SCENE_NUMBERS; i++) {
        scene_frame_numbers(&middle)[i] = 0.5 * scene_frame_values(&bands->low[index])[i] + 0.5 * scene_frame_values(&bands->high[index])[i];
    }
    return middle;
}

/* Just outside either end, and what is no number; of a quantity that the file leaves out everything but 0. */
static void assert_frame_is_tight(const golden *bands, int index)
{
    char why[GOLDEN_REASON];
    scene_frame frame = middle_of(bands, index);
    assert_true(golden_accepts(bands, index, &frame, why));
    for (int i = 0; i < SCENE_NUMBERS; i++) {
        const double low = scene_frame_values(&bands->low[index])[i], high = scene_frame_values(&bands->high[index])[i];
        const double wrong[] = {nextafter(low, -INFINITY), nextafter(high, INFINITY), NAN, INFINITY, -INFINITY};
        double *number = scene_frame_numbers(&frame) + i;
        const double right = *number;
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
            *number = wrong[k];
            assert_false(golden_accepts(bands, index, &frame, why));
            assert_non_null(strstr(why, scene_quantity_name(scene_quantity_of(i))));
        }
        *number = right;
    }
}

static void test_values_outside_a_band_are_rejected(void **state)
{
    (void)state;
    for (int i = 0; i < scene_variant_count; i++) {
        const golden bands = golden_bands_or_fail(&scene_variants[i]);
        for (int k = 0; k < bands.frame_count; k++) {
            assert_frame_is_tight(&bands, k);
        }
    }
}

/* The middles of all frames, as a run would show them; `steps` of them. */
static golden_check watched(const golden *bands, int steps)
{
    golden_check check = {.bands = bands};
    int index = 0;
    for (int step = 1; step <= steps; step++) {
        const scene_frame frame = middle_of(bands, index);
        assert_true(golden_watch(&check, step, &frame));
        index += step == bands->frames[index] && index + 1 < bands->frame_count;
    }
    return check;
}

static void test_runs_of_another_shape_are_rejected(void **state)
{
    (void)state;
    const golden bands = bands_of("free-fall");
    golden_check whole = watched(&bands, bands.steps), shorter = watched(&bands, bands.steps - 1), longer = watched(&bands, bands.steps + 1);
    const int probe[SCENE_PROBES] = {bands.probe[0], bands.probe[1], bands.probe[2] + 1};
    assert_true(golden_verdict(&whole, bands.steps, bands.probe));
    assert_false(golden_verdict(&shorter, bands.steps - 1, bands.probe));
    assert_false(golden_verdict(&shorter, bands.steps, bands.probe)); /* even if it says that it took all steps */
    assert_false(golden_verdict(&longer, bands.steps + 1, bands.probe));
    assert_false(golden_verdict(&whole, bands.steps, probe));
    scene_frame frame = middle_of(&bands, 0);
    golden_check check = {.bands = &bands};
    frame.kinetic[0] = NAN;
    assert_false(golden_watch(&check, 1, &frame));
    assert_false(golden_verdict(&check, bands.steps, bands.probe));
}

/* Bands of scenes that differ in stiffness, limit or friction are not those of one run. */
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
        const golden a = bands_of(pairs[i][0]), b = bands_of(pairs[i][1]);
        const scene_frame middle = middle_of(&a, a.frame_count - 1);
        char why[GOLDEN_REASON];
        if (golden_accepts(&b, b.frame_count - 1, &middle, why)) {
            fail_msg("%s ends within the bands of %s", pairs[i][0], pairs[i][1]);
        }
    }
}

static bool accepts_text(const char *text, char why[GOLDEN_REASON])
{
    char path[] = "/tmp/cipc-golden-XXXXXX";
    golden bands;
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

enum { TEXT_SIZE = 2048 };
#define WHOLE "{\"kinetic\": [0, 1], \"box_low\": [[0, 1], [0, 1], [0, 1]]}"

/* A file of three steps with these probes and these first and last frames. */
static const char *file_of(char text[TEXT_SIZE], const char *probes, const char *first, const char *last)
{
    snprintf(text, TEXT_SIZE, "{\"command\": \"c\", \"steps\": 3, \"probes\": %s, \"frames\": {\"1\": %s, \"2\": " WHOLE ", \"3\": %s}}", probes, first, last);
    return text;
}

static void test_broken_golden_files_are_rejected(void **state)
{
    (void)state;
    static const char *const wrong_frames[][2] = {
        {"{\"kinetic\": [1, 0], \"box_low\": [[0, 1], [0, 1], [0, 1]]}", "not 1 of"},
        {"{\"kinetic\": [0], \"box_low\": [[0, 1], [0, 1], [0, 1]]}", "not 1 of"},
        {"{\"kinetic\": [\"0\", 1], \"box_low\": [[0, 1], [0, 1], [0, 1]]}", "not 1 of"},
        {"{\"kinetic\": [0, 1, 2], \"box_low\": [[0, 1], [0, 1], [0, 1]]}", "not 1 of"},
        {"{\"kinetic\": null, \"box_low\": [[0, 1], [0, 1], [0, 1]]}", "not 1 of"},
        {"{\"kinetic\": [0, 1], \"box_low\": [[0, 1], [0, 1]]}", "not 3 of"},
        {"{\"kinetic\": [0, 1], \"box_low\": [[0, 1], [0, 1], [0, 1], [0, 1]]}", "not 3 of"},
        {"{\"kinetic\": [0, 1]}", "lacks box_low"},
        {"{\"kinetic\": [0, 1], \"box_low\": [[0, 1], [0, 1], [0, 1]], \"elastic\": [0, 1]}", "has elastic"},
        {"{\"kinetic\": [0, 1], \"box_low\": [[0, 1], [0, 1], [0, 1]], \"unheard of\": [0, 1]}", "not known"},
        {"null", "lacks"},
    };
    static const char *const wrong_files[][2] = {
        {"", "expected"},
        {"{\"command\": \"d\", \"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE "}}", "of another run"},
        {"{\"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE "}}", "no command"},
        {"{\"command\": \"c\", \"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {}}", "has 0 frames"},
        {"{\"command\": \"c\", \"steps\": 1, \"probes\": [0, 1, 2]}", "has 0 frames"},
        {"{\"command\": \"c\", \"steps\": 2, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE "}}", "lacks the last frame, 2"},
        {"{\"command\": \"c\", \"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE ", \"2\": " WHOLE "}}", "none of steps 1 to 1"},
        {"{\"command\": \"c\", \"steps\": 2, \"probes\": [0, 1, 2], \"frames\": {\"2\": " WHOLE ", \"1\": " WHOLE "}}", "lacks frame 1"},
        {"{\"command\": \"c\", \"steps\": 3, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE ", \"3\": " WHOLE "}}", "lacks frame 2"},
        {"{\"command\": \"c\", \"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {\"1\": " WHOLE ", \"1\": " WHOLE "}}", "duplicate"},
        {"{\"command\": \"c\", \"steps\": 1, \"probes\": [0, 1, 2], \"frames\": {\"1x\": " WHOLE "}}", "none of steps"},
    };
    char why[GOLDEN_REASON], text[TEXT_SIZE];
    golden bands;
    const char *good = "[0, 1, 2]";
    assert_false(golden_read("tests/golden/none.json", "c", &bands, why));
    assert_true(accepts_text(file_of(text, good, WHOLE, WHOLE), why));
    assert_false(accepts_text(file_of(text, "[0, 1]", WHOLE, WHOLE), why));
    assert_false(accepts_text(file_of(text, "[0, 1, 2, 3]", WHOLE, WHOLE), why));
    for (size_t i = 0; i < sizeof wrong_frames / sizeof wrong_frames[0]; i++) {
        assert_false(accepts_text(file_of(text, good, WHOLE, wrong_frames[i][0]), why));
        if (strstr(why, wrong_frames[i][1]) == NULL) {
            fail_msg("%s: rejected with: %s", wrong_frames[i][0], why);
        }
    }
    for (size_t i = 0; i < sizeof wrong_files / sizeof wrong_files[0]; i++) {
        assert_false(accepts_text(wrong_files[i][0], why));
        if (strstr(why, wrong_files[i][1]) == NULL) {
            fail_msg("%s: rejected with: %s", wrong_files[i][0], why);
        }
    }
}

/* A part without a program would leave its scenes out. */
static void test_every_part_has_a_program(void **state)
{
    (void)state;
    for (int part = 1; part <= GOLDEN_PARTS + 1; part++) {
        char path[SCENE_PATH];
        snprintf(path, sizeof path, "tests/scenes/test_golden_%d.c", part);
        FILE *file = fopen(path, "r");
        assert_int_equal(file != NULL, part <= GOLDEN_PARTS);
        if (file != NULL) {
            fclose(file);
        }
    }
}

/* What the first frame leaves out has to be 0 in a run. */
static void test_what_a_file_leaves_out_has_to_be_zero(void **state)
{
    (void)state;
    const golden bands = bands_of("free-fall");
    scene_frame frame = middle_of(&bands, 0);
    char why[GOLDEN_REASON];
    assert_true(golden_accepts(&bands, 0, &frame, why));
    frame.stitches[0] = 0x1p-1074;
    assert_false(golden_accepts(&bands, 0, &frame, why));
    assert_non_null(strstr(why, "stitches"));
}

/* ---- Claims ----------------------------------------------------------------------------------------------------------------- */

/* Height of the centre of mass at the end, and the largest stretch at the end of any step. */
typedef struct drape {
    double height, stretch;
} drape;

static drape draped(const char *name)
{
    const scene_request request = request_of(name);
    scene_outcome outcome = golden_run_or_fail(&request);
    const drape d = {outcome.last.centre_of_mass[1], outcome.max_step_stretch};
    print_message("%s: centre of mass at %.4f m, largest stretch at the end of a step %.4f\n", name, d.height, d.stretch);
    scene_outcome_free(&outcome);
    return d;
}

/* Claim C13: a stiff membrane on a coarse mesh keeps cloth from folding (locking), so it stays higher; a soft one drapes, but stretches far
 * beyond what cloth does; a soft one with a strain limit does neither. */
static void test_strain_limit_cures_membrane_locking(void **state)
{
    (void)state;
    const drape stiff = draped("drape-membrane-1"), medium = draped("drape-membrane-0.1"), soft = draped("drape-membrane-0.01"),
                cured = draped("drape-membrane-0.01-limit-1.0608");
    assert_true(stiff.height > medium.height && medium.height > soft.height);
    assert_true(stiff.stretch < medium.stretch && medium.stretch < soft.stretch);
    assert_true(cured.height < stiff.height);    /* drapes, */
    assert_true(cured.stretch < medium.stretch); /* and stretches no more than it may */
    assert_true(soft.stretch > 1.0608 && medium.stretch > 1.0608); /* cotton's limit (docs/scene.md) */
    claim_figure("C13", "drape: height of the centre of mass, membrane 1, above that of 0.01 with the limit", stiff.height - cured.height, "m", CLAIM_MORE, 0);
    claim_figure("C13", "drape: largest stretch, membrane 0.1, above that of 0.01 with the limit", medium.stretch - cured.stretch, "1", CLAIM_MORE, 0);
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
        scene_outcome outcome = golden_run_or_fail(&request);
        golden_assert_monitored(&outcome);
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
        scene_outcome outcome = golden_run_or_fail(&request);
        golden_assert_monitored(&outcome);
        golden_print_figures(sizes[i][0], &outcome);
        assert_true(outcome.max_contacts > 0 && outcome.max_friction > 0);
        assert_true(outcome.last.box_low[1] < -0.158); /* on the ground, which is at -0.16 */
        gap = fmin(gap, outcome.min_gap);
        used = fmax(used, outcome.max_stretch_ratio);
        scene_outcome_free(&outcome);
    }
    claim_figure("C14", "drape to 0.4 s, h = 0.02, 0.01, 0.004 s: smallest gap - xi at any accepted point", gap, "m", CLAIM_MORE, 0);
    claim_figure("C14", "the same: part of the strain limit used at any accepted point", used, "1", CLAIM_LESS, 1);
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--list") == 0) {
        for (int i = 0; i < scene_variant_count; i++) {
            puts(scene_variants[i].name);
        }
        return 0;
    }
    if (argc == 6 && strcmp(argv[1], "--record") == 0) {
        const scene_variant *variant = scene_variant_of(argv[2]);
        return variant != NULL && scene_record(variant, atoi(argv[3]), strtod(argv[4], NULL), strtoul(argv[5], NULL, 10)) ? 0 : 1;
    }
    const struct CMUnitTest checks[] = {
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_threads_change_nothing_in_larger_systems),
        cmocka_unit_test(test_comparison_of_threads_sees_one_ulp),
        cmocka_unit_test(test_values_outside_a_band_are_rejected),
        cmocka_unit_test(test_runs_of_another_shape_are_rejected),
        cmocka_unit_test(test_every_part_has_a_program),
        cmocka_unit_test(test_what_a_file_leaves_out_has_to_be_zero),
        cmocka_unit_test(test_bands_tell_variants_apart),
        cmocka_unit_test(test_broken_golden_files_are_rejected),
    };
    const struct CMUnitTest claims[] = {
        cmocka_unit_test(test_strain_limit_cures_membrane_locking),
        cmocka_unit_test(test_friction_threshold),
        cmocka_unit_test(test_smaller_time_steps_keep_every_invariant),
    };
    return cmocka_run_group_tests_name("checks", checks, NULL, NULL) + cmocka_run_group_tests_name("claims", claims, NULL, NULL);
}
