/* The progress line: one line, rewritten in place, readable whatever the numbers. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cipc/output.h"

typedef struct line { char text[512]; } line;

static line shown(double min_gap, double max_stretch, double seconds_left)
{
    line l = {{0}};
    FILE *terminal = tmpfile();
    assert_non_null(terminal);
    cipc_progress_line(terminal, 3, 100, 0.03, 12, 345, min_gap, max_stretch, seconds_left);
    rewind(terminal);
    assert_in_range(fread(l.text, 1, sizeof l.text - 1, terminal), 1, sizeof l.text - 1);
    fclose(terminal);
    assert_int_equal(l.text[0], '\r');
    assert_null(strchr(l.text, '\n'));
    return l;
}

static void assert_shows(const line *l, const char *part)
{
    if (strstr(l->text, part) == NULL) {
        fail_msg("no '%s' in '%s'", part, l->text);
    }
}

static void test_ordinary_numbers(void **state)
{
    (void)state;
    const line l = shown(1.25e-4, 1.0456, 65);
    static const char *const parts[] = {"step 3/100",     "t 0.03 s",       "newton 12", "contacts 345",
                                        "gap 1.25e-04 m", "stretch 1.0456", "left 1:05"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        assert_shows(&l, parts[i]);
    }
}

static void test_odd_numbers(void **state)
{
    (void)state;
    line l = shown(INFINITY, 1, 3725.6);
    assert_shows(&l, "gap -");
    assert_shows(&l, "left 1:02:06");
    l = shown(1e-3, NAN, NAN);
    assert_shows(&l, "left -");
    assert_shows(&l, "stretch -");
    l = shown(1e-3, 0, 1); /* nothing that could be stretched */
    assert_shows(&l, "stretch -");
    l = shown(1e-3, 1, INFINITY);
    assert_shows(&l, "left -");
    l = shown(1e-3, 1, -1);
    assert_shows(&l, "left -");
}

static void test_the_method_asynchronous(void **state)
{
    (void)state;
    const cipc_asynchronous_report reports[] = {{.total_events = 12345, .layers = 7, .contacts = 34, .smallest_step = 2.5e-6}, {.smallest_step = INFINITY}};
    static const char *const parts[2][7] = {{"step 3/100", "t 0.03 s", "events 12345", "layers 7  contacts 34", "least step 2.50e-06 s", "gap 1.25e-04 m", "left 1:05"},
                                            {"\r\033[K", "events 0", "layers 0  contacts 0", "least step -", "gap -", "left -", ""}};
    for (int i = 0; i < 2; i++) {
        line l = {{0}};
        FILE *terminal = tmpfile();
        cipc_asynchronous_progress_line(terminal, 3, 100, 0.03, &reports[i], i == 0 ? 1.25e-4 : INFINITY, i == 0 ? 65 : NAN);
        rewind(terminal);
        assert_in_range(fread(l.text, 1, sizeof l.text - 1, terminal), 1, sizeof l.text - 1);
        fclose(terminal);
        assert_null(strchr(l.text, '\n'));
        for (int k = 0; k < 7; k++) assert_shows(&l, parts[i][k]);
    }
}

static void test_the_method_mass_spring(void **state)
{
    (void)state;
    const cipc_massspring_report report = {.substeps = 21, .contacts = 34, .hits = 55, .deformation = 0.0625};
    const cipc_massspring_times times[] = {{.frame = 0.5, .step = 0.25}, {.frame = 0.5}};
    static const char *const parts[2][6] = {{"step 3/100", "t 0.03 s", "substeps 21  contacts 34  hits 55", "deformation 0.0625", "real time 2.00e+00 x", "left 1:05"},
                                            {"\r\033[K", "", "", "", "real time -", "left -"}};
    for (int i = 0; i < 2; i++) {
        line l = {{0}};
        FILE *terminal = tmpfile();
        cipc_massspring_progress_line(terminal, 3, 100, 0.03, &report, &times[i], i == 0 ? 65 : NAN);
        rewind(terminal);
        assert_in_range(fread(l.text, 1, sizeof l.text - 1, terminal), 1, sizeof l.text - 1);
        fclose(terminal);
        for (int k = 0; k < 6; k++) assert_shows(&l, parts[i][k]);
    }
}

static void test_clear(void **state)
{
    (void)state;
    char text[16] = {0};
    FILE *terminal = tmpfile();
    cipc_progress_clear(terminal);
    rewind(terminal);
    assert_int_equal(fread(text, 1, sizeof text - 1, terminal), 4);
    assert_string_equal(text, "\r\033[K");
    fclose(terminal);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ordinary_numbers),
        cmocka_unit_test(test_odd_numbers),
        cmocka_unit_test(test_the_method_asynchronous),
        cmocka_unit_test(test_the_method_mass_spring),
        cmocka_unit_test(test_clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
