/* Ctrl-C and friends, asked after instead of obeyed at once, so that no write is cut in half. */
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H

#include <stdbool.h>

/* From now on SIGINT and SIGTERM are only noted. */
void cipc_interrupt_hold(void);
/* Has one arrived since? The first that is seen restores the signals' usual force: a second Ctrl-C kills. */
bool cipc_interrupt_seen(void);

#endif
