/* The steps of a run: step, look, write, show. */
#include "cli/steps.h"

#include <math.h>
#include <string.h>
#include <unistd.h>
#include "cli/command.h"
#include "cli/interrupt.h"

void cipc_simulation_write_state(const cipc_simulation *s, const char *name, const double *position)
{
    cipc_error error;
    char *path = cipc_path_in(s->request->directory, name);
    if (path == NULL) {
        cipc_fail(&error, CIPC_E_OUT_OF_MEMORY, name, "no memory for a file's name");
        cipc_say(&error);
        return;
    }
    if (cipc_obj_write(path, s->scene->model, position, &error) != CIPC_OK) {
        cipc_say(&error);
    }
    cipc_free(path);
}

const cipc_steps *cipc_steps_of(cipc_method method)
{
    if (method == CIPC_METHOD_MASS_SPRING) {
        return &cipc_massspring_steps;
    }
    return method == CIPC_METHOD_ASYNCHRONOUS ? &cipc_asynchronous_steps : &cipc_implicit_steps;
}

void cipc_steps_found_at(cipc_error *error, const char *where)
{
    char place[sizeof error->place + 64], remedy[sizeof error->remedy];
    const char *monitor = strncmp(error->place, "monitor", 7) == 0 ? error->place : "monitor";
    snprintf(place, sizeof place, "%s, %s", where, monitor);
    snprintf(remedy, sizeof remedy, "%s", error->remedy);
    cipc_fail(error, error->status, place, "%s", error->what);
    cipc_fail_remedy(error, "%s", remedy);
}

cipc_status cipc_steps_interrupted(cipc_simulation *s, cipc_error *error)
{
    if (!cipc_interrupt_seen()) {
        return CIPC_OK;
    }
    s->interrupted = true;
    return cipc_fail(error, CIPC_E_NO_PROGRESS, "run", "interrupted by a signal");
}

cipc_status cipc_simulation_frame_obj(const cipc_simulation *s, cipc_error *error)
{
    char name[64];
    snprintf(name, sizeof name, "obj/frame_%05d.obj", s->scene->state->step);
    char *path = cipc_path_in(s->request->directory, name);
    if (path == NULL) {
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, name, "no memory for a file's name");
    }
    cipc_status status = cipc_obj_write(path, s->scene->model, s->scene->state->position, error);
    cipc_free(path);
    return status;
}

static bool is_power_of_two(int n)
{
    return n > 0 && (n & (n - 1)) == 0;
}

/* The statistics' line comes before the frame: after a kill in between, the line is one too many, which resuming cuts off. The XDMF file is
 * rewritten whenever the number of frames has doubled, so that it costs little and a killed run has one that shows at least half. */
static cipc_status write_step(cipc_simulation *s, cipc_error *error)
{
    const double begin = cipc_clock();
    cipc_status status = cipc_steps_of(s->scene->method)->write_line(s, error);
    if (status == CIPC_OK) {
        status = cipc_trajectory_append(s->trajectory, s->scene->state, error);
    }
    if (status == CIPC_OK && s->request->write_obj) {
        status = cipc_simulation_frame_obj(s, error);
    }
    if (status == CIPC_OK && is_power_of_two(cipc_trajectory_frames(s->trajectory))) {
        status = cipc_simulation_xdmf(s, error);
    }
    s->summary.output_seconds += cipc_clock() - begin;
    return status;
}

static void show_progress(const cipc_simulation *s)
{
    if (s->request->quiet || !isatty(STDERR_FILENO)) {
        return;
    }
    const int step = s->scene->state->step, done = step - s->first_step;
    const double left = done > 0 ? (cipc_clock() - s->begin) / done * (s->scene->steps - step) : NAN;
    cipc_steps_of(s->scene->method)->show_line(s, left);
}

static cipc_status take_step(cipc_simulation *s)
{
    s->seen = cipc_step_invariants_none();
    if (s->velocity != NULL) {
        memcpy(s->velocity, s->scene->state->velocity, 3 * (size_t)s->scene->model->node_count * sizeof *s->velocity);
    }
    cipc_status status = cipc_steps_of(s->scene->method)->take(s);
    if (status == CIPC_OK) {
        status = write_step(s, &s->error);
    } else if (!s->interrupted && cipc_status_exit(status) != 3) {
        cipc_simulation_write_state(s, "failed.obj", s->scene->state->position);
    }
    if (status == CIPC_OK) {
        s->summary.steps_taken = s->scene->state->step;
        s->summary.time = s->scene->state->time;
        show_progress(s);
    }
    return status;
}

cipc_status cipc_simulation_steps(cipc_simulation *s)
{
    cipc_status status = CIPC_OK;
    cipc_steps_of(s->scene->method)->begin(s);
    while (status == CIPC_OK && s->scene->state->step < s->scene->steps) {
        if (cipc_interrupt_seen()) {
            s->interrupted = true;
            break;
        }
        status = take_step(s);
    }
    if (!s->request->quiet && isatty(STDERR_FILENO)) {
        cipc_progress_clear(stderr);
    }
    return s->interrupted ? CIPC_OK : status;
}
