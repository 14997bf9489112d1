/* The HDF5 file of a trajectory: its datasets, and frames in and out. Nothing here reports or silences errors: false means that HDF5
 * refused, errno (if not 0) why. trajectory.c is the only user.
 *
 * Why a kill at any instruction leaves a readable file: every chunk of every dataset is allocated when the file is made, so a frame
 * is written over room that exists, and no metadata of HDF5 (superblock, object headers, chunk index) changes after that. The counter
 * /frames, 8 bytes, is written after the frame's data. Caches are off, so writes reach the system in program order. Object times are
 * off (they are metadata), and the file is of the 1.8 format, which has no "open for writing" mark that a kill could leave behind. */
#ifndef OUTPUT_TRAJECTORY_FILE_H
#define OUTPUT_TRAJECTORY_FILE_H

#include <hdf5.h>
#include <stdbool.h>
#include "cipc/model.h"

typedef enum cipc_frame_scalar {
    CIPC_FRAME_TIME = 0,
    CIPC_FRAME_STEP,
    CIPC_FRAME_BARRIER_STIFFNESS,
    CIPC_FRAME_STRAIN_STIFFNESS_FACTOR,
    CIPC_FRAME_SCALAR_COUNT
} cipc_frame_scalar;

/* Files of format 1 (of shells only; no segments, particles, node_body in /topology, no kinds of bodies) can be read, not appended to. */
enum { CIPC_TRAJECTORY_FORMAT = 2 };

typedef struct cipc_trajectory_file {
    hid_t file, position, velocity, memory, scalar[CIPC_FRAME_SCALAR_COUNT], frames; /* memory: only if memory_count > 0 */
    int format;      /* its number: 1 .. CIPC_TRAJECTORY_FORMAT */
    int node_count, memory_count;
    int frame_count; /* whole frames */
    int room;        /* frames that the datasets have room for */
} cipc_trajectory_file;

#define CIPC_TRAJECTORY_FILE_CLOSED ((cipc_trajectory_file){-1, -1, -1, -1, {-1, -1, -1, -1}, -1, 0, 0, 0, 0, 0})

/* A new file of empty datasets; no frames yet. */
bool cipc_trajectory_file_make(cipc_trajectory_file *f, const char *path, int node_count, int memory_count, int room);
/* An existing one; false also if its datasets are not those of a trajectory. */
bool cipc_trajectory_file_open(cipc_trajectory_file *f, const char *path, bool writable);
/* Closes what is open. */
bool cipc_trajectory_file_close(cipc_trajectory_file *f);

/* Write frame number frame_count and raise the counter; there must be room. */
bool cipc_trajectory_file_append(cipc_trajectory_file *f, const cipc_state *state);
/* Read frame number `frame`; state's arrays are the caller's, each may be NULL. Its memory_count is not looked at: it has to be the file's. */
bool cipc_trajectory_file_read(const cipc_trajectory_file *f, int frame, cipc_state *state);
/* The times of the first `count` frames. */
bool cipc_trajectory_file_times(const cipc_trajectory_file *f, int count, double *times);

/* The parts that never change: /topology and /scene. */
bool cipc_trajectory_topology_write(hid_t file, const cipc_model *model, const char *scene_json);
bool cipc_trajectory_topology_copy(hid_t from, hid_t to);
/* Are the elements, bodies and rest shape those of the model, to the bit? */
bool cipc_trajectory_topology_matches(hid_t file, const cipc_model *model);
/* The text of /scene, a block of cipc_alloc; NULL: not there, or out of memory. */
char *cipc_trajectory_scene_read(hid_t file);

#endif
