/* Versions: each is there and looks like one. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <ctype.h>
#include <string.h>

#include "cipc/base.h"
#include "output/versions.h"

static void test_all_are_there(void **state)
{
    (void)state;
    json_t *versions = cipc_versions();
    static const char *const names[] = {"cipc", "compiler", "platform", "glibc",   "cholmod", "gmp",
                                        "mpfr", "gsl",      "hdf5",     "jansson", "cairo"};
    assert_int_equal(json_object_size(versions), sizeof names / sizeof names[0]);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *text = json_string_value(json_object_get(versions, names[i]));
        assert_non_null(text);
        const char *digit = text;
        while (*digit != '\0' && !isdigit((unsigned char)*digit)) {
            digit++;
        }
        if (*digit == '\0' || strchr(digit, '.') == NULL) {
            fail_msg("%s: %s", names[i], text);
        }
    }
    assert_string_equal(json_string_value(json_object_get(versions, "cipc")), cipc_version());
    json_decref(versions);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all_are_there)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
