/* Status codes, names, remedies, exit statuses and the one-line error text. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cipc/base.h"

typedef struct row {
    int number;
    const char *name;
    const char *remedy;
} row;

static const row rows[] = {
#define CIPC_X(name, number, remedy) {number, #name, remedy},
    CIPC_DIAGNOSTICS(CIPC_X)
#undef CIPC_X
};

enum { ROWS = sizeof rows / sizeof rows[0] };

static void test_every_code_has_its_name_and_remedy(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        assert_string_equal(cipc_status_name((cipc_status)rows[i].number), rows[i].name);
        assert_string_equal(cipc_status_remedy((cipc_status)rows[i].number), rows[i].remedy);
        assert_true(strlen(rows[i].remedy) < sizeof((cipc_error *)0)->remedy);
    }
    assert_string_equal(cipc_status_name(CIPC_OK), "OK");
    assert_string_equal(cipc_status_name(CIPC_E_OUT_OF_RANGE), "OUT_OF_RANGE");
}

static void test_numbers_are_distinct_and_of_four_digits(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        assert_in_range(rows[i].number, 1001, 3999);
        for (int k = 0; k < i; k++) {
            assert_int_not_equal(rows[i].number, rows[k].number);
        }
    }
}

static void test_exit_status_is_the_thousands_digit(void **state)
{
    (void)state;
    assert_int_equal(cipc_status_exit(CIPC_OK), 0);
    assert_int_equal(cipc_status_exit(CIPC_E_OUT_OF_MEMORY), 1);
    assert_int_equal(cipc_status_exit(CIPC_E_USAGE), 2);
    assert_int_equal(cipc_status_exit(CIPC_E_VIOLATED_GAP), 3);
    for (int i = 0; i < ROWS; i++) {
        assert_int_equal(cipc_status_exit((cipc_status)rows[i].number), rows[i].number / 1000);
    }
}

/* A number outside the list must not look like success nor run off the table. */
static void test_unknown_number(void **state)
{
    (void)state;
    const int unknown[] = {7, 1000, 2999, 999999};
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++) {
        assert_string_equal(cipc_status_name((cipc_status)unknown[i]), "UNKNOWN");
        assert_true(strlen(cipc_status_remedy((cipc_status)unknown[i])) > 0);
        assert_int_equal(cipc_status_exit((cipc_status)unknown[i]), 1);
    }
}

static void test_fail_fills_everything(void **state)
{
    (void)state;
    cipc_error error;
    memset(&error, 0xa5, sizeof error);
    assert_int_equal(cipc_fail(&error, CIPC_E_WRONG_TYPE, "scene.json:3:9 steps", "a %s where an %s is due", "text", "integer"), 2004);
    assert_int_equal(error.status, CIPC_E_WRONG_TYPE);
    assert_string_equal(error.place, "scene.json:3:9 steps");
    assert_string_equal(error.what, "a text where an integer is due");
    assert_string_equal(error.remedy, cipc_status_remedy(CIPC_E_WRONG_TYPE));
}

static void test_fail_without_error_or_place(void **state)
{
    (void)state;
    assert_int_equal(cipc_fail(NULL, CIPC_E_IO, "here", "%d", 1), CIPC_E_IO);
    assert_int_equal(cipc_fail_remedy(NULL, "%d", 1), CIPC_OK);
    cipc_error error;
    cipc_fail(&error, CIPC_E_IO, NULL, "disk full");
    assert_string_equal(error.place, "");
    assert_string_equal(error.what, "disk full");
}

static void test_text_stays_one_line(void **state)
{
    (void)state;
    cipc_error error;
    cipc_fail(&error, CIPC_E_SYNTAX, "a\nb", "tab\there\r\nescape\x1b[2J del\x7f, f\xc3\xbcnf stays");
    assert_string_equal(error.place, "a b");
    assert_string_equal(error.what, "tab here  escape [2J del , f\xc3\xbcnf stays");
    cipc_fail_remedy(&error, "did you mean \"%s\"?", "x\ny");
    assert_string_equal(error.remedy, "did you mean \"x y\"?");
}

static void test_long_text_is_cut_not_overrun(void **state)
{
    (void)state;
    static char text[4096];
    memset(text, 'x', sizeof text - 1);
    struct {
        cipc_error error;
        char guard[16];
    } box;
    memset(box.guard, 'g', sizeof box.guard);
    cipc_fail(&box.error, CIPC_E_IO, text, "%s", text);
    cipc_fail_remedy(&box.error, "%s", text);
    assert_int_equal(strlen(box.error.place), sizeof box.error.place - 1);
    assert_int_equal(strlen(box.error.what), sizeof box.error.what - 1);
    assert_int_equal(strlen(box.error.remedy), sizeof box.error.remedy - 1);
    for (size_t i = 0; i < sizeof box.guard; i++) {
        assert_int_equal(box.guard[i], 'g');
    }
}

/* A caller may wrap an error it got: the old texts are arguments of the new ones. */
static void test_fail_may_quote_its_own_error(void **state)
{
    (void)state;
    cipc_error error;
    cipc_fail(&error, CIPC_E_BAD_MESH, "ball.obj:7", "a face with two corners");
    cipc_fail(&error, CIPC_E_BAD_MESH, error.place, "body ball: %s", error.what);
    assert_string_equal(error.place, "ball.obj:7");
    assert_string_equal(error.what, "body ball: a face with two corners");
    assert_int_equal(cipc_fail_remedy(&error, "%s, line 7", error.remedy), CIPC_E_BAD_MESH);
    assert_string_equal(error.remedy, "mend the mesh at the line named, line 7");
}

/* Does the page hold a table row that starts as this diagnostic's must? */
static bool page_lists(const char *page, const row *r)
{
    char start[512];
    snprintf(start, sizeof start, "\n| %d | %s | %s | ", r->number, r->name, r->remedy);
    return strstr(page, start) != NULL;
}

static void test_docs_list_every_diagnostic(void **state)
{
    (void)state;
    static char page[1 << 16];
    FILE *file = fopen("docs/diagnostics.md", "r"); /* the test run starts in the top folder */
    assert_non_null(file);
    size_t length = fread(page, 1, sizeof page - 1, file);
    fclose(file);
    assert_in_range(length, 1, sizeof page - 2); /* all of it fitted */

    for (int i = 0; i < ROWS; i++) {
        if (!page_lists(page, &rows[i])) {
            fail_msg("docs/diagnostics.md has no row \"| %d | %s | %s | ...\"", rows[i].number, rows[i].name, rows[i].remedy);
        }
    }
    int listed = 0;
    for (const char *c = page; (c = strstr(c, "\n| ")) != NULL; c++) {
        listed += c[3] >= '1' && c[3] <= '3';
    }
    assert_int_equal(listed, ROWS); /* and none that is no more */

    const row wrong = {rows[0].number, rows[0].name, "another remedy"};
    assert_false(page_lists(page, &wrong));
}

static void test_version_is_three_numbers(void **state)
{
    (void)state;
    int major, minor, patch;
    char rest;
    assert_int_equal(sscanf(cipc_version(), "%d.%d.%d%c", &major, &minor, &patch, &rest), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_code_has_its_name_and_remedy),
        cmocka_unit_test(test_numbers_are_distinct_and_of_four_digits),
        cmocka_unit_test(test_exit_status_is_the_thousands_digit),
        cmocka_unit_test(test_unknown_number),
        cmocka_unit_test(test_fail_fills_everything),
        cmocka_unit_test(test_fail_without_error_or_place),
        cmocka_unit_test(test_text_stays_one_line),
        cmocka_unit_test(test_long_text_is_cut_not_overrun),
        cmocka_unit_test(test_fail_may_quote_its_own_error),
        cmocka_unit_test(test_docs_list_every_diagnostic),
        cmocka_unit_test(test_version_is_three_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
