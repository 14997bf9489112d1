/* A sequence of meshes of which only the vertices count, one file a frame. */
#include "scene/track.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh_file.h"
#include "scene/transform.h"

enum { FRAMES_MAX = 100000 };

/* "walk%04d.obj", cut at its number. It is never handed to printf: it comes from the scene. */
typedef struct sequence {
    char path[PATH_MAX];
    int before;        /* bytes before the number */
    const char *after; /* what follows it */
    int digits;        /* at least so many, with zeros in front */
} sequence;

/* Only the file's own name is searched: a folder may be called anything. */
static bool split(sequence *s)
{
    const char *slash = strrchr(s->path, '/'), *name = slash != NULL ? slash + 1 : s->path, *mark = strchr(name, '%');
    if (mark == NULL || strchr(mark + 1, '%') != NULL) return false;
    const char *at = mark + 1;
    s->before = (int)(mark - s->path);
    s->digits = 0;
    if (at[0] == '0' && isdigit((unsigned char)at[1])) {
        s->digits = at[1] - '0';
        at += 2;
    }
    s->after = at + 1;
    return *at == 'd';
}

static bool frame_path(const sequence *s, int number, char path[PATH_MAX])
{
    return snprintf(path, PATH_MAX, "%.*s%0*d%s", s->before, s->path, s->digits, number, s->after) < PATH_MAX;
}

static void read_files(scene_reader *r, const scene_cursor *track, sequence *s)
{
    scene_cursor member = scene_member(track, "files");
    const char *files = scene_string(r, track, "files", NULL);
    if (r->status != CIPC_OK) return;
    if (!scene_resolve_path(r->path, files, s->path))
        scene_reject(r, &member, CIPC_E_MISSING_FILE, "a path of more than %d bytes", PATH_MAX - 1);
    else if (!split(s))
        scene_reject(r, &member, CIPC_E_OUT_OF_RANGE, "'%.200s' must have one number in its file name, like walk%%d.obj or walk%%04d.obj", files);
}

/* BAD_MESH keeps its place, which is a line of the frame's file. */
static void reject_frame(scene_reader *r, const scene_cursor *files, const char *path, cipc_status status, const cipc_error *error)
{
    if (status == CIPC_E_BAD_MESH) {
        r->error = *error;
        r->status = status;
    } else {
        scene_reject(r, files, status, "'%.400s' %s", path, error->what);
    }
}

static void pick(const scene_transform *placement, const cipc_mesh *mesh, const scene_tracked *tracked, double *frame)
{
    for (int i = 0; i < tracked->count; i++) scene_place_nodes(placement, mesh->nodes + 3 * tracked->nodes[i], 1, frame + 3 * i);
}

static void read_frame(scene_reader *r, const scene_cursor *track, const char *path, const scene_transform *placement,
                       const scene_tracked *tracked, double *frame)
{
    cipc_mesh mesh;
    cipc_error error;
    scene_cursor files = scene_member(track, "files");
    cipc_status status = cipc_mesh_read(&mesh, path, CIPC_MESH_NODES, &error);
    if (status != CIPC_OK) {
        reject_frame(r, &files, path, status, &error);
        return;
    }
    if (mesh.node_count == tracked->body_count)
        pick(placement, &mesh, tracked, frame);
    else
        scene_reject(r, &files, CIPC_E_BAD_MESH, "'%.400s' has %d vertices, but body '%s' has %d nodes", path, mesh.node_count, tracked->body,
                     tracked->body_count);
    cipc_mesh_free(&mesh);
}

static void read_frames(scene_reader *r, const scene_cursor *track, const sequence *s, int first, const scene_transform *placement,
                        const scene_tracked *tracked, cipc_track *result)
{
    size_t numbers = 3 * (size_t)tracked->count;
    scene_cursor files = scene_member(track, "files");
    result->frames = cipc_alloc((size_t)result->frame_count * numbers, sizeof *result->frames);
    if (result->frames == NULL) scene_reject_memory(r, track);
    for (int i = 0; i < result->frame_count && r->status == CIPC_OK; i++) {
        char path[PATH_MAX];
        if (frame_path(s, first + i, path))
            read_frame(r, track, path, placement, tracked, result->frames + (size_t)i * numbers);
        else
            scene_reject(r, &files, CIPC_E_MISSING_FILE, "a path of more than %d bytes", PATH_MAX - 1);
    }
}

/* The folder is made absolute, so that the resolved scene finds the files from anywhere. */
static void make_absolute(scene_reader *r, const scene_cursor *track, const sequence *s)
{
    char folder[PATH_MAX], absolute[PATH_MAX];
    const char *slash = strrchr(s->path, '/'), *name = slash != NULL ? slash + 1 : s->path;
    snprintf(folder, sizeof folder, "%.*s", slash != NULL ? (int)(slash - s->path) + 1 : 1, slash != NULL ? s->path : ".");
    if (r->status == CIPC_OK && realpath(folder, absolute) != NULL)
        scene_set(r, track, "files", json_sprintf("%s/%s", strcmp(absolute, "/") == 0 ? "" : absolute, name));
}

void scene_read_track(scene_reader *r, const scene_cursor *track, const scene_tracked *tracked, cipc_track *result)
{
    static const char *const keys[] = {"files", "first", "count", "begin", "interval", "scale", "rotate", "translate", NULL};
    sequence s = {.before = 0};
    scene_transform placement;
    *result = (cipc_track){0};
    if (!scene_is_object(r, track, keys)) return;
    read_files(r, track, &s);
    int first = scene_integer(r, track, "first", 1, 0, INT_MAX - FRAMES_MAX);
    result->frame_count = scene_integer(r, track, "count", SCENE_REQUIRED, 1, FRAMES_MAX);
    result->begin = scene_number(r, track, "begin", 0, scene_any);
    result->interval = scene_number(r, track, "interval", SCENE_REQUIRED_NUMBER, scene_positive);
    scene_read_placement(r, track, &placement);
    if (r->status == CIPC_OK) read_frames(r, track, &s, first, &placement, tracked, result);
    make_absolute(r, track, &s);
    if (r->status == CIPC_OK) return;
    cipc_free(result->frames);
    *result = (cipc_track){0};
}
