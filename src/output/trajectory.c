/* The trajectory of a run: created, resumed, appended to, read. */
#include "cipc/output.h"
#include "output/atomic_file.h"
#include "output/scene_match.h"
#include "output/trajectory_file.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

struct cipc_trajectory {
    cipc_trajectory_file file;
    char *path, *temporary;
};

/* HDF5 prints its errors to stderr unless told otherwise; what it was told before is restored. */
typedef struct silence {
    H5E_auto2_t function;
    void *data;
} silence;

static silence silence_begin(void)
{
    silence before = {NULL, NULL};
    H5Eget_auto(H5E_DEFAULT, &before.function, &before.data);
    H5Eset_auto(H5E_DEFAULT, NULL, NULL);
    errno = 0;
    return before;
}

static void silence_end(silence before)
{
    H5Eset_auto(H5E_DEFAULT, before.function, before.data);
}

/* At the start at most this many frames are set aside: room costs a chunk index entry even where it costs no disk. */
static const int greatest_first_room = 4096;

static int first_room(int wanted, int needed)
{
    int room = wanted < greatest_first_room ? wanted : greatest_first_room;
    return room > needed ? room : needed;
}

static void discard(cipc_trajectory *t)
{
    if (t != NULL) {
        cipc_trajectory_file_close(&t->file);
        cipc_free(t->path);
        cipc_free(t->temporary);
        cipc_free(t);
    }
}

static cipc_status allocate(cipc_trajectory **trajectory, const char *path, cipc_error *error)
{
    cipc_trajectory *t = cipc_alloc(1, sizeof *t);
    if (t != NULL) {
        t->file = CIPC_TRAJECTORY_FILE_CLOSED;
        t->path = cipc_alloc(strlen(path) + 1, 1);
        t->temporary = cipc_atomic_temporary(path);
    }
    if (t == NULL || t->path == NULL || t->temporary == NULL) {
        discard(t);
        return cipc_fail(error, CIPC_E_OUT_OF_MEMORY, path, "no memory for a trajectory");
    }
    strcpy(t->path, path);
    *trajectory = t;
    return CIPC_OK;
}

/* Close the file `made` under the temporary name, give it the name proper and open it in place of t->file; on failure t->file stays. */
static cipc_status publish(cipc_trajectory *t, cipc_trajectory_file *made, bool good, cipc_error *error)
{
    good = cipc_trajectory_file_close(made) && good;
    if (!good) {
        cipc_status status = cipc_fail_io(error, t->temporary, "write the trajectory");
        remove(t->temporary);
        return status;
    }
    if (rename(t->temporary, t->path) != 0) {
        cipc_status status = cipc_fail_io(error, t->path, "move the trajectory into place");
        remove(t->temporary);
        return status;
    }
    cipc_trajectory_file_close(&t->file);
    if (!cipc_trajectory_file_open(&t->file, t->path, true)) {
        return cipc_fail_io(error, t->path, "open the trajectory just written");
    }
    return CIPC_OK;
}

cipc_status cipc_trajectory_create(cipc_trajectory **trajectory, const char *path, const cipc_model *model, const cipc_state *state,
                                   const char *scene_json, int room, cipc_error *error)
{
    *trajectory = NULL;
    cipc_trajectory *t = NULL;
    cipc_status status = allocate(&t, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    silence before = silence_begin();
    cipc_trajectory_file made = CIPC_TRAJECTORY_FILE_CLOSED;
    bool good = cipc_trajectory_file_make(&made, t->temporary, model->node_count, state->memory_count, first_room(room, 1)) &&
                cipc_trajectory_topology_write(made.file, model, scene_json) && cipc_trajectory_file_append(&made, state);
    status = publish(t, &made, good, error);
    silence_end(before);
    if (status != CIPC_OK) {
        discard(t);
        return status;
    }
    *trajectory = t;
    return CIPC_OK;
}

/* Copy all frames; the state is a buffer. */
static bool copy_frames(const cipc_trajectory_file *from, cipc_trajectory_file *to)
{
    const size_t numbers = 3 * (size_t)from->node_count;
    cipc_state frame = {.node_count = from->node_count};
    frame.position = cipc_alloc(numbers, sizeof(double));
    frame.velocity = cipc_alloc(numbers, sizeof(double));
    frame.memory = cipc_alloc((size_t)from->memory_count, sizeof(double));
    bool good = frame.position != NULL && frame.velocity != NULL && frame.memory != NULL;
    if (!good) {
        errno = ENOMEM;
    }
    for (int i = 0; i < from->frame_count && good; i++) {
        good = cipc_trajectory_file_read(from, i, &frame) && cipc_trajectory_file_append(to, &frame);
    }
    cipc_free(frame.position);
    cipc_free(frame.velocity);
    cipc_free(frame.memory);
    return good;
}

/* Replace the file by one with the same frames and another room. */
static cipc_status change_room(cipc_trajectory *t, int room, cipc_error *error)
{
    cipc_trajectory_file made = CIPC_TRAJECTORY_FILE_CLOSED;
    errno = 0;
    bool good = cipc_trajectory_file_make(&made, t->temporary, t->file.node_count, t->file.memory_count, room) &&
                cipc_trajectory_topology_copy(t->file.file, made.file) && copy_frames(&t->file, &made);
    return publish(t, &made, good, error);
}

/* An older program wrote the frames of an older format, and its steps need not be ours to the last bit: to go on from them would make a run
 * that nobody can repeat. */
static cipc_status check_format(const cipc_trajectory *t, cipc_error *error)
{
    if (t->file.format == CIPC_TRAJECTORY_FORMAT) {
        return CIPC_OK;
    }
    cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path,
              "the trajectory is of format %d, of an older cipc; this one goes on from format %d only", t->file.format,
              CIPC_TRAJECTORY_FORMAT);
    cipc_fail_remedy(error, "go on with the cipc that wrote it (attribute cipc_version), or start without --resume");
    return CIPC_E_NOT_RESUMABLE;
}

/* CIPC_OK if the open file is of this model and scene. */
static cipc_status check_same_run(const cipc_trajectory *t, const cipc_model *model, const char *scene_json, cipc_error *error)
{
    if (t->file.node_count != model->node_count || !cipc_trajectory_topology_matches(t->file.file, model)) {
        return cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "the trajectory is of other bodies than the scene has");
    }
    char *scene = cipc_trajectory_scene_read(t->file.file);
    if (scene == NULL) {
        return cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "the trajectory's scene cannot be read");
    }
    char difference[256];
    cipc_status status = CIPC_OK;
    if (!cipc_scene_match(scene, scene_json, difference, sizeof difference)) {
        status = cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "the trajectory is of a scene that differs from this one at %s",
                           difference[0] != '\0' ? difference : "its root");
    }
    cipc_free(scene);
    return status;
}

static cipc_status check_memory(const cipc_trajectory *t, const cipc_state *state, cipc_error *error)
{
    if (t->file.memory_count == state->memory_count) {
        return CIPC_OK;
    }
    return cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "the trajectory remembers %d numbers a frame besides positions and velocities, the method %d", t->file.memory_count, state->memory_count);
}

static cipc_status read_last(const cipc_trajectory *t, cipc_state *state, cipc_error *error)
{
    cipc_state last = *state;
    if (t->file.frame_count < 1 || !cipc_trajectory_file_read(&t->file, t->file.frame_count - 1, &last)) {
        return cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "the trajectory has no whole frame");
    }
    *state = last;
    return CIPC_OK;
}

static cipc_status open_to_resume(cipc_trajectory *t, const cipc_model *model, cipc_state *state, const char *scene_json, int room,
                                  cipc_error *error)
{
    if (access(t->path, F_OK) != 0) {
        return cipc_fail(error, CIPC_E_MISSING_FILE, t->path, "there is no trajectory to resume");
    }
    if (!cipc_trajectory_file_open(&t->file, t->path, true)) {
        if (errno == EACCES || errno == EPERM || errno == EROFS || errno == EISDIR) {
            return cipc_fail_io(error, t->path, "open the trajectory");
        }
        return cipc_fail(error, CIPC_E_NOT_RESUMABLE, t->path, "not a trajectory of cipc, or damaged");
    }
    cipc_status status = check_format(t, error);
    if (status == CIPC_OK) {
        status = check_same_run(t, model, scene_json, error);
    }
    if (status == CIPC_OK) {
        status = check_memory(t, state, error);
    }
    if (status == CIPC_OK) {
        status = read_last(t, state, error);
    }
    const int wanted = first_room(room, t->file.frame_count);
    if (status == CIPC_OK && wanted > t->file.room) {
        status = change_room(t, wanted, error);
    }
    return status;
}

cipc_status cipc_trajectory_resume(cipc_trajectory **trajectory, const char *path, const cipc_model *model, cipc_state *state,
                                   const char *scene_json, int room, cipc_error *error)
{
    *trajectory = NULL;
    cipc_trajectory *t = NULL;
    cipc_status status = allocate(&t, path, error);
    if (status != CIPC_OK) {
        return status;
    }
    silence before = silence_begin();
    status = open_to_resume(t, model, state, scene_json, room, error);
    silence_end(before);
    if (status != CIPC_OK) {
        if (status == CIPC_E_MISSING_FILE) {
            cipc_fail_remedy(error, "start without --resume");
        }
        discard(t);
        return status;
    }
    *trajectory = t;
    return CIPC_OK;
}

cipc_status cipc_trajectory_append(cipc_trajectory *trajectory, const cipc_state *state, cipc_error *error)
{
    cipc_status status = CIPC_OK;
    silence before = silence_begin();
    if (trajectory->file.frame_count == trajectory->file.room) {
        status = change_room(trajectory, 2 * trajectory->file.room, error);
    }
    if (status == CIPC_OK && !cipc_trajectory_file_append(&trajectory->file, state)) {
        status = cipc_fail_io(error, trajectory->path, "append a frame");
    }
    silence_end(before);
    return status;
}

int cipc_trajectory_frames(const cipc_trajectory *trajectory)
{
    return trajectory->file.frame_count;
}

cipc_status cipc_trajectory_close(cipc_trajectory *trajectory, cipc_error *error)
{
    if (trajectory == NULL) {
        return CIPC_OK;
    }
    cipc_status status = CIPC_OK;
    silence before = silence_begin();
    if (trajectory->file.room > trajectory->file.frame_count) {
        status = change_room(trajectory, trajectory->file.frame_count, error);
    }
    errno = 0;
    if (!cipc_trajectory_file_close(&trajectory->file) && status == CIPC_OK) {
        status = cipc_fail_io(error, trajectory->path, "close the trajectory");
    }
    discard(trajectory);
    silence_end(before);
    return status;
}

/* ---- Reading -------------------------------------------------------------------------------------------------------------- */

static cipc_status open_to_read(cipc_trajectory_file *file, const char *path, cipc_error *error)
{
    *file = CIPC_TRAJECTORY_FILE_CLOSED;
    if (access(path, F_OK) != 0) {
        return cipc_fail(error, CIPC_E_MISSING_FILE, path, "there is no trajectory");
    }
    if (!cipc_trajectory_file_open(file, path, false)) {
        return cipc_fail(error, CIPC_E_IO, path, "not a trajectory of cipc, or damaged");
    }
    return CIPC_OK;
}

cipc_status cipc_trajectory_count(const char *path, int *frames, cipc_error *error)
{
    cipc_trajectory_file file;
    silence before = silence_begin();
    cipc_status status = open_to_read(&file, path, error);
    if (status == CIPC_OK) {
        *frames = file.frame_count;
    }
    cipc_trajectory_file_close(&file);
    silence_end(before);
    return status;
}

static cipc_status read_frame(const cipc_trajectory_file *file, const char *path, int frame, double *position, int node_count, double *time,
                              cipc_error *error)
{
    if (file->node_count != node_count) {
        return cipc_fail(error, CIPC_E_IO, path, "the trajectory has %d nodes, not %d", file->node_count, node_count);
    }
    if (frame < 0 || frame >= file->frame_count) {
        return cipc_fail(error, CIPC_E_IO, path, "there is no frame %d: the trajectory has %d", frame, file->frame_count);
    }
    cipc_state state = {.node_count = node_count, .position = position};
    if (!cipc_trajectory_file_read(file, frame, &state)) {
        return cipc_fail(error, CIPC_E_IO, path, "cannot read frame %d: the file is damaged", frame);
    }
    if (time != NULL) {
        *time = state.time;
    }
    return CIPC_OK;
}

cipc_status cipc_trajectory_read(const char *path, int frame, double *position, int node_count, double *time, cipc_error *error)
{
    cipc_trajectory_file file;
    silence before = silence_begin();
    cipc_status status = open_to_read(&file, path, error);
    if (status == CIPC_OK) {
        status = read_frame(&file, path, frame, position, node_count, time, error);
    }
    cipc_trajectory_file_close(&file);
    silence_end(before);
    return status;
}

cipc_status cipc_trajectory_times(const char *path, double *times, int frame_count, cipc_error *error)
{
    cipc_trajectory_file file;
    silence before = silence_begin();
    cipc_status status = open_to_read(&file, path, error);
    if (status == CIPC_OK && !cipc_trajectory_file_times(&file, frame_count, times)) {
        status =
            cipc_fail(error, CIPC_E_IO, path, "cannot read the times of %d frames: the trajectory has %d", frame_count, file.frame_count);
    }
    cipc_trajectory_file_close(&file);
    silence_end(before);
    return status;
}
