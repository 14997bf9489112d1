/* SIGINT and SIGTERM as a flag. The flag is the program's one writable static: a handler has no argument to take it by, and blocking the signals
 * instead would not do, since threads made before main (OpenBLAS's) would still receive them. */
#include "cli/interrupt.h"

#include <signal.h>
#include <string.h>

static volatile sig_atomic_t interrupt_arrived;

static void note(int number)
{
    (void)number;
    interrupt_arrived = 1;
}

static void set_handler(void (*handler)(int))
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART; /* a write under way is finished */
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void cipc_interrupt_hold(void) { set_handler(note); }

bool cipc_interrupt_seen(void)
{
    if (!interrupt_arrived) return false;
    interrupt_arrived = 0;
    set_handler(SIG_DFL);
    return true;
}
