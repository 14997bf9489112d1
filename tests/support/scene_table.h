/* The scenes that are held against golden files: every scene of the catalogue and its variants, at size ci. */
#ifndef SUPPORT_SCENE_TABLE_H
#define SUPPORT_SCENE_TABLE_H

#include "support/scene_run.h"

/* A 1 % fault (scene_fault.h) that cannot be seen: its name, and why. With `seen_by`, whether it is seen is drawn by the last bits, so by BLAS kernels too, and says nothing: then that
 * other variant, which has the same fault, must see it. */
typedef struct scene_unfelt {
    const char *fault, *reason, *seen_by;
} scene_unfelt;

enum { SCENE_UNFELT = 8 };
typedef struct scene_variant {
    const char *name; /* tests/golden/NAME.json */
    scene_request request;
    scene_unfelt unfelt[SCENE_UNFELT]; /* up to the first without a name */
} scene_variant;

extern const scene_variant scene_variants[];
extern const int scene_variant_count;
const scene_variant *scene_variant_of(const char *name); /* NULL: none */

enum { SCENE_PATH = 128, SCENE_COMMAND = 512 };
void scene_golden_path(const scene_variant *variant, char path[SCENE_PATH]);
/* The run as a user would ask for it. */
void scene_command(const scene_variant *variant, char command[SCENE_COMMAND]);

/* One scene recorded, as JSON on stdout: the command, the probes, the quantities with their units and how many numbers each has, and all
 * numbers after every step. jitter, seed: as in a scene_request. False: an error is on stderr, and what is on stdout counts for nothing. */
bool scene_record(const scene_variant *variant, int threads, double jitter, unsigned long seed);

#endif
