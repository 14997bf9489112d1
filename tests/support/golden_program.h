/* A test program that holds every `parts`-th scene of scene_table.h against its golden file: the run itself, and the faults of 1 %. */
#ifndef SUPPORT_GOLDEN_PROGRAM_H
#define SUPPORT_GOLDEN_PROGRAM_H

#include "support/golden.h"
#include "support/scene_table.h"

/* part = 1 to GOLDEN_PARTS. Returns the exit status: the number of tests that failed. There are as many files tests/scenes/test_golden_*.c. */
enum { GOLDEN_PARTS = 8 };
int golden_program(int part);

/* For tests: a failure of the test, with the reason, when that is not possible. */
scene_outcome golden_run_or_fail(const scene_request *request);
golden golden_bands_or_fail(const scene_variant *variant);
/* The monitors have looked, and what they report agrees with their verdicts. */
void golden_assert_monitored(const scene_outcome *outcome);
void golden_print_figures(const char *name, const scene_outcome *outcome);

#endif
