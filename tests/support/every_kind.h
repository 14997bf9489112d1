/* Small models of bodies of any kinds, for the tests of output: what is shown of each kind, and what is left when a kind is missing. */
#ifndef SUPPORT_EVERY_KIND_H
#define SUPPORT_EVERY_KIND_H

#include <stdbool.h>
#include "support/sample_run.h"

enum { STRAND_NODES = 4, GRAIN_COUNT = 3 };

/* One body of each kind listed, side by side along x, all free, at y = 0 to 1: "cloth" (a square of 2 triangles), "strand" (4 nodes in a
 * row, 3 segments), "grains" (3 particles), "block" (a tetrahedron); and, at y = -0.5 to 0, "needles" (2 fixed segments) if asked for.
 * Rods and particles are 0.05 thick. Destroy it with sample_run_destroy(), move it on with sample_run_advance(). */
sample_run every_kind_create(const cipc_body_kind *kinds, int count, bool needles);
/* All four kinds and the needles. */
sample_run every_kind_create_all(void);

#endif
