/* Golden files, tests/golden/NAME.json: between which values each number of each recorded frame of a scene has to lie. The rule by which
 * ci/golden makes them is in docs/validation.md, "Golden bands". */
#ifndef SUPPORT_GOLDEN_H
#define SUPPORT_GOLDEN_H

#include <stdbool.h>

#include "support/scene_run.h"

enum { GOLDEN_FRAMES = 32, GOLDEN_REASON = 512 };

typedef struct golden {
    int steps;                 /* of the whole run */
    int probe[SCENE_PROBES];   /* nodes */
    int frame_count;
    int frames[GOLDEN_FRAMES]; /* steps after which the run is looked at, ascending; the last is `steps` */
    scene_frame low[GOLDEN_FRAMES], high[GOLDEN_FRAMES];
} golden;

/* Every file has at least the frames 1, 2, 3, 5, 8, 12, 18, 27, ... (each half as late again as the one before) and the last. */
int golden_next_frame(int frame);

/* The file has to be of this very command and well formed to the last entry: no frame of the sequence, no number of a quantity is missing, and
 * every name is known. A quantity that no frame names has to be exactly 0 in all of them. why: one clause, no newline. */
bool golden_read(const char *path, const char *command, golden *bands, char why[GOLDEN_REASON]);
/* Frame number `index` (from 0). NaN is outside of every band. */
bool golden_accepts(const golden *bands, int index, const scene_frame *frame, char why[GOLDEN_REASON]);

/* A run held against bands while it goes on: the context of golden_watch, which ends the run at the first frame out of band. */
typedef struct golden_check {
    const golden *bands;
    int seen; /* frames that were in band */
    bool outside;
    char why[GOLDEN_REASON];
} golden_check;
bool golden_watch(void *context, int step, const scene_frame *frame);
/* After the run: nothing was out of band, and frames, steps and probes are those of the file, none more and none less. */
bool golden_verdict(golden_check *check, int steps, const int probe[SCENE_PROBES]);

#endif
