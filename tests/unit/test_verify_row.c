/* Rows of reports: what they count, how they merge, and every way in which they fail. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "verify/row.h"

static const cipc_query query = {.fn = "distance2_point_point", .x = {1, 2, 3, 4, 5, 6}};

/* Two counters (one forbidden, one a branch), a maximum, a histogram. */
static void describe(verify_row *row)
{
    verify_row_init(row, "a row");
    verify_row_forbid(row, "wrong");
    verify_row_branch(row, "left", 0.25);
    verify_row_maximum(row, "error", 4);
    verify_row_histogram(row, "ratio");
}

static void assert_failure(const verify_row *row, bool whole, const char *part)
{
    char text[256];
    bool failed = verify_row_failure(row, whole, text, sizeof text);
    if (part == NULL) {
        if (failed) fail_msg("%s", text);
    } else if (!failed || strstr(text, part) == NULL) {
        fail_msg("wanted \"%s\", got \"%s\"", part, failed ? text : "no failure");
    }
}

static verify_row good_row(void)
{
    verify_row row;
    describe(&row);
    row.samples = 8;
    for (int i = 0; i < 2; i++) verify_count(&row, 1, i, NULL);
    verify_measure(&row, 0, 3.5, 5, &query);
    return row;
}

static void test_verdicts(void **state)
{
    (void)state;
    verify_row row = good_row();
    assert_failure(&row, true, NULL);
    row.samples = 12; /* a quarter of it is 3 */
    assert_failure(&row, true, "branch left was reached 2 times, at least 3");
    assert_failure(&row, false, NULL); /* a shard does not judge minima */
    row = good_row();
    verify_count(&row, 0, 7, &query);
    assert_failure(&row, false, "wrong: 1 times, first in sample 7");
    row = good_row();
    verify_measure(&row, 0, nextafter(4, 5), 6, &query);
    assert_failure(&row, false, "error is 4, more than 4, in sample 6");
    row = good_row();
    verify_measure(&row, 0, NAN, 6, &query);
    assert_failure(&row, true, "error is nan");
    describe(&row);
    assert_failure(&row, true, "no sample was run");
    assert_failure(&row, false, NULL);
    row.samples = 1; /* a branch with any share at all must be reached at least once */
    assert_failure(&row, true, "at least 1 are asked for");
}

static void test_first_and_largest_are_kept(void **state)
{
    (void)state;
    verify_row row;
    describe(&row);
    verify_count(&row, 0, 9, &query);
    verify_count(&row, 0, 4, &query);
    verify_count(&row, 0, 6, &query);
    assert_true(row.counters[0].count == 3 && row.counters[0].sample == 4);
    verify_measure(&row, 0, 1, 9, &query);
    verify_measure(&row, 0, 2, 8, &query);
    verify_measure(&row, 0, 2, 3, &query);
    verify_measure(&row, 0, 2, 5, &query);
    assert_true(row.maxima[0].value == 2 && row.maxima[0].sample == 3);
    verify_measure(&row, 0, NAN, 20, &query);
    verify_measure(&row, 0, INFINITY, 1, &query);
    assert_true(isnan(row.maxima[0].value) && row.maxima[0].sample == 20);
}

/* The same in whatever order the parts come. */
static void test_merging(void **state)
{
    (void)state;
    verify_row parts[3], ahead, back, whole;
    describe(&whole);
    for (int p = 0; p < 3; p++) describe(&parts[p]);
    for (long i = 0; i < 90; i++) {
        verify_row *rows[2] = {&whole, &parts[i % 3]};
        for (int k = 0; k < 2; k++) {
            rows[k]->samples++;
            if (i % 7 == 5) verify_count(rows[k], 0, i, &query);
            if (i % 2) verify_count(rows[k], 1, i, NULL);
            verify_measure(rows[k], 0, (double)((i * 37) % 50), i, &query);
            verify_ratio(rows[k], 0, (double)i / 80);
        }
    }
    describe(&ahead);
    describe(&back);
    for (int p = 0; p < 3; p++) {
        assert_true(verify_row_merge(&ahead, &parts[p]));
        assert_true(verify_row_merge(&back, &parts[2 - p]));
    }
    assert_memory_equal(&ahead, &whole, sizeof whole);
    assert_memory_equal(&back, &whole, sizeof whole);
    verify_row other;
    verify_row_init(&other, "a row");
    assert_false(verify_row_merge(&ahead, &other));
}

static void test_percentiles(void **state)
{
    (void)state;
    verify_row row;
    describe(&row);
    assert_true(isnan(verify_percentile(&row.histograms[0], 0.5)));
    for (int i = 0; i < 100; i++) verify_ratio(&row, 0, 0.01 * i);
    assert_true(fabs(verify_percentile(&row.histograms[0], 0.5) - 0.5) < 0.03);
    assert_true(verify_percentile(&row.histograms[0], 0.01) < 0.03);
    verify_ratio(&row, 0, 1e9); /* beyond the last bin, before the first: kept at the ends */
    verify_ratio(&row, 0, -1);
    assert_true(row.histograms[0].total == 102 && row.histograms[0].bins[VERIFY_BINS - 1] == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_first_and_largest_are_kept),
        cmocka_unit_test(test_merging),
        cmocka_unit_test(test_percentiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
