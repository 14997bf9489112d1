/* Which runs a test of figures measures, and which it leaves out when only some are asked for. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/figure_run.h"

static void test_selection(void **state)
{
    (void)state;
    static const struct {
        const char *run, *selected;
        bool want;
    } cases[] = {
        {"cards", NULL, true},
        {"cards", "", false},
        {"cards", "cards", true},
        {"cards", "noodles cards", true},
        {"cards", "cards noodles", true},
        {"cards", "noodles stack", false},
        {"tablecloth", "tablecloth-2 tablecloth-4", false}, /* the beginning of a word */
        {"tablecloth-2", "tablecloth stack", false},
        {"cloth-2", "tablecloth-2", false}, /* its end */
        {"tablecloth", "tablecloth-2 tablecloth", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (figure_run_selected(cases[i].run, cases[i].selected) != cases[i].want) fail_msg("%s of '%s'", cases[i].run, cases[i].selected ? cases[i].selected : "(null)");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_selection),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
