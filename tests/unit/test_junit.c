/* JUnit XML: what is written, text of any content, files that cannot be written; the verdicts of runs. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

#include "cipc/output.h"
#include "output/junit.h"
#include "support/every_kind.h"
#include "support/failing_memory.h"

/* The text of the file, to be freed. */
static char *written(const cipc_junit_case *cases, int count)
{
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "verdicts.xml");
    assert_int_equal(cipc_junit_write(file.text, cases, count, &error), CIPC_OK);
    size_t size = 0;
    char *bytes = file_read(&file, &size), *text = calloc(size + 1, 1);
    assert_non_null(text);
    memcpy(text, bytes, size);
    free(bytes);
    folder_remove(&folder);
    return text;
}

static void test_suites_and_counts(void **state)
{
    (void)state;
    const cipc_junit_case cases[] = {
        {"drape", "M1", CIPC_JUNIT_PASSED, ""},         {"drape", "M2", CIPC_JUNIT_FAILED, "a < b & \"c\""}, {"drape", "M3", CIPC_JUNIT_SKIPPED, "none"},
        {"other", "steps", CIPC_JUNIT_ERROR, "no disk"},
    };
    char *text = written(cases, 4);
    assert_string_equal(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                              "<testsuites tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\">\n"
                              "  <testsuite name=\"drape\" tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\">\n"
                              "    <testcase classname=\"drape\" name=\"M1\"/>\n"
                              "    <testcase classname=\"drape\" name=\"M2\">\n"
                              "      <failure message=\"a &lt; b &amp; &quot;c&quot;\"/>\n"
                              "    </testcase>\n"
                              "    <testcase classname=\"drape\" name=\"M3\">\n"
                              "      <skipped message=\"none\"/>\n"
                              "    </testcase>\n"
                              "  </testsuite>\n"
                              "  <testsuite name=\"other\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\">\n"
                              "    <testcase classname=\"other\" name=\"steps\">\n"
                              "      <error message=\"no disk\"/>\n"
                              "    </testcase>\n"
                              "  </testsuite>\n"
                              "</testsuites>\n");
    free(text);
}

/* The suite's name as it stands in the file. */
static void assert_name(const char *name, const char *expected)
{
    const cipc_junit_case only = {.suite = name, .name = "x"};
    char *text = written(&only, 1), *begin = strstr(text, "testsuite name=\"");
    assert_non_null(begin);
    begin += strlen("testsuite name=\"");
    *strstr(begin, "\" tests=") = '\0';
    assert_string_equal(begin, expected);
    free(text);
}

static void test_text_of_any_content(void **state)
{
    (void)state;
    assert_name("caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\xb6 \xed\x9f\xbf \xee\x80\x80 \xf4\x8f\xbf\xbf", "caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\xb6 \xed\x9f\xbf \xee\x80\x80 \xf4\x8f\xbf\xbf");
    assert_name("a\tb\nc\x1b\x7f", "a?b?c??");
    assert_name("\xff\xc3", "??");                  /* no UTF-8; cut off */
    assert_name("\xc0\xaf \xe0\x80\xaf", "?? ???"); /* longer than need be */
    assert_name("\xed\xa0\x80", "???");             /* a surrogate */
    assert_name("\xef\xbf\xbe \xef\xbf\xbf", "??? ???");
    assert_name("\xf4\x90\x80\x80 \xf8\x88", "???? ??");
    assert_name("\x80", "?");
}

/* Every text of two bytes, and of three that begins beyond ASCII, is taken as the C library takes UTF-8, and nothing but what XML may have comes out. */
static void test_against_the_library(void **state)
{
    (void)state;
    if (setlocale(LC_CTYPE, "C.UTF-8") == NULL) {
        skip();
    }
    static cipc_junit_case cases[4096];
    static char names[4096][5];
    for (int high = 0; high < 16; high++) {
        for (int i = 0; i < 4096; i++) {
            const unsigned char made[4] = {(unsigned char)(0xe0 + high), (unsigned char)(1 + i / 64 * 4 % 255), (unsigned char)(0x80 + i % 64), 'z'};
            memcpy(names[i], made, 4);
            cases[i] = (cipc_junit_case){.suite = "s", .name = names[i]};
        }
        char *text = written(cases, 4096);
        const size_t length = strlen(text);
        wchar_t *wide = calloc(length + 1, sizeof *wide);
        assert_non_null(wide);
        assert_true(mbstowcs(wide, text, length + 1) != (size_t)-1);
        for (const wchar_t *c = wide; *c != L'\0'; c++) {
            assert_true((*c >= 0x20 || *c == L'\n') && *c != 0x7f && !(*c >= 0xd800 && *c <= 0xdfff) && *c != 0xfffe && *c != 0xffff);
        }
        free(wide);
        free(text);
    }
    setlocale(LC_CTYPE, "C");
}

static void test_a_folder_that_is_not_there(void **state)
{
    (void)state;
    cipc_error error;
    const cipc_junit_case only = {.suite = "s", .name = "x"};
    assert_int_equal(cipc_junit_write("/no/such/folder/v.xml", &only, 1, &error), CIPC_E_IO);
    assert_int_equal(cipc_junit_write("/dev/full/v.xml", &only, 1, &error), CIPC_E_IO);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "v.xml");
    const cipc_junit_case only = {.suite = "s", .name = "x"};
    long n = 1;
    for (;; n++) {
        cipc_error error;
        fail_allocation(n);
        const cipc_status status = cipc_junit_write(file.text, &only, 1, &error);
        if (!allocation_failed()) {
            assert_int_equal(status, CIPC_OK);
            break;
        }
        assert_int_equal(status, CIPC_E_OUT_OF_MEMORY);
        assert_false(file_exists(&file));
    }
    fail_allocation(0);
    assert_true(n > 1);
    folder_remove(&folder);
}

/* ---- Runs ------------------------------------------------------------------------------------------------------------------- */

static cipc_run_summary good_run(void)
{
    cipc_run_summary s = cipc_run_summary_default();
    s.scene_name = "drape";
    s.steps_asked = s.steps_taken = 4;
    s.points_checked = 10;
    s.energy_checks = 9;
    s.momentum_checks = 4;
    s.swept = true;
    s.limited_triangles = 100;
    s.tetrahedra = 7;
    return s;
}

/* A letter per case, steps first: '.' passed, 'F'ailed, 'E'rror, 'S'kipped; and that the file contains `part`. */
static void assert_cases(const cipc_run_summary *s, const char *letters, const char *part)
{
    cipc_error error;
    const path folder = folder_make(), file = path_in(&folder, "v.xml");
    assert_int_equal(cipc_summary_junit(file.text, s, &error), CIPC_OK);
    size_t size = 0;
    char *bytes = file_read(&file, &size), *text = calloc(size + 1, 1), found[16] = {0};
    memcpy(text, bytes, size);
    folder_remove(&folder);
    int count = 0;
    for (const char *c = strstr(text, "<testcase"); c != NULL && count < 15; count++) {
        const char *next = strstr(c + 1, "<testcase"), *end = next != NULL ? next : text + size;
        const char *f = strstr(c, "<failure"), *e = strstr(c, "<error"), *k = strstr(c, "<skipped");
        found[count] = f != NULL && f < end ? 'F' : e != NULL && e < end ? 'E' : k != NULL && k < end ? 'S' : '.';
        c = next;
    }
    if (strstr(text, part) == NULL) fail_msg("no '%s' in %s", part, text);
    assert_string_equal(found, letters);
    free(bytes);
    free(text);
}

static void test_verdicts_of_runs(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    assert_cases(&s, ".........", "tests=\"9\" failures=\"0\" errors=\"0\" skipped=\"0\"");
    s.momentum_source = "gravity";
    s.momentum_checks = 0;
    assert_cases(&s, ".......S.", "not checked: gravity");
    s.tetrahedra = 0;
    assert_cases(&s, "....S..S.", "no tetrahedron");
    s.limited_triangles = 0;
    assert_cases(&s, "...SS..S.", "strain limit");
    s.swept = false;
    assert_cases(&s, "...SSS.S.", "monitor.swept is off");
    s.monitored = false;
    assert_cases(&s, ".SSSSSSSS", "not checked: the monitors are off");
    s = good_run();
    s.points_checked = s.energy_checks = s.momentum_checks = 0;
    assert_cases(&s, ".SSSSSSSS", "no accepted point");
}

static void test_verdicts_of_the_method_asynchronous(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.method = CIPC_METHOD_ASYNCHRONOUS;
    s.energy_checks = 0;
    s.windows_checked = 6;
    s.limited_triangles = 0;
    assert_cases(&s, "...S..S..", "not checked: the energy oscillates");
}

static void test_verdicts_of_the_method_mass_spring(void **state)
{
    (void)state;
    cipc_run_summary s = good_run();
    s.method = CIPC_METHOD_MASS_SPRING;
    s.energy_checks = s.momentum_checks = 0;
    s.limited_triangles = 0;
    s.swept = false;
    s.momentum_source = "mass-spring steps";
    s.massspring.frames = 4;
    assert_cases(&s, ".SSS.SSS.", "counted, not guaranteed by the method mass-spring: 0 of 4 frames");
    s.massspring.intersecting = (cipc_counted){.frames = 3, .first_step = 2, .first = {.what = "edge 7 meets"}};
    assert_cases(&s, ".SSS.SSS.", "3 of 4 frames; the first: edge 7 meets");
    assert_cases(&s, ".SSS.SSS.", "not checked: the method mass-spring makes no claim about paths");
    assert_cases(&s, ".SSS.SSS.", "not checked: explicit steps minimise no potential");
    s.steps_taken = 3;
    s.interrupted = true;
    assert_cases(&s, "ESSS.SSS.", "interrupted after step 3 of 4: go on with --resume");
}

static void test_verdicts_of_runs_that_went_wrong(void **state)
{
    (void)state;
    cipc_error error;
    cipc_run_summary s = good_run();
    s.steps_taken = 2;
    s.error = &error;
    s.status = cipc_fail(&error, CIPC_E_VIOLATED_GAP, "step 3, iteration 1, monitor M2", "a <b> gap");
    assert_cases(&s, "S.F......", "step 3, iteration 1, monitor M2: CIPC-3002: a &lt;b&gt; gap: ");
    assert_cases(&s, "S.F......", "an invariant broke in step 3 of 4");
    s.status = cipc_fail(&error, CIPC_E_NOT_CONVERGED, "step 3", "did not converge");
    assert_cases(&s, "E........", "step 3: CIPC-1003: did not converge: ");
    s.status = cipc_fail(&error, CIPC_E_INDETERMINATE, "step 3", "cannot tell");
    assert_cases(&s, "ESSSSS...", "gave up");
    s.status = cipc_fail(&error, CIPC_E_IO, "summary.json", "no space");
    s.steps_taken = 4;
    assert_cases(&s, "E........", "no space");
    s = good_run();
    s.steps_taken = 3;
    s.interrupted = true;
    assert_cases(&s, "E........", "interrupted after step 3 of 4");
    s.interrupted = false; /* nobody knows why */
    assert_cases(&s, "E........", "after step 3 of 4");
    s = good_run();
    s.converged = false;
    assert_cases(&s, "F........", "a step did not converge");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_suites_and_counts),          cmocka_unit_test(test_text_of_any_content),
        cmocka_unit_test(test_against_the_library),        cmocka_unit_test(test_a_folder_that_is_not_there),
        cmocka_unit_test(test_out_of_memory),              cmocka_unit_test(test_verdicts_of_runs),
        cmocka_unit_test(test_verdicts_of_runs_that_went_wrong), cmocka_unit_test(test_verdicts_of_the_method_asynchronous),
        cmocka_unit_test(test_verdicts_of_the_method_mass_spring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
