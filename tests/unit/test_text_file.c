/* Reading whole files. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "scene/text_file.h"
#include "support/failing_memory.h"
#include "support/scene_trial.h"

static void check_length(size_t length)
{
    char *folder = make_folder(), *bytes = malloc(length + 1), *text;
    size_t found;
    for (size_t i = 0; i < length; i++) bytes[i] = (char)('a' + i % 26);
    char *path = write_file(folder, "f", bytes, length);
    assert_int_equal(scene_read_text(path, &text, &found, NULL), CIPC_OK);
    assert_int_equal(found, length);
    assert_memory_equal(text, bytes, length);
    assert_int_equal(text[length], '\0');
    cipc_free(text);
    free(bytes);
    free(path);
    remove_folder(folder);
}

/* Around the first block's size, 65536, where the buffer grows. */
static void test_lengths(void **state)
{
    (void)state;
    const size_t lengths[] = {0, 1, 65534, 65535, 65536, 65537, 300000};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) check_length(lengths[i]);
}

static void test_what_cannot_be_read(void **state)
{
    (void)state;
    char *text;
    size_t length;
    cipc_error error;
    assert_int_equal(scene_read_text("/nowhere/at/all", &text, &length, &error), CIPC_E_MISSING_FILE);
    assert_string_equal(error.place, "/nowhere/at/all");
    assert_non_null(strstr(error.what, "cannot be opened"));
    assert_null(text);
    assert_int_equal(scene_read_text("/", &text, &length, &error), CIPC_E_MISSING_FILE); /* a folder opens, but cannot be read */
    assert_null(text);
}

static void test_no_memory(void **state)
{
    (void)state;
    char *folder = make_folder(), *path = write_file(folder, "f", "x", 1), *text;
    size_t length;
    fail_allocation(1);
    assert_int_equal(scene_read_text(path, &text, &length, NULL), CIPC_E_OUT_OF_MEMORY);
    assert_null(text);
    fail_allocation(0);
    free(path);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lengths),
        cmocka_unit_test(test_what_cannot_be_read),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
