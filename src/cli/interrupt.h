/* Ctrl-C and friends, asked after instead of waited for: SIGINT and SIGTERM are blocked and polled, so that no handler and no global
 * flag are needed, and no write is cut in half. */
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H

#include <stdbool.h>

/* From now on the two signals only wait. Call before the first thread is made: threads inherit it. */
void cipc_interrupt_hold(void);
/* Has one arrived since? The first that is seen restores the signals' usual force: a second Ctrl-C kills. */
bool cipc_interrupt_seen(void);

#endif
