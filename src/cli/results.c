/* What a run leaves behind when it ends, well or not. */
#include "cli/simulation.h"

#include <math.h>
#include <sys/resource.h>
#include "cli/command.h"
#include "cli/steps.h"

/* Paths of one call, freed together; `good` is false if any is missing. */
typedef struct paths { char *trajectory, *xdmf, *stats, *frames, *plots, *summary; bool good; } paths;

static paths paths_in(const char *directory)
{
    paths p = {
        cipc_path_in(directory, "trajectory.h5"), cipc_path_in(directory, "trajectory.xdmf"), cipc_path_in(directory, "stats.jsonl"),
        cipc_path_in(directory, "frames.png"), cipc_path_in(directory, "plots.png"), cipc_path_in(directory, "summary.json"), true,
    };
    p.good = p.trajectory != NULL && p.xdmf != NULL && p.stats != NULL && p.frames != NULL && p.plots != NULL && p.summary != NULL;
    return p;
}

static void paths_free(paths *p)
{
    char *all[] = {p->trajectory, p->xdmf, p->stats, p->frames, p->plots, p->summary};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        cipc_free(all[i]);
    }
}

static cipc_status no_memory(cipc_error *error)
{
    return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, "results", "no memory for the names of files");
}

static cipc_status write_xdmf(const char *trajectory, const char *xdmf, const cipc_model *model, cipc_error *error)
{
    int frames = 0;
    cipc_status status = cipc_trajectory_count(trajectory, &frames, error);
    double *times = NULL;
    if (status == CIPC_OK) {
        times = cipc_alloc((size_t)frames, sizeof *times);
        status = times != NULL ? cipc_trajectory_times(trajectory, times, frames, error) : no_memory(error);
    }
    if (status == CIPC_OK) {
        status = cipc_xdmf_write(xdmf, "trajectory.h5", model, frames, times, error);
    }
    cipc_free(times);
    return status;
}

cipc_status cipc_simulation_xdmf(cipc_simulation *s, cipc_error *error)
{
    paths p = paths_in(s->request->directory);
    cipc_status status = p.good ? write_xdmf(p.trajectory, p.xdmf, s->scene->model, error) : no_memory(error);
    paths_free(&p);
    return status;
}

/* Keep the first error; say every later one, so that none is lost. */
static void note(cipc_status status, const cipc_error *found, cipc_status *first, cipc_error *error)
{
    if (status == CIPC_OK) {
        return;
    }
    if (*first == CIPC_OK) {
        *first = status;
        *error = *found;
    } else {
        cipc_say(found);
    }
}

static cipc_status write_pictures(cipc_simulation *s, const paths *p, cipc_error *error)
{
    const cipc_scene *scene = s->scene;
    cipc_picture_options options = cipc_picture_options_default();
    options.azimuth = scene->camera_azimuth;
    options.elevation = scene->camera_elevation;
    options.zoom = scene->camera_zoom;
    options.subject = scene->camera_subject;
    cipc_error found;
    cipc_status status = CIPC_OK;
    note(cipc_frames_png(p->frames, p->trajectory, scene->model, &options, &found), &found, &status, error);
    note(cipc_steps_of(scene->method)->plot(s, p->plots, p->stats, &found), &found, &status, error);
    return status;
}

static void complete_summary(cipc_simulation *s)
{
    struct rusage usage;
    cipc_run_summary *summary = &s->summary;
    if (getrusage(RUSAGE_SELF, &usage) == 0) {
        summary->peak_memory_kb = usage.ru_maxrss;
    }
    summary->interrupted = s->interrupted;
    summary->seconds = s->earlier_seconds + (cipc_clock() - s->begin);
}

cipc_status cipc_simulation_results(cipc_simulation *s, cipc_error *error)
{
    const double begin = cipc_clock();
    cipc_error found;
    cipc_status status = CIPC_OK;
    note(cipc_trajectory_close(s->trajectory, &found), &found, &status, error);
    s->trajectory = NULL;
    note(cipc_ccd_record_close(s->ccd_record, &found), &found, &status, error);
    s->ccd_record = NULL;
    paths p = paths_in(s->request->directory);
    if (!p.good) {
        paths_free(&p);
        note(no_memory(&found), &found, &status, error);
        return status;
    }
    note(write_xdmf(p.trajectory, p.xdmf, s->scene->model, &found), &found, &status, error);
    note(write_pictures(s, &p, &found), &found, &status, error);
    s->summary.output_seconds += cipc_clock() - begin;
    complete_summary(s);
    if (status != CIPC_OK && s->summary.status == CIPC_OK) {
        s->summary.status = status;
        s->summary.error = error;
    }
    note(cipc_summary_write(p.summary, &s->summary, &found), &found, &status, error);
    paths_free(&p);
    return status;
}
