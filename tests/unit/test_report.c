/* Reports: to JSON and back, joined from shards as if from one run, and refused when they do not belong together. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "verify/report.h"

static const verify_campaign *const campaigns[2] = {&verify_distance, &verify_toi};

/* A report of one shard of two small campaigns. */
static void run_shard(verify_report *report, int shard, int shards, unsigned long seed)
{
    const verify_run run = {.seed = seed, .samples = 600, .shard = shard, .shards = shards, .threads = 1};
    memset(report, 0, sizeof *report);
    report->seed = seed;
    report->samples = 600;
    report->shards = shards;
    report->shards_done = 1ULL << (shard - 1);
    for (int c = 0; c < 2; c++) {
        verify_row *rows = verify_report_add(report, campaigns[c]->name, campaigns[c]->row_count);
        for (int i = 0; i < campaigns[c]->row_count; i++) assert_int_equal(verify_run_row(campaigns[c], i, &run, &rows[i], NULL), CIPC_OK);
    }
}

static char *dump(const verify_report *report)
{
    json_t *json = verify_report_json(report, json_object());
    assert_non_null(json);
    char *text = json_dumps(json, JSON_SORT_KEYS | JSON_REAL_PRECISION(17));
    json_decref(json);
    return text;
}

/* Through JSON into *into. */
static cipc_status join(verify_report *into, const verify_report *from, cipc_error *error)
{
    json_t *json = verify_report_json(from, json_object());
    cipc_status status = verify_report_merge(into, json, "part.json", error);
    json_decref(json);
    return status;
}

static void test_shards_make_the_whole(void **state)
{
    (void)state;
    verify_report *r = test_calloc(4, sizeof *r), *whole = &r[3];
    cipc_error error;
    run_shard(whole, 1, 1, 5);
    whole->shards = 3; /* what one run of three shards would be called */
    whole->shards_done = 7;
    memset(&r[2], 0, sizeof r[2]);
    for (int shard = 3; shard >= 1; shard--) {
        run_shard(&r[0], shard, 3, 5);
        assert_false(verify_report_whole(&r[2]) && shard < 3);
        assert_int_equal(join(&r[2], &r[0], &error), CIPC_OK);
        verify_report_free(&r[0]);
    }
    assert_true(verify_report_whole(&r[2]));
    char *want = dump(whole), *got = dump(&r[2]);
    assert_string_equal(got, want);
    free(want);
    free(got);
    verify_report_free(whole);
    verify_report_free(&r[2]);
    test_free(r);
}

static void test_what_does_not_belong_together(void **state)
{
    (void)state;
    verify_report *r = test_calloc(3, sizeof *r);
    cipc_error error;
    run_shard(&r[0], 1, 2, 5);
    assert_int_equal(join(&r[2], &r[0], &error), CIPC_OK);
    assert_int_equal(join(&r[2], &r[0], &error), CIPC_E_BAD_QUERY); /* twice the same shard */
    assert_non_null(strstr(error.what, "there already"));
    run_shard(&r[1], 2, 2, 6);
    assert_int_equal(join(&r[2], &r[1], &error), CIPC_E_BAD_QUERY);
    assert_non_null(strstr(error.what, "seed"));
    verify_report_free(&r[1]);
    run_shard(&r[1], 2, 2, 5);
    r[1].campaigns[1].rows[0].counters[0].name[0] = 'X';
    assert_int_equal(join(&r[2], &r[1], &error), CIPC_E_BAD_QUERY);
    assert_non_null(strstr(error.what, "rows are others"));
    assert_false(verify_report_whole(&r[2]));
    for (int i = 0; i < 3; i++) verify_report_free(&r[i]);
    test_free(r);
}

static void test_malformed_reports(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "[]", "{}", "{\"campaigns\": []}", "{\"campaigns\": [{}], \"shards\": 1}", "{\"campaigns\": [{\"campaign\": \"x\", \"rows\": [{}]}], \"shards\": 0}",
        "{\"campaigns\": [{\"campaign\": \"x\", \"rows\": [{}]}], \"shards\": 1, \"shards_done\": [2]}",
        "{\"campaigns\": [{\"campaign\": \"x\", \"rows\": [{\"name\": \"\"}]}], \"shards\": 1}",
        "{\"campaigns\": [{\"campaign\": \"x\", \"rows\": [{\"name\": \"r\", \"histograms\": [{\"bins\": [1]}]}]}], \"shards\": 1}",
        "{\"campaigns\": [{\"campaign\": \"x\", \"rows\": [{\"name\": \"r\", \"counters\": [{\"query\": {\"fn\": \"none\"}}]}]}], \"shards\": 1}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        verify_report *r = test_calloc(1, sizeof *r);
        cipc_error error;
        json_t *json = json_loads(texts[i], 0, NULL);
        assert_non_null(json);
        assert_int_equal(verify_report_merge(r, json, "bad.json", &error), CIPC_E_BAD_QUERY);
        assert_non_null(strstr(error.place, "bad.json"));
        json_decref(json);
        verify_report_free(r);
        test_free(r);
    }
}

/* No campaign at all is a failure; and a failing row is named in words and in JSON, with a replayable query. */
static void test_failures_are_told(void **state)
{
    (void)state;
    verify_report *r = test_calloc(1, sizeof *r);
    r->shards = 1;
    r->shards_done = 1;
    assert_int_equal(verify_report_failures(r, NULL), 1);
    run_shard(r, 1, 1, 5);
    const int before = verify_report_failures(r, NULL); /* so few samples need not reach every branch */
    verify_row *row = &r->campaigns[1].rows[3];
    const cipc_query query = {.fn = "toi_point_point", .x = {1}, .x1 = {-1}, .scale = 0.1};
    verify_count(row, 0, 11, &query);
    assert_int_equal(verify_report_failures(r, NULL), before + 1);
    char *text = dump(r), line[4096] = "";
    assert_non_null(strstr(text, "\"verdict\": \"failed\""));
    assert_non_null(strstr(text, "\"failure\": "));
    free(text);
    FILE *file = tmpfile();
    assert_int_equal(verify_report_worst(r, file, NULL), CIPC_OK);
    rewind(file);
    bool found = false;
    while (!found && fgets(line, sizeof line, file) != NULL) found = strstr(line, "toi_point_point") != NULL && strstr(line, "unsafe") != NULL;
    assert_true(found);
    fclose(file);
    verify_report_free(r);
    test_free(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shards_make_the_whole),
        cmocka_unit_test(test_what_does_not_belong_together),
        cmocka_unit_test(test_malformed_reports),
        cmocka_unit_test(test_failures_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
