/* Verdicts as JUnit XML, for continuous integration systems. */
#ifndef OUTPUT_JUNIT_H
#define OUTPUT_JUNIT_H

#include "cipc/base.h"

/* FAILED: looked at, and wrong. ERROR: could not be looked at, because something else went wrong. SKIPPED: there was nothing to look at. */
typedef enum cipc_junit_outcome { CIPC_JUNIT_PASSED = 0, CIPC_JUNIT_FAILED, CIPC_JUNIT_ERROR, CIPC_JUNIT_SKIPPED, CIPC_JUNIT_OUTCOMES } cipc_junit_outcome;

/* Text is UTF-8 of any content: what XML has no place for becomes '?'. */
typedef struct cipc_junit_case {
    const char *suite, *name;
    cipc_junit_outcome outcome;
    char message[2048]; /* why it did not pass: one line */
} cipc_junit_case;

/* The file appears whole or not at all. Cases of the same suite stand together. CIPC_E_IO; CIPC_E_OUT_OF_MEMORY. */
cipc_status cipc_junit_write(const char *path, const cipc_junit_case *cases, int count, cipc_error *error);

#endif
