/* SIGINT and SIGTERM, polled. */
#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <time.h>

static sigset_t both(void)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

void cipc_interrupt_hold(void)
{
    const sigset_t set = both();
    sigprocmask(SIG_BLOCK, &set, NULL);
}

bool cipc_interrupt_seen(void)
{
    const sigset_t set = both();
    const struct timespec no_time = {0, 0};
    if (sigtimedwait(&set, NULL, &no_time) < 0) {
        return false;
    }
    sigprocmask(SIG_UNBLOCK, &set, NULL);
    return true;
}
