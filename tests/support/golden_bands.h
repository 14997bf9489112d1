/* Golden bands: for each scene, between which values each quantity of scene_run.h has to end (tests/golden/NAME.json). The rule by which
 * bands are made is in docs/validation.md, "Golden bands". */
#ifndef SUPPORT_GOLDEN_BANDS_H
#define SUPPORT_GOLDEN_BANDS_H

#include <stdbool.h>
#include <stddef.h>

#include "support/scene_run.h"

typedef struct golden_bands {
    double low[QUANTITY_COUNT], high[QUANTITY_COUNT];
} golden_bands;

/* One clause, no newline: why a golden file or a result was rejected. */
enum { GOLDEN_REASON = 512 };

/* Read tests/golden/NAME.json. The file has to be of this very command and to have exactly the quantities there are. */
bool golden_read(const char *path, const char *command, golden_bands *bands, char why[GOLDEN_REASON]);
/* Every quantity is within its band; NaN is not. */
bool golden_accepts(const golden_bands *bands, const double quantity[QUANTITY_COUNT], char why[GOLDEN_REASON]);

/* What the floors of the rule are made of. */
typedef struct golden_scale {
    double time_step, tolerance, mass; /* s, m/s, kg */
} golden_scale;

/* The rule: bands from runs that are all as good as one another. */
golden_bands golden_derive(int runs, const double (*quantity)[QUANTITY_COUNT], golden_scale scale);
/* Write the file: the bands, and how each came about. */
bool golden_write(const char *path, const char *command, int runs, const double (*quantity)[QUANTITY_COUNT], golden_scale scale,
                  char why[GOLDEN_REASON]);

#endif
