/* Signals that wait until they are asked after. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/interrupt.h"

/* In a child, which may die of it: leaves with a bit for each thing that went as it should. */
static void receive(int signal_number)
{
    int right = 0;
    cipc_interrupt_hold();
    right |= !cipc_interrupt_seen() ? 1 : 0;
    raise(signal_number); /* it would kill, were it not held */
    raise(signal_number);
    right |= cipc_interrupt_seen() ? 2 : 0;
    right |= !cipc_interrupt_seen() ? 4 : 0; /* two at once are one */
    if (right != 7) {
        _exit(right);
    }
    raise(signal_number); /* after the first was seen, the usual force is back */
    _exit(100);
}

static void test_first_is_held_second_kills(void **state)
{
    (void)state;
    const int signals[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            receive(signals[i]);
        }
        int how;
        assert_int_equal(waitpid(child, &how, 0), child);
        assert_true(WIFSIGNALED(how));
        assert_int_equal(WTERMSIG(how), signals[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_first_is_held_second_kills)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
