/* cipc run: the arguments. */
#include "cli/command.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include "cli/simulation.h"

enum { KEY_STEPS = 0x2001, KEY_SET, KEY_THREADS, KEY_RESUME, KEY_NO_MONITOR, KEY_OBJ, KEY_JUNIT, KEY_RECORD_CCD, KEY_RECORD_CCD_LIMIT, MOST_THREADS = 1024 };
enum { RECORDED_QUERIES = 20000, MOST_RECORDED_QUERIES = 10000000 };

typedef struct request {
    const char *scene_path, *directory, *junit;
    const char **overrides; /* as given, and "steps=N" of --steps */
    int override_count;
    char steps[32];
    long threads;           /* 0: as the scene says */
    const char *record_ccd; /* NULL: no record */
    long record_ccd_limit;  /* 0: not given */
    bool resume, no_monitor, quiet, obj;
} request;

static cipc_status take_steps(request *r, const char *value, cipc_error *error)
{
    long steps = 0;
    cipc_status status = cipc_parse_integer("--steps", value, 0, INT_MAX, &steps, error);
    snprintf(r->steps, sizeof r->steps, "steps=%ld", steps);
    return status;
}

static cipc_status take_operand(request *r, const char *value, cipc_error *error)
{
    if (r->scene_path != NULL) {
        return cipc_fail(error, CIPC_E_USAGE, "run", "surplus argument '%s': one scene at a time", value);
    }
    r->scene_path = value;
    return CIPC_OK;
}

static cipc_status take(void *input, int key, char *value, cipc_error *error)
{
    request *r = input;
    switch (key) {
    case 0: return take_operand(r, value, error);
    case 'o': r->directory = value; return CIPC_OK;
    case KEY_STEPS: return take_steps(r, value, error);
    case KEY_SET: r->overrides[r->override_count++] = value; return CIPC_OK;
    case KEY_THREADS: return cipc_parse_integer("--threads", value, 1, MOST_THREADS, &r->threads, error);
    case KEY_RESUME: r->resume = true; return CIPC_OK;
    case KEY_NO_MONITOR: r->no_monitor = true; return CIPC_OK;
    case KEY_OBJ: r->obj = true; return CIPC_OK;
    case KEY_JUNIT: r->junit = value; return CIPC_OK;
    case KEY_RECORD_CCD: r->record_ccd = value; return CIPC_OK;
    case KEY_RECORD_CCD_LIMIT: return cipc_parse_integer("--record-ccd-limit", value, 1, MOST_RECORDED_QUERIES, &r->record_ccd_limit, error);
    default: r->quiet = true; return CIPC_OK; /* 'q', the only one left */
    }
}

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "The folder to write to (default: out/SCENE); it is made when it does not exist", 0},
    {"steps", KEY_STEPS, "N", 0, "Take N time steps instead of as many as the scene says", 0},
    {"set", KEY_SET, "PATH=VALUE", 0,
     "Override a key of the scene, as in --set bodies.cloth.strain_limit.limit=1.01; --set size=desk applies a block of \"sizes\"", 0},
    {"threads", KEY_THREADS, "N", 0, "Number of threads; results do not depend on it", 0},
    {"resume", KEY_RESUME, NULL, 0, "Go on after the last whole frame in the folder", 0},
    {"no-monitor", KEY_NO_MONITOR, NULL, 0, "Do not check the invariants: the run then proves nothing", 0},
    {"obj", KEY_OBJ, NULL, 0, "Write a Wavefront OBJ file per frame as well", 0},
    {"junit", KEY_JUNIT, "FILE", 0, "Write the verdicts as JUnit XML too, for continuous integration systems", 0},
    {"record-ccd", KEY_RECORD_CCD, "FILE", 0,
     "Write the queries that the run puts to continuous collision detection to FILE, for cipc ccd, cipc eval and other codebases", 0},
    {"record-ccd-limit", KEY_RECORD_CCD_LIMIT, "N", 0, "Record at most N of them, spread over the whole run (default 20000)", 0},
    {"quiet", 'q', NULL, 0, "No progress line", 0},
    {0},
};
static const cipc_arguments arguments = {
    "cipc run",
    options,
    "SCENE.json",
    "Simulate a scene and write what happened to a folder: trajectory.h5 and .xdmf, stats.jsonl, summary.json, scene.json, frames.png, "
    "plots.png."
    "\vExit status: 0 every step converged and every invariant held; 1 the computation failed; 2 bad usage or bad input; 3 an invariant "
    "broke.",
    take,
};

/* "tests/scenes/drape.json" -> "drape". */
static void scene_name(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/'), *base = slash != NULL ? slash + 1 : path;
    snprintf(name, size, "%s", base);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name && strcmp(dot, ".json") == 0) {
        *dot = '\0';
    }
}

static void join_words(int argc, char **argv, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "cipc");
    for (int i = 0; i < argc && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, " %s", argv[i]);
    }
}

/* A scene that cannot be used: no earlier file of verdicts may stay for this run's. */
static int refused(const request *r, const char *name, const cipc_error *error)
{
    cipc_run_summary summary = cipc_run_summary_default();
    summary.scene_name = name;
    summary.status = error->status;
    summary.error = error;
    return cipc_verdicts_junit(r->junit, &summary, cipc_say(error));
}

/* Options that the method cannot follow. Nothing is put to continuous collision detection where there is none: an empty file would look like a run without contact. */
static cipc_status check_method(const request *r, const cipc_scene *scene, cipc_error *error)
{
    if (r->record_ccd == NULL || scene->method == CIPC_METHOD_C_IPC) {
        return CIPC_OK;
    }
    cipc_fail(error, CIPC_E_USAGE, "--record-ccd", "the method %s asks nothing of continuous collision detection", cipc_method_name(scene->method));
    return cipc_fail_remedy(error, "leave the option out, or add --set method=c-ipc");
}

static int run(const request *r, const char *command)
{
    char name[256], directory[512];
    scene_name(r->scene_path, name, sizeof name);
    snprintf(directory, sizeof directory, "out/%s", name);
    cipc_error error;
    cipc_scene *scene = NULL;
    if (cipc_scene_load(&scene, r->scene_path, r->override_count, r->overrides, &error) != CIPC_OK) {
        return refused(r, name, &error);
    }
    if (check_method(r, scene, &error) != CIPC_OK) {
        cipc_scene_destroy(scene);
        return refused(r, name, &error);
    }
    if (r->threads > 0) {
        scene->options.threads = (int)r->threads;
    }
    const cipc_run_request asked = {
        .scene_name = name, .directory = r->directory != NULL ? r->directory : directory, .command = command, .junit = r->junit, .resume = r->resume,
        .monitor = scene->monitor && !r->no_monitor, .quiet = r->quiet, .write_obj = r->obj || scene->write_obj,
        .record_ccd = r->record_ccd, .record_ccd_limit = r->record_ccd_limit > 0 ? r->record_ccd_limit : RECORDED_QUERIES,
    };
    const int exit_status = cipc_simulate(scene, &asked);
    cipc_scene_destroy(scene);
    return exit_status;
}

static cipc_status parse(request *r, int argc, char **argv, bool *answered, cipc_error *error)
{
    cipc_status status = cipc_parse_arguments(&arguments, argc, argv, r, answered, error);
    if (status != CIPC_OK || *answered) {
        return status;
    }
    if (r->scene_path == NULL) {
        cipc_fail(error, CIPC_E_USAGE, "run", "no scene is given");
        return cipc_fail_remedy(error, "name a scene file, as in cipc run tests/scenes/drape.json; see cipc run --help");
    }
    if (r->directory != NULL && r->directory[0] == '\0') {
        return cipc_fail(error, CIPC_E_USAGE, "--output", "the folder's name is empty");
    }
    if (r->record_ccd != NULL && r->record_ccd[0] == '\0') {
        return cipc_fail(error, CIPC_E_USAGE, "--record-ccd", "the file's name is empty");
    }
    if (r->record_ccd == NULL && r->record_ccd_limit > 0) {
        cipc_fail(error, CIPC_E_USAGE, "--record-ccd-limit", "nothing is recorded");
        return cipc_fail_remedy(error, "name the file with --record-ccd FILE");
    }
    if (r->steps[0] != '\0') {
        r->overrides[r->override_count++] = r->steps;
    }
    return CIPC_OK;
}

int cipc_command_run(int argc, char **argv)
{
    cipc_error error;
    bool answered = false;
    request r = {.overrides = cipc_alloc((size_t)argc + 1, sizeof r.overrides[0])};
    int exit_status = 0;
    char command[2048];
    join_words(argc, argv, command, sizeof command); /* now: argp changes the order of the words */
    if (r.overrides == NULL) {
        cipc_fail(&error, CIPC_E_OUT_OF_MEMORY, "run", "no memory to read the arguments");
        return cipc_say(&error);
    }
    if (parse(&r, argc, argv, &answered, &error) != CIPC_OK) {
        exit_status = cipc_say(&error);
    } else if (!answered) {
        exit_status = run(&r, command);
    }
    cipc_free(r.overrides);
    return exit_status;
}
