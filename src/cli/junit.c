/* A command that came to nothing, as JUnit XML. */
#include "cli/command.h"

#include <stdio.h>
#include "output/junit.h"

int cipc_junit_refused(const char *path, const char *command, const cipc_error *error, int exit_status)
{
    if (path == NULL) {
        return exit_status;
    }
    cipc_junit_case only = {.suite = command, .name = "the command", .outcome = CIPC_JUNIT_ERROR};
    snprintf(only.message, sizeof only.message, "%s: CIPC-%d: %s: %s", error->place, (int)error->status, error->what, error->remedy);
    cipc_error second;
    if (cipc_junit_write(path, &only, 1, &second) != CIPC_OK) {
        cipc_say(&second);
    }
    return exit_status;
}
