/* Words and numbers of a text. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "scene/text_scan.h"

static cipc_error error;

static scene_scan scan_of(const char *text)
{
    return (scene_scan){.path = "f.txt", .at = text, .line = 1, .error = &error};
}

static void assert_word(scene_scan *scan, scene_reach reach, const char *text, int line)
{
    scene_word word;
    assert_true(scene_next_word(scan, reach, &word));
    assert_true(scene_word_is(&word, text));
    assert_int_equal(scan->line, line);
}

static void test_words_and_lines(void **state)
{
    (void)state;
    scene_scan scan = scan_of("  one\ttwo\r\n\n three\n");
    scene_word word;
    assert_word(&scan, SCENE_SAME_LINE, "one", 1);
    assert_word(&scan, SCENE_SAME_LINE, "two", 1);
    assert_false(scene_next_word(&scan, SCENE_SAME_LINE, &word));
    assert_int_equal(scan.line, 1);
    assert_true(scene_peek_word(&scan, SCENE_ANYWHERE, &word));
    assert_true(scene_word_is(&word, "three"));
    assert_int_equal(scan.line, 1); /* a look ahead moves nothing */
    assert_word(&scan, SCENE_ANYWHERE, "three", 3);
    assert_false(scene_next_word(&scan, SCENE_ANYWHERE, &word));
    assert_false(scene_word_is(&(scene_word){"three", 5}, "thre"));
    assert_false(scene_word_is(&(scene_word){"three", 5}, "threes"));
}

static void test_lines_are_skipped(void **state)
{
    (void)state;
    scene_scan scan = scan_of("a b c\nd e");
    assert_word(&scan, SCENE_ANYWHERE, "a", 1);
    scene_skip_line(&scan);
    assert_word(&scan, SCENE_ANYWHERE, "d", 2);
    scene_skip_line(&scan);
    scene_word word;
    assert_false(scene_next_word(&scan, SCENE_ANYWHERE, &word));
}

static void test_numbers(void **state)
{
    (void)state;
    scene_scan scan = scan_of("1.5 -2e-3\n7 -8 9");
    double x;
    long long n;
    assert_int_equal(scene_expect_number(&scan, SCENE_ANYWHERE, "x", &x), CIPC_OK);
    assert_true(x == 1.5);
    assert_int_equal(scene_expect_number(&scan, SCENE_SAME_LINE, "x", &x), CIPC_OK);
    assert_true(x == -2e-3);
    assert_int_equal(scene_expect_line_end(&scan, "x"), CIPC_OK);
    assert_int_equal(scene_expect_integer(&scan, SCENE_ANYWHERE, "n", &n), CIPC_OK);
    assert_true(n == 7);
    assert_int_equal(scene_expect_integer(&scan, SCENE_SAME_LINE, "n", &n), CIPC_OK);
    assert_true(n == -8);
    assert_int_equal(scene_expect_count(&scan, SCENE_SAME_LINE, "n", 9, &n), CIPC_OK);
    assert_true(n == 9);
}

static void assert_rejected(cipc_status found, cipc_status status, const char *place, const char *what)
{
    assert_int_equal(found, status);
    assert_string_equal(error.place, place);
    assert_string_equal(error.what, what);
}

static void test_what_is_expected_and_missing(void **state)
{
    (void)state;
    scene_scan scan = scan_of("a\n");
    scene_word word;
    assert_int_equal(scene_expect_word(&scan, SCENE_SAME_LINE, "a word", &word), CIPC_OK);
    assert_rejected(scene_expect_word(&scan, SCENE_SAME_LINE, "a word", &word), CIPC_E_BAD_MESH, "f.txt:1", "the line ends where a word is expected");
    assert_rejected(scene_expect_word(&scan, SCENE_ANYWHERE, "a word", &word), CIPC_E_BAD_MESH, "f.txt:2", "the file ends where a word is expected");
    scan = scan_of("a b");
    scene_next_word(&scan, SCENE_ANYWHERE, &word);
    assert_rejected(scene_expect_line_end(&scan, "a"), CIPC_E_BAD_MESH, "f.txt:1", "'b' after a");
}

static void test_bad_numbers(void **state)
{
    (void)state;
    static const char *const bad_numbers[] = {"1x", "x", "--1", "1,5", "$1"};
    double x;
    long long n;
    for (size_t i = 0; i < sizeof bad_numbers / sizeof *bad_numbers; i++) {
        scene_scan scan = scan_of(bad_numbers[i]), again = scan;
        char what[100];
        snprintf(what, sizeof what, "'%s' is not a number; x is expected", bad_numbers[i]);
        assert_rejected(scene_expect_number(&scan, SCENE_ANYWHERE, "x", &x), CIPC_E_BAD_MESH, "f.txt:1", what);
        snprintf(what, sizeof what, "'%s' is not a whole number; n is expected", bad_numbers[i]);
        assert_rejected(scene_expect_integer(&again, SCENE_ANYWHERE, "n", &n), CIPC_E_BAD_MESH, "f.txt:1", what);
    }
    scene_scan scan = scan_of("1e999 nan 1.5 9223372036854775808 -1 10");
    assert_rejected(scene_expect_number(&scan, SCENE_ANYWHERE, "x", &x), CIPC_E_BAD_MESH, "f.txt:1", "x is not a finite number");
    assert_rejected(scene_expect_number(&scan, SCENE_ANYWHERE, "x", &x), CIPC_E_BAD_MESH, "f.txt:1", "x is not a finite number");
    assert_rejected(scene_expect_integer(&scan, SCENE_ANYWHERE, "n", &n), CIPC_E_BAD_MESH, "f.txt:1", "'1.5' is not a whole number; n is expected");
    assert_rejected(scene_expect_integer(&scan, SCENE_ANYWHERE, "n", &n), CIPC_E_BAD_MESH, "f.txt:1",
                    "'9223372036854775808' is not a whole number of 64 bits; n is expected");
    assert_rejected(scene_expect_count(&scan, SCENE_ANYWHERE, "n", 9, &n), CIPC_E_OUT_OF_RANGE, "f.txt:1", "n is -1; 0 to 9 are allowed");
    assert_rejected(scene_expect_count(&scan, SCENE_ANYWHERE, "n", 9, &n), CIPC_E_OUT_OF_RANGE, "f.txt:1", "n is 10; 0 to 9 are allowed");
}

static void test_entries(void **state)
{
    (void)state;
    scene_scan scan = scan_of("1 $End");
    assert_int_equal(scene_expect_entry(&scan, "rows", 0, 3), CIPC_OK);
    assert_word(&scan, SCENE_ANYWHERE, "1", 1);
    assert_rejected(scene_expect_entry(&scan, "rows", 1, 3), CIPC_E_BAD_MESH, "f.txt:1", "'$End' after 1 of 3 rows");
    assert_rejected(scene_expect_entry(&scan, "rows", 2, 3), CIPC_E_BAD_MESH, "f.txt:1", "the file ends after 2 of 3 rows");
    scan = scan_of("\nCELLS 3");
    assert_rejected(scene_expect_entry(&scan, "rows", 0, 3), CIPC_E_BAD_MESH, "f.txt:2", "'CELLS' after 0 of 3 rows");
}

/* Words are shown up to 40 bytes, paths from their end; the message stays one line. */
static void test_long_words_and_paths(void **state)
{
    (void)state;
    char word[101], path[1001];
    memset(word, 'w', 100);
    memset(path, 'p', 1000);
    word[100] = path[1000] = '\0';
    memcpy(path + 990, "/the.obj", 9);
    path[998] = '\0';
    scene_scan scan = {.path = path, .at = word, .line = 123, .error = &error};
    double x;
    assert_int_equal(scene_expect_number(&scan, SCENE_ANYWHERE, "x", &x), CIPC_E_BAD_MESH);
    assert_int_equal(strspn(error.what + 1, "w"), 40);
    assert_non_null(strstr(error.place, "/the.obj:123"));
    assert_int_equal(scene_scan_reject_at(&scan, 0, CIPC_E_IO, "all"), CIPC_E_IO);
    assert_string_equal(error.place + strlen(error.place) - 8, "/the.obj");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words_and_lines),
        cmocka_unit_test(test_lines_are_skipped),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_what_is_expected_and_missing),
        cmocka_unit_test(test_bad_numbers),
        cmocka_unit_test(test_entries),
        cmocka_unit_test(test_long_words_and_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
