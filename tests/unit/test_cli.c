/* The program itself: exit statuses, messages, files, interruption. It is run as a user runs it; CIPC names it (default build/cipc). */
#define _XOPEN_SOURCE 700 /* posix_openpt, realpath */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <cairo.h>
#include <fcntl.h>
#include <hdf5.h>
#include <jansson.h>
#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cipc/output.h"
#include "support/sample_run.h"

/* A cloth of 3 x 3 nodes that falls on a floor; its steps are quick. */
#define FLOOR                                                                                                                              \
    "{\"name\": \"floor\", \"fixed\": true, \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [2, 2], \"cells\": [1, 1]}}}"
#define CLOTH(height)                                                                                                                      \
    "{\"name\": \"cloth\", \"material\": \"cotton\", \"strain_limit\": {\"limit\": 1.0608}, \"offset\": 1e-3, "                            \
    "\"shell\": {\"grid\": {\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.13, " height ", 0.07]}}"
#define SCENE(rest, bodies) "{\"time_step\": 0.01, \"steps\": 5, \"contact\": {\"dhat\": 1e-3}, " rest "\"bodies\": [" bodies "]}"

static const char falling[] = SCENE("", FLOOR ", " CLOTH("0.01"));
static const char crossing[] = SCENE("", FLOOR ", " CLOTH("0"));
static const char too_near[] = SCENE("", FLOOR ", " CLOTH("0.0004")); /* the pair's thickness is 0.5e-3: the floor's is 0 */
/* The same without strain limit, for the other method. */
#define LIMP_CLOTH                                                                                                                         \
    "{\"name\": \"cloth\", \"material\": \"cotton\", \"offset\": 1e-3, \"shell\": {\"grid\": {\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, "      \
    "\"transform\": {\"translate\": [0.13, 0.003, 0.07]}}"
static const char asynchronous[] = SCENE("\"method\": \"asynchronous\", ", FLOOR ", " LIMP_CLOTH);

typedef struct fixture {
    char program[PATH_MAX];
    path folder, out, scene;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    const char *program = getenv("CIPC");
    if (realpath(program != NULL ? program : "build/cipc", f->program) == NULL) {
        print_error("no program: set CIPC\n");
        return -1;
    }
    f->folder = folder_make();
    f->out = path_in(&f->folder, "new/out");
    f->scene = path_in(&f->folder, "scene.json");
    file_write(&f->scene, falling, strlen(falling));
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    folder_remove(&f->folder);
    free(f);
    return 0;
}

/* What a run of the program gave. */
typedef struct outcome {
    int exit_status; /* -1: it did not end by itself */
    char out[65536], err[8192];
} outcome;

enum { MOST_WORDS = 16 };

/* Start the program with the words given, up to NULL; its output goes to two files in the folder. */
static pid_t start(const fixture *f, va_list words)
{
    const path out = path_in(&f->folder, "stdout"), err = path_in(&f->folder, "stderr");
    char *argv[MOST_WORDS + 2] = {(char *)(uintptr_t)f->program};
    for (int i = 1; i <= MOST_WORDS && (argv[i] = va_arg(words, char *)) != NULL;) {
        i++;
    }
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        dup2(open(out.text, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        dup2(open(err.text, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        execv(f->program, argv);
        _exit(126);
    }
    assert_true(child > 0);
    return child;
}

static void read_text(const fixture *f, const char *name, char *text, size_t size)
{
    const path file = path_in(&f->folder, name);
    char *bytes = file_read(&file, NULL);
    snprintf(text, size, "%s", bytes);
    free(bytes);
}

static outcome await(const fixture *f, pid_t child)
{
    outcome o;
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    o.exit_status = WIFEXITED(how) ? WEXITSTATUS(how) : -1;
    read_text(f, "stdout", o.out, sizeof o.out);
    read_text(f, "stderr", o.err, sizeof o.err);
    return o;
}

static outcome cipc(const fixture *f, ...)
{
    va_list words;
    va_start(words, f);
    const pid_t child = start(f, words);
    va_end(words);
    return await(f, child);
}

static pid_t cipc_in_background(const fixture *f, ...)
{
    va_list words;
    va_start(words, f);
    const pid_t child = start(f, words);
    va_end(words);
    return child;
}

/* One line "cipc: where: CIPC-number: what: how to mend it" on stderr, nothing on stdout. */
static void assert_message(const outcome *o, int exit_status, const char *number, const char *part)
{
    if (o->exit_status != exit_status || o->out[0] != '\0') {
        fail_msg("exit status %d, stdout '%s', stderr '%s'", o->exit_status, o->out, o->err);
    }
    const char *end = strchr(o->err, '\n');
    if (strncmp(o->err, "cipc: ", 6) != 0 || end == NULL || end[1] != '\0' || strstr(o->err, number) == NULL ||
        strstr(o->err, part) == NULL) {
        fail_msg("stderr is '%s', without %s or '%s'", o->err, number, part);
    }
    int colons = 0;
    for (const char *c = strstr(o->err, ": "); c != NULL; c = strstr(c + 1, ": ")) {
        colons++;
    }
    assert_true(colons >= 4);
}

static json_t *load_result(const fixture *f, const char *name)
{
    const path file = path_in(&f->out, name);
    json_error_t error;
    json_t *object = json_load_file(file.text, JSON_REJECT_DUPLICATES, &error);
    if (object == NULL) {
        fail_msg("%s: %s", file.text, error.text);
    }
    return object;
}

static const char *text_of(const json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

/* ---- Usage ----------------------------------------------------------------------------------------------------------------- */

static void test_help_and_version(void **state)
{
    const fixture *f = *state;
    outcome o = cipc(f, "--version", NULL);
    char expected[64];
    snprintf(expected, sizeof expected, "cipc %s\n", cipc_version());
    assert_int_equal(o.exit_status, 0);
    assert_string_equal(o.out, expected);
    o = cipc(f, "--help", NULL);
    assert_true(o.exit_status == 0 && strstr(o.out, "scenes") != NULL && strstr(o.out, "run") != NULL);
    assert_string_equal(o.err, "");
    o = cipc(f, "help", NULL);
    assert_true(o.exit_status == 0 && strstr(o.out, "scenes") != NULL);
    const outcome by_word = cipc(f, "help", "run", NULL), by_option = cipc(f, "run", "--help", NULL);
    assert_int_equal(by_word.exit_status, 0);
    assert_string_equal(by_word.out, by_option.out);
    static const char *const options[] = {"cipc run", "SCENE.json",   "--output=DIR", "--steps=N", "--set=PATH=VALUE", "--threads=N",
                                          "--resume", "--no-monitor", "--obj",        "--quiet",   "--help",           "--version"};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        if (strstr(by_word.out, options[i]) == NULL) {
            fail_msg("no %s in the help", options[i]);
        }
    }
    o = cipc(f, "scenes", "--usage", NULL);
    assert_true(o.exit_status == 0 && strstr(o.out, "--json") != NULL);
    o = cipc(f, "run", "--version", NULL);
    assert_string_equal(o.out, expected);
}

static void test_bad_usage(void **state)
{
    const fixture *f = *state;
    const struct { const char *words[4]; const char *part; } cases[] = {
        {{NULL}, "cipc --help"},
        {{"rnu"}, "the nearest command is run"},
        {{"scene", "--json"}, "the nearest command is scenes"},
        {{"help", "rum"}, "the nearest command is run"},
        {{"--halp"}, "'--halp'"},
        {{"run"}, "no scene is given"},
        {{"run", "a.json", "b.json"}, "'b.json'"},
        {{"run", "a.json", "--stpes=4"}, "the nearest option is --steps"},
        {{"run", "a.json", "-x"}, "'-x'"},
        {{"run", "a.json", "-qx"}, "'-qx'"},
        {{"run", "a.json", "--steps"}, "'--steps' needs a value"},
        {{"run", "a.json", "-o"}, "'-o' needs a value"},
        {{"run", "a.json", "-o", ""}, "empty"},
        {{"run", "a.json", "--quiet=yes"}, "takes no value"},
        {{"run", "a.json", "--steps=4.5"}, "'4.5' is not a whole number"},
        {{"run", "a.json", "--steps=-1"}, "out of range"},
        {{"run", "a.json", "--steps=99999999999999999999"}, "out of range"},
        {{"run", "a.json", "--threads=0"}, "whole number from 1"},
        {{"run", "a.json", "--record-ccd="}, "empty"},
        {{"run", "a.json", "--record-ccd-limit=5"}, "--record-ccd FILE"},
        {{"run", "a.json", "--record-ccd=a", "--record-ccd-limit=0"}, "whole number from 1"},
        {{"scenes", "drape"}, "'drape'"},
        {{"scenes", "--jsom"}, "the nearest option is --json"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *const *w = cases[i].words;
        const outcome o = cipc(f, w[0], w[1], w[2], w[3], NULL);
        assert_message(&o, 2, "CIPC-2001", cases[i].part);
    }
}

static void test_scenes(void **state)
{
    const fixture *f = *state;
    const outcome table = cipc(f, "scenes", NULL), as_json = cipc(f, "scenes", "--json", NULL);
    assert_true(table.exit_status == 0 && as_json.exit_status == 0);
    json_t *list = json_loads(as_json.out, JSON_REJECT_DUPLICATES, NULL);
    assert_true(json_array_size(list) > 0);
    size_t index;
    json_t *entry;
    json_array_foreach(list, index, entry) {
        static const char *const keys[] = {"name", "title", "source", "file"};
        for (int k = 0; k < 4; k++) {
            const char *text = text_of(entry, keys[k]);
            assert_true(text != NULL && strstr(table.out, text) != NULL);
        }
    }
    json_decref(list);
}

/* ---- Bad input ------------------------------------------------------------------------------------------------------------- */

static void assert_nothing_written(const fixture *f)
{
    assert_false(file_exists(&f->out));
}

static void test_bad_scenes(void **state)
{
    const fixture *f = *state;
    outcome o = cipc(f, "run", "/no/such/scene.json", "-o", f->out.text, NULL);
    assert_message(&o, 2, "CIPC-2007", "/no/such/scene.json");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "bodies.cloth.densty=3", NULL);
    assert_message(&o, 2, "CIPC-200", "densty");
    const struct { const char *text, *number, *part; } cases[] = {
        {"{\"steps\": 1,\n  }", "CIPC-2002", "scene.json:2"},
        {SCENE("\"newtn\": {}, ", FLOOR), "CIPC-2003", "newtn"},
        {crossing, "CIPC-2009", "\"cloth\""},
        {too_near, "CIPC-2010", "\"cloth\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        file_write(&f->scene, cases[i].text, strlen(cases[i].text));
        o = cipc(f, "run", f->scene.text, "-o", f->out.text, NULL);
        assert_message(&o, 2, cases[i].number, cases[i].part);
        o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--no-monitor", NULL); /* the start is checked all the same */
        assert_message(&o, 2, cases[i].number, cases[i].part);
    }
    assert_nothing_written(f);
}

static const char *const result_names[] = {"trajectory.h5", "trajectory.xdmf", "stats.jsonl", "summary.json",
                                           "scene.json",    "frames.png",      "plots.png"};
enum { RESULT_COUNT = sizeof result_names / sizeof result_names[0] };

static void test_bad_scene_leaves_earlier_results(void **state)
{
    const fixture *f = *state;
    char *before[RESULT_COUNT];
    size_t sizes[RESULT_COUNT];
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, NULL).exit_status, 0);
    for (int i = 0; i < RESULT_COUNT; i++) {
        const path file = path_in(&f->out, result_names[i]);
        before[i] = file_read(&file, &sizes[i]);
    }
    file_write(&f->scene, crossing, strlen(crossing));
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, NULL).exit_status, 2);
    for (int i = 0; i < RESULT_COUNT; i++) {
        const path file = path_in(&f->out, result_names[i]);
        size_t size;
        char *after = file_read(&file, &size);
        assert_int_equal(size, sizes[i]);
        assert_memory_equal(after, before[i], size);
        free(after);
        free(before[i]);
    }
}

/* ---- Runs ------------------------------------------------------------------------------------------------------------------ */

static int count_lines(const path *file)
{
    int lines = 0;
    char *text = file_read(file, NULL);
    for (const char *c = text; *c != '\0'; c++) {
        lines += *c == '\n';
    }
    free(text);
    return lines;
}

static void assert_is_png(const fixture *f, const char *name)
{
    const path file = path_in(&f->out, name);
    cairo_surface_t *surface = cairo_image_surface_create_from_png(file.text);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_true(cairo_image_surface_get_width(surface) > 400);
    cairo_surface_destroy(surface);
}

static int frames_of(const fixture *f)
{
    cipc_error error;
    int frames = 0;
    const path h5 = path_in(&f->out, "trajectory.h5");
    if (cipc_trajectory_count(h5.text, &frames, &error) != CIPC_OK) {
        fail_msg("%s: %s", error.place, error.what);
    }
    return frames;
}

static void test_good_run_writes_everything(void **state)
{
    const fixture *f = *state;
    const outcome o = cipc(f, "run", f->scene.text, "--output", f->out.text, "--steps", "7", "--obj", "--threads", "2", NULL);
    assert_int_equal(o.exit_status, 0);
    assert_string_equal(o.out, "");
    assert_string_equal(o.err, ""); /* no progress line: stderr is not a terminal */
    for (int i = 0; i < RESULT_COUNT; i++) {
        const path file = path_in(&f->out, result_names[i]);
        assert_true(file_exists(&file));
    }
    const path stats = path_in(&f->out, "stats.jsonl"), last = path_in(&f->out, "obj/frame_00007.obj"),
               none = path_in(&f->out, "obj/frame_00008.obj");
    assert_int_equal(count_lines(&stats), 7);
    assert_int_equal(frames_of(f), 8);
    assert_true(file_exists(&last) && !file_exists(&none));
    assert_is_png(f, "frames.png");
    assert_is_png(f, "plots.png");
    json_t *summary = load_result(f, "summary.json"), *scene = load_result(f, "scene.json");
    const json_t *invariants = json_object_get(summary, "invariants");
    assert_string_equal(text_of(summary, "status"), "OK");
    assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), 7);
    assert_int_equal(json_integer_value(json_object_get(summary, "threads")), 2);
    assert_string_equal(text_of(invariants, "M1"), "holds");
    assert_string_equal(text_of(invariants, "M2"), "holds");
    assert_string_equal(text_of(invariants, "M3"), "holds");
    assert_string_equal(text_of(invariants, "M4"), "not checked"); /* there are no tetrahedra */
    assert_string_equal(text_of(invariants, "M6"), "holds");
    assert_string_equal(text_of(invariants, "M7"), "not checked: gravity");
    assert_string_equal(text_of(invariants, "M8"), "holds");
    assert_string_equal(text_of(json_object_get(summary, "scene"), "name"), "scene");
    assert_int_equal(json_integer_value(json_object_get(scene, "steps")), 7);
    assert_non_null(strstr(text_of(summary, "command"), "--steps 7 --obj"));
    json_decref(summary);
    json_decref(scene);
}

static void test_default_folder(void **state)
{
    const fixture *f = *state;
    char here[PATH_MAX];
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(f->folder.text), 0);
    const outcome o = cipc(f, "run", "scene.json", "--steps=1", "-q", NULL);
    assert_int_equal(chdir(here), 0);
    assert_int_equal(o.exit_status, 0);
    const path summary = path_in(&f->folder, "out/scene/summary.json");
    assert_true(file_exists(&summary));
}

static void test_run_without_monitors_claims_nothing(void **state)
{
    const fixture *f = *state;
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--no-monitor", NULL).exit_status, 0);
    json_t *summary = load_result(f, "summary.json");
    const char *key;
    json_t *verdict;
    json_object_foreach(json_object_get(summary, "invariants"), key, verdict) {
        assert_string_equal(json_string_value(verdict), "not checked");
    }
    json_decref(summary);
}

/* A cloth thrown at another one without gravity: the sum of their momenta is kept, as far as rounding goes. */
static void test_run_without_outer_forces(void **state)
{
    const fixture *f = *state;
    static const char thrown[] = SCENE("\"gravity\": [0, 0, 0], ",
                                       "{\"name\": \"other\", \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [0.3, 0.3], \"cells\": [3, 3]}}}, "
                                       "{\"name\": \"thrown\", \"material\": \"cotton\", \"velocity\": [0.1, -1, 0], \"shell\": {\"grid\": {\"size\": [0.2, 0.2], "
                                       "\"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.03, 0.01, 0.02]}}");
    file_write(&f->scene, thrown, strlen(thrown));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, NULL);
    assert_string_equal(o.err, "");
    assert_int_equal(o.exit_status, 0);
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M7"), "holds");
    assert_int_equal(json_integer_value(json_object_get(json_object_get(summary, "monitors"), "momentum_checks")), 5);
    const json_t *extremes = json_object_get(summary, "extremes");
    assert_true(json_integer_value(json_object_get(extremes, "max_contacts")) > 0);
    assert_true(json_real_value(json_object_get(extremes, "max_momentum_change")) < 1e-12);
    json_decref(summary);
}

/* A new run in the same folder: nothing of the longer, failed one before it remains. */
static void test_new_run_removes_stale_results(void **state)
{
    const fixture *f = *state;
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--obj", NULL);
    assert_int_equal(o.exit_status, 0);
    static const char *const names[] = {"violation.obj", "violation.json", "failed.obj", "obj/frame_00001.obj", "obj/frame_00005.obj"};
    enum { STALE = sizeof names / sizeof names[0] };
    for (int i = 0; i < STALE - 2; i++) {
        const path file = path_in(&f->out, names[i]);
        file_write(&file, "", 0);
    }
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=0", NULL);
    assert_int_equal(o.exit_status, 0);
    for (int i = 0; i < STALE; i++) {
        const path file = path_in(&f->out, names[i]);
        assert_false(file_exists(&file));
    }
    assert_int_equal(frames_of(f), 1);
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M1"), "not checked"); /* there was no point to look at */
    json_decref(summary);
}

static void test_no_convergence(void **state)
{
    const fixture *f = *state;
    const outcome o =
        cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "newton.iterations=1", "--set", "newton.tolerance=1e-12", NULL);
    assert_message(&o, 1, "CIPC-1003", "step 0");
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(summary, "status"), "NOT_CONVERGED");
    assert_true(json_is_false(json_object_get(summary, "converged")));
    const path failed = path_in(&f->out, "failed.obj"), violation = path_in(&f->out, "violation.obj");
    assert_true(file_exists(&failed));
    assert_false(file_exists(&violation));
    assert_is_png(f, "plots.png");
    json_decref(summary);
}

static void assert_file_contains(const path *file, const char *part)
{
    size_t size = 0;
    char *bytes = file_read(file, &size), *text = calloc(size + 1, 1);
    assert_non_null(text);
    memcpy(text, bytes, size);
    free(bytes);
    if (strstr(text, part) == NULL) {
        fail_msg("%s: no '%s' in %s", file->text, part, text);
    }
    free(text);
}

/* Verdicts for continuous integration systems, however the run ends; an earlier file never stays for another run's. */
static void test_junit(void **state)
{
    const fixture *f = *state;
    const path file = path_in(&f->folder, "verdicts.xml");
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--junit", file.text, NULL).exit_status, 0);
    assert_file_contains(&file, "<testsuite name=\"scene\" tests=\"9\" failures=\"0\" errors=\"0\" skipped=\"2\">");
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "newton.iterations=1", "--set", "newton.tolerance=1e-12", "--junit", file.text, NULL).exit_status, 1);
    assert_file_contains(&file, "<error message=\"step 0: CIPC-1003");
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "bodies.cloth.densty=3", "--junit", file.text, NULL).exit_status, 2);
    assert_file_contains(&file, "densty");
    file_write(&f->scene, crossing, strlen(crossing));
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--junit", file.text, NULL).exit_status, 2);
    assert_file_contains(&file, "CIPC-2009");
    file_write(&f->scene, falling, strlen(falling));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--junit", "/no/such/folder/v.xml", NULL);
    assert_message(&o, 1, "CIPC-1002", "/no/such/folder/v.xml");
    assert_int_equal(cipc(f, "verify", "distance", "--samples", "400", "--quiet", "--junit", file.text, NULL).exit_status, 3); /* too few to reach every branch */
    assert_file_contains(&file, "<testsuite name=\"distance\"");
    assert_file_contains(&file, "<failure message=");
    assert_int_equal(cipc(f, "verify", "distanse", "--junit", file.text, NULL).exit_status, 2);
    assert_file_contains(&file, "errors=\"1\"");
}

/* A port that answers one query right, one wrong, one not at all, and a question that nobody asked. */
static void test_junit_of_judge(void **state)
{
    const fixture *f = *state;
    const path file = path_in(&f->folder, "verdicts.xml"), vectors = path_in(&f->folder, "v.jsonl"), answers = path_in(&f->folder, "a.jsonl");
    static const char asked[] = "{\"id\":1,\"fn\":\"intersect_edge_triangle\",\"x\":[0,0,-1,0,0,1,-1,-1,0,2,-1,0,-1,2,0],\"want\":{\"intersects\":true}}\n"
                                "{\"id\":2,\"fn\":\"intersect_edge_triangle\",\"x\":[0,0,-1,0,0,1,-1,-1,0,2,-1,0,-1,2,0],\"want\":{\"intersects\":true}}\n"
                                "{\"id\":3,\"fn\":\"intersect_edge_triangle\",\"x\":[0,0,-1,0,0,1,-1,-1,0,2,-1,0,-1,2,0],\"want\":{\"intersects\":true}}\n";
    static const char answered[] = "{\"id\":1,\"fn\":\"intersect_edge_triangle\",\"got\":{\"intersects\":true}}\n"
                                   "{\"id\":2,\"fn\":\"intersect_edge_triangle\",\"got\":{\"intersects\":false}}\n"
                                   "{\"id\":9,\"fn\":\"intersect_edge_triangle\",\"got\":{\"intersects\":true}}\n";
    file_write(&vectors, asked, strlen(asked));
    file_write(&answers, answered, strlen(answered));
    assert_int_equal(cipc(f, "judge", vectors.text, answers.text, "--junit", file.text, NULL).exit_status, 3);
    assert_file_contains(&file, "<testsuite name=\"cipc judge\" tests=\"2\" failures=\"2\"");
    assert_file_contains(&file, "2 answers are wrong or missing");
    assert_file_contains(&file, "answer no question: 1");
    assert_int_equal(cipc(f, "judge", "/no/such/vectors", "--junit", file.text, NULL).exit_status, 2);
    assert_file_contains(&file, "errors=\"1\"");
}

static void test_unwritable_folder(void **state)
{
    const fixture *f = *state;
    const path inside_a_file = path_in(&f->scene, "out"); /* also root cannot make that */
    const outcome o = cipc(f, "run", f->scene.text, "-o", inside_a_file.text, NULL);
    assert_message(&o, 1, "CIPC-1002", "scene.json");
    const outcome is_file = cipc(f, "run", f->scene.text, "-o", f->scene.text, NULL);
    assert_message(&is_file, 1, "CIPC-1002", "scene.json");
}

/* A limit on the size of files stands in for a full disk: whatever is cut short, the program ends by itself with status 1 and says so. */
static void test_no_space(void **state)
{
    const fixture *f = *state;
    const rlim_t limits[] = {100, 5000, 20000, 37000}; /* the last lets the trajectory through, not the pictures */
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        struct rlimit before, lowered;
        assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
        lowered = (struct rlimit){limits[i], before.rlim_max};
        signal(SIGXFSZ, SIG_IGN);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &lowered), 0);
        const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, NULL);
        setrlimit(RLIMIT_FSIZE, &before);
        signal(SIGXFSZ, SIG_DFL);
        assert_int_equal(o.exit_status, 1);
        assert_true(limits[i] < 1000 || strstr(o.err, "CIPC-1002") != NULL); /* below, the message itself may not fit into its file */
    }
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(summary, "status"), "IO");
    assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), 5);
    json_decref(summary);
}

static void test_full_standard_output(void **state)
{
    const fixture *f = *state;
    const path out = path_in(&f->folder, "stdout"), err = path_in(&f->folder, "stderr");
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO);
        dup2(open(err.text, O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        execl(f->program, f->program, "scenes", "--json", (char *)NULL);
        _exit(126);
    }
    file_write(&out, "", 0);
    const outcome o = await(f, child);
    assert_message(&o, 1, "CIPC-1002", "standard output");
}

static void test_progress_on_a_terminal(void **state)
{
    const fixture *f = *state;
    for (int quiet = 0; quiet < 2; quiet++) {
        const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
        if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) { /* a bare chroot without /dev/pts */
            print_message("this machine has no pseudo-terminals: the progress line cannot be looked at\n");
            skip();
        }
        const int end = open(ptsname(terminal), O_RDWR | O_NOCTTY);
        const pid_t child = fork();
        if (child == 0) {
            dup2(end, STDERR_FILENO);
            close(terminal);
            execl(f->program, f->program, "run", f->scene.text, "-o", f->out.text, quiet ? "-q" : "--steps=3", (char *)NULL);
            _exit(126);
        }
        close(end);
        char text[8192];
        size_t length = 0;
        ssize_t got = 0;
        while (length < sizeof text - 1 && (got = read(terminal, text + length, sizeof text - 1 - length)) > 0) {
            length += (size_t)got;
        }
        text[length] = '\0';
        int how;
        assert_int_equal(waitpid(child, &how, 0), child);
        assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
        if (quiet) {
            assert_int_equal(length, 0);
        } else {
            assert_non_null(strstr(text, "step 1/3"));
            assert_non_null(strstr(text, "step 3/3"));
        }
        close(terminal);
    }
}

/* ---- Interruption and resuming ------------------------------------------------------------------------------------------------ */

/* Run for very many steps; once statistics have been written `writes` times, send the signal. No waiting by the clock: the system tells. */
static outcome interrupt(const fixture *f, int signal_number, int writes)
{
    const path parent = path_in(&f->folder, "new");
    (void)mkdir(parent.text, 0700);
    (void)mkdir(f->out.text, 0700);
    const int watch = inotify_init1(IN_CLOEXEC);
    assert_true(watch >= 0 && inotify_add_watch(watch, f->out.text, IN_MODIFY) >= 0);
    const pid_t child = cipc_in_background(f, "run", f->scene.text, "-o", f->out.text, "--steps=1000000", NULL);
    for (int seen = 0; seen < writes;) {
        _Alignas(struct inotify_event) char events[4096];
        const ssize_t length = read(watch, events, sizeof events);
        assert_true(length > 0);
        for (const char *at = events; at < events + length;) {
            const struct inotify_event *event = (const void *)at;
            seen += event->len > 0 && strcmp(event->name, "stats.jsonl") == 0;
            at += sizeof *event + event->len;
        }
    }
    close(watch);
    assert_int_equal(kill(child, signal_number), 0);
    return await(f, child);
}

static double *last_positions(const fixture *f, int *frames, int *numbers)
{
    cipc_error error;
    const path h5 = path_in(&f->out, "trajectory.h5");
    json_t *summary = load_result(f, "summary.json");
    const int nodes = (int)json_integer_value(json_object_get(json_object_get(summary, "model"), "nodes"));
    json_decref(summary);
    assert_true(nodes > 0);
    double *x = calloc(3 * (size_t)nodes, sizeof *x), time;
    *numbers = 3 * nodes;
    *frames = frames_of(f);
    if (cipc_trajectory_read(h5.text, *frames - 1, x, nodes, &time, &error) != CIPC_OK) {
        fail_msg("%s: %s", error.place, error.what);
    }
    return x;
}

/* The frames that an interrupted and resumed run ends with are those of a run in one go, bit for bit. */
static void resume_and_compare(const fixture *f, int more)
{
    char steps[32];
    int frames, numbers, frames_in_one_go;
    const int before = frames_of(f);
    snprintf(steps, sizeof steps, "--steps=%d", before - 1 + more);
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", steps, NULL);
    assert_string_equal(o.err, "");
    assert_int_equal(o.exit_status, 0);
    double *resumed = last_positions(f, &frames, &numbers);
    assert_int_equal(frames, before + more);
    const path stats = path_in(&f->out, "stats.jsonl");
    assert_int_equal(count_lines(&stats), frames - 1);
    json_t *summary = load_result(f, "summary.json");
    assert_int_equal(json_integer_value(json_object_get(summary, "resumed_from")), before - 1);
    assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), frames - 1);
    const char *gap = text_of(json_object_get(summary, "invariants"), "M2");
    assert_true(strcmp(gap, "holds") == 0 || strncmp(gap, "counted: ", 9) == 0);
    const json_int_t points = json_integer_value(json_object_get(json_object_get(summary, "monitors"), "points_checked"));
    json_decref(summary);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, steps, NULL).exit_status, 0);
    double *in_one_go = last_positions(f, &frames_in_one_go, &numbers);
    assert_int_equal(frames_in_one_go, frames);
    assert_memory_equal(resumed, in_one_go, (size_t)numbers * sizeof *resumed);
    summary = load_result(f, "summary.json");
    assert_int_equal(json_integer_value(json_object_get(json_object_get(summary, "monitors"), "points_checked")), points);
    json_decref(summary);
    free(resumed);
    free(in_one_go);
}

static void test_interrupted_run(void **state)
{
    const fixture *f = *state;
    const int signals[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        const outcome o = interrupt(f, signals[i], 5);
        assert_int_equal(o.exit_status, 1);
        assert_non_null(strstr(o.err, "interrupted"));
        assert_non_null(strstr(o.err, "--resume"));
        json_t *summary = load_result(f, "summary.json");
        assert_string_equal(text_of(summary, "status"), "INTERRUPTED");
        assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), frames_of(f) - 1);
        json_decref(summary);
        assert_is_png(f, "frames.png");
        resume_and_compare(f, 3);
    }
}

static void test_killed_run(void **state)
{
    const fixture *f = *state;
    for (int writes = 1; writes <= 9; writes += 4) {
        const outcome o = interrupt(f, SIGKILL, writes);
        assert_int_equal(o.exit_status, -1);
        assert_true(frames_of(f) >= writes - 1);
        resume_and_compare(f, 2);
    }
}

/* A record in the output folder, which the run makes; what cipc eval takes. A place that cannot be written to is refused before anything else is touched; a resumed run
 * records its own steps. */
static void test_recorded_queries(void **state)
{
    const fixture *f = *state;
    const path record = path_in(&f->out, "ccd.jsonl"), absent = path_in(&f->out, "absent/ccd.jsonl"), stats = path_in(&f->out, "stats.jsonl");
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--record-ccd", record.text, "--record-ccd-limit", "50", NULL);
    assert_int_equal(o.exit_status, 0);
    char *bytes = file_read(&record, NULL), *line = strtok(bytes, "\n");
    int count = 0;
    for (; line != NULL; line = strtok(NULL, "\n"), count++) assert_non_null(strstr(line, "\"fn\":\"toi_"));
    free(bytes);
    assert_true(count > 10 && count <= 50);
    size_t before, after;
    free(file_read(&stats, &before));
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--record-ccd", absent.text, NULL);
    assert_message(&o, 1, "CIPC-1002", "absent");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--record-ccd", f->folder.text, NULL);
    assert_message(&o, 1, "CIPC-1002", "it is a folder");
    free(file_read(&stats, &after));
    assert_int_equal(before, after);
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", "--record-ccd", record.text, NULL); /* nothing left to do, nothing asked */
    assert_int_equal(o.exit_status, 0);
    assert_int_equal(count_lines(&record), 0);
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", "--steps=7", "--record-ccd", record.text, NULL);
    assert_int_equal(o.exit_status, 0);
    bytes = file_read(&record, NULL);
    assert_non_null(strstr(bytes, "\"step\":7"));
    assert_null(strstr(bytes, "\"step\":5"));
    free(bytes);
}

/* The comparison of a record; a file that is not one. */
static void test_compared_queries(void **state)
{
    const fixture *f = *state;
    const path record = path_in(&f->folder, "ccd.jsonl"), report = path_in(&f->folder, "ccd.json"), empty = path_in(&f->folder, "empty.jsonl");
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--record-ccd", record.text, NULL).exit_status, 0);
    outcome o = cipc(f, "ccd", record.text, record.text, "--json", report.text, NULL);
    assert_int_equal(o.exit_status, 0);
    assert_true(o.err[0] == '\0' && strstr(o.out, "minimum-separation") != NULL && strstr(o.out, "\nccd ") != NULL);
    json_t *json = json_load_file(report.text, 0, NULL);
    assert_string_equal(text_of(json, "verdict"), "passed");
    const json_t *file = json_array_get(json_object_get(json, "files"), 1), *certified = json_array_get(json_object_get(file, "methods"), 0);
    assert_int_equal(json_integer_value(json_object_get(file, "queries")), count_lines(&record));
    assert_string_equal(text_of(certified, "method"), "certified");
    assert_int_equal(json_integer_value(json_object_get(certified, "usable")), json_integer_value(json_object_get(file, "judged")));
    json_decref(json);
    file_write(&empty, "", 0);
    o = cipc(f, "ccd", empty.text, NULL);
    assert_message(&o, 2, "CIPC-2013", "empty");
    o = cipc(f, "ccd", "/no/such/file.jsonl", NULL);
    assert_message(&o, 2, "CIPC-2007", "--record-ccd");
    o = cipc(f, "ccd", f->scene.text, NULL);
    assert_message(&o, 2, "CIPC-2013", "scene.json");
    o = cipc(f, "ccd", NULL);
    assert_message(&o, 2, "CIPC-2001", "no file");
}

/* ---- The method asynchronous -------------------------------------------------------------------------------------------------- */

/* One file serves both methods, but for what the other does not know: said where it stands, with a remedy that helps. */
static void test_asynchronous_run(void **state)
{
    const fixture *f = *state;
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "method=asynchronous", NULL);
    assert_message(&o, 2, "CIPC-2005", "bodies.cloth.strain_limit: ");
    assert_non_null(strstr(o.err, "scene.json:1:"));
    assert_non_null(strstr(o.err, "--set bodies.cloth.strain_limit=null"));
    assert_nothing_written(f);
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "method=asynchronous", "--set", "bodies.cloth.strain_limit=null", "--steps=8", "--obj", NULL);
    assert_string_equal(o.err, "");
    assert_int_equal(o.exit_status, 0);
    for (int i = 0; i < RESULT_COUNT; i++) {
        const path file = path_in(&f->out, result_names[i]);
        assert_true(file_exists(&file));
    }
    const path stats = path_in(&f->out, "stats.jsonl"), last = path_in(&f->out, "obj/frame_00008.obj");
    assert_true(count_lines(&stats) == 8 && frames_of(f) == 9 && file_exists(&last));
    json_t *summary = load_result(f, "summary.json");
    const json_t *invariants = json_object_get(summary, "invariants"), *monitors = json_object_get(summary, "monitors"), *totals = json_object_get(summary, "totals");
    static const char *const expected[8] = {"holds", "holds", "not checked", "not checked", "holds", "not checked: the energy oscillates", "not checked: gravity", "holds"};
    for (int i = 0; i < 8; i++) {
        const char key[3] = {'M', (char)('1' + i), '\0'};
        assert_string_equal(text_of(invariants, key), expected[i]);
    }
    assert_string_equal(text_of(summary, "method"), "asynchronous");
    const json_int_t points = json_integer_value(json_object_get(monitors, "points_checked")), windows = json_integer_value(json_object_get(monitors, "windows_checked"));
    assert_true(points - windows == 8 && windows >= 8);
    assert_true(json_integer_value(json_object_get(json_object_get(totals, "events"), "gravity")) == 8 * 16);
    assert_true(json_integer_value(json_object_get(json_object_get(summary, "extremes"), "layers")) > 0); /* it has come to the floor */
    assert_true(json_number_value(json_object_get(monitors, "seconds")) > 0);
    json_decref(summary);
    const path plots = path_in(&f->out, "plots.png");
    cairo_surface_t *surface = cairo_image_surface_create_from_png(plots.text);
    assert_int_equal(cairo_image_surface_get_width(surface), 1800); /* the plots of the method */
    cairo_surface_destroy(surface);
}

/* Without the swept monitor, and without any. */
static void test_asynchronous_run_unmonitored(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, asynchronous, strlen(asynchronous));
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "monitor.swept=false", NULL).exit_status, 0);
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M1"), "holds");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M5"), "not checked");
    assert_int_equal(json_integer_value(json_object_get(json_object_get(summary, "monitors"), "windows_checked")), 0);
    json_decref(summary);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--no-monitor", NULL).exit_status, 0);
    summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M1"), "not checked");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M6"), "not checked");
    json_decref(summary);
}

/* Two cloths that meet in free space: kicks are opposite to rounding, with friction and restitution too. */
static void test_asynchronous_momentum(void **state)
{
    const fixture *f = *state;
    static const char thrown[] = SCENE("\"method\": \"asynchronous\", \"gravity\": [0, 0, 0], \"asynchronous\": {\"restitution\": 0.5}, ",
                                       "{\"name\": \"other\", \"material\": \"cotton\", \"friction\": 0.3, \"shell\": {\"grid\": {\"size\": [0.3, 0.3], \"cells\": [3, 3]}}}, "
                                       "{\"name\": \"thrown\", \"material\": \"cotton\", \"friction\": 0.3, \"damping\": {\"stiffness\": 1e-5}, \"velocity\": [0.1, -1, 0], \"shell\": "
                                       "{\"grid\": {\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.03, 0.01, 0.02]}}");
    file_write(&f->scene, thrown, strlen(thrown));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, NULL);
    assert_string_equal(o.err, "");
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M7"), "holds");
    assert_int_equal(json_integer_value(json_object_get(json_object_get(summary, "monitors"), "momentum_checks")), 5);
    assert_true(json_integer_value(json_object_get(json_object_get(summary, "extremes"), "max_contacts")) > 0);
    assert_true(json_real_value(json_object_get(json_object_get(summary, "extremes"), "max_momentum_change")) < 1e-15);
    json_decref(summary);
}

/* A stall: earlier frames stay, the state reached is written, and a higher cap goes on to the very frames of a run with that cap. */
static void test_asynchronous_stall(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, asynchronous, strlen(asynchronous));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=6", "--set", "asynchronous.events=1500", NULL);
    assert_message(&o, 1, "CIPC-1005", "stalled: more than 1500 events");
    assert_non_null(strstr(o.err, "--resume"));
    const int frames = frames_of(f);
    assert_in_range(frames, 2, 6); /* free fall first, then contact, which has many events */
    const path failed = path_in(&f->out, "failed.obj"), violation = path_in(&f->out, "violation.obj"), stats = path_in(&f->out, "stats.jsonl");
    assert_true(file_exists(&failed) && !file_exists(&violation));
    assert_int_equal(count_lines(&stats), frames - 1);
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(summary, "status"), "NO_PROGRESS");
    assert_true(json_is_false(json_object_get(summary, "converged")));
    assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), frames - 1);
    json_decref(summary);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=6", "--resume", "--set", "asynchronous.thickness=2e-3", NULL).exit_status, 2);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=6", "--resume", "--set", "asynchronous.events=100000000", NULL).exit_status, 0);
    int count, numbers;
    double *resumed = last_positions(f, &count, &numbers);
    assert_int_equal(count, 7);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=6", NULL).exit_status, 0);
    double *in_one_go = last_positions(f, &count, &numbers);
    assert_memory_equal(resumed, in_one_go, (size_t)numbers * sizeof *resumed);
    free(resumed);
    free(in_one_go);
}

static void test_asynchronous_interruptions(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, asynchronous, strlen(asynchronous));
    const outcome o = interrupt(f, SIGINT, 5);
    assert_int_equal(o.exit_status, 1);
    assert_non_null(strstr(o.err, "interrupted"));
    const path failed = path_in(&f->out, "failed.obj");
    assert_false(file_exists(&failed)); /* nothing failed */
    json_t *summary = load_result(f, "summary.json");
    assert_string_equal(text_of(summary, "status"), "INTERRUPTED");
    json_decref(summary);
    resume_and_compare(f, 3);
    assert_int_equal(interrupt(f, SIGKILL, 4).exit_status, -1);
    resume_and_compare(f, 2);
}

/* There is no CCD whose queries could be recorded; and verdicts are written all the same. */
static void test_asynchronous_refusals(void **state)
{
    const fixture *f = *state;
    const path record = path_in(&f->folder, "ccd.jsonl"), verdicts = path_in(&f->folder, "verdicts.xml");
    file_write(&f->scene, asynchronous, strlen(asynchronous));
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--record-ccd", record.text, "--junit", verdicts.text, NULL);
    assert_message(&o, 2, "CIPC-2001", "--record-ccd: ");
    assert_file_contains(&verdicts, "--record-ccd");
    assert_nothing_written(f);
    assert_false(file_exists(&record));
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "asynchronous.thickness=-1", NULL);
    assert_message(&o, 2, "CIPC-2005", "--set asynchronous.thickness=-1");
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--junit", verdicts.text, NULL).exit_status, 0);
    assert_file_contains(&verdicts, "not checked: the energy oscillates");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", "--set", "method=c-ipc", NULL);
    assert_message(&o, 2, "CIPC-2012", "method");
}

/* Cloth that falls on a ball. */
static const char springs[] = SCENE("\"method\": \"mass-spring\", \"colliders\": [{\"name\": \"ball\", \"sphere\": {\"center\": [0, 0, 0], \"radius\": 0.1}}], ",
                                    "{\"name\": \"cloth\", \"material\": \"cotton\", \"membrane\": {\"model\": \"springs\", \"young\": 1e5}, \"velocity\": [0, -1, 0], \"shell\": {\"grid\": "
                                    "{\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.01, 0.11, 0.02]}}");

static void test_mass_spring_run(void **state)
{
    const fixture *f = *state;
    const path verdicts = path_in(&f->folder, "verdicts.xml"), stats = path_in(&f->out, "stats.jsonl"), last = path_in(&f->out, "obj/frame_00005.obj");
    file_write(&f->scene, springs, strlen(springs));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--obj", "--junit", verdicts.text, NULL);
    assert_string_equal(o.err, "");
    assert_int_equal(o.exit_status, 0);
    for (int i = 0; i < RESULT_COUNT; i++) {
        const path file = path_in(&f->out, result_names[i]);
        assert_true(file_exists(&file));
    }
    assert_true(count_lines(&stats) == 5 && frames_of(f) == 6 && file_exists(&last));
    assert_file_contains(&verdicts, "counted, not guaranteed by the method mass-spring: 0 of 5 frames");
    json_t *summary = load_result(f, "summary.json");
    static const char *const expected[8] = {"counted: 0 of 5 frames intersect", "counted: 0 of 5 frames are too near", "not checked", "not checked", "not checked: the method makes no claim about paths",
                                            "not checked: explicit steps minimise no potential", "not checked: mass-spring steps", "holds"};
    for (int i = 0; i < 8; i++) {
        const char key[3] = {'M', (char)('1' + i), '\0'};
        assert_string_equal(text_of(json_object_get(summary, "invariants"), key), expected[i]);
    }
    assert_true(json_integer_value(json_object_get(json_object_get(summary, "totals"), "hits")) > 0); /* it has come to the ball */
    json_decref(summary);
}

/* Two layers thrown at each other pass through: frames are counted, the run goes on and ends well. */
static void test_mass_spring_counts(void **state)
{
    const fixture *f = *state;
    static const char thrown[] = SCENE("\"method\": \"mass-spring\", ",
                                       "{\"name\": \"wall\", \"fixed\": true, \"material\": \"cotton\", \"shell\": {\"grid\": {\"size\": [1, 1], \"cells\": [1, 1]}}, \"transform\": {\"rotate\": "
                                       "{\"axis\": [0, 0, 1], \"angle\": 1.5}}}, {\"name\": \"cloth\", \"material\": \"cotton\", \"membrane\": {\"model\": \"springs\"}, \"velocity\": [-6, 0, 0], "
                                       "\"shell\": {\"grid\": {\"size\": [0.2, 0.2], \"cells\": [2, 2]}}, \"transform\": {\"translate\": [0.2, 0, 0.02]}}");
    file_write(&f->scene, thrown, strlen(thrown));
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, NULL);
    assert_string_equal(o.err, "");
    assert_int_equal(o.exit_status, 0);
    const path violation = path_in(&f->out, "violation.obj");
    assert_false(file_exists(&violation));
    json_t *summary = load_result(f, "summary.json");
    const json_t *counted = json_object_get(json_object_get(json_object_get(summary, "monitors"), "counted"), "M1"), *first = json_object_get(counted, "first");
    const json_int_t frames = json_integer_value(json_object_get(counted, "frames"));
    assert_in_range(frames, 1, 4);
    assert_int_equal(json_integer_value(json_object_get(first, "step")), 2); /* 0.1 m away at 0.06 m a step */
    assert_non_null(strstr(text_of(first, "what"), "body \"wall\""));
    assert_int_equal(json_integer_value(json_object_get(summary, "steps_taken")), 5);
    json_decref(summary);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--no-monitor", NULL).exit_status, 0);
    summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M1"), "not checked");
    json_decref(summary);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=2", NULL).exit_status, 0); /* it ends where they intersect, and goes on from there */
    summary = load_result(f, "summary.json");
    assert_string_equal(text_of(json_object_get(summary, "invariants"), "M1"), "counted: 1 of 2 frames intersect");
    json_decref(summary);
    resume_and_compare(f, 3);
    const outcome start = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "bodies.cloth.transform.translate=[0,0,0]", NULL);
    assert_message(&start, 2, "CIPC-2009", "the start: ");
}

static void test_mass_spring_refusals(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, springs, strlen(springs));
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "colliders.ball.sphere.radius=0.2", NULL);
    assert_message(&o, 2, "CIPC-2005", "starts inside of 'ball'");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "mass_spring.step=0.01", "--set", "mass_spring.too_long=refuse", NULL);
    assert_message(&o, 2, "CIPC-2005", "too long for these springs: at most");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--set", "method=c-ipc", NULL);
    assert_message(&o, 2, "CIPC-2005", "colliders are of the method mass-spring");
    assert_nothing_written(f);
}

/* A file of the method before its memory was written: what cannot go on alike does not go on. */
static void test_mass_spring_without_memory(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, springs, strlen(springs));
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, "--steps=2", NULL).exit_status, 0);
    const path file = path_in(&f->out, "trajectory.h5");
    hid_t h5 = H5Fopen(file.text, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(h5 >= 0 && H5Ldelete(h5, "memory", H5P_DEFAULT) >= 0);
    H5Fclose(h5);
    const outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", "--steps=4", NULL);
    assert_message(&o, 2, "CIPC-2012", "remembers 0 numbers");
    assert_int_equal(frames_of(f), 3); /* earlier results stay */
}

static void test_mass_spring_interruption(void **state)
{
    const fixture *f = *state;
    file_write(&f->scene, springs, strlen(springs));
    const outcome o = interrupt(f, SIGINT, 5);
    assert_int_equal(o.exit_status, 1);
    assert_non_null(strstr(o.err, "go on with --resume"));
    resume_and_compare(f, 6);
}

static void test_resume_refusals(void **state)
{
    const fixture *f = *state;
    outcome o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", NULL);
    assert_message(&o, 2, "CIPC-2007", "start without --resume");
    assert_nothing_written(f);
    assert_int_equal(cipc(f, "run", f->scene.text, "-o", f->out.text, NULL).exit_status, 0);
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", "--set", "contact.dhat=2e-3", NULL);
    assert_message(&o, 2, "CIPC-2012", "contact.dhat");
    o = cipc(f, "run", f->scene.text, "-o", f->out.text, "--resume", NULL); /* nothing left to do */
    assert_int_equal(o.exit_status, 0);
    assert_int_equal(frames_of(f), 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_help_and_version, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_bad_usage, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_scenes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_bad_scenes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_bad_scene_leaves_earlier_results, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_good_run_writes_everything, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_default_folder, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_run_without_monitors_claims_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_run_without_outer_forces, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_new_run_removes_stale_results, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_no_convergence, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_junit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_junit_of_judge, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_unwritable_folder, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_no_space, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_full_standard_output, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_progress_on_a_terminal, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_interrupted_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_killed_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_recorded_queries, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_compared_queries, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_run_unmonitored, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_momentum, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_stall, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_interruptions, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_asynchronous_refusals, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_mass_spring_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_mass_spring_counts, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_mass_spring_refusals, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_mass_spring_without_memory, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_mass_spring_interruption, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_resume_refusals, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
