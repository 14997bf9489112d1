/* Figures of claims: what fails the test that reports them, by one unit in the last place, and what they write for the ledger. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/json_number.h"
#include "support/claim.h"
#include "support/every_kind.h"

typedef struct figure {
    double measured, low, high;
    claim_relation relation;
    bool within;
} figure;

static void report(void **state)
{
    const figure *f = *state;
    const char *const claim = "X1"; /* of no paper: ci/claims --check looks for literal names */
    if (f->within) claim_within(claim, "what", f->measured, "m", f->low, f->high);
    else claim_figure(claim, "what", f->measured, "m", f->relation, f->low);
}

/* A test that reports the figure, run in a process of its own: did it pass? */
static bool passes(const figure *f)
{
    fflush(stdout);
    fflush(stderr);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (freopen("/dev/null", "w", stdout) == NULL || freopen("/dev/null", "w", stderr) == NULL) _exit(99);
        const struct CMUnitTest one[] = {{"report", report, NULL, NULL, (void *)(uintptr_t)f}};
        _exit(cmocka_run_group_tests(one, NULL, NULL));
    }
    int status = 0;
    assert_true(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) <= 1);
    return WEXITSTATUS(status) == 0;
}

static void test_relations(void **state)
{
    (void)state;
    const double t = 0.1, below = nextafter(t, 0), above = nextafter(t, 1);
    const struct {
        claim_relation relation;
        bool below, at, above;
    } cases[] = {
        {CLAIM_LESS, true, false, false}, {CLAIM_AT_MOST, true, true, false}, {CLAIM_MORE, false, false, true}, {CLAIM_AT_LEAST, false, true, true}, {CLAIM_EQUAL, false, true, false},
    };
    unsetenv("CIPC_CLAIMS");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(passes(&(figure){below, t, 0, cases[i].relation, false}), cases[i].below);
        assert_int_equal(passes(&(figure){t, t, 0, cases[i].relation, false}), cases[i].at);
        assert_int_equal(passes(&(figure){above, t, 0, cases[i].relation, false}), cases[i].above);
        assert_false(passes(&(figure){NAN, t, 0, cases[i].relation, false}));
        assert_false(passes(&(figure){t, NAN, 0, cases[i].relation, false}));
    }
}

static void test_within(void **state)
{
    (void)state;
    unsetenv("CIPC_CLAIMS");
    assert_true(passes(&(figure){nextafter(1, 2), 1, 2, CLAIM_LESS, true}));
    assert_true(passes(&(figure){nextafter(2, 1), 1, 2, CLAIM_LESS, true}));
    assert_false(passes(&(figure){1, 1, 2, CLAIM_LESS, true}));
    assert_false(passes(&(figure){2, 1, 2, CLAIM_LESS, true}));
    assert_false(passes(&(figure){NAN, 1, 2, CLAIM_LESS, true}));
}

/* A figure that fails is in the file too: the ledger shows it. */
static void test_lines(void **state)
{
    (void)state;
    const path folder = folder_make(), file = path_in(&folder, "figures.jsonl");
    setenv("CIPC_CLAIMS", file.text, 1);
    const double third = 1.0 / 3;
    assert_true(passes(&(figure){third, 0.5, 0, CLAIM_LESS, false}));
    assert_false(passes(&(figure){INFINITY, 0.5, 0, CLAIM_LESS, false}));
    assert_true(passes(&(figure){third, 0, 1, CLAIM_LESS, true}));
    setenv("CIPC_CLAIMS", "/no/such/folder/figures.jsonl", 1);
    assert_false(passes(&(figure){third, 0.5, 0, CLAIM_LESS, false}));
    unsetenv("CIPC_CLAIMS");
    FILE *stream = fopen(file.text, "r");
    assert_non_null(stream);
    const double measured[] = {third, INFINITY, third};
    for (int i = 0; i < 3; i++) {
        json_t *line = json_loadf(stream, JSON_DISABLE_EOF_CHECK, NULL);
        assert_non_null(line);
        assert_string_equal(json_string_value(json_object_get(line, "claim")), "X1");
        assert_string_equal(json_string_value(json_object_get(line, "figure")), "what");
        assert_string_equal(json_string_value(json_object_get(line, "unit")), "m");
        assert_string_equal(json_string_value(json_object_get(line, "relation")), i < 2 ? "<" : "within");
        assert_true(cipc_json_double(json_object_get(line, "measured")) == measured[i]);
        assert_true(cipc_json_double(json_object_get(line, i < 2 ? "threshold" : "high")) == (i < 2 ? 0.5 : 1));
        json_decref(line);
    }
    assert_int_equal(fgetc(stream), '\n');
    assert_int_equal(fgetc(stream), EOF);
    fclose(stream);
    folder_remove(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_relations), cmocka_unit_test(test_within), cmocka_unit_test(test_lines)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
