/* What the commands vectors, eval and judge share. */
#ifndef CLI_CONFORMANCE_H
#define CLI_CONFORMANCE_H

#include <jansson.h>
#include <stdbool.h>
#include "cipc/base.h"

/* A function's name, "all" (*fn = NULL), or a message with the nearest one. */
cipc_status cipc_take_function(const char *command, const char *name, const char **fn, cipc_error *error);
cipc_status cipc_take_precision(const char *value, bool *single, cipc_error *error);
/* One compact line on standard output. */
cipc_status cipc_write_line(const json_t *line, cipc_error *error);

#endif
