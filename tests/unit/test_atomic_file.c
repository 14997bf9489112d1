/* Files that appear whole or not at all. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cipc/output.h"
#include "output/atomic_file.h"
#include "support/failing_memory.h"
#include "support/sample_run.h"

static int all_allocations_succeed(void **state)
{
    (void)state;
    fail_allocation(0);
    return 0;
}

static void assert_content(const path *file, const char *expected)
{
    char *bytes = file_read(file, NULL);
    assert_string_equal(bytes, expected);
    free(bytes);
}

static void test_new_content_replaces_old_at_the_end_only(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.txt"), partial = path_in(&folder, "a.txt.partial");
    file_write(&file, "old", 3);
    cipc_atomic_file atomic;
    assert_int_equal(cipc_atomic_open(&atomic, file.text, &error), CIPC_OK);
    fputs("new", atomic.stream);
    fflush(atomic.stream);
    assert_content(&file, "old");
    assert_true(file_exists(&partial));
    assert_int_equal(cipc_atomic_close(&atomic, CIPC_OK, &error), CIPC_OK);
    assert_content(&file, "new");
    assert_false(file_exists(&partial));
    folder_remove(&folder);
}

static void test_failure_leaves_the_old_file(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.txt"), partial = path_in(&folder, "a.txt.partial");
    file_write(&file, "old", 3);
    cipc_atomic_file atomic;
    assert_int_equal(cipc_atomic_open(&atomic, file.text, &error), CIPC_OK);
    fputs("new", atomic.stream);
    assert_int_equal(cipc_atomic_close(&atomic, CIPC_E_OUT_OF_MEMORY, &error), CIPC_E_OUT_OF_MEMORY);
    assert_content(&file, "old");
    assert_false(file_exists(&partial));
    folder_remove(&folder);
}

/* /dev/full takes no byte: the write error shows when the buffer is emptied. */
static void test_full_device_is_an_io_error(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.txt"), partial = path_in(&folder, "a.txt.partial");
    assert_int_equal(symlink("/dev/full", partial.text), 0);
    assert_int_equal(cipc_text_write(file.text, "some text", &error), CIPC_E_IO);
    assert_non_null(strstr(error.what, "No space left"));
    assert_false(file_exists(&file));
    assert_false(file_exists(&partial));
    folder_remove(&folder);
}

static void test_place_that_cannot_be_written(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "no/a.txt"), taken = path_in(&folder, "taken");
    assert_int_equal(cipc_text_write(file.text, "x", &error), CIPC_E_IO);
    assert_non_null(strstr(error.place, "no/a.txt"));
    assert_int_equal(cipc_text_write(folder.text, "x", &error), CIPC_E_IO); /* a folder is in the way */
    assert_int_equal(cipc_text_write(taken.text, "x", NULL), CIPC_OK);
    folder_remove(&folder);
    path beside; /* what the failed rename left beside the folder: nothing */
    assert_in_range(snprintf(beside.text, sizeof beside.text, "%s.partial", folder.text), 1, sizeof beside.text - 1);
    assert_false(file_exists(&beside));
}

static void test_out_of_memory(void **state)
{
    (void)state;
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "a.txt");
    for (long n = 1;; n++) {
        fail_allocation(n);
        cipc_status status = cipc_text_write(file.text, "x", &error);
        if (!allocation_failed()) {
            assert_int_equal(status, CIPC_OK);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_false(file_exists(&file));
    }
    fail_allocation(0);
    folder_remove(&folder);
}

static void test_cause_in_the_message(void **state)
{
    (void)state;
    cipc_error error;
    errno = ENOSPC;
    assert_int_equal(cipc_fail_io(&error, "f", "write"), CIPC_E_IO);
    assert_string_equal(error.what, "cannot write: No space left on device");
    errno = ENOMEM;
    assert_int_equal(cipc_fail_io(&error, "f", "write"), CIPC_E_OUT_OF_MEMORY);
    errno = 0;
    assert_int_equal(cipc_fail_io(&error, "f", "write"), CIPC_E_IO);
    assert_string_equal(error.what, "cannot write");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_new_content_replaces_old_at_the_end_only, all_allocations_succeed),
        cmocka_unit_test_setup(test_failure_leaves_the_old_file, all_allocations_succeed),
        cmocka_unit_test_setup(test_full_device_is_an_io_error, all_allocations_succeed),
        cmocka_unit_test_setup(test_place_that_cannot_be_written, all_allocations_succeed),
        cmocka_unit_test_setup(test_out_of_memory, all_allocations_succeed),
        cmocka_unit_test_setup(test_cause_in_the_message, all_allocations_succeed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
