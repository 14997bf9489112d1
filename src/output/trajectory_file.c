/* The datasets of a trajectory file, and frames in and out of them. */
#include "output/trajectory_file.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const struct { const char *name, *unit; bool integer; } scalars[CIPC_FRAME_SCALAR_COUNT] = {
    [CIPC_FRAME_TIME] = {"time", "s", false},
    [CIPC_FRAME_STEP] = {"step", "1", true},
    [CIPC_FRAME_BARRIER_STIFFNESS] = {"barrier_stiffness", "J/m^4", false},
    [CIPC_FRAME_STRAIN_STIFFNESS_FACTOR] = {"strain_stiffness_factor", "1", false},
};

/* The attribute `format` of the root: these words and a number. Since 2, /topology has segments, particles, node_body and kinds of bodies. */
#define FORMAT "cipc trajectory"

static bool write_text_attribute(hid_t object, const char *name, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    bool good = H5Tset_size(type, strlen(text) + 1) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0;
    hid_t attribute = H5Acreate(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    good = good && H5Awrite(attribute, type, text) >= 0;
    good = H5Aclose(attribute) >= 0 && good;
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

/* A dataset whose chunks are `chunk_frames` frames long and all allocated now. fill: pointer to the value of frames not yet written, or
 * NULL for whatever the file system gives (zeros, and no disk space until they are written). */
static hid_t make_dataset(hid_t file, const char *name, const char *unit, hid_t type, int rank, const hsize_t dims[], hsize_t chunk_frames,
                          hid_t fill_type, const void *fill)
{
    hsize_t most[3], chunk[3];
    for (int i = 0; i < rank; i++) {
        most[i] = i == 0 ? H5S_UNLIMITED : dims[i];
        chunk[i] = i == 0 ? chunk_frames : dims[i];
    }
    hid_t space = H5Screate_simple(rank, dims, most), creation = H5Pcreate(H5P_DATASET_CREATE), access = H5Pcreate(H5P_DATASET_ACCESS);
    bool good = H5Pset_chunk(creation, rank, chunk) >= 0 && H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY) >= 0 &&
                H5Pset_obj_track_times(creation, false) >= 0 && H5Pset_chunk_cache(access, 0, 0, 0.0) >= 0;
    if (fill != NULL) {
        good = good && H5Pset_fill_value(creation, fill_type, fill) >= 0 && H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC) >= 0;
    } else {
        good = good && H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0;
    }
    hid_t dataset = good ? H5Dcreate(file, name, type, space, H5P_DEFAULT, creation, access) : -1;
    if (dataset >= 0 && !write_text_attribute(dataset, "unit", unit)) {
        H5Dclose(dataset);
        dataset = -1;
    }
    H5Pclose(access);
    H5Pclose(creation);
    H5Sclose(space);
    return dataset;
}

static hid_t make_scalar_dataset(hid_t file, cipc_frame_scalar which, hsize_t room)
{
    const double not_a_number = (double)NAN;
    const int64_t minus_one = -1;
    return scalars[which].integer
               ? make_dataset(file, scalars[which].name, scalars[which].unit, H5T_STD_I64LE, 1, &room, room, H5T_NATIVE_INT64, &minus_one)
               : make_dataset(file, scalars[which].name, scalars[which].unit, H5T_IEEE_F64LE, 1, &room, room, H5T_NATIVE_DOUBLE,
                              &not_a_number);
}

static hid_t make_counter(hid_t file)
{
    hid_t space = H5Screate(H5S_SCALAR), creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(creation, false);
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    hid_t dataset = H5Dcreate(file, "frames", H5T_STD_I64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    const int64_t none = 0;
    if (dataset >= 0 && H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &none) < 0) {
        H5Dclose(dataset);
        dataset = -1;
    }
    H5Pclose(creation);
    H5Sclose(space);
    return dataset;
}

/* See the head of trajectory_file.h. Without locks other programs can read while the run goes on, which is safe here. */
static hid_t access_properties(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    H5Pset_sieve_buf_size(access, 0);
    H5Pset_file_locking(access, false, true);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    return access;
}

bool cipc_trajectory_file_make(cipc_trajectory_file *f, const char *path, int node_count, int memory_count, int room)
{
    *f = CIPC_TRAJECTORY_FILE_CLOSED;
    f->node_count = node_count;
    f->memory_count = memory_count;
    f->room = room;
    hid_t access = access_properties();
    f->file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    f->format = CIPC_TRAJECTORY_FORMAT;
    char format[64];
    snprintf(format, sizeof format, FORMAT " %d", f->format);
    bool good = f->file >= 0 && write_text_attribute(f->file, "format", format) &&
                write_text_attribute(f->file, "cipc_version", cipc_version());
    if (good) {
        const hsize_t dims[3] = {(hsize_t)room, (hsize_t)node_count, 3};
        f->position = make_dataset(f->file, "positions", "m", H5T_IEEE_F64LE, 3, dims, 1, -1, NULL);
        f->velocity = make_dataset(f->file, "velocities", "m/s", H5T_IEEE_F64LE, 3, dims, 1, -1, NULL);
        f->frames = make_counter(f->file);
        good = f->position >= 0 && f->velocity >= 0 && f->frames >= 0;
    }
    if (good && memory_count > 0) {
        const hsize_t dims[2] = {(hsize_t)room, (hsize_t)memory_count};
        f->memory = make_dataset(f->file, "memory", "as of the method", H5T_IEEE_F64LE, 2, dims, 1, -1, NULL);
        good = f->memory >= 0;
    }
    for (int i = 0; i < CIPC_FRAME_SCALAR_COUNT && good; i++) {
        f->scalar[i] = make_scalar_dataset(f->file, (cipc_frame_scalar)i, (hsize_t)room);
        good = f->scalar[i] >= 0;
    }
    return good;
}

/* The number behind the words; 0: another format, or none. */
static int read_format(hid_t file)
{
    char text[64] = "";
    int format = 0;
    hid_t attribute = H5Aopen(file, "format", H5P_DEFAULT), type = H5Aget_type(attribute);
    const bool fits = H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) && H5Tget_size(type) < sizeof text;
    if (!fits || H5Aread(attribute, type, text) < 0 || sscanf(text, FORMAT " %d", &format) != 1) {
        format = 0;
    }
    H5Tclose(type);
    H5Aclose(attribute);
    return format;
}

static hid_t open_dataset(hid_t file, const char *name)
{
    hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(access, 0, 0, 0.0);
    hid_t dataset = H5Dopen(file, name, access);
    H5Pclose(access);
    return dataset;
}

/* Rank of the dataset, its extents in dims[3]; -1 if it is not open. */
static int extents(hid_t dataset, hsize_t dims[3])
{
    hid_t space = H5Dget_space(dataset);
    int rank = H5Sget_simple_extent_ndims(space);
    if (rank > 3 || (rank > 0 && H5Sget_simple_extent_dims(space, dims, NULL) < 0)) {
        rank = -1;
    }
    H5Sclose(space);
    return rank;
}

/* Takes node count and room from `positions` and holds everything else against them. */
static bool read_extents(cipc_trajectory_file *f)
{
    hsize_t p[3] = {0, 0, 0}, v[3] = {0, 0, 0};
    if (extents(f->position, p) != 3 || extents(f->velocity, v) != 3 || p[2] != 3 || memcmp(p, v, sizeof p) != 0 || p[0] > INT32_MAX ||
        p[1] > INT32_MAX) {
        return false;
    }
    for (int i = 0; i < CIPC_FRAME_SCALAR_COUNT; i++) {
        hsize_t s[3] = {0, 0, 0};
        if (extents(f->scalar[i], s) != 1 || s[0] != p[0]) {
            return false;
        }
    }
    hsize_t m[3] = {p[0], 0, 0};
    if (f->memory >= 0 && (extents(f->memory, m) != 2 || m[0] != p[0] || m[1] < 1 || m[1] > INT32_MAX)) {
        return false;
    }
    int64_t frames = -1;
    hsize_t none[3];
    if (extents(f->frames, none) != 0 || H5Dread(f->frames, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &frames) < 0 || frames < 0 ||
        frames > (int64_t)p[0]) {
        return false;
    }
    f->room = (int)p[0];
    f->node_count = (int)p[1];
    f->memory_count = (int)m[1];
    f->frame_count = (int)frames;
    return true;
}

bool cipc_trajectory_file_open(cipc_trajectory_file *f, const char *path, bool writable)
{
    *f = CIPC_TRAJECTORY_FILE_CLOSED;
    hid_t access = access_properties();
    f->file = H5Fopen(path, writable ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if (f->file < 0) {
        return false;
    }
    f->format = read_format(f->file);
    f->position = open_dataset(f->file, "positions");
    f->velocity = open_dataset(f->file, "velocities");
    f->frames = open_dataset(f->file, "frames");
    if (H5Lexists(f->file, "memory", H5P_DEFAULT) > 0) {
        f->memory = open_dataset(f->file, "memory");
    }
    for (int i = 0; i < CIPC_FRAME_SCALAR_COUNT; i++) {
        f->scalar[i] = open_dataset(f->file, scalars[i].name);
    }
    return f->format >= 1 && f->format <= CIPC_TRAJECTORY_FORMAT && f->position >= 0 && f->velocity >= 0 && f->frames >= 0 &&
           read_extents(f);
}

bool cipc_trajectory_file_close(cipc_trajectory_file *f)
{
    bool good = true;
    hid_t datasets[] = {f->position, f->velocity, f->memory, f->frames, f->scalar[0], f->scalar[1], f->scalar[2], f->scalar[3]};
    for (size_t i = 0; i < sizeof datasets / sizeof datasets[0]; i++) {
        if (datasets[i] >= 0) {
            good = H5Dclose(datasets[i]) >= 0 && good;
        }
    }
    if (f->file >= 0) {
        good = H5Fclose(f->file) >= 0 && good;
    }
    *f = CIPC_TRAJECTORY_FILE_CLOSED;
    return good;
}

typedef enum direction { READ, WRITE } direction;

/* Move frame `frame` of a dataset from or to memory: `rank` 3 is a whole [rows][3] array, 2 a row of numbers, 1 a number. */
static bool transfer(hid_t dataset, direction way, int frame, int rank, int rows, hid_t memory_type, void *values)
{
    const hsize_t start[3] = {(hsize_t)frame, 0, 0}, count[3] = {1, (hsize_t)rows, 3};
    hid_t in_file = H5Dget_space(dataset), in_memory = H5Screate_simple(rank, count, NULL);
    bool good = H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start, NULL, count, NULL) >= 0;
    if (way == WRITE) {
        good = good && H5Dwrite(dataset, memory_type, in_memory, in_file, H5P_DEFAULT, values) >= 0;
    } else {
        good = good && H5Dread(dataset, memory_type, in_memory, in_file, H5P_DEFAULT, values) >= 0;
    }
    H5Sclose(in_memory);
    H5Sclose(in_file);
    return good;
}

static bool transfer_scalars(const cipc_trajectory_file *f, direction way, int frame, cipc_state *state)
{
    int64_t step = state->step;
    bool good = transfer(f->scalar[CIPC_FRAME_TIME], way, frame, 1, 0, H5T_NATIVE_DOUBLE, &state->time) &&
                transfer(f->scalar[CIPC_FRAME_STEP], way, frame, 1, 0, H5T_NATIVE_INT64, &step) &&
                transfer(f->scalar[CIPC_FRAME_BARRIER_STIFFNESS], way, frame, 1, 0, H5T_NATIVE_DOUBLE, &state->barrier_stiffness) &&
                transfer(f->scalar[CIPC_FRAME_STRAIN_STIFFNESS_FACTOR], way, frame, 1, 0, H5T_NATIVE_DOUBLE,
                         &state->strain_stiffness_factor);
    state->step = (int)step;
    return good && step >= 0 && step <= INT32_MAX;
}

bool cipc_trajectory_file_append(cipc_trajectory_file *f, const cipc_state *state)
{
    cipc_state copy = *state; /* transfer() takes pointers that are not const; its WRITE leaves what they point at alone */
    const int64_t frames = f->frame_count + 1;
    bool good = transfer(f->position, WRITE, f->frame_count, 3, f->node_count, H5T_NATIVE_DOUBLE, copy.position) &&
                transfer(f->velocity, WRITE, f->frame_count, 3, f->node_count, H5T_NATIVE_DOUBLE, copy.velocity) &&
                (f->memory_count == 0 || transfer(f->memory, WRITE, f->frame_count, 2, f->memory_count, H5T_NATIVE_DOUBLE, copy.memory)) &&
                transfer_scalars(f, WRITE, f->frame_count, &copy) && H5Fflush(f->file, H5F_SCOPE_LOCAL) >= 0 &&
                H5Dwrite(f->frames, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &frames) >= 0 &&
                H5Fflush(f->file, H5F_SCOPE_LOCAL) >= 0;
    if (good) {
        f->frame_count++;
    }
    return good;
}

bool cipc_trajectory_file_read(const cipc_trajectory_file *f, int frame, cipc_state *state)
{
    bool good = frame >= 0 && frame < f->frame_count && transfer_scalars(f, READ, frame, state);
    if (good && state->position != NULL) {
        good = transfer(f->position, READ, frame, 3, f->node_count, H5T_NATIVE_DOUBLE, state->position);
    }
    if (good && state->velocity != NULL) {
        good = transfer(f->velocity, READ, frame, 3, f->node_count, H5T_NATIVE_DOUBLE, state->velocity);
    }
    if (good && f->memory_count > 0 && state->memory != NULL) {
        good = transfer(f->memory, READ, frame, 2, f->memory_count, H5T_NATIVE_DOUBLE, state->memory);
    }
    return good;
}

bool cipc_trajectory_file_times(const cipc_trajectory_file *f, int count, double *times)
{
    if (count > f->frame_count) {
        return false;
    }
    const hsize_t start = 0, length = (hsize_t)count;
    hid_t in_file = H5Dget_space(f->scalar[CIPC_FRAME_TIME]), in_memory = H5Screate_simple(1, &length, NULL);
    bool good = H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &start, NULL, &length, NULL) >= 0 &&
                H5Dread(f->scalar[CIPC_FRAME_TIME], H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, times) >= 0;
    H5Sclose(in_memory);
    H5Sclose(in_file);
    return good;
}
