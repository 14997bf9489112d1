/* One run of a scene: check, open, step, close. */
#include "cli/simulation.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/steps.h"

double cipc_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

char *cipc_path_in(const char *directory, const char *name)
{
    const size_t size = strlen(directory) + strlen(name) + 2;
    char *path = cipc_alloc(size, 1);
    if (path != NULL) {
        snprintf(path, size, "%s/%s", directory, name);
    }
    return path;
}

/* mkdir -p. */
static cipc_status make_directory(const char *directory, cipc_error *error)
{
    char *path = cipc_path_in(directory, "");
    if (path == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, directory, "no memory for the folder's name");
    }
    cipc_status status = CIPC_OK;
    for (char *slash = strchr(path + 1, '/'); slash != NULL && status == CIPC_OK; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST) {
            status = cipc_fail(error, CIPC_E_IO, path, "cannot create the output folder: %s", strerror(errno));
        }
        *slash = '/';
    }
    struct stat found;
    if (status == CIPC_OK && (stat(directory, &found) != 0 || !S_ISDIR(found.st_mode))) {
        status = cipc_fail(error, CIPC_E_IO, directory, "the output folder is not a folder");
        cipc_fail_remedy(error, "name another folder with -o");
    }
    cipc_free(path);
    return status;
}

/* ---- The state to begin with ---------------------------------------------------------------------------------------------- */

/* An invariant that is broken before the first step is the scene's fault, not the solver's. */
static cipc_status as_bad_input(cipc_status status)
{
    switch (status) {
    case CIPC_E_VIOLATED_INTERSECTION: return CIPC_E_INITIAL_INTERSECTION;
    case CIPC_E_VIOLATED_GAP: return CIPC_E_INITIAL_GAP;
    case CIPC_E_VIOLATED_STRAIN: return CIPC_E_INITIAL_STRAIN;
    case CIPC_E_VIOLATED_INVERSION: return CIPC_E_BAD_MESH;
    case CIPC_E_VIOLATED_FINITE: return CIPC_E_OUT_OF_RANGE;
    default: return status;
    }
}

/* Checked with or without --no-monitor: the method's promise starts from a state that keeps it. Mass-spring promises nothing, so that a run of it may go on from where it intersects. */
static cipc_status check_start(cipc_simulation *s, cipc_error *error)
{
    const bool promises = !s->request->resume || s->scene->method != CIPC_METHOD_MASS_SPRING;
    cipc_invariant_options options = cipc_invariant_options_default();
    options.reach = s->scene->monitor_reach;
    options.threads = s->scene->options.threads;
    cipc_status status = cipc_monitor_create(&s->monitor, s->scene->model, &options, error);
    if (status != CIPC_OK) {
        return status;
    }
    cipc_invariant_report report;
    cipc_invariant_report_init(&report);
    const double *x = s->scene->state->position;
    status = promises ? cipc_monitor_check(s->monitor, x, &report, error) : cipc_monitor_finite(s->scene->model, x, error);
    if (as_bad_input(status) != status) {
        return cipc_fail(error, as_bad_input(status), s->scene->path, "the start: %s", error->what);
    }
    return status;
}

/* ---- Opening -------------------------------------------------------------------------------------------------------------- */

/* Results of an earlier run in the folder, once the new trajectory has taken the old one's place. */
static void remove_stale(const cipc_simulation *s)
{
    static const char *const names[] = {"summary.json",  "trajectory.xdmf", "frames.png", "plots.png",
                                        "violation.obj", "violation.json",  "failed.obj"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char *path = cipc_path_in(s->request->directory, names[i]);
        if (path != NULL) {
            remove(path);
        }
        cipc_free(path);
    }
}

/* OBJ frames are numbered without gaps from `first` on. */
static void remove_stale_obj(const cipc_simulation *s, int first)
{
    bool found = true;
    for (int i = first; found; i++) {
        char name[64];
        snprintf(name, sizeof name, "obj/frame_%05d.obj", i);
        char *path = cipc_path_in(s->request->directory, name);
        found = path != NULL && remove(path) == 0;
        cipc_free(path);
    }
}

static cipc_status open_stats(cipc_simulation *s, const char *path, cipc_error *error)
{
    const bool resume = s->request->resume;
    if (resume) {
        cipc_status status = cipc_stats_resume(path, s->scene->state->step, &s->summary, error);
        if (status != CIPC_OK) {
            return status;
        }
        s->summary.resumed_from = s->scene->state->step;
        s->earlier_seconds = s->summary.seconds;
    }
    s->stats = fopen(path, resume ? "ab" : "wb");
    if (s->stats == NULL) {
        return cipc_fail(error, CIPC_E_IO, path, "cannot write the statistics: %s", strerror(errno));
    }
    return CIPC_OK;
}

static cipc_status open_trajectory(cipc_simulation *s, const char *path, cipc_error *error)
{
    const cipc_scene *scene = s->scene;
    const int room = scene->steps < 1000000 ? scene->steps + 1 : 1000000; /* a hint; see cipc/output.h */
    if (!s->request->resume) {
        return cipc_trajectory_create(&s->trajectory, path, scene->model, scene->state, scene->resolved, room, error);
    }
    cipc_status status = cipc_trajectory_resume(&s->trajectory, path, scene->model, scene->state, scene->resolved, room, error);
    return status != CIPC_OK ? status : check_start(s, error);
}

/* A fresh run touches nothing in the folder before its own trajectory has taken the old one's place. */
static cipc_status open_files(cipc_simulation *s, const char *trajectory, const char *stats, const char *scene, const char *obj,
                              cipc_error *error)
{
    cipc_status status = s->request->resume ? CIPC_OK : make_directory(s->request->directory, error);
    if (status == CIPC_OK && s->request->record_ccd != NULL) { /* the folder may be the place for it */
        status = cipc_ccd_record_open(&s->ccd_record, s->request->record_ccd, s->scene->model, s->request->record_ccd_limit, error);
    }
    if (status == CIPC_OK) {
        status = open_trajectory(s, trajectory, error);
    }
    if (status == CIPC_OK) {
        remove_stale(s);
        remove_stale_obj(s, s->scene->state->step + (s->request->resume ? 1 : 0));
        status = open_stats(s, stats, error);
    }
    if (status == CIPC_OK) {
        status = cipc_text_write(scene, s->scene->resolved, error);
    }
    if (status == CIPC_OK && s->request->write_obj) {
        status = make_directory(obj, error);
    }
    if (status == CIPC_OK && s->request->write_obj && !s->request->resume) {
        status = cipc_simulation_frame_obj(s, error);
    }
    return status;
}

static cipc_status open_run(cipc_simulation *s, cipc_error *error)
{
    const char *directory = s->request->directory;
    char *trajectory = cipc_path_in(directory, "trajectory.h5"), *stats = cipc_path_in(directory, "stats.jsonl");
    char *scene = cipc_path_in(directory, "scene.json"), *obj = cipc_path_in(directory, "obj");
    cipc_status status = CIPC_OK;
    if (trajectory == NULL || stats == NULL || scene == NULL || obj == NULL) {
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, directory, "no memory for the names of files");
    } else {
        status = open_files(s, trajectory, stats, scene, obj, error);
    }
    cipc_free(trajectory);
    cipc_free(stats);
    cipc_free(scene);
    cipc_free(obj);
    return status;
}

/* ---- The summary ---------------------------------------------------------------------------------------------------------- */

/* Why M7 has nothing to say, or NULL. */
static const char *momentum_source(const cipc_scene *scene)
{
    if (scene->method == CIPC_METHOD_MASS_SPRING) {
        return "mass-spring steps"; /* colliders, wind, projection and friction of cloth on itself: no bound on their rounding is derived */
    }
    return scene->options.quasistatic ? "quasistatic steps" : cipc_momentum_source(scene->model);
}

/* Pairs of bodies that pass through each other, a body and itself included. */
static int count_apart(const cipc_model *model)
{
    int count = 0;
    for (int a = 0; a < model->body_count; a++) {
        for (int b = a; b < model->body_count; b++) { count += model->pair_apart[a * model->body_count + b] ? 1 : 0; }
    }
    return count;
}

/* ---- The whole ------------------------------------------------------------------------------------------------------------ */

static void begin_summary(cipc_simulation *s)
{
    const cipc_scene *scene = s->scene;
    s->summary = cipc_run_summary_default();
    s->summary.method = scene->method;
    s->summary.scene_path = scene->path;
    s->summary.scene_size = scene->size;
    s->summary.scene_name = s->request->scene_name;
    s->summary.command = s->request->command;
    s->summary.steps_asked = scene->steps;
    s->summary.monitored = s->request->monitor;
    s->summary.swept = s->request->monitor && scene->monitor_swept && scene->method != CIPC_METHOD_MASS_SPRING;
    cipc_run_summary_of_model(&s->summary, scene->model);
    s->summary.momentum_source = momentum_source(scene);
    s->summary.bodies_apart = count_apart(scene->model);
    s->summary.stitches = scene->model->stitch_count;
    s->summary.threads = scene->options.threads;
    s->summary.seed = scene->seed;
    s->summary.limited_triangles = cipc_invariant_limited_triangles(scene->model);
}

/* Everything that can be wrong with the input, before the output folder is touched. */
static cipc_status prepare(cipc_simulation *s)
{
    cipc_status status = s->request->resume ? CIPC_OK : check_start(s, &s->error); /* a resumed run is checked when its state is known */
    if (status == CIPC_OK) {
        status = cipc_steps_of(s->scene->method)->create(s, &s->error);
    }
    return status == CIPC_OK ? open_run(s, &s->error) : status;
}

static void say_interrupted(const cipc_simulation *s)
{
    fprintf(stderr, "cipc: %s: interrupted by a signal after step %d of %d: go on with --resume\n", s->request->directory,
            s->scene->state->step < s->summary.steps_taken ? s->scene->state->step : s->summary.steps_taken, s->scene->steps);
}

/* Room for the point accepted before, for the swept monitor, and for the velocities before a step, for that of momentum. */
static cipc_status prepare_memory(cipc_simulation *s)
{
    const size_t count = 3 * (size_t)s->scene->model->node_count;
    const bool swept = s->monitor != NULL && s->scene->monitor_swept && s->scene->method == CIPC_METHOD_C_IPC; /* the other is told whole paths */
    const bool momentum = s->monitor != NULL && s->summary.momentum_source == NULL;
    if (swept) { s->previous = cipc_alloc(count, sizeof *s->previous); }
    if (momentum) { s->velocity = cipc_alloc(count, sizeof *s->velocity); }
    const bool good = (!swept || s->previous != NULL) && (!momentum || s->velocity != NULL);
    return good ? CIPC_OK : cipc_fail(&s->error, CIPC_E_OUT_OF_MEMORY, "run", "no memory for the state before a step");
}

static int run_to_the_end(cipc_simulation *s)
{
    s->first_step = s->scene->state->step;
    s->summary.steps_taken = s->scene->state->step;
    s->summary.time = s->scene->state->time;
    cipc_status status = CIPC_OK;
    if (!s->request->monitor) {
        cipc_monitor_destroy(s->monitor);
        s->monitor = NULL;
    }
    status = prepare_memory(s);
    if (status == CIPC_OK) {
        status = cipc_simulation_steps(s);
    }
    s->summary.status = status;
    s->summary.error = status != CIPC_OK ? &s->error : NULL;
    cipc_error later;
    const cipc_status end = cipc_simulation_results(s, &later);
    int exit_status = 0;
    if (status != CIPC_OK) {
        exit_status = cipc_say(&s->error);
    }
    if (end != CIPC_OK) {
        const int second = cipc_say(&later);
        exit_status = exit_status != 0 ? exit_status : second;
    }
    if (s->interrupted) {
        say_interrupted(s);
        exit_status = 1;
    }
    return exit_status;
}

static void clear(cipc_simulation *s)
{
    cipc_error ignored;
    cipc_trajectory_close(s->trajectory, &ignored); /* still open only if something else has failed and been said */
    cipc_ccd_record_discard(s->ccd_record); /* likewise */
    cipc_stepper_destroy(s->stepper);
    cipc_asynchronous_destroy(s->integrator);
    cipc_massspring_destroy(s->massspring);
    cipc_monitor_destroy(s->monitor);
    cipc_free(s->previous);
    cipc_free(s->velocity);
    if (s->stats != NULL) {
        fclose(s->stats); /* every line was flushed and checked */
    }
}

int cipc_simulate(cipc_scene *scene, const cipc_run_request *request)
{
    cipc_simulation s = {.request = request, .scene = scene, .begin = cipc_clock()};
    cipc_interrupt_hold();
    begin_summary(&s);
    int exit_status = 0;
    const cipc_status status = prepare(&s);
    if (status == CIPC_OK) {
        exit_status = run_to_the_end(&s);
    } else {
        exit_status = cipc_say(&s.error);
        s.summary.status = status;
        s.summary.error = &s.error;
    }
    exit_status = cipc_verdicts_junit(request->junit, &s.summary, exit_status);
    clear(&s);
    return exit_status;
}

int cipc_verdicts_junit(const char *path, const cipc_run_summary *summary, int exit_status)
{
    cipc_error error;
    if (path == NULL || cipc_summary_junit(path, summary, &error) == CIPC_OK) {
        return exit_status;
    }
    const int second = cipc_say(&error);
    return exit_status != 0 ? exit_status : second;
}
