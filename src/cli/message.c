/* How the program speaks: one line on stderr per message. */
#include "cli/command.h"

#include <stdio.h>

int cipc_say(const cipc_error *error)
{
    fprintf(stderr, "cipc: %s: CIPC-%d: %s: %s\n", error->place, (int)error->status, error->what, error->remedy);
    return cipc_status_exit(error->status);
}

void cipc_print_version(void)
{
    printf("cipc %s\n", cipc_version());
}
