/* Arguments and output of the commands vectors, eval and judge. */
#include "cli/conformance.h"

#include <stdio.h>
#include <string.h>
#include "base/json_number.h"
#include "scene/nearest_name.h"
#include "verify/query.h"

cipc_status cipc_take_function(const char *command, const char *name, const char **fn, cipc_error *error)
{
    const char *names[VERIFY_FUNCTION_LIMIT];
    *fn = NULL;
    if (strcmp(name, "all") == 0) return CIPC_OK;
    *fn = verify_function_name(name);
    if (*fn != NULL) return CIPC_OK;
    for (int i = 0; i < verify_function_count(); i++) names[i] = verify_function_at(i);
    cipc_fail(error, CIPC_E_USAGE, command, "unknown function '%s'", name);
    return cipc_fail_remedy(error, "the nearest one is %s; cipc vectors --list names all", scene_nearest_name(name, names, verify_function_count()));
}

cipc_status cipc_take_precision(const char *value, bool *single, cipc_error *error)
{
    *single = strcmp(value, "binary32") == 0;
    if (*single || strcmp(value, "binary64") == 0) return CIPC_OK;
    cipc_fail(error, CIPC_E_USAGE, "--precision", "unknown precision '%s'", value);
    return cipc_fail_remedy(error, "give binary64 or binary32");
}

cipc_status cipc_write_line(const json_t *line, cipc_error *error)
{
    if (json_dumpf(line, stdout, CIPC_JSON_FORMAT | JSON_COMPACT) == 0 && fputc('\n', stdout) != EOF) return CIPC_OK;
    return cipc_fail(error, CIPC_E_IO, "standard output", "cannot be written to");
}
