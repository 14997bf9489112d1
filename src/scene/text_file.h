/* A whole file in memory. */
#ifndef SCENE_TEXT_FILE_H
#define SCENE_TEXT_FILE_H

#include <stddef.h>

#include "cipc/base.h"

/* The bytes of a file, followed by '\0'; free with cipc_free. MISSING_FILE if it cannot be opened or read, OUT_OF_RANGE beyond 1 GB. */
cipc_status scene_read_text(const char *path, char **text, size_t *length, cipc_error *error);

#endif
