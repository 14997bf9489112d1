#include "support/figure_run.h"

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
#include "support/scene_run.h"

const char *figure_size(void)
{
    const char *size = getenv("CIPC_SIZE");
    return size != NULL && *size != '\0' ? size : "ci";
}

/* ---- A run that is there already --------------------------------------------------------------------------------------------- */

enum { FOLDER_SIZE = 960, PATH_SIZE = 1024 };

/* Is the file this text? */
static bool file_is(const char *path, const char *text)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) return false;
    const size_t length = strlen(text);
    char *found = malloc(length + 2);
    assert_non_null(found);
    const size_t got = fread(found, 1, length + 2, file);
    fclose(file);
    const bool same = (got == length || (got == length + 1 && found[length] == '\n')) && memcmp(found, text, length) == 0;
    free(found);
    return same;
}

static double number_at(const json_t *summary, const char *key)
{
    return json_number_value(json_object_get(json_object_get(summary, "extremes"), key));
}

/* Complete, of this scene, and monitored? Then its last frame. */
static bool take(figure_run *run, const char *folder)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%.950s/scene.json", folder);
    if (!file_is(path, run->scene->resolved)) return false;
    snprintf(path, sizeof path, "%.950s/summary.json", folder);
    json_t *summary = json_load_file(path, 0, NULL);
    const char *status = json_string_value(json_object_get(summary, "status"));
    bool good = status != NULL && strcmp(status, "OK") == 0 && json_integer_value(json_object_get(summary, "steps_taken")) == run->scene->steps &&
                json_is_number(json_object_get(json_object_get(summary, "extremes"), "max_stretch"));
    if (good) {
        run->min_gap = number_at(summary, "min_gap");
        run->max_stretch = number_at(summary, "max_stretch");
    }
    json_decref(summary);
    int frames = 0;
    double time;
    cipc_error error;
    snprintf(path, sizeof path, "%.950s/trajectory.h5", folder);
    good = good && cipc_trajectory_count(path, &frames, &error) == CIPC_OK && frames == run->scene->steps + 1;
    return good && cipc_trajectory_read(path, frames - 1, run->end, run->scene->model->node_count, &time, &error) == CIPC_OK;
}

/* ---- A run of our own --------------------------------------------------------------------------------------------------------- */

static void run_here(figure_run *run, const char *file, const char *const *overrides)
{
    scene_request request = {.file = file, .threads = 1};
    scene_outcome outcome;
    cipc_error error;
    for (int i = 0; overrides[i] != NULL; i++) request.overrides[i] = overrides[i];
    if (scene_run(&request, &outcome, &error) != CIPC_OK) {
        scene_outcome_free(&outcome);
        fail_msg("%s: %s: %s", file, error.place, error.what);
    }
    memcpy(run->end, outcome.position, 3 * (size_t)outcome.node_count * sizeof *run->end);
    run->min_gap = outcome.min_gap;
    run->max_stretch = outcome.max_stretch;
    scene_outcome_free(&outcome);
}

bool figure_run_selected(const char *name, const char *selected)
{
    const size_t length = strlen(name);
    for (const char *p = selected; p != NULL; p = strchr(p, ' ')) {
        p += *p == ' ';
        if (strncmp(p, name, length) == 0 && (p[length] == ' ' || p[length] == '\0')) return true;
    }
    return selected == NULL;
}

figure_run figure_run_of(const char *name, const char *scene, const char *const *overrides)
{
    if (!figure_run_selected(name, getenv("CIPC_RUNS_SELECTED"))) skip();
    const char *all[FIGURE_OVERRIDES + 2] = {NULL}, *runs = getenv("CIPC_RUNS");
    char file[PATH_SIZE], size[64], folder[FOLDER_SIZE];
    int count = 0;
    snprintf(file, sizeof file, "tests/scenes/%s.json", scene);
    snprintf(size, sizeof size, "size=%s", figure_size());
    all[count++] = size;
    for (; overrides != NULL && *overrides != NULL; overrides++) {
        assert_true(count <= FIGURE_OVERRIDES);
        all[count++] = *overrides;
    }
    figure_run run = {0};
    cipc_error error;
    if (cipc_scene_load(&run.scene, file, count, all, &error) != CIPC_OK) fail_msg("%s: %s", error.place, error.what);
    run.steps = run.scene->steps;
    run.end = cipc_alloc(3 * (size_t)run.scene->model->node_count, sizeof *run.end);
    assert_non_null(run.end);
    snprintf(folder, sizeof folder, "%s/%s", runs != NULL ? runs : "", name);
    if (runs == NULL || !take(&run, folder)) run_here(&run, file, all);
    return run;
}

void figure_run_free(figure_run *run)
{
    cipc_free(run->end);
    cipc_scene_destroy(run->scene);
    *run = (figure_run){0};
}

const cipc_body *figure_body(const figure_run *run, const char *name)
{
    const cipc_model *m = run->scene->model;
    for (int b = 0; b < m->body_count; b++) {
        if (strcmp(m->bodies[b].name, name) == 0) return &m->bodies[b];
    }
    fail_msg("no body is called %s", name);
    return NULL;
}

void figure_centre(const figure_run *run, const cipc_body *body, const double *x, double centre[3])
{
    const double *mass = run->scene->model->mass;
    double total = 0;
    centre[0] = centre[1] = centre[2] = 0;
    for (int i = body->first_node; i < body->first_node + body->node_count; i++) {
        total += mass[i];
        for (int k = 0; k < 3; k++) centre[k] += mass[i] * x[3 * i + k];
    }
    for (int k = 0; k < 3; k++) centre[k] /= total;
}
