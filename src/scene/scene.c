/* Loading a scene: text, tree, overrides, settings, bodies, model, constraints, state; and the tree back to text. */
#include "cipc/scene.h"

#include <stdio.h>
#include <string.h>

#include "scene/bodies.h"
#include "scene/body_kind.h"
#include "scene/dirichlet_sets.h"
#include "scene/json_text.h"
#include "scene/loads.h"
#include "scene/massspring.h"
#include "scene/method.h"
#include "scene/overrides.h"
#include "scene/pairs.h"
#include "scene/seams.h"
#include "scene/settings.h"
#include "scene/text_file.h"

static cipc_status parse(scene_reader *r)
{
    json_error_t parse_error;
    r->root = json_loadb(r->text, r->length, JSON_REJECT_DUPLICATES, &parse_error);
    if (r->root != NULL) return CIPC_OK;
    char place[sizeof r->error.place];
    size_t length = strlen(r->path), longest = sizeof place - 40;
    const char *path = length > longest ? r->path + length - longest : r->path;
    if (parse_error.line > 0)
        snprintf(place, sizeof place, "%s:%d:%d", path, parse_error.line, parse_error.column > 0 ? parse_error.column : 1);
    else
        snprintf(place, sizeof place, "%s:1:1", path);
    r->status = cipc_fail(&r->error, CIPC_E_SYNTAX, place, "%s", parse_error.text);
    return r->status;
}

/* What the model finds wrong with a body is said at the body's mesh. */
static void reject_model(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_status status, const cipc_error *error)
{
    scene_cursor list = scene_member(root, "bodies");
    for (int b = 0; b < bodies->count; b++) {
        if (strcmp(bodies->descriptions[b].name, error->place) != 0) continue;
        scene_cursor body = scene_element(&list, (size_t)scene_entry_of(bodies, b)), mesh = scene_member(&body, scene_kind_key(bodies->descriptions[b].kind));
        scene_reject(r, &mesh, status, "%s", error->what);
    }
    scene_reject(r, &list, status, "%s: %s", error->place, error->what);
}

/* Which bodies the pictures are about: output.camera.subject. */
static void read_subject(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, cipc_scene *scene)
{
    scene_cursor output = scene_member(root, "output"), camera = scene_member(&output, "camera"), subject = scene_member(&camera, "subject");
    if (subject.value == NULL || !scene_is_array(r, &subject, 1, (size_t)bodies->count)) return;
    scene->camera_subject = cipc_alloc((size_t)bodies->count, sizeof *scene->camera_subject);
    if (scene->camera_subject == NULL) scene_reject_memory(r, &subject);
    for (size_t i = 0; i < json_array_size(subject.value) && r->status == CIPC_OK; i++) {
        scene_cursor name = scene_element(&subject, i);
        int count;
        const int first = scene_find_bodies(r, &name, bodies, &count);
        for (int k = 0; k < count; k++) scene->camera_subject[first + k] = true;
    }
}

static void build(scene_reader *r, const scene_cursor *root, const scene_bodies *bodies, const double gravity[3], cipc_scene *scene)
{
    cipc_error error;
    if (r->status != CIPC_OK) return;
    cipc_status status = cipc_model_create(&scene->model, bodies->descriptions, bodies->count, gravity, &error);
    if (status == CIPC_OK) status = cipc_state_create(&scene->state, bodies->descriptions, bodies->count, &error);
    if (status != CIPC_OK) {
        reject_model(r, root, bodies, status, &error);
        return;
    }
    scene_read_friction(r, root, bodies, scene->model);
    scene_read_collisions(r, root, bodies, scene->model);
    scene_read_stitches(r, root, bodies, scene->model);
    scene_read_dirichlet(r, root, bodies, scene->model);
    scene_read_loads(r, root, bodies, scene->model);
    scene_check_method(r, root, bodies, scene);
    if (r->status == CIPC_OK && scene->method == CIPC_METHOD_MASS_SPRING) {
        status = cipc_state_remember(scene->state, cipc_massspring_memory(scene->model, &scene->massspring), &error);
        if (status != CIPC_OK) reject_model(r, root, bodies, status, &error);
    }
    scene_check_colliders(r, root, scene);
    read_subject(r, root, bodies, scene);
}

static void read_scene(scene_reader *r, cipc_scene *scene)
{
    static const char *const keys[] = {"method",   "title",       "size",            "sizes",      "compat",    "time_step",  "steps",
                                       "gravity",  "seed",        "integrator",      "newton",     "contact",   "bodies",     "friction",
                                       "stitches", "quasistatic", "strain_coupling", "collisions", "dirichlet", "monitor",    "output",
                                       "loads",    "asynchronous", "mass_spring",     "colliders",  NULL};
    double gravity[3];
    scene_bodies bodies = {0};
    scene_cursor root = scene_root(r->root);
    if (!scene_is_object(r, &root, keys)) return;
    scene_read_settings(r, &root, scene, gravity);
    scene_read_bodies(r, &root, scene->seed, scene->options.released, &bodies);
    build(r, &root, &bodies, gravity, scene);
    scene_bodies_free(&bodies);
    if (r->status != CIPC_OK) return;
    scene->resolved = scene_json_text(r->root);
    if (scene->resolved == NULL) scene_reject_memory(r, &root);
}

static cipc_status load(scene_reader *r, cipc_scene *scene, int override_count, const char *const *overrides)
{
    cipc_status status = parse(r);
    scene_cursor root = scene_root(r->root);
    if (status == CIPC_OK && !json_is_object(r->root)) status = scene_reject(r, &root, CIPC_E_WRONG_TYPE, "a scene must be an object");
    if (status == CIPC_OK) status = scene_apply_overrides(r, override_count, overrides);
    if (status == CIPC_OK) read_scene(r, scene);
    return r->status;
}

static char *copy_path(const char *path)
{
    size_t size = strlen(path) + 1;
    char *copy = cipc_alloc(size, 1);
    if (copy != NULL) memcpy(copy, path, size);
    return copy;
}

cipc_status cipc_scene_load(cipc_scene **scene, const char *path, int override_count, const char *const *overrides, cipc_error *error)
{
    *scene = NULL;
    char *text;
    size_t length;
    cipc_status status = scene_read_text(path, &text, &length, error);
    if (status != CIPC_OK) return status;
    scene_reader reader = {.path = path, .text = text, .length = length};
    cipc_scene *made = cipc_alloc(1, sizeof *made);
    if (made != NULL) made->path = copy_path(path);
    if (made == NULL || made->path == NULL)
        status = cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for a scene");
    else
        status = load(&reader, made, override_count, overrides);
    if (status == CIPC_OK) {
        *scene = made;
    } else {
        if (reader.status != CIPC_OK && error != NULL) *error = reader.error;
        cipc_scene_destroy(made);
    }
    scene_reader_free(&reader);
    cipc_free(text);
    return status;
}

void cipc_scene_destroy(cipc_scene *scene)
{
    if (scene == NULL) return;
    cipc_model_destroy(scene->model);
    cipc_state_destroy(scene->state);
    cipc_free(scene->path);
    cipc_free(scene->title);
    cipc_free(scene->resolved);
    cipc_free(scene->camera_subject);
    cipc_free(scene->colliders);
    cipc_free(scene);
}
