/* What the tests of output and of the command line share: a small model, a state that moves, a folder that goes away. */
#ifndef SUPPORT_SAMPLE_RUN_H
#define SUPPORT_SAMPLE_RUN_H

#include <stddef.h>
#include "cipc/model.h"

/* A cloth of 3 x 3 nodes with a strain limit ("cloth", at y = 0.2, size 1) over a fixed ground of two triangles
 * ("ground", y = 0, size 2). */
typedef struct sample_run {
    cipc_model *model;
    cipc_state *state;
} sample_run;
sample_run sample_run_create(void);
void sample_run_destroy(sample_run *run);
/* The state after one more step: positions, velocities and scalars whose bits are all different from step to step. */
void sample_run_advance(sample_run *run);

/* An empty folder under TMPDIR; folder_remove() empties and removes it.. */
typedef struct path { char text[512]; } path;
path folder_make(void);
void folder_remove(const path *folder);
path path_in(const path *folder, const char *name);

/* A file's bytes (malloc'd, with a 0 behind them); fails the test if it cannot be read. size may be NULL. */
char *file_read(const path *file, size_t *size);
void file_write(const path *file, const void *bytes, size_t size);
int file_exists(const path *file);

#endif
