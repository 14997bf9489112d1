/* A file that appears whole under its name, or not at all: written under a temporary name beside it, then renamed. */
#ifndef OUTPUT_ATOMIC_FILE_H
#define OUTPUT_ATOMIC_FILE_H

#include <stdio.h>
#include "cipc/base.h"

typedef struct cipc_atomic_file {
    FILE *stream;      /* to write to */
    char *path;        /* the final name */
    char *temporary;   /* path + ".partial" */
} cipc_atomic_file;

/* path + ".partial", a block of cipc_alloc; NULL: out of memory. */
char *cipc_atomic_temporary(const char *path);

cipc_status cipc_atomic_open(cipc_atomic_file *file, const char *path, cipc_error *error);
/* Close; if `status` is CIPC_OK and everything was written, rename into place, else remove the temporary file. Frees; returns `status`,
 * or the error met here. */
cipc_status cipc_atomic_close(cipc_atomic_file *file, cipc_status status, cipc_error *error);

/* CIPC_E_IO with the system's word for errno appended, "cannot WHAT: No space left on device"; CIPC_E_OUT_OF_MEMORY for ENOMEM. */
cipc_status cipc_fail_io(cipc_error *error, const char *path, const char *what);

#endif
