/* The trajectory file: exact to the bit, whole at every instant, refused when it is not ours. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <fcntl.h>
#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cipc/output.h"
#include "support/every_kind.h"
#include "support/failing_memory.h"

static const char scene[] = "{\"steps\": 5, \"contact\": {\"dhat\": 0.001}, \"bodies\": [{\"name\": \"cloth\"}]}";

typedef struct fixture {
    sample_run run;
    path folder, file;
} fixture;

static int set_up(void **state)
{
    fixture *f = malloc(sizeof *f);
    fail_allocation(0);
    f->run = sample_run_create();
    f->folder = folder_make();
    f->file = path_in(&f->folder, "trajectory.h5");
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    fail_allocation(0);
    sample_run_destroy(&f->run);
    folder_remove(&f->folder);
    free(f);
    return 0;
}

static void accept(cipc_status status, const cipc_error *error)
{
    if (status != CIPC_OK) {
        fail_msg("%s: %s", error->place, error->what);
    }
}

/* Frames 0 .. frames-1 of the sample run; closed. */
static void write_frames(fixture *f, int frames, int room)
{
    cipc_error error;
    cipc_trajectory *t;
    accept(cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, room, &error), &error);
    for (int i = 1; i < frames; i++) {
        sample_run_advance(&f->run);
        accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    }
    accept(cipc_trajectory_close(t, &error), &error);
}

static void assert_bits_equal(const double *a, const double *b, int count)
{
    assert_memory_equal(a, b, (size_t)count * sizeof *a);
}

/* The file has the frames of the sample run from 0 to at least `least`-1, all exact. Returns how many. */
static int check_frames(const path *file, int least)
{
    cipc_error error;
    int frames = 0;
    accept(cipc_trajectory_count(file->text, &frames, &error), &error);
    assert_true(frames >= least);
    sample_run expected = sample_run_create();
    const int nodes = expected.model->node_count;
    double *position = calloc(3 * (size_t)nodes, sizeof *position), *times = calloc((size_t)frames, sizeof *times);
    accept(cipc_trajectory_times(file->text, times, frames, &error), &error);
    for (int i = 0; i < frames; i++) {
        double time = -1;
        accept(cipc_trajectory_read(file->text, i, position, nodes, &time, &error), &error);
        assert_bits_equal(position, expected.state->position, 3 * nodes);
        assert_bits_equal(&time, &expected.state->time, 1);
        assert_bits_equal(&times[i], &expected.state->time, 1);
        sample_run_advance(&expected);
    }
    free(position);
    free(times);
    sample_run_destroy(&expected);
    return frames;
}

static void test_round_trip_with_room_to_spare_and_without(void **state)
{
    fixture *f = *state;
    const int rooms[] = {0, 1, 2, 6, 100};
    for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; i++) {
        sample_run_destroy(&f->run);
        f->run = sample_run_create();
        write_frames(f, 6, rooms[i]);
        assert_int_equal(check_frames(&f->file, 6), 6);
    }
    const path leftover = path_in(&f->folder, "trajectory.h5.partial");
    assert_false(file_exists(&leftover));
}

static hsize_t first_extent(const char *file, const char *dataset)
{
    hid_t handle = H5Fopen(file, H5F_ACC_RDONLY, H5P_DEFAULT), data = H5Dopen(handle, dataset, H5P_DEFAULT), space = H5Dget_space(data);
    hsize_t dims[3] = {0, 0, 0};
    H5Sget_simple_extent_dims(space, dims, NULL);
    H5Sclose(space);
    H5Dclose(data);
    H5Fclose(handle);
    return dims[0];
}

/* Any HDF5 program finds as many frames as there are, and the topology. */
static void test_closed_file_has_no_empty_frames(void **state)
{
    fixture *f = *state;
    write_frames(f, 4, 50);
    assert_int_equal(first_extent(f->file.text, "positions"), 4);
    assert_int_equal(first_extent(f->file.text, "velocities"), 4);
    assert_int_equal(first_extent(f->file.text, "time"), 4);
    assert_int_equal(first_extent(f->file.text, "topology/triangles"), f->run.model->triangle_count);
    assert_int_equal(first_extent(f->file.text, "topology/edges"), f->run.model->edge_count);
    assert_int_equal(first_extent(f->file.text, "topology/bodies"), f->run.model->body_count);
}

static void test_same_run_gives_the_same_bytes(void **state)
{
    fixture *f = *state;
    size_t size_a, size_b;
    write_frames(f, 3, 3);
    char *a = file_read(&f->file, &size_a);
    sample_run_destroy(&f->run);
    f->run = sample_run_create();
    write_frames(f, 3, 3);
    char *b = file_read(&f->file, &size_b);
    assert_int_equal(size_a, size_b);
    assert_memory_equal(a, b, size_a);
    free(a);
    free(b);
}

static void test_resume_restores_everything(void **state)
{
    fixture *f = *state;
    write_frames(f, 3, 3);
    sample_run other = sample_run_create();
    cipc_error error;
    cipc_trajectory *t;
    accept(cipc_trajectory_resume(&t, f->file.text, other.model, other.state, scene, 10, &error), &error);
    const cipc_state *a = f->run.state, *b = other.state;
    assert_int_equal(b->step, a->step);
    assert_bits_equal(&b->time, &a->time, 1);
    assert_bits_equal(&b->barrier_stiffness, &a->barrier_stiffness, 1);
    assert_bits_equal(&b->strain_stiffness_factor, &a->strain_stiffness_factor, 1);
    assert_bits_equal(b->position, a->position, 3 * a->node_count);
    assert_bits_equal(b->velocity, a->velocity, 3 * a->node_count);
    for (int i = 0; i < 4; i++) {
        sample_run_advance(&other);
        accept(cipc_trajectory_append(t, other.state, &error), &error);
    }
    assert_int_equal(cipc_trajectory_frames(t), 7);
    accept(cipc_trajectory_close(t, &error), &error);
    assert_int_equal(check_frames(&f->file, 7), 7);
    sample_run_destroy(&other);
}

/* What a method remembers is written with every frame, also of a file that grows, and comes back with the last one; methods that remember nothing have no such dataset. */
static void test_memory_comes_back(void **state)
{
    fixture *f = *state;
    enum { COUNT = 5 };
    sample_run other = sample_run_create();
    cipc_error error;
    cipc_trajectory *t;
    double memory[COUNT];
    write_frames(f, 3, 3);
    hid_t plain = H5Fopen(f->file.text, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(H5Lexists(plain, "memory", H5P_DEFAULT) == 0);
    H5Fclose(plain);
    sample_run_destroy(&f->run);
    f->run = sample_run_create();
    accept(cipc_state_remember(f->run.state, COUNT, &error), &error);
    accept(cipc_state_remember(other.state, COUNT, &error), &error);
    accept(cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 2, &error), &error);
    for (int k = 1; k <= 6; k++) {
        sample_run_advance(&f->run);
        for (int i = 0; i < COUNT; i++) memory[i] = f->run.state->memory[i] = k + 0.1 * i;
        accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    }
    accept(cipc_trajectory_close(t, &error), &error);
    assert_int_equal(first_extent(f->file.text, "memory"), 7);
    assert_int_equal(check_frames(&f->file, 7), 7);
    accept(cipc_trajectory_resume(&t, f->file.text, other.model, other.state, scene, 20, &error), &error);
    accept(cipc_trajectory_close(t, &error), &error);
    assert_bits_equal(other.state->memory, memory, COUNT);
    assert_bits_equal(other.state->position, f->run.state->position, 3 * other.state->node_count);
    const int step = other.state->step = 77;
    for (int count = COUNT - 1; count <= COUNT + 1; count += 2) { /* of another number of things: refused, and the state stays */
        accept(cipc_state_remember(other.state, count, &error), &error);
        assert_int_equal(cipc_trajectory_resume(&t, f->file.text, other.model, other.state, scene, 20, &error), CIPC_E_NOT_RESUMABLE);
        assert_true(other.state->step == step && other.state->memory[0] == 0);
    }
    sample_run_destroy(&other);
}

/* Silence is part of the contract: nothing on stderr, and the caller's HDF5 error handler is back in place. */
static cipc_status resume_quietly(fixture *f, const cipc_model *model, cipc_state *into, const char *json, cipc_error *error)
{
    const path log = path_in(&f->folder, "stderr");
    H5E_auto2_t before, after;
    void *data;
    H5Eget_auto(H5E_DEFAULT, &before, &data);
    fflush(stderr);
    const int saved = dup(STDERR_FILENO), out = open(log.text, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDERR_FILENO);
    cipc_trajectory *t = NULL;
    cipc_status status = cipc_trajectory_resume(&t, f->file.text, model, into, json, 4, error);
    if (status == CIPC_OK) {
        cipc_trajectory_close(t, error);
    } else {
        assert_null(t);
    }
    fflush(stderr);
    dup2(saved, STDERR_FILENO);
    close(saved);
    close(out);
    H5Eget_auto(H5E_DEFAULT, &after, &data);
    assert_true(before == after);
    size_t size;
    free(file_read(&log, &size));
    assert_int_equal(size, 0);
    return status;
}

/* A memory of as many frames as there are not: no trajectory. */
static void test_memory_of_other_frames_is_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    int frames;
    write_frames(f, 3, 3);
    const hsize_t shapes[][2] = {{2, 5}, {3, 0}, {15, 0}};
    for (size_t k = 0; k < sizeof shapes / sizeof shapes[0]; k++) {
        hid_t file = H5Fopen(f->file.text, H5F_ACC_RDWR, H5P_DEFAULT), space = H5Screate_simple(k < 2 ? 2 : 1, shapes[k], NULL);
        if (k > 0) {
            assert_true(H5Ldelete(file, "memory", H5P_DEFAULT) >= 0);
        }
        hid_t dataset = H5Dcreate(file, "memory", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        assert_true(dataset >= 0);
        H5Dclose(dataset);
        H5Sclose(space);
        H5Fclose(file);
        assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_IO);
        assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    }
}

static void test_resume_with_another_scene_is_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    write_frames(f, 2, 2);
    static const char longer[] =
        "{\"steps\": 500, \"output\": {\"obj\": true}, \"contact\": {\"dhat\": 0.001}, \"bodies\": [{\"name\": \"cloth\"}]}";
    static const char other[] = "{\"steps\": 5, \"contact\": {\"dhat\": 0.002}, \"bodies\": [{\"name\": \"cloth\"}]}";
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, longer, &error), CIPC_OK);
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, other, &error), CIPC_E_NOT_RESUMABLE);
    assert_non_null(strstr(error.what, "contact.dhat"));
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, "no json", &error), CIPC_E_NOT_RESUMABLE);
}

static void test_resume_with_another_model_is_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    write_frames(f, 2, 2);
    sample_run other = sample_run_create();
    const double before = other.state->position[0];
    other.model->triangles[0][0] ^= 1;
    assert_int_equal(resume_quietly(f, other.model, other.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    other.model->triangles[0][0] ^= 1;
    other.model->rest[5] += 1e-12;
    assert_int_equal(resume_quietly(f, other.model, other.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    other.model->rest[5] = f->run.model->rest[5];
    other.model->bodies[0].name[0] = 'k';
    assert_int_equal(resume_quietly(f, other.model, other.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    other.model->bodies[0].name[0] = 'c';
    other.model->edge_count--;
    assert_int_equal(resume_quietly(f, other.model, other.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    other.model->edge_count++;
    assert_true(other.state->position[0] == before); /* a refusal leaves the state alone */
    assert_int_equal(resume_quietly(f, other.model, other.state, scene, &error), CIPC_OK);
    sample_run_destroy(&other);
}

/* ---- Bodies of every kind -------------------------------------------------------------------------------------------------- */

static void become(fixture *f, sample_run run)
{
    sample_run_destroy(&f->run);
    f->run = run;
}

/* The integers of a dataset of rank 1 or 2 (malloc'd); how many goes to *count. */
static int *read_integers(const path *file, const char *dataset, int *count)
{
    hid_t handle = H5Fopen(file->text, H5F_ACC_RDONLY, H5P_DEFAULT), data = H5Dopen(handle, dataset, H5P_DEFAULT);
    hid_t space = H5Dget_space(data);
    assert_true(space >= 0);
    *count = (int)H5Sget_simple_extent_npoints(space);
    int *values = calloc((size_t)*count + 1, sizeof *values);
    if (*count > 0) {
        assert_true(H5Dread(data, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    }
    H5Sclose(space);
    H5Dclose(data);
    H5Fclose(handle);
    return values;
}

static void assert_integers(const path *file, const char *dataset, const int *wanted, int count)
{
    int found;
    int *values = read_integers(file, dataset, &found);
    assert_int_equal(found, count);
    assert_memory_equal(values, wanted, (size_t)count * sizeof *wanted);
    free(values);
}

static void test_topology_of_every_kind(void **state)
{
    fixture *f = *state;
    become(f, every_kind_create_all());
    write_frames(f, 2, 2);
    const int segments[] = {4, 5, 5, 6, 6, 7, 15, 16, 17, 18}, particles[] = {8, 9, 10};
    const int node_body[] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
    assert_integers(&f->file, "topology/segments", segments, 10);
    assert_integers(&f->file, "topology/particles", particles, 3);
    assert_integers(&f->file, "topology/node_body", node_body, 19);
    assert_integers(&f->file, "topology/tetrahedra", f->run.model->tetrahedra[0], 4);
    assert_int_equal(first_extent(f->file.text, "topology/triangles"), 6);
    assert_int_equal(first_extent(f->file.text, "topology/edges"), f->run.model->edge_count);
}

/* Kinds by their names, as any HDF5 program sees them, and the bodies' ranges. */
static void test_rows_of_every_kind(void **state)
{
    fixture *f = *state;
    static const struct { const char *kind; int first_segment, segment_count, first_tetrahedron, tetrahedron_count; } wanted[] = {
        {"shell", 0, 0, 0, 0}, {"rods", 0, 3, 0, 0}, {"particles", 3, 0, 0, 0}, {"volume", 3, 0, 0, 1}, {"rods", 3, 2, 1, 0}};
    typedef struct row { int kind, first_segment, segment_count, first_tetrahedron, tetrahedron_count; double thickness; } row;
    row rows[5];
    become(f, every_kind_create_all());
    write_frames(f, 2, 2);
    hid_t handle = H5Fopen(f->file.text, H5F_ACC_RDONLY, H5P_DEFAULT), data = H5Dopen(handle, "topology/bodies", H5P_DEFAULT);
    hid_t in_file = H5Dget_type(data), kind = H5Tget_member_type(in_file, (unsigned)H5Tget_member_index(in_file, "kind"));
    hid_t type = H5Tcreate(H5T_COMPOUND, sizeof rows[0]);
    H5Tinsert(type, "kind", offsetof(row, kind), kind);
    H5Tinsert(type, "first_segment", offsetof(row, first_segment), H5T_NATIVE_INT);
    H5Tinsert(type, "segment_count", offsetof(row, segment_count), H5T_NATIVE_INT);
    H5Tinsert(type, "first_tetrahedron", offsetof(row, first_tetrahedron), H5T_NATIVE_INT);
    H5Tinsert(type, "tetrahedron_count", offsetof(row, tetrahedron_count), H5T_NATIVE_INT);
    H5Tinsert(type, "thickness", offsetof(row, thickness), H5T_NATIVE_DOUBLE);
    assert_true(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows) >= 0);
    for (int b = 0; b < 5; b++) {
        char name[32];
        assert_true(H5Tenum_nameof(kind, &rows[b].kind, name, sizeof name) >= 0);
        assert_string_equal(name, wanted[b].kind);
        assert_int_equal(rows[b].first_segment, wanted[b].first_segment);
        assert_int_equal(rows[b].segment_count, wanted[b].segment_count);
        assert_int_equal(rows[b].first_tetrahedron, wanted[b].first_tetrahedron);
        assert_int_equal(rows[b].tetrahedron_count, wanted[b].tetrahedron_count);
        assert_true(rows[b].thickness == 0.05);
    }
    H5Tclose(type);
    H5Tclose(kind);
    H5Tclose(in_file);
    H5Dclose(data);
    H5Fclose(handle);
}

/* Each kind alone: datasets of the others are empty, and such a file is written, copied to another room, and gone on from like any other. */
static void test_a_kind_alone(void **state)
{
    fixture *f = *state;
    cipc_error error;
    for (cipc_body_kind kind = CIPC_BODY_SHELL; kind <= CIPC_BODY_VOLUME; kind++) {
        become(f, every_kind_create(&kind, 1, false));
        write_frames(f, 3, 1);
        const cipc_model *m = f->run.model;
        assert_int_equal(first_extent(f->file.text, "topology/triangles"), m->triangle_count);
        assert_int_equal(first_extent(f->file.text, "topology/segments"), m->segment_count);
        assert_int_equal(first_extent(f->file.text, "topology/particles"), kind == CIPC_BODY_PARTICLES ? m->node_count : 0);
        sample_run again = every_kind_create(&kind, 1, false);
        assert_int_equal(resume_quietly(f, again.model, again.state, scene, &error), CIPC_OK);
        assert_bits_equal(again.state->position, f->run.state->position, 3 * m->node_count);
        assert_bits_equal(again.state->velocity, f->run.state->velocity, 3 * m->node_count);
        sample_run_destroy(&again);
    }
}

static void test_resume_with_other_kinds_is_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    become(f, every_kind_create_all());
    write_frames(f, 2, 2);
    cipc_model *m = f->run.model;
    int *const changes[] = {&m->edges[m->first_segment][1], &m->tetrahedra[0][2], &m->node_body[9], &m->bodies[1].first_segment};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        *changes[i] += 1;
        assert_int_equal(resume_quietly(f, m, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
        *changes[i] -= 1;
    }
    m->bodies[2].kind = CIPC_BODY_SHELL; /* its nodes are no particles then */
    assert_int_equal(resume_quietly(f, m, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    m->bodies[2].kind = CIPC_BODY_PARTICLES;
    m->bodies[2].material.thickness *= 2;
    assert_int_equal(resume_quietly(f, m, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    m->bodies[2].material.thickness /= 2;
    assert_int_equal(resume_quietly(f, m, f->run.state, scene, &error), CIPC_OK);
}

static void set_format(const path *file, const char *text)
{
    hid_t handle = H5Fopen(file->text, H5F_ACC_RDWR, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text) + 1);
    assert_true(H5Adelete(handle, "format") >= 0);
    hid_t attribute = H5Acreate(handle, "format", type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Awrite(attribute, type, text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    H5Fclose(handle);
}

/* A file as an older cipc wrote it is still read (for pictures), but not gone on from. */
static void test_older_format_is_read_but_not_resumed(void **state)
{
    fixture *f = *state;
    cipc_error error;
    write_frames(f, 3, 3);
    set_format(&f->file, "cipc trajectory 1");
    hid_t handle = H5Fopen(f->file.text, H5F_ACC_RDWR, H5P_DEFAULT);
    static const char *const newer[] = {"topology/segments", "topology/particles", "topology/node_body"};
    for (size_t i = 0; i < sizeof newer / sizeof newer[0]; i++) {
        assert_true(H5Ldelete(handle, newer[i], H5P_DEFAULT) >= 0);
    }
    H5Fclose(handle);
    assert_int_equal(check_frames(&f->file, 3), 3);
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    assert_non_null(strstr(error.what, "format 1"));
    assert_non_null(strstr(error.remedy, "--resume"));
    assert_int_equal(check_frames(&f->file, 3), 3); /* and it is as it was */
}

static void test_unknown_formats_are_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    int frames;
    static const char *const unknown[] = {"cipc trajectory 3", "cipc trajectory 0", "cipc trajectory", "another format 2", ""};
    write_frames(f, 2, 2);
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++) {
        set_format(&f->file, unknown[i]);
        assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_IO);
        assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    }
    set_format(&f->file, "cipc trajectory 2");
    assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_OK);
}

/* ---- Damage --------------------------------------------------------------------------------------------------------------- */

static void test_damaged_files_are_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    int frames;
    size_t size;
    write_frames(f, 3, 3);
    char *bytes = file_read(&f->file, &size);
    for (size_t kept = 0; kept < size; kept += size / 24 + 1) {
        file_write(&f->file, bytes, kept);
        assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_IO);
        assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    }
    file_write(&f->file, bytes, size - 1);
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
    free(bytes);
    hid_t foreign = H5Fcreate(f->file.text, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT); /* good HDF5, but no trajectory */
    H5Fclose(foreign);
    assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_IO);
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_NOT_RESUMABLE);
}

/* A counter beyond the frames that there is room for cannot be right. */
static void test_impossible_counter_is_refused(void **state)
{
    fixture *f = *state;
    cipc_error error;
    int frames;
    write_frames(f, 3, 3);
    const int64_t wrong[] = {4, -1, INT64_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        hid_t file = H5Fopen(f->file.text, H5F_ACC_RDWR, H5P_DEFAULT), counter = H5Dopen(file, "frames", H5P_DEFAULT);
        H5Dwrite(counter, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &wrong[i]);
        H5Dclose(counter);
        H5Fclose(file);
        assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_IO);
    }
}

static void test_missing_files_and_frames(void **state)
{
    fixture *f = *state;
    cipc_error error;
    int frames;
    double position[3 * 64], time;
    assert_int_equal(cipc_trajectory_count(f->file.text, &frames, &error), CIPC_E_MISSING_FILE);
    assert_int_equal(resume_quietly(f, f->run.model, f->run.state, scene, &error), CIPC_E_MISSING_FILE);
    assert_non_null(strstr(error.remedy, "--resume"));
    write_frames(f, 3, 3);
    const int nodes = f->run.model->node_count;
    assert_int_equal(cipc_trajectory_read(f->file.text, 3, position, nodes, &time, &error), CIPC_E_IO);
    assert_int_equal(cipc_trajectory_read(f->file.text, -1, position, nodes, &time, &error), CIPC_E_IO);
    assert_int_equal(cipc_trajectory_read(f->file.text, 0, position, nodes + 1, &time, &error), CIPC_E_IO);
    assert_int_equal(cipc_trajectory_times(f->file.text, position, 4, &error), CIPC_E_IO);
    assert_int_equal(cipc_trajectory_read(f->file.text, 0, NULL, nodes, NULL, &error), CIPC_OK);
    assert_int_equal(cipc_trajectory_close(NULL, &error), CIPC_OK);
}

static void test_file_that_cannot_be_created(void **state)
{
    fixture *f = *state;
    cipc_error error;
    cipc_trajectory *t;
    const path nowhere = path_in(&f->folder, "no/such/folder.h5");
    assert_int_equal(cipc_trajectory_create(&t, nowhere.text, f->run.model, f->run.state, scene, 2, &error), CIPC_E_IO);
    assert_null(t);
    assert_non_null(strstr(error.place, "no/such"));
    assert_non_null(strstr(error.what, "No such file"));
}

/* A run's file can be read by others while it grows. */
static void test_reading_while_writing(void **state)
{
    fixture *f = *state;
    cipc_error error;
    cipc_trajectory *t;
    accept(cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 2, &error), &error);
    for (int frames = 1; frames < 6; frames++) {
        assert_int_equal(check_frames(&f->file, frames), frames);
        sample_run_advance(&f->run);
        accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    }
    accept(cipc_trajectory_close(t, &error), &error);
}

/* ---- Interruption --------------------------------------------------------------------------------------------------------- */

/* Child: append for ever, and tell after each frame. */
static void append_until_killed(fixture *f, int pipe_end)
{
    cipc_trajectory *t;
    if (cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 2, NULL) != CIPC_OK) {
        _exit(1);
    }
    for (;;) {
        sample_run_advance(&f->run);
        if (cipc_trajectory_append(t, f->run.state, NULL) != CIPC_OK || write(pipe_end, "", 1) != 1) {
            _exit(1);
        }
    }
}

/* SIGKILL lands wherever the child then is: in an append, or in the copy to a larger file. The kill comes after `told` frames. */
static void kill_after(fixture *f, int told)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        close(ends[0]);
        append_until_killed(f, ends[1]);
    }
    close(ends[1]);
    for (int i = 0; i < told; i++) {
        char byte;
        assert_int_equal(read(ends[0], &byte, 1), 1);
    }
    assert_int_equal(kill(child, SIGKILL), 0);
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFSIGNALED(how) && WTERMSIG(how) == SIGKILL);
    close(ends[0]);
}

static void test_killed_run_leaves_whole_frames(void **state)
{
    fixture *f = *state;
    cipc_error error;
    for (int told = 1; told <= 40; told++) {
        kill_after(f, told);
        const int frames = check_frames(&f->file, told + 1);
        sample_run other = sample_run_create();
        cipc_trajectory *t;
        accept(cipc_trajectory_resume(&t, f->file.text, other.model, other.state, scene, frames + 2, &error), &error);
        assert_int_equal(other.state->step, frames - 1);
        sample_run_advance(&other);
        accept(cipc_trajectory_append(t, other.state, &error), &error);
        accept(cipc_trajectory_close(t, &error), &error);
        assert_int_equal(check_frames(&f->file, frames + 1), frames + 1);
        sample_run_destroy(&other);
    }
}

static size_t counter_offset(const path *file)
{
    hid_t handle = H5Fopen(file->text, H5F_ACC_RDONLY, H5P_DEFAULT), counter = H5Dopen(handle, "frames", H5P_DEFAULT);
    const size_t offset = (size_t)H5Dget_offset(counter);
    H5Dclose(counter);
    H5Fclose(handle);
    return offset;
}

/* Every state of the file that an append cut short can leave: some of the bytes that it changes are new, the counter is still old. All old
 * frames must be there. This also proves that an append changes nothing that reading depends on. */
static void test_append_cut_short_anywhere(void **state)
{
    fixture *f = *state;
    cipc_error error;
    cipc_trajectory *t;
    size_t size_a, size_b;
    accept(cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 4, &error), &error);
    sample_run_advance(&f->run);
    accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    char *a = file_read(&f->file, &size_a);
    sample_run_advance(&f->run);
    accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    char *b = file_read(&f->file, &size_b);
    accept(cipc_trajectory_close(t, &error), &error);
    assert_int_equal(size_a, size_b); /* the room was there before */
    file_write(&f->file, a, size_a);
    const size_t counter = counter_offset(&f->file);
    size_t differences = 0;
    for (size_t i = 0; i < size_a; i++) {
        if (a[i] == b[i] || (i >= counter && i < counter + sizeof(int64_t))) {
            continue;
        }
        a[i] = b[i];
        if (differences++ % 16 == 0) {
            file_write(&f->file, a, size_a);
            assert_int_equal(check_frames(&f->file, 2), 2);
        }
    }
    assert_true(differences > sizeof(double) * 3); /* the test has seen a change */
    memcpy(a + counter, b + counter, sizeof(int64_t));
    assert_memory_equal(a, b, size_a);
    file_write(&f->file, a, size_a);
    assert_int_equal(check_frames(&f->file, 3), 3);
    free(a);
    free(b);
}

/* ---- Refusals of the system ------------------------------------------------------------------------------------------------ */

/* Child: no file may grow beyond `times` the size of the first. Creates, then appends until it is refused; leaves with the number of frames
 * appended that were accepted, or 100 + a number for what went wrong otherwise. */
static void append_within(fixture *f, rlim_t times)
{
    cipc_error error;
    cipc_trajectory *t;
    signal(SIGXFSZ, SIG_IGN);
    if (cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 1, &error) != CIPC_OK) {
        _exit(100);
    }
    struct stat first;
    stat(f->file.text, &first);
    const struct rlimit size = {times * (rlim_t)first.st_size, times * (rlim_t)first.st_size};
    setrlimit(RLIMIT_FSIZE, &size);
    for (int appended = 0; appended < 64; appended++) {
        sample_run_advance(&f->run);
        cipc_status status = cipc_trajectory_append(t, f->run.state, &error);
        if (status == CIPC_OK) {
            continue;
        }
        if (status != CIPC_E_IO || error.status != CIPC_E_IO) {
            _exit(101);
        }
        cipc_trajectory_close(t, &error); /* may or may not find room for its copy, but must come back */
        _exit(appended);                  /* not exit(): see the remark on H5dont_atexit() in src/cli/main.c */
    }
    _exit(102);
}

static void test_no_space_is_an_error_that_keeps_the_frames(void **state)
{
    fixture *f = *state;
    enum { ROOM_FOR_SOME = 2 };
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        append_within(f, ROOM_FOR_SOME);
    }
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how));
    const int appended = WEXITSTATUS(how);
    assert_in_range(appended, 1, 63);
    assert_int_equal(check_frames(&f->file, appended + 1), appended + 1);
}

static void test_every_allocation_may_fail(void **state)
{
    fixture *f = *state;
    cipc_error error;
    cipc_trajectory *t = NULL;
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_trajectory_create(&t, f->file.text, f->run.model, f->run.state, scene, 1, &error);
        const bool failed = allocation_failed();
        fail_allocation(0);
        if (!failed) {
            accept(status, &error);
            break;
        }
        assert_int_not_equal(status, CIPC_OK);
        assert_null(t);
        assert_false(file_exists(&f->file));
    }
    sample_run_advance(&f->run);
    fail_allocation(1); /* this append needs a copy, and that a buffer */
    assert_int_equal(cipc_trajectory_append(t, f->run.state, &error), CIPC_E_OUT_OF_MEMORY);
    fail_allocation(0);
    assert_int_equal(check_frames(&f->file, 1), 1);
    accept(cipc_trajectory_append(t, f->run.state, &error), &error);
    accept(cipc_trajectory_close(t, &error), &error);
    assert_int_equal(check_frames(&f->file, 2), 2);
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_trajectory_resume(&t, f->file.text, f->run.model, f->run.state, scene, 1, &error);
        const bool failed = allocation_failed();
        fail_allocation(0);
        if (!failed) {
            accept(status, &error);
            break;
        }
        assert_int_not_equal(status, CIPC_OK);
        assert_null(t);
    }
    accept(cipc_trajectory_close(t, &error), &error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_round_trip_with_room_to_spare_and_without, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_closed_file_has_no_empty_frames, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_same_run_gives_the_same_bytes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_resume_restores_everything, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_memory_comes_back, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_memory_of_other_frames_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_resume_with_another_scene_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_resume_with_another_model_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_topology_of_every_kind, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_rows_of_every_kind, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_kind_alone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_resume_with_other_kinds_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_older_format_is_read_but_not_resumed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_unknown_formats_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_damaged_files_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_impossible_counter_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_missing_files_and_frames, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_file_that_cannot_be_created, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_reading_while_writing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_killed_run_leaves_whole_frames, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_append_cut_short_anywhere, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_no_space_is_an_error_that_keeps_the_frames, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_every_allocation_may_fail, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
